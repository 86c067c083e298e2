// SPDX-License-Identifier: Apache-2.0
// The natural residual of planar contacts (problem/residual.h) in space, friction with a polygon in place of
// the interval:
//
//   normal     abs(fN - max(0, fN - r aN))
//   friction   abs(fF - the nearest point of mu max(0, fN) times the polygon to fF - r aF), by component
//   sliding    abs(fF + mu fN slip), by component           bilateral   abs(r aN)
//
// which vanish together exactly at the solutions of the law on polygons (complete.h). r = 1 / max A_ii;
// the largest of these, relative to max abs(b) / max A_ii. Shapes: f, a rows x 1; one polygon per contact.

#ifndef STICTION_SOLVER_COMPLETE_POLYGON_RESIDUAL_H_
#define STICTION_SOLVER_COMPLETE_POLYGON_RESIDUAL_H_

#include <algorithm>
#include <vector>

#include "solver/complete/polygon.h"
#include "solver/problem/problem.h"

namespace stiction {

// Where the law wants the friction of the contact whose normal is in `row`.
template <class Scalar, class Vector>
Planar<Scalar> WantedFriction(const Contact<Scalar>& contact, const FrictionPolygon<Scalar>& polygon,
                              const Vector& f, const Vector& a, int row, const Scalar& r) {
  if (contact.kind == ContactKind::kSliding) {
    const Scalar limit = contact.mu * f[row];
    return {Scalar(-limit * contact.slip[0]), Scalar(-limit * contact.slip[1])};
  }
  const Scalar radius = contact.mu * std::max<Scalar>(Scalar(0), f[row]);
  if (Sign(radius) == 0) return {Scalar(0), Scalar(0)};
  return polygon.Project({Scalar(f[row + 1] - r * a[row + 1]), Scalar(f[row + 2] - r * a[row + 2])}, radius);
}

// Problem: a ContactProblem of dimension 3. Not a number if a force or an acceleration is not finite.
template <class Problem, class Scalar, class Vector>
Scalar PolygonResidual(const Problem& problem, const std::vector<FrictionPolygon<Scalar>>& polygons,
                       const Vector& f, const Vector& a) {
  const Scalar nothing(0);
  Scalar max_A(0), max_b(0), worst(0), zero(0);
  for (int i = 0; i < problem.rows(); ++i) {
    zero += (f[i] - f[i]) + (a[i] - a[i]);  // of finite numbers only
    max_A = std::max<Scalar>(max_A, problem.A(i, i));
    max_b = std::max<Scalar>(max_b, Abs(problem.b[i]));
  }
  if (zero != 0) return zero;  // maxima pass over what is not a number
  const Scalar r = max_A > 0 ? Scalar(1 / max_A) : Scalar(1);
  int row = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const Contact<Scalar>& contact = problem.contacts[i];
    const bool bilateral = contact.kind == ContactKind::kBilateral;
    const Scalar free =
        bilateral ? Scalar(f[row] - r * a[row]) : std::max<Scalar>(nothing, Scalar(f[row] - r * a[row]));
    worst = std::max<Scalar>(worst, Abs(Scalar(f[row] - free)));
    if (contact.HasFrictionRows()) {
      const Planar<Scalar> wanted = WantedFriction(contact, polygons[i], f, a, row, r);
      for (int c = 0; c < 2; ++c) worst = std::max<Scalar>(worst, Abs(Scalar(f[row + 1 + c] - wanted[c])));
    }
    row += contact.HasFrictionRows() ? 3 : 1;
  }
  return max_b > 0 ? Scalar(worst / (max_b * r)) : worst;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_COMPLETE_POLYGON_RESIDUAL_H_
