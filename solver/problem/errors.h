// SPDX-License-Identifier: Apache-2.0
// Strict errors of forces: how far b, mu and A must move until the forces are an exact solution.
//
// With a = A f + b, S_i = sum_j abs(A_ij f_j) and a number theta, the unit of row i is
//
//   s_N = abs(b_N) + theta S_N,      s_T = abs(b_T) + theta S_T   (abs(b_T): of the tangents of a contact
//   together)
//
// A contact is in one of its modes:
//
//   separates   f = 0;  aN >= 0
//   rests       fN >= 0, abs(fF) <= mu fN;  aN = 0, aF = 0
//   slips       fN >= 0, abs(fF) = mu fN;   aN = 0, aF = -t fF with some t >= 0
//
// (bilateral: aN = 0; sliding: fF = -mu slip fN (24) and no condition on aF; frictionless: the first two lines
// for the normal alone; by (21), (22): fF.aF <= 0 in place of aF = -t fF.) What a condition on a row misses is
// told in units of the row, and what one on abs(fF) misses in units of mu fN: the error is the largest of both.
// Forces that a mode wants to be zero are taken for zero; what all of them do to a row is added to what the row
// misses, and is an error of every row.
//
// So, with eps = the error and tau = theta eps: **the forces, those taken for zero set to zero, satisfy every
// condition exactly for some b, mu and A that differ by at most eps abs(b), eps mu and tau abs(A), entry by
// entry** (for the tangents of a contact eps abs(b_T); for sliding contacts mu slip by eps mu). Proof: W.
// Oettli and W. Prager, 1964: a row that misses r may be mended by db_i = -x eps abs(b_i), dA_ij = -x tau
// abs(A_ij) sign f_j, x = r / (eps s_i). certify/exact/neighbour.h makes that problem, and holds the forces
// against it.
//
// Forces that are zero lend nothing to a unit; forces that only press against each other, a jam, lend theta
// times what they do to a row, as their rounding does. Neither A's symmetry nor its definiteness is needed, and
// mu is never divided by: it may be infinite. A -> D A D, b -> D b, f -> D^-1 f with a positive factor per
// contact changes no error. Errors are at most 1 / theta.
//
// On polygons (complete/polygon_errors.h) a slip is told by the distance of fF from the point of mu fN times
// the polygon that is nearest to fF - r aF, in units of mu fN, with r the ratio of mu fN and s_T.
//
// Shapes: f, a rows x 1. Rows whose acceleration is known to be off by at most E_i miss that much more.

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "solver/problem/options.h"
#include "solver/problem/problem.h"
#include "solver/problem/scalar.h"
#include "solver/problem/solution.h"
#include "solver/problem/units.h"

namespace stiction {

// Over rationals 2^65536: beyond products of four numbers of any other arithmetic.
template <class Scalar>
Scalar Infinity() {
  if constexpr (kIsExact<Scalar>) {
    static const Scalar huge = [] {
      Scalar x(2);
      for (int k = 0; k < 16; ++k) x *= Scalar(x);
      return x;
    }();
    return huge;
  } else {
    return std::numeric_limits<Scalar>::infinity();
  }
}

// x in units, also infinite ones.
template <class Scalar>
Scalar InUnits(const Scalar& x, const Scalar& unit) {
  if (x == 0) return Scalar(0);
  return unit > 0 && x < Infinity<Scalar>() ? Scalar(x / unit) : Infinity<Scalar>();
}

template <class Vector>
bool AreFinite(const Vector& f, const Vector& a) {
  typename Vector::Scalar zero(0);
  for (int i = 0; i < f.size(); ++i) zero += (f[i] - f[i]) + (a[i] - a[i]);  // of finite numbers only
  return zero == 0;
}

// mu x, where mu may be infinite: 0 of an x that is not positive.
template <class Scalar>
Scalar Limit(const Scalar& mu, const Scalar& x) {
  return x > 0 ? Scalar(mu * x) : Scalar(0);
}

// What is allowed: forces are called solved if their error is at most eps, with theta = tau / eps.
struct Gate {
  double eps = 0;  // of b and mu
  double tau = 0;  // of A, and of the rounding of forces

  double theta() const { return eps > 0 ? tau / eps : 1; }
};

// Roundings of a force that `tau` is.
inline constexpr double kRoundings = 8;

// Half a unit in the last place of what is told of forces: those of wide numbers are rounded to doubles.
template <class Scalar>
inline constexpr double kTold = 0x1p-53;
template <>
inline constexpr double kTold<float> = 0x1p-24;

// Errors up to which forces of a scalar are called a solution, where nobody asks for others. Over float it lies
// above tau.
template <class Scalar>
inline constexpr double kSolvedResidual = 1e-8;
template <>
inline constexpr double kSolvedResidual<float> = 1e-5;
template <class Scalar>
double ResidualOf(const Request& request) {
  return request.residual > 0 ? request.residual : kSolvedResidual<Scalar>;
}

// residual: what is asked for; 0: that of the scalar.
template <class Scalar>
Gate GateOf(double residual = 0) {
  const double eps = residual > 0 ? residual : kSolvedResidual<Scalar>;
  return {eps, std::min(eps, kRoundings * kTold<Scalar>)};
}

// Where a method looks at its own forces, with accelerations that it has rounded itself: theta with that
// rounding in tau. What it takes for solved is left to the gate.
template <class Scalar>
Scalar WorkingTheta(double residual, int rows) {
  if constexpr (kIsExact<Scalar>) {
    return Scalar(GateOf<double>(residual).theta());
  } else {
    const Scalar eps(residual > 0 ? residual : kSolvedResidual<Scalar>);
    const Scalar tau = Scalar(rows + kRoundings) * std::numeric_limits<Scalar>::epsilon();
    return tau < eps ? Scalar(tau / eps) : Scalar(1);
  }
}

// What a contact does: a frictionless, sliding or bilateral one that touches rests.
enum class Motion : std::uint8_t { kSeparates, kRests, kSlips };

// A contact's friction and its acceleration.
template <class Scalar>
struct FrictionAt {
  Scalar limit;  // mu fN; may be infinite
  std::array<Scalar, 2> f, a;
  Scalar force_unit;
  std::array<Scalar, 2> unit;  // of a
  bool on_line;                // in the plane, where friction has one component
};

// What a slip misses.
template <class Scalar>
struct SlipMiss {
  Scalar force;             // N
  std::array<Scalar, 2> a;  // what aF must change by
};

namespace internal {

// t >= 0 with the least of max_k abs(a_k + t f_k) / unit_k: a corner of one of the four lines, or 0.
template <class Scalar>
Scalar NearestOnRay(const FrictionAt<Scalar>& at) {
  std::array<Scalar, 2> p, q;
  int count = 0;
  for (int k = 0; k < 2; ++k) {
    if (!(at.unit[k] > 0) || at.f[k] == 0) continue;
    p[count] = at.a[k] / at.unit[k];
    q[count] = at.f[k] / at.unit[k];
    ++count;
  }
  std::array<Scalar, 5> tried = {Scalar(0)};
  int candidates = 1;
  const auto add = [&](const Scalar& numerator, const Scalar& denominator) {
    if (denominator == 0) return;
    const Scalar t = numerator / denominator;
    if (t > 0) tried[candidates++] = t;
  };
  for (int k = 0; k < count; ++k) add(Scalar(-p[k]), q[k]);
  if (count == 2) {
    add(Scalar(p[1] - p[0]), Scalar(q[0] - q[1]));
    add(Scalar(-p[1] - p[0]), Scalar(q[0] + q[1]));
  }
  const auto miss = [&](const Scalar& t) {
    Scalar most(0);
    for (int k = 0; k < count; ++k) most = std::max(most, Scalar(Abs(Scalar(p[k] + t * q[k]))));
    return most;
  };
  Scalar best = tried[0], least = miss(best);
  for (int c = 1; c < candidates; ++c) {
    const Scalar now = miss(tried[c]);
    if (!(now < least)) continue;
    least = now;
    best = tried[c];
  }
  return best;
}

}  // namespace internal

// How far fF is beyond the disc of radius mu fN, and from its edge.
template <class Scalar>
Scalar BeyondDisc(const FrictionAt<Scalar>& at) {
  return std::max(Scalar(0), Scalar(Length(at.f[0], at.f[1]) - at.limit));
}
template <class Scalar>
Scalar OffDisc(const FrictionAt<Scalar>& at) {
  return Abs(Scalar(Length(at.f[0], at.f[1]) - at.limit));
}

// Coulomb's law: aF against fF.
template <class Scalar>
SlipMiss<Scalar> MissOfSlip(const FrictionAt<Scalar>& at) {
  SlipMiss<Scalar> miss{OffDisc(at), at.a};
  if (at.on_line) {
    if ((at.f[0] > 0 && at.a[0] < 0) || (at.f[0] < 0 && at.a[0] > 0)) miss.a[0] = Scalar(0);
    return miss;
  }
  const Scalar t = internal::NearestOnRay(at);
  for (int k = 0; k < 2; ++k) miss.a[k] += t * at.f[k];
  return miss;
}

// (21), (22): no power. The same share of both units takes away what there is.
template <class Scalar>
SlipMiss<Scalar> MissOfFreeSlip(const FrictionAt<Scalar>& at) {
  const Scalar power = at.f[0] * at.a[0] + at.f[1] * at.a[1];
  SlipMiss<Scalar> miss{OffDisc(at), {Scalar(0), Scalar(0)}};
  if (!(power > 0)) return miss;
  const Scalar most = Abs(at.f[0]) * at.unit[0] + Abs(at.f[1]) * at.unit[1];
  if (!(most > 0)) return {miss.force, at.a};
  for (int k = 0; k < 2; ++k) miss.a[k] = (at.f[k] < 0 ? -power : power) / most * at.unit[k];
  return miss;
}

// Friction within the disc of radius mu fN, in the plane the interval.
template <class Scalar>
struct FrictionInDisc {
  bool free;  // by (21), (22)

  Scalar Excess(int, const FrictionAt<Scalar>& at) const { return BeyondDisc(at); }
  SlipMiss<Scalar> Slip(int, const FrictionAt<Scalar>& at) const {
    return free ? MissOfFreeSlip(at) : MissOfSlip(at);
  }
};

// ---- The law ---------------------------------------------------------------------------------
//
// It is written here alone, for all measures of what forces miss: the strict one (ErrorMeter), which the gate
// bounds, and the lenient one (lenient.h). A measure tells errors, by units of its own:
//
//   OfRow(x, row)                           a_row misses x
//   OfTangents(x, row, count)               aF misses x; the contact has `count` rows
//   OfFriction(x, unit)                     fF misses x
//   OfForce(problem, f, row)                f_row is not zero
//   OfForces(problem, f, i, row, touching)  the forces of contact i are not zero; where that is no less than
//                                           what it misses touching, any such number will do
//   unit(row), FrictionUnit(i, limit)       the units of a_row and of fF
//
// `friction` tells of a static contact with a limit above 0: Excess(i, FrictionAt), how far fF is beyond it;
// Slip(i, FrictionAt) -> SlipMiss. Measures are inner loops, which a call for each contact would slow by a
// fifth.

// A contact in the nearest of its modes, which misses least.
template <class Scalar>
struct NearestMode {
  Motion motion = Motion::kRests;
  Scalar error = Scalar(0);                            // the largest of what is missed
  Scalar friction = Scalar(0);                         // that of fF
  std::optional<std::array<Scalar, 2>> tangents = {};  // what aF misses, where not any will do
};

// Of friction, where the contact touches.
template <class Problem, class Vector, class Measure, class Friction>
[[gnu::always_inline]] inline auto NearestFriction(const Problem& problem, const Vector& f, const Vector& a,
                                                   int i, int row, const Measure& measure,
                                                   const Friction& friction) {
  using Scalar = typename Vector::Scalar;
  const auto& contact = problem.contacts[i];
  const int count = problem.dimension;
  const Scalar zero(0), limit = Limit(Scalar(contact.mu), Scalar(f[row]));
  FrictionAt<Scalar> at{limit,        {zero, zero}, {zero, zero}, measure.FrictionUnit(i, limit),
                        {zero, zero}, count == 2};
  for (int k = 0; k + 1 < count; ++k) {
    at.f[k] = f[row + 1 + k];
    at.a[k] = a[row + 1 + k];
    at.unit[k] = measure.unit(row + 1 + k);
    if (contact.kind == ContactKind::kSliding) at.f[k] += Scalar(contact.slip[k]) * limit;
  }
  NearestMode<Scalar> mode;
  if (contact.kind == ContactKind::kSliding || limit == 0) {
    if (contact.kind == ContactKind::kStatic) mode.motion = Motion::kSlips;  // as it likes
    mode.error = mode.friction = measure.OfFriction(Length(at.f[0], at.f[1]), at.force_unit);
    return mode;
  }
  const bool bounded = limit < Infinity<Scalar>();
  if (bounded) mode.friction = measure.OfFriction(friction.Excess(i, at), at.force_unit);
  mode.error = std::max(mode.friction, measure.OfTangents(at.a, row, count));
  mode.tangents = at.a;
  if (!bounded || mode.error == 0) return mode;
  const SlipMiss<Scalar> miss = friction.Slip(i, at);
  const Scalar of_force = measure.OfFriction(miss.force, at.force_unit);
  const Scalar slips = std::max(of_force, measure.OfTangents(miss.a, row, count));
  if (slips < mode.error) mode = {Motion::kSlips, slips, of_force, miss.a};
  return mode;
}

// Of contact i, whose normal is in `row`.
template <class Problem, class Vector, class Measure, class Friction>
[[gnu::always_inline]] inline auto NearestModeOf(const Problem& problem, const Vector& f, const Vector& a,
                                                 int i, int row, const Measure& measure,
                                                 const Friction& friction) {
  using Scalar = typename Vector::Scalar;
  const auto& contact = problem.contacts[i];
  NearestMode<Scalar> mode;
  if (contact.HasFrictionRows()) mode = NearestFriction(problem, f, a, i, row, measure, friction);
  mode.error = std::max(mode.error, measure.OfRow(Scalar(Abs(Scalar(a[row]))), row));
  if (contact.kind == ContactKind::kBilateral) return mode;
  if (f[row] < 0) mode.error = std::max(mode.error, measure.OfForce(problem, f, row));
  if (mode.error == 0) return mode;
  Scalar open = measure.OfRow(Scalar(-a[row]), row);
  if (open < mode.error) open = std::max(open, measure.OfForces(problem, f, i, row, mode));
  if (open < mode.error) mode = {Motion::kSeparates, open};
  return mode;
}

// Adds sum_j abs(A_ij f_j) to the size of row i.
template <class Problem, class Vector, class Scalar>
void AddSizes(const Problem& problem, const Vector& f, std::vector<Scalar>& size) {
  const auto add = [&](int i, int j, const auto& x) {
    if (f[j] != 0) size[i] += Scalar(Abs(Scalar(x))) * Scalar(Abs(Scalar(f[j])));
  };
  if constexpr (requires { problem.A.ForEachOfHalf(add); }) {
    problem.A.ForEachOfHalf([&](int i, int j, const auto& x) {
      add(i, j, x);
      if (i != j) add(j, i, x);
    });
  } else {
    ForEachEntry(problem.A, add);
  }
}

// Measures forces. Memory is kept between calls.
template <class Scalar>
class ErrorMeter {
 public:
  // a: A f + b, off by at most rounding[i] where that is given. Infinite errors only of numbers that are not
  // finite.
  template <class Problem, class Vector, class Friction>
  Errors<Scalar> Measure(const Problem& problem, const Vector& f, const Vector& a, const Scalar& theta,
                         const Friction& friction, const std::vector<Scalar>* rounding = nullptr) {
    Errors<Scalar> errors;
    modes_.assign(problem.contacts.size(), {});
    size_.assign(problem.rows(), Scalar(0));
    unit_.assign(problem.rows(), Scalar(0));
    if (!AreFinite(f, a)) {
      errors.is_finite = false;
      errors.acceleration = errors.force = errors.backward = errors.amplification = Infinity<Scalar>();
      return errors;
    }
    theta_ = theta;
    most_ = Scalar(1) / theta;
    rounding_ = rounding;
    TakeSizes(problem, f);
    has_ghosts_ = false;
    ForEachContact(problem, [&](int i, int row, int count) {
      modes_[i] = NearestModeOf(problem, f, a, i, row, *this, friction);
      if (modes_[i].motion == Motion::kSeparates) {
        for (int k = 0; k < count; ++k) {
          if (f[row + k] != 0) AddGhost(problem, f, i, row + k);
        }
      } else if (f[row] < 0 && problem.contacts[i].kind != ContactKind::kBilateral) {
        AddGhost(problem, f, i, row);
      }
    });
    return Told(problem, a);
  }

  // Of each contact, by the measure before.
  const std::vector<NearestMode<Scalar>>& modes() const { return modes_; }
  // sum_j abs(A_ij f_j), and the unit of row i.
  const Scalar& size(int row) const { return size_[row]; }
  const Scalar& unit(int row) const { return unit_[row]; }

  // The measure of the law.
  const Scalar& FrictionUnit(int, const Scalar& limit) const { return limit; }
  Scalar OfRow(const Scalar& x, int row) const { return RowError(Scalar(x + RoundingOf(row)), row); }
  Scalar OfTangents(const std::array<Scalar, 2>& x, int row, int count) const {
    Scalar most(0);
    for (int k = 1; k < count; ++k) most = std::max(most, OfRow(Scalar(Abs(x[k - 1])), row + k));
    return most;
  }
  Scalar OfFriction(const Scalar& x, const Scalar& unit) const { return Capped(InUnits(x, unit)); }
  // What force j does to the row that notices it most, in units of that row. One that no row notices, as no
  // force acts there, is a force all the same.
  template <class Problem, class Vector>
  Scalar OfForce(const Problem& problem, const Vector& f, int j) const {
    Scalar most(0);
    if (f[j] == 0) return most;
    bool acts = false;
    ForEachInColumn(problem.A, j, [&](int i, const auto& x) {
      if (x == 0) return;
      acts = true;
      most = std::max(most, RowError(Scalar(Abs(Scalar(Scalar(x) * f[j]))), i));
    });
    return acts ? most : most_;
  }
  // Its own row notices a normal force too: mostly enough to see that the contact touches.
  template <class Problem, class Vector>
  Scalar OfForces(const Problem& problem, const Vector& f, int i, int row,
                  const NearestMode<Scalar>& touching) const {
    Scalar most(0);
    if (f[row] > 0) most = RowError(Scalar(Abs(Scalar(problem.A.coeff(row, row))) * f[row]), row);
    const int end = row + RowsOf(problem.contacts[i], problem.dimension);
    for (int j = row; j < end && most < touching.error; ++j) most = std::max(most, OfForce(problem, f, j));
    return most;
  }

 private:
  template <class Problem, class Vector>
  void TakeSizes(const Problem& problem, const Vector& f) {
    AddSizes(problem, f, size_);
    ForEachContact(problem, [&](int, int row, int count) {
      const Scalar free = TangentLength(problem.b, row, count);
      unit_[row] = Abs(Scalar(problem.b[row])) + theta_ * size_[row];
      for (int k = 1; k < count; ++k) unit_[row + k] = free + theta_ * size_[row + k];
    });
  }

  Scalar Capped(const Scalar& x) const { return std::min(x, most_); }
  Scalar RoundingOf(int row) const { return rounding_ == nullptr ? Scalar(0) : (*rounding_)[row]; }
  Scalar RowError(const Scalar& missed, int row) const {
    return missed > 0 ? Capped(InUnits(missed, unit_[row])) : Scalar(0);
  }

  // Force j of a contact is taken for zero. One that acts on no row is an error of the contact.
  template <class Problem, class Vector>
  void AddGhost(const Problem& problem, const Vector& f, int contact, int j) {
    if (!has_ghosts_) ghosts_.assign(problem.rows(), Scalar(0));
    has_ghosts_ = true;
    bool acts = false;
    ForEachInColumn(problem.A, j, [&](int i, const auto& x) {
      if (x == 0) return;
      acts = true;
      ghosts_[i] += Scalar(Abs(Scalar(Scalar(x) * f[j])));
    });
    if (!acts) modes_[contact].friction = most_;
  }

  template <class Problem, class Vector>
  Errors<Scalar> Told(const Problem& problem, const Vector& a) {
    Errors<Scalar> errors;
    Scalar largest(0);
    ForEachContact(problem, [&](int i, int first, int count) {
      const NearestMode<Scalar>& mode = modes_[i];
      for (int k = 0; k < count; ++k) {
        const int row = first + k;
        if (has_ghosts_) unit_[row] = std::max(Scalar(0), Scalar(unit_[row] - theta_ * ghosts_[row]));
        const Scalar size = size_[row] + Abs(Scalar(problem.b[row]));
        errors.amplification = std::max(errors.amplification, Capped(InUnits(size, unit_[row])));
        if (has_ghosts_) errors.acceleration = std::max(errors.acceleration, RowError(ghosts_[row], row));
        if (k > 0 && !mode.tangents) continue;
        const Scalar lacks = k > 0 ? (*mode.tangents)[k - 1] : Scalar(a[row]);
        Scalar missed = mode.motion == Motion::kSeparates ? Scalar(-lacks) : Scalar(Abs(lacks));
        missed += RoundingOf(row);
        if (has_ghosts_) missed += ghosts_[row];
        errors.acceleration = std::max(errors.acceleration, RowError(missed, row));
        if (missed > 0) errors.backward = std::max(errors.backward, InUnits(missed, size));
      }
      errors.force = std::max(errors.force, mode.friction);
      if (errors.Largest() > largest) errors.contact = i;
      largest = errors.Largest();
    });
    return errors;
  }

  Scalar theta_ = Scalar(1), most_ = Scalar(1);
  const std::vector<Scalar>* rounding_ = nullptr;
  std::vector<Scalar> size_, unit_, ghosts_;  // by row
  std::vector<NearestMode<Scalar>> modes_;    // by contact
  bool has_ghosts_ = false;
};

// Strict errors by the law; in the plane both laws are one.
template <class Problem, class Vector>
auto MeasureErrors(const Problem& problem, FrictionLaw law, const Vector& f, const Vector& a,
                   ErrorMeter<typename Vector::Scalar>& meter, const typename Vector::Scalar& theta,
                   const std::vector<typename Vector::Scalar>* rounding = nullptr) {
  using Scalar = typename Vector::Scalar;
  const bool free = law == FrictionLaw::kBaraff && problem.dimension == 3;
  return meter.Measure(problem, f, a, theta, FrictionInDisc<Scalar>{free}, rounding);
}

// By the theta of a method that is asked for a residual; 0: of none.
template <class Problem, class Vector>
auto MeasureErrors(const Problem& problem, FrictionLaw law, const Vector& f, const Vector& a,
                   double residual = 0) {
  using Scalar = typename Vector::Scalar;
  ErrorMeter<Scalar> meter;
  return MeasureErrors(problem, law, f, a, meter, WorkingTheta<Scalar>(residual, problem.rows()));
}

}  // namespace stiction
