// SPDX-License-Identifier: Apache-2.0
// Lenient errors of forces: what they miss in the largest units that a reader may wish for (units.h).
//
// Only they accuse: forces of another program are called *wrong* if their lenient error is above its accuracy,
// *solved* if their strict one (errors.h) is within it, and *neither* between the two. Forces that are off by a
// share x of the largest at their contact, and zero where that is zero, have a lenient error of at most 2 x.
//
//   separates   -aN / s_N,  abs(fN) / phi_N,  abs(fF) / phi_F
//   rests       abs(aN) / s_N,  -fN / phi_N,  abs(aF) / s_F,  (abs(fF) - mu fN) / L
//   slips       the first two of these, abs(fF + mu fN aF / abs(aF)) / L
//   slips slowly  the first two, abs(fF - p) / L, p the point of the disc nearest to fF - (L / s_F) aF
//
// each the largest of its line, the contact that of its least mode. By (21), (22) a slip has any direction with
// fF.aF
// <= 0. Shapes: f, a rows x 1; a = A f + b.

#ifndef STICTION_SOLVER_PROBLEM_LENIENT_H_
#define STICTION_SOLVER_PROBLEM_LENIENT_H_

#include <algorithm>
#include <array>

#include "solver/problem/errors.h"
#include "solver/problem/units.h"

namespace stiction {

namespace internal {

// The friction of a static contact that touches, in units L of force and s of acceleration.
template <class Scalar>
class LenientFriction {
 public:
  LenientFriction(const std::array<Scalar, 2>& f, const std::array<Scalar, 2>& a, const Scalar& limit,
                  const Scalar& L, const Scalar& s)
      : f_(f), a_(a), limit_(limit), L_(L), s_(s), force_(Length(f[0], f[1])), speed_(Length(a[0], a[1])) {}

  Scalar Error(FrictionLaw law, bool on_line) const {
    Scalar least = std::max(InUnits(speed_, s_), InUnits(std::max(Scalar(0), Scalar(force_ - limit_)), L_));
    if (!(speed_ > 0) || !(limit_ < Infinity<Scalar>())) return least;
    if (law == FrictionLaw::kBaraff && !on_line) return std::min(least, FreeSlip());
    const Scalar x = f_[0] + limit_ * (a_[0] / speed_), y = f_[1] + limit_ * (a_[1] / speed_);
    least = std::min(least, InUnits(Length(x, y), L_));
    return on_line ? least : std::min(least, SlowSlip());  // on a line a slow slip gains nothing
  }

 private:
  Scalar FreeSlip() const {
    const Scalar power = (f_[0] * a_[0] + f_[1] * a_[1]) / speed_;
    return InUnits(std::max(Scalar(Abs(Scalar(force_ - limit_))), power), L_);
  }
  Scalar SlowSlip() const {
    if (!(s_ > 0) || !(L_ > 0) || !(L_ < Infinity<Scalar>())) return Infinity<Scalar>();
    const Scalar r = L_ / s_;
    Scalar x = f_[0] - r * a_[0], y = f_[1] - r * a_[1];
    const Scalar length = Length(x, y);
    if (length > limit_) {
      x *= limit_ / length;
      y *= limit_ / length;
    }
    return InUnits(Length(Scalar(f_[0] - x), Scalar(f_[1] - y)), L_);
  }

  std::array<Scalar, 2> f_, a_;
  Scalar limit_, L_, s_, force_, speed_;
};

}  // namespace internal

// Of one contact, its normal in `row`.
template <class Problem, class Vector, class Scalar>
Scalar LenientErrorOf(const Problem& problem, FrictionLaw law, const LenientUnits<Scalar>& units,
                      const Vector& f, const Vector& a, int i, int row) {
  const auto& contact = problem.contacts[i];
  const Scalar fN = f[row], aN = a[row];
  const auto accelerates = [&](const Scalar& x) {
    return x > 0 ? InUnits(x, units.acceleration(row)) : Scalar(0);
  };
  const auto forces = [&](const Scalar& x) { return x > 0 ? InUnits(x, units.force(row)) : Scalar(0); };
  if (contact.kind == ContactKind::kBilateral) return accelerates(Abs(aN));
  Scalar open = std::max(accelerates(Scalar(-aN)), forces(Abs(fN)));
  Scalar closed = std::max(accelerates(Abs(aN)), forces(Scalar(-fN)));
  if (!contact.HasFrictionRows()) return std::min(open, closed);
  const int count = problem.dimension;
  std::array<Scalar, 2> force = {Scalar(0), Scalar(0)}, speed = force, missed = force;
  const Scalar limit = Limit(Scalar(contact.mu), fN);
  for (int k = 0; k + 1 < count; ++k) {
    force[k] = f[row + 1 + k];
    speed[k] = a[row + 1 + k];
    missed[k] = force[k] + Scalar(contact.slip[k]) * limit;
  }
  if (contact.kind == ContactKind::kSliding) {
    const Scalar miss = InUnits(Length(missed[0], missed[1]), units.friction(i));
    return std::max(miss, std::min(open, closed));
  }
  open = std::max(open, InUnits(Length(force[0], force[1]), units.force(row + 1)));
  const internal::LenientFriction<Scalar> friction(force, speed, limit, units.friction(i),
                                                   units.acceleration(row + 1));
  return std::min(open, std::max(closed, friction.Error(law, count == 2)));
}

// The largest of all contacts, and where; of numbers that are not finite it is infinite. `units` is written:
// its memory is kept between calls.
template <class Scalar>
struct LenientError {
  Scalar error = Scalar(0);
  int contact = -1;
};
template <class Problem, class Vector>
auto MeasureLeniently(const Problem& problem, FrictionLaw law, const Vector& f, const Vector& a,
                      LenientUnits<typename Vector::Scalar>& units) {
  using Scalar = typename Vector::Scalar;
  LenientError<Scalar> worst;
  Scalar zero(0);
  for (int i = 0; i < problem.rows(); ++i) zero += (f[i] - f[i]) + (a[i] - a[i]);
  if (!(zero == 0)) {
    worst.error = Infinity<Scalar>();
    return worst;
  }
  units.Take(problem, f);
  int row = 0;
  for (int i = 0; i < static_cast<int>(problem.contacts.size()); ++i) {
    const Scalar error = LenientErrorOf(problem, law, units, f, a, i, row);
    if (error > worst.error) worst = {error, i};
    row += RowsOf(problem.contacts[i], problem.dimension);
  }
  return worst;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_PROBLEM_LENIENT_H_
