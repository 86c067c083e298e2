// SPDX-License-Identifier: Apache-2.0
// Natural residual: how far (f, a) is from the contact conditions. No tolerance inside.
//
//   normal     abs(fN - max(0, fN - r aN))
//   friction   abs(fF - clamp(fF - r aF, -mu fN, mu fN)),  fN replaced by max(0, fN)
//   sliding    abs(fF + mu u fN)                            instead of `friction` (24)
//   bilateral  abs(r a)                                     instead of `normal` (4.5)
//
// which vanish together exactly where (15), (16), (24) and (4.5) hold. r = 1 / max A_ii turns accelerations
// into forces; the result is relative to the larger of max abs(f) and max abs(b) / max A_ii. Shapes: f, a rows
// x 1. Planar problems. Allocates nothing. Not a number if a force or an acceleration is not finite.

#ifndef STICTION_SOLVER_RESIDUAL_H_
#define STICTION_SOLVER_RESIDUAL_H_

#include <algorithm>

#include "solver/problem.h"
#include "solver/scalar.h"

namespace stiction {

// The residual is worst / scale; scale is zero only where all forces and b are.
template <class Scalar>
struct Residual {
  Scalar worst = Scalar(0), scale = Scalar(0);
};

template <class Scalar, int Rows, class Vector>
Residual<Scalar> MeasureResidual(const ContactProblem<Scalar, Rows>& problem, const Vector& f,
                                 const Vector& a) {
  Scalar max_A(0), max_b(0), max_f(0), worst(0), zero(0);
  for (int i = 0; i < problem.rows(); ++i) {
    zero += (f[i] - f[i]) + (a[i] - a[i]);  // of finite numbers only
    max_A = std::max<Scalar>(max_A, problem.A(i, i));
    max_b = std::max<Scalar>(max_b, Abs(problem.b[i]));
    max_f = std::max<Scalar>(max_f, Abs(f[i]));
  }
  if (zero != 0) return {zero, zero};  // maxima pass over what is not a number
  const Scalar r = max_A > 0 ? Scalar(1 / max_A) : Scalar(1);
  int row = 0;
  for (const auto& contact : problem.contacts) {
    const bool bilateral = contact.kind == ContactKind::kBilateral;
    const Scalar normal =
        bilateral ? Scalar(f[row] - r * a[row]) : std::max<Scalar>(Scalar(0), f[row] - r * a[row]);
    worst = std::max<Scalar>(worst, Abs(Scalar(f[row] - normal)));
    if (contact.kind == ContactKind::kSliding) {
      worst = std::max<Scalar>(worst, Abs(Scalar(f[row + 1] + contact.mu * contact.slip[0] * f[row])));
      ++row;
    } else if (contact.HasFrictionRows()) {
      const Scalar bound = contact.mu * std::max<Scalar>(Scalar(0), f[row]);
      const Scalar wanted = f[row + 1] - r * a[row + 1];
      const Scalar friction = std::min<Scalar>(bound, std::max<Scalar>(Scalar(-bound), wanted));
      worst = std::max<Scalar>(worst, Abs(Scalar(f[row + 1] - friction)));
      ++row;
    }
    ++row;
  }
  return {worst, std::max<Scalar>(max_f, max_b * r)};
}

template <class Scalar, int Rows, class Vector>
Scalar NaturalResidual(const ContactProblem<Scalar, Rows>& problem, const Vector& f, const Vector& a) {
  const Residual<Scalar> residual = MeasureResidual(problem, f, a);
  return residual.scale > 0 ? Scalar(residual.worst / residual.scale) : residual.worst;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_RESIDUAL_H_
