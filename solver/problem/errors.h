// SPDX-License-Identifier: Apache-2.0
// Errors of forces: how far they and their accelerations are from the law of every contact, in the contact's
// own units (units.h). No tolerance inside.
//
// A contact is in one of its modes. The error of a mode is the largest of what its conditions miss, and the
// error of the contact that of its nearest mode:
//
//   separates   abs(fN), abs(fF);            -aN
//   sticks      -fN, abs(fF) - mu fN;        abs(aN), abs(aF)
//   slips       -fN, abs(fF - what the law wants of it);      abs(aN)
//
// So `solved` says that every contact separates, sticks or slips but for so much, and no condition of (15),
// (16) is missed by more: no sum of small violations passes for a mode. Where slip is slow, what the law wants
// turns with the smallest change of aF; so a contact also slips if both fF and aF may move by so much that the
// law holds. What friction misses is measured in
// units of fF or of mu fN, in whichever it is less; mu is never divided by, and may be infinite. Bilateral:
// abs(aN). Sliding: the first two lines for the normal alone, and abs(fF + mu slip fN) (24).
//
// Friction that the law wants of a contact that slips, with the limit mu fN:
//
//   plane, Coulomb   -mu fN aF / abs(aF); both moved: the distance d of fF from the nearest point p of the disc
//                    to fF - r aF, since p is what the law wants of aF - (fF - p) / r, too
//   (21), (22)       any of length mu fN with fF.aF <= 0; both moved: aF by what it is along fF
//   polygons         the same d with mu fN times the polygon for the disc (complete/polygon_errors.h)
//
// r is the unit of friction over that of aF, so that d is the same error of both.
//
// Shapes: f, a rows x 1. Accelerations may be off by `rounding` times Units::size; errors are then upper
// bounds, the rounding of lengths and limits of friction included.

#ifndef STICTION_SOLVER_PROBLEM_ERRORS_H_
#define STICTION_SOLVER_PROBLEM_ERRORS_H_

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "solver/problem/law.h"
#include "solver/problem/problem.h"
#include "solver/problem/scalar.h"
#include "solver/problem/solution.h"
#include "solver/problem/units.h"

namespace stiction {

// What the friction of a contact misses.
template <class Scalar>
struct FrictionGap {
  Scalar excess;    // over what fN allows, where it sticks
  Scalar distance;  // from what the law wants where it slips; infinite where that is not known
  Scalar moved_force, moved_acceleration;  // the same where both move; likewise
};

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

// mu x, where mu may be infinite: of a force or a unit that is not negative.
template <class Scalar>
Scalar Limit(const Scalar& mu, const Scalar& x) {
  return x > 0 ? Scalar(mu * x) : Scalar(0);
}

// A contact's friction and its acceleration.
template <class Scalar>
struct FrictionAt {
  Scalar limit;  // mu fN
  std::array<Scalar, 2> f, a;
  Scalar error;  // bounds that of a
  Scalar r;      // unit of f over that of a; 0 where that of a is 0 or that of f infinite
  bool on_line;  // in the plane, where friction has one component
};

// Of the circle where both move. On a line, as in the plane, that gains nothing.
template <class Scalar>
Scalar MovedDistance(const FrictionAt<Scalar>& at) {
  if (!(at.r > 0) || (at.f[1] == 0 && at.a[1] == 0)) return Infinity<Scalar>();
  Scalar x = at.f[0] - at.r * at.a[0], y = at.f[1] - at.r * at.a[1];
  const Scalar length = Length(x, y);
  if (length > at.limit) {
    x *= at.limit / length;
    y *= at.limit / length;
  }
  return Length(Scalar(at.f[0] - x), Scalar(at.f[1] - y)) + at.r * at.error;
}

// Friction of the circle, or in the plane, which is the same with a second component of zero.
template <class Scalar>
FrictionGap<Scalar> GapOfFriction(FrictionLaw law, const FrictionAt<Scalar>& at) {
  const auto& [limit, f, a, error, r, on_line] = at;
  const Scalar none = Infinity<Scalar>(), force = Length(f[0], f[1]), speed = Length(a[0], a[1]);
  FrictionGap<Scalar> gap{std::max(Scalar(0), Scalar(force - limit)), none, none, none};
  if (!(limit < none)) return gap;
  const bool coulomb = law == FrictionLaw::kCoulomb;
  if (coulomb && r > 0) {
    gap.moved_force = MovedDistance(at);
    if (gap.moved_force < none) gap.moved_acceleration = gap.moved_force / r;
  } else if (!coulomb && force > 0) {
    gap.moved_force = Abs(Scalar(force - limit));
    gap.moved_acceleration = std::max(Scalar(0), Scalar((f[0] * a[0] + f[1] * a[1]) / force + error));
  }
  if (!(speed > error)) return gap;
  const Scalar turn =
      on_line ? Scalar(0) : Scalar(2 * error / speed);  // of the direction: of a line it is a sign
  if (coulomb) {
    const Scalar x = f[0] + limit * (a[0] / speed), y = f[1] + limit * (a[1] / speed);
    gap.distance = Length(x, y) + limit * turn;
    return gap;
  }
  const Scalar along = (f[0] * a[0] + f[1] * a[1]) / speed + force * turn;
  const Scalar across = Abs(Scalar(f[0] * a[1] - f[1] * a[0])) / speed;
  gap.distance = along <= 0 ? Abs(Scalar(force - limit)) : Length(along, Scalar(across - limit)) + force * turn;
  return gap;
}

namespace internal {

// What one mode of a contact misses, or the nearest so far.
template <class Scalar>
struct ModeError {
  Scalar acceleration, force, backward;

  bool IsLess(const ModeError& other) const {
    return std::max(acceleration, force) < std::max(other.acceleration, other.force);
  }
};

// One contact: its values, and its units.
template <class Scalar>
class ContactErrors {
 public:
  template <class Problem, class Vector>
  ContactErrors(const Problem& problem, const Units<Scalar>& units, const Vector& f, const Vector& a, int i,
                int row, const Scalar& rounding)
      : kind_(problem.contacts[i].kind), mu_(problem.contacts[i].mu) {
    tangents_ = problem.contacts[i].HasFrictionRows() ? problem.dimension - 1 : 0;
    fN_ = f[row];
    aN_ = a[row];
    normal_ = {units.acceleration(row), units.force(row), units.size(row), Scalar(rounding * units.size(row))};
    for (int k = 0; k < tangents_; ++k) {
      const int at = row + 1 + k;
      fF_[k] = f[at];
      aF_[k] = a[at];
      slip_[k] = problem.contacts[i].slip[k];
      friction_.acceleration = std::max(friction_.acceleration, units.acceleration(at));
      friction_.force = std::max(friction_.force, units.force(at));
      const Scalar error = rounding * units.size(at);
      friction_.rounding = k == 0 ? error : Length(friction_.rounding, error);
      least_size_ = k == 0 ? units.size(at) : std::min(least_size_, units.size(at));
      at_rest_ = std::max(at_rest_, InUnits(Scalar(Abs(a[at]) + error), units.size(at)));
    }
    limit_ = Limit(mu_, std::max(Scalar(0), fN_));
    friction_unit_ = std::max(friction_.force, Limit(mu_, normal_.force));
    if (limit_ < Infinity<Scalar>()) of_lengths_ = 2 * rounding * (Length(fF_[0], fF_[1]) + limit_);
  }

  // gap(FrictionAt): what the friction of a static contact misses.
  template <class Gap>
  ModeError<Scalar> Nearest(Gap gap) const {
    ModeError<Scalar> closed = Closed();
    if (kind_ == ContactKind::kBilateral) return closed;
    ModeError<Scalar> open = Open();
    if (kind_ == ContactKind::kSliding) {
      const Scalar x = fF_[0] + slip_[0] * Limited(), y = fF_[1] + slip_[1] * Limited();
      const Scalar missed = InUnits(Scalar(Length(x, y) + of_lengths_), friction_unit_);
      open.force = std::max(open.force, missed);
      closed.force = std::max(closed.force, missed);
    } else if (kind_ == ContactKind::kStatic) {
      open.force = std::max(open.force, InUnits(Length(fF_[0], fF_[1]), friction_.force));
      const bool in_units = friction_.acceleration > 0 && friction_unit_ < Infinity<Scalar>();
      const Scalar r = in_units ? Scalar(friction_unit_ / friction_.acceleration) : Scalar(0);
      FrictionGap<Scalar> gaps =
          gap(FrictionAt<Scalar>{limit_, fF_, aF_, friction_.rounding, r, tangents_ == 1});
      for (Scalar* distance : {&gaps.excess, &gaps.distance, &gaps.moved_force}) *distance += of_lengths_;
      closed = Closer(Sticks(closed, gaps), Slips(closed, gaps));
    }
    return Closer(open, closed);
  }

 private:
  struct RowUnits {
    Scalar acceleration = Scalar(0), force = Scalar(0), size = Scalar(0), rounding = Scalar(0);
  };

  static ModeError<Scalar> Closer(const ModeError<Scalar>& x, const ModeError<Scalar>& y) {
    return y.IsLess(x) ? y : x;
  }
  ModeError<Scalar> OfNormal(const Scalar& acceleration, const Scalar& force) const {
    return {InUnits(acceleration, normal_.acceleration), InUnits(force, normal_.force),
            InUnits(acceleration, normal_.size)};
  }
  ModeError<Scalar> Open() const {
    return OfNormal(std::max(Scalar(0), Scalar(normal_.rounding - aN_)), Abs(fN_));
  }
  ModeError<Scalar> Closed() const {
    const bool any = kind_ == ContactKind::kBilateral;
    return OfNormal(Scalar(Abs(aN_) + normal_.rounding), any ? Scalar(0) : std::max(Scalar(0), Scalar(-fN_)));
  }
  ModeError<Scalar> Sticks(ModeError<Scalar> error, const FrictionGap<Scalar>& gap) const {
    const Scalar speed = Length(aF_[0], aF_[1]) + friction_.rounding;
    error.acceleration = std::max(error.acceleration, InUnits(speed, friction_.acceleration));
    error.force = std::max(error.force, InUnits(gap.excess, friction_unit_));
    error.backward = std::max(error.backward, at_rest_);
    return error;
  }
  ModeError<Scalar> Slips(const ModeError<Scalar>& error, const FrictionGap<Scalar>& gap) const {
    ModeError<Scalar> slips = error, moved = error;
    slips.force = std::max(error.force, InUnits(gap.distance, friction_unit_));
    const Scalar most = std::min(gap.moved_acceleration, Scalar(Length(aF_[0], aF_[1]) + friction_.rounding));
    moved.force = std::max(error.force, InUnits(gap.moved_force, friction_unit_));
    moved.acceleration = std::max(error.acceleration, InUnits(gap.moved_acceleration, friction_.acceleration));
    moved.backward = std::max(error.backward, InUnits(most, least_size_));
    return Closer(slips, moved);
  }
  Scalar Limited() const { return fN_ < 0 ? Scalar(-Limit(mu_, Scalar(-fN_))) : Limit(mu_, fN_); }

  ContactKind kind_;
  int tangents_ = 0;
  Scalar mu_, fN_, aN_, limit_, friction_unit_;
  std::array<Scalar, 2> fF_ = {Scalar(0), Scalar(0)}, aF_ = fF_, slip_ = fF_;
  RowUnits normal_, friction_;
  Scalar at_rest_ = Scalar(0);     // of aF, relative to its sizes
  Scalar least_size_ = Scalar(0);  // of these
  Scalar of_lengths_ = Scalar(0);  // bounds the rounding of lengths and limits of friction
};

}  // namespace internal

// gap(contact, FrictionAt) -> FrictionGap. Problem: a ContactProblem, or one with a sparse A. `units` is
// written: its memory is kept between calls.
template <class Problem, class Vector, class Gap>
auto MeasureErrorsBy(const Problem& problem, const Vector& f, const Vector& a,
                     Units<typename Vector::Scalar>& units, const typename Vector::Scalar& rounding, Gap gap) {
  using Scalar = typename Vector::Scalar;
  Errors<Scalar> errors;
  Scalar zero(0);
  for (int i = 0; i < problem.rows(); ++i) zero += (f[i] - f[i]) + (a[i] - a[i]);  // of finite numbers only
  if (!(zero == 0)) {
    errors.is_finite = false;
    errors.acceleration = errors.force = errors.backward = errors.amplification = Infinity<Scalar>();
    return errors;
  }
  units.Take(problem, f, a);
  Scalar largest(0);
  int row = 0;
  for (int i = 0; i < static_cast<int>(problem.contacts.size()); ++i) {
    const internal::ContactErrors<Scalar> contact(problem, units, f, a, i, row, rounding);
    const auto error = contact.Nearest([&](const FrictionAt<Scalar>& at) { return gap(i, at); });
    errors.acceleration = std::max(errors.acceleration, error.acceleration);
    errors.force = std::max(errors.force, error.force);
    errors.backward = std::max(errors.backward, error.backward);
    if (errors.Largest() > largest) errors.contact = i;
    largest = errors.Largest();
    row += problem.contacts[i].HasFrictionRows() ? problem.dimension : 1;
  }
  for (int i = 0; i < problem.rows(); ++i)
    errors.amplification = std::max(errors.amplification, InUnits(units.size(i), units.acceleration(i)));
  return errors;
}

// Errors by the law; in the plane both laws are one.
template <class Problem, class Vector>
auto MeasureErrors(const Problem& problem, FrictionLaw law, const Vector& f, const Vector& a,
                   Units<typename Vector::Scalar>& units, const typename Vector::Scalar& rounding) {
  using Scalar = typename Vector::Scalar;
  const FrictionLaw friction = problem.dimension == 2 ? FrictionLaw::kCoulomb : law;
  return MeasureErrorsBy(problem, f, a, units, rounding,
                         [friction](int, const FrictionAt<Scalar>& at) { return GapOfFriction(friction, at); });
}

template <class Problem, class Vector>
auto MeasureErrors(const Problem& problem, FrictionLaw law, const Vector& f, const Vector& a) {
  using Scalar = typename Vector::Scalar;
  Units<Scalar> units;
  return MeasureErrors(problem, law, f, a, units, Scalar(0));
}

}  // namespace stiction

#endif  // STICTION_SOLVER_PROBLEM_ERRORS_H_
