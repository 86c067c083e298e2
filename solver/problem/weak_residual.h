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
#include "solver/problem/scalar.h"

namespace stiction {

template <class Scalar, class Vector>
Scalar WeakResidual(const ContactProblem<Scalar>& problem, const Vector& f, const Vector& a) {
  using std::hypot;
  Scalar max_A = 0, max_b = 0, max_f = 0, worst = 0, zero = 0;
  for (int i = 0; i < problem.rows(); ++i) {
    zero += (f[i] - f[i]) + (a[i] - a[i]);  // of finite numbers only
    max_A = std::max(max_A, problem.A(i, i));
    max_b = std::max(max_b, Abs(problem.b[i]));
    max_f = std::max(max_f, Abs(Scalar(f[i])));
  }
  if (zero != 0) return zero;  // maxima pass over what is not a number
  const Scalar r = max_A > 0 ? 1 / max_A : Scalar(1);
  int row = 0;
  for (const auto& contact : problem.contacts) {
    const Scalar fN = f[row];
    const bool bilateral = contact.kind == ContactKind::kBilateral;
    worst = std::max(
        worst, Abs(bilateral ? Scalar(r * a[row]) : Scalar(fN - std::max(Scalar(0), Scalar(fN - r * a[row])))));
    if (contact.kind == ContactKind::kSliding) {
      const Scalar limit = contact.mu * fN;
      worst =
          std::max(worst, hypot(f[row + 1] + limit * contact.slip[0], f[row + 2] + limit * contact.slip[1]));
    } else if (contact.kind == ContactKind::kStatic) {
      const Scalar force = hypot(f[row + 1], f[row + 2]), answer = hypot(a[row + 1], a[row + 2]);
      const Scalar slack = contact.mu * fN - force;
      worst = std::max({worst, -slack, std::min(r * answer, slack)});
      if (force > 0) worst = std::max(worst, r * (f[row + 1] * a[row + 1] + f[row + 2] * a[row + 2]) / force);
    }
    row += contact.HasFrictionRows() ? 3 : 1;
  }
  const Scalar scale = std::max(max_f, max_b * r);
  return scale > 0 ? worst / scale : worst;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_PROBLEM_WEAK_RESIDUAL_H_
