// SPDX-License-Identifier: Apache-2.0
// Weak residual: how far (f, a) is from the conditions of section 5.6, which leave the direction of slip free.
// No tolerance inside.
//
//   (15)   abs(fN - max(0, fN - r aN))
//   (22)   max(0, abs(fF) - mu fN)
//   (21)   max(0, r fF.aF / abs(fF))
//          min(r abs(aF), max(0, mu fN - abs(fF)))       aF = 0 or abs(fF) = mu fN
//
// r = 1 / max A_ii turns accelerations into forces; the result, the largest of these, is relative to the larger
// of max abs(f) and max abs(b) / max A_ii. Bilateral contacts: abs(r aN) alone. Sliding ones: (15), and
// abs(fF + mu fN slip) (24). Shapes: f, a rows x 1. Problems in space, floating-point scalars. Not a number if
// a force or an acceleration is not finite.

#ifndef STICTION_SOLVER_PROBLEM_WEAK_RESIDUAL_H_
#define STICTION_SOLVER_PROBLEM_WEAK_RESIDUAL_H_

#include <algorithm>
#include <cmath>

#include "solver/problem/problem.h"
#include "solver/problem/residual.h"
#include "solver/problem/scalar.h"

namespace stiction {

template <class Scalar, class Vector>
auto MeasureWeak(const ContactProblem<Scalar>& problem, const Vector& f, const Vector& a) {
  using std::hypot;
  using Wide = typename Vector::Scalar;
  Residual<Wide> residual = MeasureScale(problem, f, a);
  if (!residual.is_finite) return residual;
  const Wide& r = residual.r;
  Wide& worst = residual.worst;
  int row = 0;
  for (const auto& contact : problem.contacts) {
    const Wide fN = f[row], mu = contact.mu;
    const bool bilateral = contact.kind == ContactKind::kBilateral;
    worst = std::max(worst,
                     Abs(bilateral ? Wide(r * a[row]) : Wide(fN - std::max(Wide(0), Wide(fN - r * a[row])))));
    if (contact.kind == ContactKind::kSliding) {
      const Wide limit = mu * fN;
      worst =
          std::max(worst, hypot(f[row + 1] + limit * contact.slip[0], f[row + 2] + limit * contact.slip[1]));
    } else if (contact.kind == ContactKind::kStatic) {
      const Wide force = hypot(f[row + 1], f[row + 2]), answer = hypot(a[row + 1], a[row + 2]);
      const Wide slack = mu * fN - force;
      worst = std::max({worst, -slack, std::min(r * answer, slack)});
      if (force > 0) worst = std::max(worst, r * (f[row + 1] * a[row + 1] + f[row + 2] * a[row + 2]) / force);
    }
    row += contact.HasFrictionRows() ? 3 : 1;
  }
  return residual;
}

template <class Scalar, class Vector>
typename Vector::Scalar WeakResidual(const ContactProblem<Scalar>& problem, const Vector& f, const Vector& a) {
  return MeasureWeak(problem, f, a).Relative();
}

}  // namespace stiction

#endif  // STICTION_SOLVER_PROBLEM_WEAK_RESIDUAL_H_
