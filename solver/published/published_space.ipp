// SPDX-License-Identifier: Apache-2.0
// Definitions for published_space.h, in the order in which the paper tells them.

#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/linear/direction.ipp"
#include "solver/problem/lenient.h"
#include "solver/published/published_space.h"
#include "solver/published/scan.h"

namespace stiction {

// ---- Main loop: 4.3 compute-forces, 5.5 ------------------------------------------------------

template <class Scalar>
Verdict PublishedInSpace<Scalar>::Run(const Problem& problem, SpaceTrace<Scalar>* trace) {
  Start(problem, trace);
  while (!Ended() && !OuterStateRecurs()) TakeTurn();
  return verdict_;
}

template <class Scalar>
bool PublishedInSpace<Scalar>::TakeTurn() {
  Sweep();
  const int violated = ScanForViolated();
  if (violated < 0) {
    Finish();
  } else {
    Establish(violated);
  }
  return !Ended();
}

template <class Scalar>
void PublishedInSpace<Scalar>::Start(const Problem& problem, SpaceTrace<Scalar>* trace) {
  const int rows = problem.rows();
  problem_ = &problem;
  turned_ = problem;
  trace_ = trace;
  if (trace_ != nullptr) trace_->clear();
  layout_.Assign(problem.contacts, 3);
  scale_ = MakeScale(problem, request_.tolerances);
  double b = 0, A = 0;
  for (int i = 0; i < rows; ++i) {
    b = std::max(b, std::abs(Approximation<Scalar>::Of(problem.b[i])));
    A = std::max(A, std::abs(Approximation<Scalar>::Of(problem.A(i, i))));
  }
  inverse_grain_ = b > 0 ? A / (b * request_.tolerances.loop_grain) : 0;
  direction_.Start(turned_);
  limits_.assign(rows, {});
  state_.f = Vector::Constant(rows, Scalar(0));
  state_.a = problem.b;
  Reset<IndexSet, Eigen::Dynamic>(state_.sets, rows, IndexSet::kNone);
  Reset<IndexSet, Eigen::Dynamic>(last_left_, rows, IndexSet::kNone);
  frames_.assign(problem.contacts.size(), {});
  given_up_by_turning_.assign(problem.contacts.size(), false);
  on_circle_.assign(problem.contacts.size(), false);
  recorded_anew_.assign(problem.contacts.size(), 0);
  axes_.assign(problem.contacts.size(), kProblemAxes);
  turned_axes_ = 0;
  assumes_turnings_ = false;
  turnings_.clear();
  axes_in_period_ = axes_;
  recorded_in_period_ = recorded_anew_;
  ends_in_period_.clear();
  BeginPeriod();
  lines_followed_ = 0;
  last_line_.clear();
  slip_ends_.clear();
  trail_ = {};
  verdict_ = {};
  redirects_ = breaks_ = 0;
  ended_ = false;
  last_driven_contact_ = -1;
  last_step_zero_ = false;
  outer_states_.clear();
  if constexpr (!kIsExact<Scalar>) {
    Scalar zero = 0;  // x - x is zero for finite x only
    for (const auto& contact : problem.contacts) zero += contact.mu - contact.mu;
    for (int i = 0; i < rows; ++i) {
      zero += problem.b[i] - problem.b[i];
      for (int j = 0; j < rows; ++j) zero += problem.A(i, j) - problem.A(i, j);
    }
    if (zero != 0) End(Outcome::kUndecided, kNotFinite);
  }
}

template <class Scalar>
void PublishedInSpace<Scalar>::End(Outcome outcome, std::string_view reason) {
  verdict_.outcome = outcome;
  verdict_.reason = reason;
  ended_ = true;
}

// Over intervals the sets prove what the scan does not compare; rounded numbers are held against the problem.
template <class Scalar>
void PublishedInSpace<Scalar>::Finish() {
  if constexpr (!kIsExact<Scalar>) {
    const Vector forces = f(), answer = problem_->A * forces + problem_->b;
    const Scalar most = std::max(Scalar(1e-6), 10000 * std::numeric_limits<Scalar>::epsilon());
    if (MeasureLeniently(*problem_, FrictionLaw::kBaraff, forces, answer).error > most)
      return End(Outcome::kUndecided, "rounding: the forces break the conditions");
  }
  End(Outcome::kSolved);
}

template <class Scalar>
bool PublishedInSpace<Scalar>::NormalHolds(int row) const {  // (15)
  if (state_.sets[row] != IndexSet::kNone) return true;
  const int f = Sign(state_.f[row], scale_.force);
  const int a = Sign(state_.a[row], scale_.acceleration);
  return f >= 0 && a >= 0 && (f == 0 || a == 0);
}

// (21), (22) and: aF = 0 or abs(fF) = mu fN.
template <class Scalar>
bool PublishedInSpace<Scalar>::FrictionHolds(int row) const {
  using std::sqrt;
  const Scalar force = sqrt(Square(state_.f, row));
  const bool known = kEncloses<Scalar> && on_circle_[layout_.ContactOf(row)];
  const int slack = known ? 0 : Sign(Scalar(Bound(row) - force), scale_.force);
  if (slack < 0) return false;
  if (slack > 0) return Sign(Scalar(sqrt(Square(state_.a, row))), scale_.acceleration) == 0;
  if (IsSurelyZero(force)) return true;
  const Scalar power = state_.f[row] * state_.a[row] + state_.f[row + 1] * state_.a[row + 1];
  return Sign(power, Scalar(scale_.acceleration * force)) <= 0;
}

// A maintained variable is established by its set.
template <class Scalar>
bool PublishedInSpace<Scalar>::Violated(int row) const {
  if (state_.sets[row] != IndexSet::kNone) return false;
  if (layout_.IsNormal(row)) return !NormalHolds(row);
  return NormalHolds(row - 1) && !FrictionHolds(row);
}

// Whether a friction variable in NCF breaks (21); under slip=redirect it never does.
template <class Scalar>
bool PublishedInSpace<Scalar>::OpposesNoMore(int row) const {
  if (layout_.IsNormal(row) || state_.sets[row] != IndexSet::kAtUpper || !NormalHolds(row - 1)) return false;
  return Sign(state_.f[row], scale_.force) > 0 && Sign(state_.a[row], scale_.acceleration) > 0;
}

// Satisfied normals that no drive established: switch `admit` (4.1 against 4.3).
template <class Scalar>
void PublishedInSpace<Scalar>::Sweep() {
  if (request_.policy.admit == Admit::kLazy) return;
  for (int contact = 0; contact < layout_.ContactCount(); ++contact) {
    const int row = layout_.NormalRowOf(contact);
    if (state_.sets[row] != IndexSet::kNone || Sign(state_.f[row], scale_.force) != 0) continue;
    if (Sign(state_.a[row], scale_.acceleration) >= 0) state_.sets[row] = IndexSet::kSeparating;
  }
}

// First what no set establishes, then what breaks (21) in NCF.
template <class Scalar>
int PublishedInSpace<Scalar>::ScanForViolated() {
  ++verdict_.statistics.outer_scans;
  const auto worse = [this](int row, int other) {
    return layout_.IsNormal(row) ? state_.a[row] < state_.a[other]
                                 : Square(state_.a, row) > Square(state_.a, other);
  };
  const auto pick = [&](const auto& fails) {
    return PickViolated(layout_, request_.policy.scan, request_.policy.resume, last_driven_contact_, fails,
                        worse);
  };
  const int violated = pick([this](int row) { return Violated(row); });
  if (violated >= 0 || request_.policy.slip != Slip::kLiteral) return violated;
  const int broken = pick([this](int row) { return OpposesNoMore(row); });
  breaks_ += broken >= 0;
  return broken;
}

// Establishes the conditions of a violated variable; friction that rests from before it was given up, or that
// opposes its acceleration no more, is first driven to zero (5.5).
template <class Scalar>
void PublishedInSpace<Scalar>::Establish(int row) {
  if (layout_.IsNormal(row)) return DriveToZero(row, DriveGoal::kEstablish, 1);
  const Scalar square = Square(state_.f, row);
  if (IsSurelyZero(square) || Sign(square, Scalar(scale_.force * scale_.force)) == 0)
    return EstablishFriction(row);
  state_.sets[row] = IndexSet::kNone;
  AlongForce(row);
  DriveToZero(row, DriveGoal::kZero, -1);
  if (Ended() || request_.policy.rezero == Rezero::kRescan || !Violated(row)) return;
  EstablishFriction(row);
}

// "We first increase fx (assuming ax < 0) until either i moves into NCF, or ax reaches zero. If i is in NCF, we
// are done, otherwise we now adjust fy" (5.6). A contact given up by turning takes the direction opposite to
// its acceleration for x.
template <class Scalar>
void PublishedInSpace<Scalar>::EstablishFriction(int row) {
  using std::sqrt;
  const int contact = layout_.ContactOf(row);
  if (given_up_by_turning_[contact]) {
    const Scalar size = sqrt(Square(state_.a, row));
    const Tangent a = FrictionInProblemAxes(state_.a, row);
    Turn(contact, {Scalar(-a[0] / size), Scalar(-a[1] / size)});
    state_.a[row] = -size;
    state_.a[row + 1] = Scalar(0);
  } else {
    Turn(contact, {Scalar(1), Scalar(0)});
  }
  for (const int component : {row, row + 1}) {
    const int sign = Sign(state_.a[component], scale_.acceleration);
    if (sign == 0) {
      state_.a[component] = Scalar(0);
      MoveDriven(component, IndexSet::kSticking);
    } else {
      if (sign > 0) Reverse(component);
      DriveToZero(component, DriveGoal::kEstablish, 1);
    }
    if (Ended() || state_.sets[row] == IndexSet::kAtUpper || component != row) return;
    if (!NormalHolds(row - 1)) {
      state_.sets[row] = IndexSet::kNone;
      return;
    }
  }
}

// ---- One drive: 4.3 drive-to-zero, 5.2-5.6 ---------------------------------------------------

template <class Scalar>
void PublishedInSpace<Scalar>::DriveToZero(int driven, DriveGoal goal, int sign) {
  Statistics& statistics = verdict_.statistics;
  ++statistics.drives;
  last_driven_contact_ = layout_.ContactOf(driven);
  Reset<IndexSet, Eigen::Dynamic>(last_left_, problem_->rows(), IndexSet::kNone);
  last_step_zero_ = false;
  zero_run_ = 0;
  using System = DirectionSystem<Scalar, Eigen::Dynamic>;
  while (!BudgetSpent()) {
    const auto status = direction_.Solve(turned_, layout_, state_.sets, driven, sign, scale_);
    if (status != System::Status::kRegular) ++statistics.singular_directions;
    if (status == System::Status::kInconsistent) return End(Outcome::kSingular);
    if constexpr (kEncloses<Scalar>) {
      const bool regular = status == System::Status::kRegular;
      line_ = regular ? NameOfLine(driven, axes_, recorded_anew_) : LineName();
      if (assumes_turnings_)
        line_in_period_ = regular ? NameOfLine(driven, axes_in_period_, recorded_in_period_) : LineName();
    }
    if constexpr (kIsExact<Scalar>) {
      OuterState none = {}, &from = outer_states_.empty() ? none : outer_states_.back();
      from.regular |= status == System::Status::kRegular && from.sets == state_.sets;
    }
    const Step<Scalar> step = FindStep(driven, goal);
    if (step.limiting < 0) return End(Outcome::kRay);
    const bool zero = Sign(step.s, scale_.force) == 0;
    RecordDirection(driven, goal);
    Advance(step, zero);
    ++statistics.steps;
    statistics.zero_steps += zero;
    zero_run_ = zero ? zero_run_ + 1 : 0;
    statistics.longest_zero_run = std::max(statistics.longest_zero_run, zero_run_);
    const IndexSet from = state_.sets[step.limiting];
    const auto sets_before = state_.sets;
    bool gives_up = false;
    if (step.limiting == driven) {
      MoveDriven(driven, step.wants);
    } else if (!TurnsAway(step.limiting)) {
      const bool wants_back = step.wants == last_left_[step.limiting];
      gives_up = GivesUp(request_.policy.give_up, wants_back, zero, last_step_zero_);
      statistics.bounces += wants_back && zero;
      statistics.give_ups += gives_up;
      if (gives_up) {
        GiveUpLimiting(step.limiting, last_driven_contact_);
      } else {
        MoveLimiting(step.limiting, step.wants);
      }
    }
    statistics.pivots += state_.sets != sets_before;
    last_step_zero_ = zero;
    RecordStep(step, from, gives_up);
    if (step.limiting == driven) return;
  }
}

// f += s df, a += s da; then the limit that was reached is met exactly, and so is abs(fF) = mu fN in NCF.
template <class Scalar>
void PublishedInSpace<Scalar>::Advance(const Step<Scalar>& step, bool zero) {
  MoveAlong(step, zero);
  if (!zero) LeaveCircles();
  MeetLimit(step.limiting, step.wants);
  for (int row = 0; row < problem_->rows(); ++row) {
    if (state_.sets[row] == IndexSet::kAtUpper) state_.f[row] = Bound(row);
  }
  if (!kEncloses<Scalar>) return;
  if (!zero) NoteSlipEnds();
  if (step.wants == IndexSet::kSeparating) trail_ = {step.limiting, {}, state_.f, state_.a};
}

// Enclosures know it of forces that rest, too.
template <class Scalar>
void PublishedInSpace<Scalar>::LeaveCircles() {
  for (int contact = 0; contact < layout_.ContactCount(); ++contact) {
    const int row = layout_.NormalRowOf(contact);
    if (kEncloses<Scalar> && layout_.HasFriction(row)) {
      const Vector& df = direction_.df();
      if (IsSurelyZero(df[row]) && IsSurelyZero(df[row + 1]) && IsSurelyZero(df[row + 2])) continue;
    }
    on_circle_[contact] = false;
  }
}

template <class Scalar>
void PublishedInSpace<Scalar>::MeetLimit(int row, IndexSet wants) {
  switch (wants) {
    case IndexSet::kClamped:
    case IndexSet::kSticking:
      state_.a[row] = Scalar(0);
      if (state_.sets[row] == IndexSet::kAtUpper &&
          (request_.policy.slip == Slip::kLiteral || SlipEndsOnLine(layout_.ContactOf(row))))
        state_.a[row + 1] = Scalar(0);
      break;
    case IndexSet::kAtUpper:
      AlongForce(FrictionOf(row));
      state_.f[FrictionOf(row)] = Bound(FrictionOf(row));
      ++recorded_anew_[layout_.ContactOf(row)];
      recorded_in_period_[layout_.ContactOf(row)] =
          recorded_anew_[layout_.ContactOf(row)] - recorded_before_[layout_.ContactOf(row)];
      break;
    default:
      state_.f[row] = Scalar(0);
      break;
  }
}

template <class Scalar>
void PublishedInSpace<Scalar>::Move(int row, IndexSet to) {
  last_left_[row] = state_.sets[row];
  if (kEncloses<Scalar> && state_.sets[row] == IndexSet::kAtUpper && to == IndexSet::kNone)
    on_circle_[layout_.ContactOf(row)] = true;
  state_.sets[row] = to;
  if (layout_.IsNormal(row)) return;
  state_.sets[row + 1] = to == IndexSet::kSticking ? to : IndexSet::kNone;
}

// The driven variable joins its set. After x alone that is CF for x, with y in no set.
template <class Scalar>
void PublishedInSpace<Scalar>::MoveDriven(int driven, IndexSet wants) {
  const int contact = layout_.ContactOf(driven);
  if (wants == IndexSet::kAtUpper) {
    Move(FrictionOf(driven), wants);
  } else {
    state_.sets[driven] = wants;
  }
  const bool second = driven > FrictionOf(driven);
  if (wants == IndexSet::kAtUpper || second) given_up_by_turning_[contact] = false;
}

template <class Scalar>
void PublishedInSpace<Scalar>::MoveLimiting(int row, IndexSet wants) {
  if (wants == IndexSet::kSticking) on_circle_[layout_.ContactOf(row)] = true;
  Move(row, wants);
}

// slip=redirect: at d.aF = 0 with aF /= 0 the recorded direction opposes the acceleration no more, and the
// contact is given up whatever the length of the step.
template <class Scalar>
bool PublishedInSpace<Scalar>::TurnsAway(int row) {
  if (state_.sets[row] != IndexSet::kAtUpper || request_.policy.slip != Slip::kRedirect) return false;
  if (assumes_turnings_ && !IsSurelyZero(state_.a[row + 1])) {
    const std::pair end = {layout_.ContactOf(row), line_in_period_};
    const bool rests_at_zero = !line_in_period_.empty() && line_in_period_.back() == 0;
    turnings_.push_back(
        {state_.a[row + 1], rests_at_zero && (ends_in_period_.contains(end) || ends_before_.contains(end))});
  } else if (IsSurelyZero(state_.a[row + 1]) || Sign(state_.a[row + 1], scale_.acceleration) == 0) {
    state_.a[row + 1] = Scalar(0);
    return false;
  }
  Move(row, IndexSet::kNone);
  given_up_by_turning_[layout_.ContactOf(row)] = true;
  ++redirects_;
  return true;
}

// "j is removed from whatever index set it was in" (5.5).
template <class Scalar>
void PublishedInSpace<Scalar>::GiveUpLimiting(int row, int driven_contact) {
  Move(row, IndexSet::kNone);
  if (!layout_.IsNormal(row) || !layout_.HasFriction(row) || request_.policy.drop == Drop::kVariable) return;
  if (layout_.ContactOf(row) != driven_contact && state_.sets[row + 1] != IndexSet::kNone)
    Move(row + 1, IndexSet::kNone);
}

// ---- Step size: 4.3 maxstep, 5.5, 5.6 --------------------------------------------------------

// The driver's gap shrinks at `rate`; a limit exists if rate > 0.
template <class Scalar>
void PublishedInSpace<Scalar>::Offer(Limit& limit, const Scalar& gap, const Scalar& rate, IndexSet wants,
                                     const Scalar& tolerance) {
  if (IsSurelyZero(rate) || Sign(rate, tolerance) <= 0) return;
  Scalar s = gap / rate;
  if (!kIsExact<Scalar> && s <= 0) s = Scalar(0);  // gap < 0 by rounding only; and no zero has a sign
  if (limit.exists && !(s < limit.s)) return;
  limit = {true, std::move(s), wants};
}

template <class Scalar>
Step<Scalar> PublishedInSpace<Scalar>::FindStep(int driven, DriveGoal goal) {
  int nearest = -1;
  const int driven_friction = layout_.IsNormal(driven) ? -1 : FrictionOf(driven);
  for (int row = 0; row < problem_->rows(); ++row) {
    limits_[row].exists = false;
    if (row == driven) {
      LimitDriven(driven, goal);
    } else if (row != driven_friction) {
      LimitMaintained(row);
    }
    if (limits_[row].exists && (nearest < 0 || limits_[row].s < limits_[nearest].s)) nearest = row;
  }
  if (nearest < 0) return {};
  const int limiting = FirstOf(driven, nearest, request_.policy.ties);
  return {limits_[limiting].s, limiting, limits_[limiting].wants, false};
}

// Of those that limit together with `nearest`. C, NC, CF, NCF: the order of the enumerators.
template <class Scalar>
int PublishedInSpace<Scalar>::FirstOf(int driven, int nearest, Ties ties) const {
  const Scalar reach = limits_[nearest].s + scale_.force;
  const auto limits = [&](int row) {
    return row == nearest || (limits_[row].exists && !(limits_[row].s > reach));
  };
  if (limits(driven)) return driven;
  int first = -1;
  for (int row = 0; row < problem_->rows(); ++row) {
    if (!limits(row)) continue;
    if (first < 0 || (ties == Ties::kSets && state_.sets[row] < state_.sets[first])) first = row;
  }
  return first;
}

template <class Scalar>
void PublishedInSpace<Scalar>::LimitDriven(int driven, DriveGoal goal) {
  Limit& limit = limits_[driven];
  if (goal == DriveGoal::kZero) return Offer(limit, state_.f[driven], Scalar(1), IndexSet::kNone, Scalar(0));
  const bool normal = layout_.IsNormal(driven);
  Offer(limit, Scalar(-state_.a[driven]), direction_.da()[driven],
        normal ? IndexSet::kClamped : IndexSet::kSticking, scale_.rate);
  if (!normal) LimitSticking(limit, FrictionOf(driven));
}

template <class Scalar>
void PublishedInSpace<Scalar>::LimitMaintained(int row) {
  Limit& limit = limits_[row];
  const bool second = !layout_.IsNormal(row) && row > FrictionOf(row);
  if (second) return;
  switch (state_.sets[row]) {
    case IndexSet::kClamped:
      return Offer(limit, state_.f[row], Scalar(-direction_.df()[row]), IndexSet::kSeparating, scale_.pivot);
    case IndexSet::kSeparating:
      return Offer(limit, state_.a[row], Scalar(-direction_.da()[row]), IndexSet::kClamped, scale_.rate);
    case IndexSet::kSticking:
      return LimitSticking(limit, row);
    case IndexSet::kAtUpper:
      return LimitSlipping(limit, row);
    default:
      return;
  }
}

// Equation (23). With c = (mu fN)^2 - fF^2 >= 0 the circle is reached where c + 2 B s + K s^2 falls to zero,
// or, if c = 0, where it falls below.
template <class Scalar>
void PublishedInSpace<Scalar>::LimitSticking(Limit& limit, int row) const {
  using std::sqrt;
  const Vector& df = direction_.df();
  const Scalar bound = Bound(row), growth = problem_->contacts[layout_.ContactOf(row)].mu * df[row - 1];
  const Scalar force = sqrt(Square(state_.f, row));
  const Scalar B = bound * growth - (state_.f[row] * df[row] + state_.f[row + 1] * df[row + 1]);
  const Scalar K = growth * growth - Square(df, row);
  const auto offer = [&](Scalar s) {  // behind aF = 0 of the driven variable if they tie
    if (!limit.exists || s + scale_.force < limit.s) limit = {true, std::move(s), IndexSet::kAtUpper};
  };
  const int K_sign = IsSurelyZero(K) ? 0 : Sign(K, Scalar(scale_.pivot * scale_.pivot));
  const Scalar slack = bound - force;
  if (on_circle_[layout_.ContactOf(row)] || IsSurelyZero(slack) || Sign(slack, scale_.force) == 0) {
    const int B_sign = IsSurelyZero(B) ? 0 : Sign(B, Scalar(scale_.pivot * bound));
    if (B_sign < 0 || (B_sign == 0 && K_sign < 0)) return offer(Scalar(0));
    if (B_sign > 0 && K_sign < 0) offer(Scalar(-2 * B / K));
    return;
  }
  const Scalar c = slack * (bound + force);
  const Scalar D = B * B - K * c;
  if (K_sign < 0) {
    const bool outward =
        Approximation<Scalar>::Of(B) <= 0;  // two forms of one root, each good for one sign of B
    return offer(outward ? Scalar(c / (sqrt(D) - B)) : Scalar((B + sqrt(D)) / -K));
  }
  if (IsSurelyZero(B) || Sign(B, Scalar(scale_.pivot * bound)) >= 0 || Sign(D) < 0) return;
  offer(Scalar(c / (sqrt(D) - B)));
}

// Back into CF (5.6): literally at aF = 0, which a generic path misses; under slip=redirect at d.aF = 0.
template <class Scalar>
void PublishedInSpace<Scalar>::LimitSlipping(Limit& limit, int row) const {
  using std::sqrt;
  const Vector& a = state_.a;
  const Vector& da = direction_.da();
  const bool rests = IsSurelyZero(a[row]) && IsSurelyZero(a[row + 1]);
  const bool on_line = !rests && SlipEndsOnLine(layout_.ContactOf(row));
  const bool redirects = request_.policy.slip == Slip::kRedirect;
  if (rests || (redirects && !on_line))
    return Offer(limit, Scalar(-a[row]), da[row], IndexSet::kSticking, scale_.rate);
  if (redirects && (IsSurelyZero(da[row]) || Sign(da[row]) <= 0)) return;
  const Scalar square = Square(da, row);
  const Scalar aside = a[row] * da[row + 1] - a[row + 1] * da[row];
  if (!on_line && !IsSurelyZero(aside) && Sign(aside, Scalar(scale_.acceleration * sqrt(square))) != 0) return;
  const Scalar approach = -(a[row] * da[row] + a[row + 1] * da[row + 1]);
  if (IsSurelyZero(approach) || Sign(approach) <= 0) return;
  Offer(limit, approach, square, IndexSet::kSticking, Scalar(scale_.rate * scale_.rate));
}

// ---- Frames ----------------------------------------------------------------------------------

// Turns the axes of a contact so that p, a unit vector in the problem's axes, is its first.
template <class Scalar>
void PublishedInSpace<Scalar>::Turn(int contact, const Tangent& p) {
  const int row = layout_.NormalRowOf(contact) + 1;
  Frame& frame = frames_[contact];
  const Tangent q = {Scalar(-p[1]), p[0]};
  for (Vector* values : {&state_.f, &state_.a, &trail_.f, &trail_.a}) {
    if (values->size() == 0) continue;
    const Tangent x = FrictionInProblemAxes(*values, row);
    (*values)[row] = p[0] * x[0] + p[1] * x[1];
    (*values)[row + 1] = q[0] * x[0] + q[1] * x[1];
  }
  frame = {p, q};
  const bool turned = !IsSurelyZero(p[1]);
  axes_[contact] = turned ? ++turned_axes_ : kProblemAxes;
  axes_in_period_[contact] = turned ? turned_axes_ - axes_before_ : kProblemAxes;
  Rebuild(row);
}

template <class Scalar>
void PublishedInSpace<Scalar>::Reverse(int row) {
  Frame& frame = frames_[layout_.ContactOf(row)];
  Tangent& axis = row == FrictionOf(row) ? frame.p : frame.q;
  axis = {Scalar(-axis[0]), Scalar(-axis[1])};
  for (Vector* values : {&state_.f, &state_.a, &trail_.f, &trail_.a}) {
    if (values->size() > 0) (*values)[row] = -(*values)[row];
  }
  Rebuild(FrictionOf(row));
}

// p along the friction force: the direction that NCF records, and along which the force is driven to zero. A
// force of zero has the direction of its change.
template <class Scalar>
void PublishedInSpace<Scalar>::AlongForce(int row) {
  using std::sqrt;
  const bool rests = IsSurelyZero(state_.f[row]) && IsSurelyZero(state_.f[row + 1]);
  const Vector& along = rests ? direction_.df() : state_.f;
  if (!IsSurelyZero(along[row + 1])) {
    const Scalar size = sqrt(Square(along, row));
    const Tangent d = FrictionInProblemAxes(along, row);
    Turn(layout_.ContactOf(row), {Scalar(d[0] / size), Scalar(d[1] / size)});
    state_.f[row + 1] = Scalar(0);
    if (!rests) state_.f[row] = size;
  } else if (!IsSurelyZero(along[row]) && Sign(along[row]) < 0) {
    Reverse(row);
  }
}

// The entries of A in the frames that belong to a contact's friction, from the problem's own.
template <class Scalar>
void PublishedInSpace<Scalar>::Rebuild(int row) {
  for (int i = row; i < row + 2; ++i) {
    for (int j = 0; j < problem_->rows(); ++j) {
      turned_.A(i, j) = Entry(i, j);
      turned_.A(j, i) = Entry(j, i);
    }
  }
}

template <class Scalar>
Scalar PublishedInSpace<Scalar>::Entry(int i, int j) const {
  const auto axis = [this](int row) {
    const Frame& frame = frames_[layout_.ContactOf(row)];
    return row == FrictionOf(row) ? frame.p : frame.q;
  };
  // In the column of the problem's row k.
  const auto across = [&](int k) -> Scalar {
    if (layout_.IsNormal(j)) return problem_->A(k, j);
    const Tangent along = axis(j);
    return along[0] * problem_->A(k, FrictionOf(j)) + along[1] * problem_->A(k, FrictionOf(j) + 1);
  };
  if (layout_.IsNormal(i)) return across(i);
  const Tangent along = axis(i);
  return along[0] * across(FrictionOf(i)) + along[1] * across(FrictionOf(i) + 1);
}

template <class Scalar>
auto PublishedInSpace<Scalar>::FrictionInProblemAxes(const Vector& values, int row) const -> Tangent {
  const Frame& frame = frames_[layout_.ContactOf(row)];
  return {Scalar(values[row] * frame.p[0] + values[row + 1] * frame.q[0]),
          Scalar(values[row] * frame.p[1] + values[row + 1] * frame.q[1])};
}

template <class Scalar>
auto PublishedInSpace<Scalar>::InProblemAxes(const Vector& values) const -> Vector {
  Vector result = values;
  for (int contact = 0; contact < layout_.ContactCount(); ++contact) {
    const int row = layout_.NormalRowOf(contact);
    if (!layout_.HasFriction(row)) continue;
    const Tangent friction = FrictionInProblemAxes(values, row + 1);
    result[row + 1] = friction[0];
    result[row + 2] = friction[1];
  }
  return result;
}

// The square of the length of a friction force, or of its acceleration.
template <class Scalar>
Scalar PublishedInSpace<Scalar>::Square(const Vector& values, int row) const {
  return values[row] * values[row] + values[row + 1] * values[row + 1];
}

// mu fN, for a friction row.
template <class Scalar>
Scalar PublishedInSpace<Scalar>::Bound(int row) const {
  return problem_->contacts[layout_.ContactOf(row)].mu * state_.f[row - 1];
}

// ---- Where the run has been -------------------------------------------------------------------

// What the force direction depends on, an axis up to its sign, and the forces that rest: 0 if they are zero,
// otherwise which of the lines that the run has followed this one is.
template <class Scalar>
auto PublishedInSpace<Scalar>::NameOfLine(int driven, const std::vector<int>& axes,
                                          const std::vector<int>& recorded) const -> LineName {
  LineName name = {driven, layout_.IsNormal(driven) ? kProblemAxes : axes[layout_.ContactOf(driven)]};
  bool rests_at_zero = true;
  for (int contact = 0; contact < layout_.ContactCount(); ++contact) {
    const int row = layout_.NormalRowOf(contact);
    const bool moves = row == driven || state_.sets[row] == IndexSet::kClamped;
    name.push_back(static_cast<int>(moves));
    rests_at_zero &= moves || IsSurelyZero(state_.f[row]);
    if (!layout_.HasFriction(row)) continue;
    const bool follows = moves && state_.sets[row + 1] == IndexSet::kAtUpper;
    name.push_back(follows ? recorded[contact] : -1);
    for (int at = row + 1; at <= row + 2; ++at) {
      const bool sticks = state_.sets[at] == IndexSet::kSticking;
      name.push_back(static_cast<int>(sticks));
      rests_at_zero &= follows || sticks || at == driven || IsSurelyZero(state_.f[at]);
    }
  }
  const bool goes_on =
      last_line_.size() == name.size() + 1 && std::equal(name.begin(), name.end(), last_line_.begin());
  name.push_back(rests_at_zero ? 0 : goes_on ? lines_followed_ : lines_followed_ + 1);
  return name;
}

// Whether aF of a contact is zero at some point of the line.
template <class Scalar>
bool PublishedInSpace<Scalar>::SlipEndsOnLine(int contact) const {
  return kEncloses<Scalar> && !line_.empty() && slip_ends_.contains({contact, line_});
}

template <class Scalar>
void PublishedInSpace<Scalar>::NoteSlipEnds() {
  for (int contact = 0; contact < layout_.ContactCount(); ++contact) {
    const int row = layout_.NormalRowOf(contact) + 1;
    if (!layout_.HasFriction(row - 1) || !IsSurelyZero(state_.a[row]) || !IsSurelyZero(state_.a[row + 1]))
      continue;
    slip_ends_.insert({contact, line_});
    if (assumes_turnings_) ends_in_period_.insert({contact, line_in_period_});
  }
}

// What is named in one period is named by the same numbers in the next.
template <class Scalar>
void PublishedInSpace<Scalar>::BeginPeriod() {
  axes_before_ = turned_axes_;
  recorded_before_ = recorded_anew_;
  ends_before_ = std::move(ends_in_period_);
  ends_in_period_.clear();
}

// f += s df, a += s da. Where a normal left C, and comes back to aN = 0 along the line that the run took from
// there, f and a are what they were.
template <class Scalar>
void PublishedInSpace<Scalar>::MoveAlong(const Step<Scalar>& step, bool zero) {
  if (kEncloses<Scalar> && !zero) {
    if (!std::equal(line_.begin(), line_.end(), last_line_.begin(), last_line_.end())) ++lines_followed_;
    last_line_ = line_;
    NoteSlipEnds();
    if (line_.empty()) trail_ = {};
    if (trail_.line.empty()) trail_.line = line_;
    if (!line_.empty() && trail_.line == line_ && trail_.normal == step.limiting &&
        step.wants == IndexSet::kClamped) {
      state_.f = trail_.f;
      state_.a = trail_.a;
      return;
    }
  }
  for (int row = 0; row < problem_->rows(); ++row) {
    if (!IsSurelyZero(direction_.df()[row])) state_.f[row] += step.s * direction_.df()[row];
    if (!IsSurelyZero(direction_.da()[row])) state_.a[row] += step.s * direction_.da()[row];
  }
}

// ---- A state of the main loop -----------------------------------------------------------------

template <class Scalar>
auto PublishedInSpace<Scalar>::standing() const -> Standing {
  Standing standing = {state_.sets, given_up_by_turning_, -1, f(), {}, recorded_anew_};
  if (request_.policy.resume == Resume::kRound) standing.last_driven = last_driven_contact_;
  for (const Frame& frame : frames_) standing.recorded.push_back(frame.p);
  return standing;
}

// What rests acts like b; then a = 0 in C and CF, where a normal takes its friction along in NCF.
template <class Scalar>
void PublishedInSpace<Scalar>::StandAt(const Standing& standing) {
  state_.sets = standing.sets;
  given_up_by_turning_ = standing.turned_away;
  last_driven_contact_ = standing.last_driven;
  Problem resting = *problem_;
  ListedUnknowns<Scalar, Eigen::Dynamic> unknowns;
  unknowns.Start(resting);
  state_.f = standing.f;
  for (int row = 0; row < problem_->rows(); ++row) {
    if (!IsUnknown(state_.sets[row])) continue;
    state_.f[row] = Scalar(0);
    unknowns.rests[row].SetUnit(row);
    unknowns.forces[row].SetUnit(row);
  }
  for (int contact = 0; contact < layout_.ContactCount(); ++contact) {
    const int row = layout_.NormalRowOf(contact);
    if (!layout_.HasFriction(row) || state_.sets[row + 1] != IndexSet::kAtUpper) continue;
    const Scalar& mu = problem_->contacts[contact].mu;
    const Tangent& d = standing.recorded[contact];
    state_.f[row + 1] = mu * state_.f[row] * d[0];
    state_.f[row + 2] = mu * state_.f[row] * d[1];
    if (IsUnknown(state_.sets[row]))
      unknowns.forces[row].Set(row, Scalar(1), Scalar(mu * d[0]), Scalar(mu * d[1]));
  }
  resting.b = problem_->A * state_.f + problem_->b;
  using System = DirectionSystem<Scalar, Eigen::Dynamic>;
  if (direction_.SolveForces(resting, unknowns, scale_) != System::Status::kRegular) Unsure<Scalar>::Refuse();
  state_.f += direction_.df();
  state_.a = direction_.da();
  for (int contact = 0; contact < layout_.ContactCount(); ++contact) {
    const int row = layout_.NormalRowOf(contact);
    if (!layout_.HasFriction(row) || state_.sets[row + 1] != IndexSet::kAtUpper) continue;
    Turn(contact, standing.recorded[contact]);
    state_.f[row + 1] = Bound(row + 1);
    state_.f[row + 2] = Scalar(0);
  }
  if (!SetsHold()) Unsure<Scalar>::Refuse();
}

// Whether what the sets keep holds, of CF strictly.
template <class Scalar>
bool PublishedInSpace<Scalar>::SetsHold() const {
  using std::sqrt;
  for (int row = 0; row < problem_->rows(); ++row) {
    const IndexSet set = state_.sets[row];
    if (set == IndexSet::kClamped && Sign(state_.f[row]) < 0) return false;
    if (set == IndexSet::kSeparating && Sign(state_.a[row]) < 0) return false;
    const bool sticks = set == IndexSet::kSticking && row == FrictionOf(row);
    if (sticks && Sign(Scalar(Bound(row) - sqrt(Square(state_.f, row)))) <= 0) return false;
  }
  return true;
}

// ---- Repeated states and budgets -------------------------------------------------------------

// Sets, forces, recorded directions, and who was given up by turning.
template <class Scalar>
std::uint64_t PublishedInSpace<Scalar>::RoundedHash() const {
  std::uint64_t hash = 0x9e3779b97f4a7c15u;
  const auto mix = [&hash](std::uint64_t word) {
    hash = (hash ^ word) * 0xff51afd7ed558ccdu;
    hash ^= hash >> 32;
  };
  const auto mix_rounded = [&mix](const Scalar& x, double inverse_grain) {
    // The offset keeps numbers that are round in the problem's scale away from the edges of the grains.
    const double grains = Approximation<Scalar>::Of(x) * inverse_grain + 0.318309886;
    mix(std::abs(grains) < 9e18 ? static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(grains)))
                                : 0);
  };
  const Vector forces = f();
  for (int row = 0; row < problem_->rows(); ++row) {
    mix_rounded(forces[row], inverse_grain_);
    mix(static_cast<std::uint64_t>(state_.sets[row]));
    if (state_.sets[row] != IndexSet::kAtUpper) continue;
    for (const Scalar& component : frames_[layout_.ContactOf(row)].p)
      mix_rounded(component, 1 / request_.tolerances.loop_grain);
  }
  for (const char turning : given_up_by_turning_) mix(static_cast<std::uint64_t>(turning));
  if (request_.policy.resume == Resume::kRound) mix(static_cast<std::uint64_t>(last_driven_contact_ + 1));
  return hash;
}

// Whether the sets decide all forces, if the matrix of C and CF is regular: then a_C = 0 and a_CF = 0 are
// equations for the forces of these, and all others are zero. And no direction is remembered; marks are
// compared with the sets.
template <class Scalar>
bool PublishedInSpace<Scalar>::Memoryless() const {
  for (int row = 0; row < problem_->rows(); ++row) {
    const IndexSet set = state_.sets[row];
    const bool solved_for = set == IndexSet::kClamped || set == IndexSet::kSticking;
    if (!solved_for && !IsSurelyZero(state_.f[row])) return false;
    if (set == IndexSet::kAtUpper) return false;
  }
  return true;
}

template <class Scalar>
bool PublishedInSpace<Scalar>::EndCycle(const OuterState& earlier) {
  verdict_.start = earlier.drives;
  verdict_.period = verdict_.statistics.drives - earlier.drives;
  End(Outcome::kCycle);
  return true;
}

template <class Scalar>
bool PublishedInSpace<Scalar>::OuterStateRecurs() {
  OuterState now = {verdict_.statistics.drives, RoundedHash(), {}, {}, -1, false};
  if constexpr (kIsExact<Scalar>) {
    now.sets = state_.sets;
    now.turned_away = given_up_by_turning_;
    if (request_.policy.resume == Resume::kRound) now.contact = last_driven_contact_;
    now.memoryless = Memoryless();
    now.singular_directions = verdict_.statistics.singular_directions;
  }
  int alike = 0;
  for (const OuterState& earlier : outer_states_) {
    if constexpr (kIsExact<Scalar>) {
      // A solution of a singular system is taken by the order of its rows, in axes that are remembered.
      const bool regular = earlier.regular && earlier.singular_directions == now.singular_directions;
      if (now.memoryless && earlier.memoryless && regular && earlier.sets == now.sets &&
          earlier.turned_away == now.turned_away && earlier.contact == now.contact)
        return EndCycle(earlier);
    }
    if (earlier.rounded != now.rounded) continue;
    if constexpr (!kIsExact<Scalar>) return EndCycle(earlier);
    verdict_.start = earlier.drives;
    verdict_.period = now.drives - earlier.drives;
    ++alike;
  }
  if (alike == 2) {  // a period without a state that proves it has passed
    End(Outcome::kUndecided, "a state recurs as far as rounding shows");
    return true;
  }
  verdict_.start = verdict_.period = 0;
  outer_states_.push_back(std::move(now));
  return false;
}

template <class Scalar>
bool PublishedInSpace<Scalar>::BudgetSpent() {
  if (verdict_.statistics.drives > request_.limits.drives) {
    End(Outcome::kLimit, "drives");
  } else if (verdict_.statistics.steps >= request_.limits.pivots) {
    End(Outcome::kLimit, "pivots");
  } else if (request_.limits.Stopped()) {
    End(Outcome::kUndecided, kStopped);
  } else {
    EndUnlessFinite();
  }
  return Ended();
}

// Ends a run that has met infinity or what is not a number; by the same test.
template <class Scalar>
void PublishedInSpace<Scalar>::EndUnlessFinite() {
  if constexpr (!kIsExact<Scalar>) {
    Scalar zero = 0;
    for (int row = 0; row < problem_->rows(); ++row)
      zero += (state_.f[row] - state_.f[row]) + (state_.a[row] - state_.a[row]);
    if (zero != 0) End(Outcome::kUndecided, kNotFinite);
  }
}

// Before the step, which can turn axes.
template <class Scalar>
void PublishedInSpace<Scalar>::RecordDirection(int driven, DriveGoal goal) {
  if (trace_ == nullptr) return;
  Pivot<Scalar>& pivot = trace_->emplace_back();
  pivot.drive = static_cast<int>(verdict_.statistics.drives);
  pivot.driven = driven;
  pivot.goal = goal;
  pivot.df = InProblemAxes(direction_.df());
  pivot.da = InProblemAxes(direction_.da());
}

template <class Scalar>
void PublishedInSpace<Scalar>::RecordStep(const Step<Scalar>& step, IndexSet from, bool gave_up) {
  if (trace_ == nullptr) return;
  Pivot<Scalar>& pivot = trace_->back();
  const int contact = layout_.ContactOf(step.limiting);
  const bool at_limit = step.wants == IndexSet::kAtUpper && !gave_up;  // NCF stands on the first row
  pivot.s = step.s;
  pivot.limiting = step.limiting;
  pivot.from = from;
  pivot.to = state_.sets[at_limit ? FrictionOf(step.limiting) : step.limiting];
  pivot.wanted = step.wants;
  pivot.gave_up = gave_up;
  pivot.turned_away = from == IndexSet::kAtUpper && pivot.to == IndexSet::kNone && !gave_up &&
                      static_cast<bool>(given_up_by_turning_[contact]);
  pivot.f = f();
  pivot.a = a();
  pivot.sets.assign(state_.sets.begin(), state_.sets.end());
  pivot.recorded.assign(layout_.ContactCount(), {Scalar(0), Scalar(0)});
  for (int row = 0; row < problem_->rows(); ++row) {
    if (state_.sets[row] == IndexSet::kAtUpper)
      pivot.recorded[layout_.ContactOf(row)] = frames_[layout_.ContactOf(row)].p;
  }
}

}  // namespace stiction
