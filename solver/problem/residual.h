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
//
// CoulombResidual is for Coulomb's law in space (and for all kinds of contacts):
//
//   static     abs(f - P(f - r (a + mu abs(aF) e_N))),  P the nearest point of the cone abs(fF) <= mu fN
//   sliding    the normal part as above, and abs(fF + mu fN slip)      bilateral    abs(r aN)
//
// The static part vanishes exactly where f is in the cone, F = a + mu abs(aF) e_N in its dual cone, and f.F =
// 0. Now F in the dual cone says aN >= 0; and f.F = fN aN + (mu fN abs(aF) + fF.aF), neither term negative. So
// it vanishes exactly where fN aN = 0 and, if fN > 0 and aF /= 0, fF = -mu fN aF / abs(aF): Coulomb's law.
// F is De Saxce's change of variables (cited from memory). The result is relative to max abs(b) / max A_ii
// alone: beside forces that grow without end, any violation would be small.

#ifndef STICTION_SOLVER_PROBLEM_RESIDUAL_H_
#define STICTION_SOLVER_PROBLEM_RESIDUAL_H_

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/problem/problem.h"
#include "solver/problem/scalar.h"

namespace stiction {

// The residual is worst / scale; scale is zero only where all forces and b are. worst / b_scale is the residual
// for methods whose forces can grow without end: beside such forces any violation would be small.
template <class Scalar>
struct Residual {
  Scalar worst = Scalar(0), scale = Scalar(0);
  Scalar b_scale = Scalar(0);  // max abs(b) / max A_ii
  Scalar r = Scalar(1);        // 1 / max A_ii
  bool is_finite = true;       // otherwise nothing else is meant

  Scalar Relative() const { return Over(scale); }
  Scalar RelativeToB() const { return Over(b_scale); }

 private:
  Scalar Over(const Scalar& size) const { return size > 0 ? Scalar(worst / size) : worst; }
};

// All but `worst`. Problem: a ContactProblem, or one with a sparse A; numbers of f and a may be wider than its.
template <class Problem, class Vector>
auto MeasureScale(const Problem& problem, const Vector& f, const Vector& a) {
  using Scalar = typename Vector::Scalar;
  Scalar max_A(0), max_b(0), max_f(0), zero(0);
  for (int i = 0; i < problem.rows(); ++i) {
    zero += (f[i] - f[i]) + (a[i] - a[i]);  // of finite numbers only; maxima pass over what is not a number
    max_A = std::max<Scalar>(max_A, problem.A.coeff(i, i));
    max_b = std::max<Scalar>(max_b, Abs(problem.b[i]));
    max_f = std::max<Scalar>(max_f, Abs(f[i]));
  }
  Residual<Scalar> residual;
  residual.is_finite = zero == 0;
  if (!residual.is_finite) residual.worst = residual.scale = residual.b_scale = zero;
  if (!residual.is_finite) return residual;
  if (max_A > 0) residual.r = 1 / max_A;
  residual.b_scale = max_b * residual.r;
  residual.scale = std::max<Scalar>(max_f, residual.b_scale);
  return residual;
}

template <class Problem, class Vector>
auto MeasureResidual(const Problem& problem, const Vector& f, const Vector& a) {
  using Scalar = typename Vector::Scalar;
  Residual<Scalar> residual = MeasureScale(problem, f, a);
  if (!residual.is_finite) return residual;
  const Scalar& r = residual.r;
  Scalar& worst = residual.worst;
  int row = 0;
  for (const auto& contact : problem.contacts) {
    // f - max(0, f - r a) is the smaller of f and r a, which rounding cannot cancel; likewise for friction.
    const Scalar shift = r * a[row];
    const bool bilateral = contact.kind == ContactKind::kBilateral;
    worst = std::max<Scalar>(worst, Abs(bilateral ? shift : std::min<Scalar>(f[row], shift)));
    if (contact.kind == ContactKind::kSliding) {
      worst = std::max<Scalar>(worst, Abs(Scalar(f[row + 1] + contact.mu * contact.slip[0] * f[row])));
    } else if (contact.HasFrictionRows()) {
      const Scalar bound = contact.mu * std::max<Scalar>(Scalar(0), f[row]);
      const Scalar least = f[row + 1] - bound, most = f[row + 1] + bound;
      const Scalar gap = std::min<Scalar>(most, std::max<Scalar>(least, r * a[row + 1]));
      worst = std::max<Scalar>(worst, Abs(gap));
    }
    row += contact.HasFrictionRows() ? 2 : 1;
  }
  return residual;
}

template <class Problem, class Vector>
typename Vector::Scalar NaturalResidual(const Problem& problem, const Vector& f, const Vector& a) {
  return MeasureResidual(problem, f, a).Relative();
}

// The nearest point of the cone of forces (fN, fF) in space with abs(fF) <= mu fN, mu >= 0.
template <class Scalar>
std::array<Scalar, 3> ProjectOnCone(const std::array<Scalar, 3>& x, const Scalar& mu) {
  using std::hypot;
  const Scalar length = hypot(x[1], x[2]);
  if (length <= mu * x[0]) return x;
  if (mu * length <= -x[0]) return {Scalar(0), Scalar(0), Scalar(0)};
  const Scalar normal = (x[0] + mu * length) / (1 + mu * mu);
  const Scalar along = length > 0 ? Scalar(mu * normal / length) : Scalar(0);
  return {normal, along * x[1], along * x[2]};
}

// Requires dimension 3 and floating-point scalars. Problem: as above.
template <class Problem, class Vector>
auto MeasureCoulomb(const Problem& problem, const Vector& f, const Vector& a) {
  using std::hypot;
  using Scalar = typename Vector::Scalar;
  Residual<Scalar> residual = MeasureScale(problem, f, a);
  if (!residual.is_finite) return residual;
  const Scalar& r = residual.r;
  int row = 0;
  for (const auto& contact : problem.contacts) {
    const Scalar mu = contact.mu;
    Scalar gap = Abs(Scalar(r * a[row]));
    if (contact.kind == ContactKind::kFrictionless || contact.kind == ContactKind::kSliding)
      gap = Abs(Scalar(f[row] - std::max(Scalar(0), f[row] - r * a[row])));
    if (contact.kind == ContactKind::kSliding) {
      const Scalar limit = mu * f[row];
      gap = hypot(gap, hypot(f[row + 1] + limit * contact.slip[0], f[row + 2] + limit * contact.slip[1]));
    }
    if (contact.kind == ContactKind::kStatic) {
      const Scalar shifted = a[row] + mu * hypot(a[row + 1], a[row + 2]);
      const std::array<Scalar, 3> wanted = ProjectOnCone<Scalar>(
          {f[row] - r * shifted, f[row + 1] - r * a[row + 1], f[row + 2] - r * a[row + 2]}, mu);
      gap = hypot(f[row] - wanted[0], hypot(f[row + 1] - wanted[1], f[row + 2] - wanted[2]));
    }
    residual.worst = std::max(residual.worst, gap);
    row += contact.HasFrictionRows() ? 3 : 1;
  }
  return residual;
}

template <class Problem, class Vector>
typename Vector::Scalar CoulombResidual(const Problem& problem, const Vector& f, const Vector& a) {
  return MeasureCoulomb(problem, f, a).RelativeToB();
}

}  // namespace stiction

#endif  // STICTION_SOLVER_PROBLEM_RESIDUAL_H_
