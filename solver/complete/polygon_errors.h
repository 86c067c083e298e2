// SPDX-License-Identifier: Apache-2.0
// Errors of forces (problem/errors.h) by the law on friction polygons: where a contact slips, the distance of
// fF from the nearest point of mu fN times the polygon to fF - r aF, which vanishes exactly where fF is a point
// of that polygon with the least fF.aF. Shapes: f, a rows x 1; one polygon per contact. Requires dimension 3.

#ifndef STICTION_SOLVER_COMPLETE_POLYGON_ERRORS_H_
#define STICTION_SOLVER_COMPLETE_POLYGON_ERRORS_H_

#include <vector>

#include "solver/complete/polygon.h"
#include "solver/problem/errors.h"

namespace stiction {

template <class Scalar>
FrictionGap<Scalar> GapOfPolygon(const FrictionPolygon<Scalar>& polygon, const FrictionAt<Scalar>& at) {
  const auto distance = [&](const Planar<Scalar>& x) {  // of fF, from the point of the polygon nearest to x
    const Planar<Scalar> p = polygon.Project(x, at.limit);
    return Length(Scalar(at.f[0] - p[0]), Scalar(at.f[1] - p[1]));
  };
  FrictionGap<Scalar> gap{distance(at.f), Infinity<Scalar>(), Infinity<Scalar>(), Infinity<Scalar>()};
  if (!(at.r > 0)) return gap;
  gap.moved_force = distance({Scalar(at.f[0] - at.r * at.a[0]), Scalar(at.f[1] - at.r * at.a[1])});
  gap.moved_acceleration = gap.moved_force / at.r;
  return gap;
}

template <class Problem, class Scalar, class Vector>
Errors<Scalar> PolygonErrors(const Problem& problem, const std::vector<FrictionPolygon<Scalar>>& polygons,
                             const Vector& f, const Vector& a) {
  Units<Scalar> units;
  return MeasureErrorsBy(problem, f, a, units, Scalar(0),
                         [&](int i, const FrictionAt<Scalar>& at) { return GapOfPolygon(polygons[i], at); });
}

}  // namespace stiction

#endif  // STICTION_SOLVER_COMPLETE_POLYGON_ERRORS_H_
