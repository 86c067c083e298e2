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
// fF.aF <= 0. The law itself is that of errors.h. Shapes: f, a rows x 1; a = A f + b, known to `noise`, m/s^2:
// an acceleration misses only what is beyond it, and aF turns towards fF by as much.

#pragma once

#include <algorithm>
#include <array>

#include "solver/problem/errors.h"
#include "solver/problem/units.h"

namespace stiction {

// What the law asks of a measure, and of friction.
template <class Scalar>
class LenientMeasure {
 public:
  LenientMeasure(const LenientUnits<Scalar>& units, FrictionLaw law, const Scalar& noise)
      : units_(units), law_(law), noise_(noise) {}

  const Scalar& unit(int row) const { return units_.acceleration(row); }
  const Scalar& FrictionUnit(int contact, const Scalar&) const { return units_.friction(contact); }
  Scalar OfRow(const Scalar& x, int row) const { return InUnits(Beyond(x), unit(row)); }
  Scalar OfTangents(const std::array<Scalar, 2>& x, int row, int) const {
    return InUnits(Beyond(Length(x[0], x[1])), unit(row + 1));
  }
  Scalar OfFriction(const Scalar& x, const Scalar& unit) const { return InUnits(x, unit); }
  template <class Problem, class Vector>
  Scalar OfForce(const Problem&, const Vector& f, int row) const {
    return InUnits(Scalar(Abs(Scalar(f[row]))), units_.force(row));
  }
  template <class Problem, class Vector>
  Scalar OfForces(const Problem& problem, const Vector& f, int i, int row,
                  const NearestMode<Scalar>& touching) const {
    const auto& contact = problem.contacts[i];
    const Scalar normal = OfForce(problem, f, row);
    if (!contact.HasFrictionRows()) return normal;
    if (contact.kind == ContactKind::kSliding) return std::max(normal, touching.friction);
    return std::max(normal, InUnits(TangentLength(f, row, problem.dimension), units_.force(row + 1)));
  }

  Scalar Excess(int, const FrictionAt<Scalar>& at) const { return BeyondDisc(at); }
  // All of it by its force.
  SlipMiss<Scalar> Slip(int, FrictionAt<Scalar> at) const {
    TakeNoise(at);
    SlipMiss<Scalar> miss{Infinity<Scalar>(), {Scalar(0), Scalar(0)}};
    const Scalar speed = Length(at.a[0], at.a[1]);
    if (!(speed > 0)) return miss;
    if (law_ == FrictionLaw::kBaraff && !at.on_line) {
      const Scalar power = (at.f[0] * at.a[0] + at.f[1] * at.a[1]) / speed;
      miss.force = std::max(OffDisc(at), power);
      return miss;
    }
    miss.force =
        Length(Scalar(at.f[0] + at.limit * (at.a[0] / speed)), Scalar(at.f[1] + at.limit * (at.a[1] / speed)));
    if (!at.on_line) miss.force = std::min(miss.force, OffSlowSlip(at));  // there it gains nothing
    return miss;
  }

 private:
  Scalar Beyond(const Scalar& x) const { return std::max(Scalar(0), Scalar(x - noise_)); }
  // As much of what aF has across fF as may be noise.
  void TakeNoise(FrictionAt<Scalar>& at) const {
    const Scalar length = Length(at.f[0], at.f[1]);
    if (!(noise_ > 0) || !(length > 0)) return;
    const std::array<Scalar, 2> across = {Scalar(-at.f[1] / length), Scalar(at.f[0] / length)};
    const Scalar x = across[0] * at.a[0] + across[1] * at.a[1];
    const Scalar less = x > 0 ? std::min(x, noise_) : std::max(x, Scalar(-noise_));
    for (int k = 0; k < 2; ++k) at.a[k] -= less * across[k];
  }
  static Scalar OffSlowSlip(const FrictionAt<Scalar>& at) {
    const Scalar &L = at.force_unit, &s = at.unit[0];
    if (!(s > 0) || !(L > 0) || !(L < Infinity<Scalar>())) return Infinity<Scalar>();
    const Scalar r = L / s;
    Scalar x = at.f[0] - r * at.a[0], y = at.f[1] - r * at.a[1];
    const Scalar length = Length(x, y);
    if (length > at.limit) {
      x *= at.limit / length;
      y *= at.limit / length;
    }
    return Length(Scalar(at.f[0] - x), Scalar(at.f[1] - y));
  }

  const LenientUnits<Scalar>& units_;
  FrictionLaw law_;
  Scalar noise_;
};

// The largest of all contacts, and where; of numbers that are not finite it is infinite. `units` is written:
// its memory is kept between calls.
template <class Scalar>
struct LenientError {
  Scalar error = Scalar(0);
  int contact = -1;
};
template <class Problem, class Vector>
auto MeasureLeniently(const Problem& problem, FrictionLaw law, const Vector& f, const Vector& a,
                      LenientUnits<typename Vector::Scalar>& units,
                      const typename Vector::Scalar& noise = typename Vector::Scalar(0)) {
  using Scalar = typename Vector::Scalar;
  LenientError<Scalar> worst;
  if (!AreFinite(f, a)) {
    worst.error = Infinity<Scalar>();
    return worst;
  }
  units.Take(problem, f);
  const LenientMeasure<Scalar> measure(units, law, noise);
  ForEachContact(problem, [&](int i, int row, int) {
    const Scalar error = NearestModeOf(problem, f, a, i, row, measure, measure).error;
    if (error > worst.error) worst = {error, i};
  });
  return worst;
}
template <class Problem, class Vector>
auto MeasureLeniently(const Problem& problem, FrictionLaw law, const Vector& f, const Vector& a) {
  LenientUnits<typename Vector::Scalar> units;
  return MeasureLeniently(problem, law, f, a, units);
}

}  // namespace stiction
