// SPDX-License-Identifier: Apache-2.0
// Errors of forces (problem/errors.h) by the law on friction polygons: where a contact slips, the distance of
// fF from the nearest point of mu fN times the polygon to fF - r aF, which vanishes exactly where fF is a point
// of that polygon with the least fF.aF. Shapes: f, a rows x 1; one polygon per contact. Requires dimension 3.

#pragma once

#include <vector>

#include "solver/complete/polygon.h"
#include "solver/problem/errors.h"

namespace stiction {

template <class Scalar>
struct FrictionInPolygon {
  const std::vector<FrictionPolygon<Scalar>>& polygons;

  Scalar Excess(int i, const FrictionAt<Scalar>& at) const { return Distance(i, at, {at.f[0], at.f[1]}); }
  // Where both may move: aF misses as much in its units.
  SlipMiss<Scalar> Slip(int i, const FrictionAt<Scalar>& at) const {
    const Scalar unit = std::max(at.unit[0], at.unit[1]);
    if (!(unit > 0)) return {Excess(i, at), {Scalar(0), Scalar(0)}};
    const Scalar r = at.limit / unit;
    const Planar<Scalar> x = {Scalar(at.f[0] - r * at.a[0]), Scalar(at.f[1] - r * at.a[1])};
    return {Distance(i, at, x), {Scalar(0), Scalar(0)}};
  }

 private:
  // Of fF, from the point of the polygon nearest to x.
  Scalar Distance(int i, const FrictionAt<Scalar>& at, const Planar<Scalar>& x) const {
    const Planar<Scalar> p = polygons[i].Project(x, at.limit);
    return Length(Scalar(at.f[0] - p[0]), Scalar(at.f[1] - p[1]));
  }
};

template <class Problem, class Scalar, class Vector>
Errors<Scalar> PolygonErrors(const Problem& problem, const std::vector<FrictionPolygon<Scalar>>& polygons,
                             const Vector& f, const Vector& a, const Scalar& theta) {
  ErrorMeter<Scalar> meter;
  return meter.Measure(problem, f, a, theta, FrictionInPolygon<Scalar>{polygons});
}

}  // namespace stiction
