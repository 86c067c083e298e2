// SPDX-License-Identifier: Apache-2.0
// Definitions for published.h, in the order in which the paper tells them.

#pragma once

#include <algorithm>

#include "solver/linear/direction.ipp"
#include "solver/published/published.h"
#include "solver/published/scan.h"
#include "solver/published/step_size.ipp"

namespace stiction {

// Sets the friction forces that are held at a limit.
template <class Scalar, int Rows>
void FollowLimits(const ContactProblem<Scalar, Rows>& problem, const RowLayout<Rows>& layout,
                  const IndexSets<Rows>& sets, typename ContactProblem<Scalar, Rows>::Vector& f) {
  for (int row = 0; row < problem.rows(); ++row) {
    const int limit = FrictionLimitSign(layout, sets, row);
    if (limit == 0) continue;
    const Scalar bound = problem.contacts[layout.ContactOf(row)].mu * f[row];
    if (limit > 0) {
      f[row + 1] = bound;
    } else {
      f[row + 1] = -bound;
    }
  }
}

// ---- Main loop: 4.3 compute-forces, 5.5 ------------------------------------------------------

template <class Scalar, int Rows>
Verdict PublishedAlgorithm<Scalar, Rows>::Run(const Problem& problem, Trace<Scalar>* trace) {
  Start(problem, trace);
  if (!IsFinite(problem)) End(Outcome::kUndecided, kNotFinite);
  ComputeForces();
  return verdict_;
}

template <class Scalar, int Rows>
void PublishedAlgorithm<Scalar, Rows>::ComputeForces() {
  while (!Ended()) {
    if (OuterStateRecurs()) break;
    Sweep();
    const int violated = ScanForViolated();
    if (violated < 0) {
      if (!IsFinite()) return;
      End(Outcome::kSolved);
    } else {
      Establish(violated);
    }
  }
}

template <class Scalar, int Rows>
void PublishedAlgorithm<Scalar, Rows>::Start(const Problem& problem, Trace<Scalar>* trace) {
  const int rows = problem.rows();
  problem_ = &problem;
  trace_ = trace;
  if (trace_ != nullptr) {
    trace_->pivots.clear();
    trace_->consulted = 0;
  }
  layout_.Assign(problem.contacts);
  scale_ = MakeScale(problem, request_.tolerances);
  direction_.Start(problem, update_from_);
  step_size_.Resize(rows);
  if constexpr (Rows == Eigen::Dynamic) state_.f.resize(rows);
  Rest();
  Reset<IndexSet, Rows>(last_left_, rows, IndexSet::kNone);
  verdict_ = {};
  ended_ = false;
  last_driven_contact_ = -1;
  last_step_zero_ = false;
  outer_states_.clear();
  inner_states_.clear();
  if constexpr (kEncloses<Scalar>) {
    leavings_.clear();
    Reset<int, Rows>(left_at_, rows, -1);
  }
}

// f = 0, and no variable in a set.
template <class Scalar, int Rows>
void PublishedAlgorithm<Scalar, Rows>::Rest() {
  for (int row = 0; row < problem_->rows(); ++row) state_.f[row] = Scalar(0);
  state_.a = problem_->b;
  Reset<IndexSet, Rows>(state_.sets, problem_->rows(), IndexSet::kNone);
}

template <class Scalar, int Rows>
void PublishedAlgorithm<Scalar, Rows>::End(Outcome outcome, std::string_view reason) {
  verdict_.outcome = outcome;
  verdict_.reason = reason;
  ended_ = true;
}

template <class Scalar, int Rows>
bool PublishedAlgorithm<Scalar, Rows>::NormalHolds(int row) const {  // (15)
  const int f = Sign(state_.f[row], scale_.force);
  const int a = Sign(state_.a[row], scale_.acceleration);
  return f >= 0 && a >= 0 && (f == 0 || a == 0);
}

template <class Scalar, int Rows>
bool PublishedAlgorithm<Scalar, Rows>::FrictionHolds(int row) const {  // (16)
  const Scalar bound = problem_->contacts[layout_.ContactOf(row)].mu * state_.f[row - 1];
  const int f = Sign(state_.f[row], scale_.force);
  const int a = Sign(state_.a[row], scale_.acceleration);
  const int slack = Sign(Scalar(bound - Abs(state_.f[row])), scale_.force);
  return slack >= 0 && a * f <= 0 && (a == 0 || slack == 0);
}

template <class Scalar, int Rows>
bool PublishedAlgorithm<Scalar, Rows>::Violated(int row) const {
  if (kEncloses<Scalar> && state_.sets[row] != IndexSet::kNone) return false;  // by its set
  if (layout_.IsNormal(row)) return !NormalHolds(row);
  return NormalHolds(row - 1) && !FrictionHolds(row);
}

// Satisfied variables that no drive established: switches `admit` (4.1 against 4.3) and `file`.
template <class Scalar, int Rows>
void PublishedAlgorithm<Scalar, Rows>::Sweep() {
  for (int row = 0; row < problem_->rows(); ++row) {
    if (state_.sets[row] != IndexSet::kNone) continue;
    if (layout_.IsNormal(row)) {
      const bool rests =
          Sign(state_.f[row], scale_.force) == 0 && Sign(state_.a[row], scale_.acceleration) >= 0;
      if (!rests) continue;
      Consult(PolicySwitch::kAdmit);
      if (request_.policy.admit == Admit::kEager) state_.sets[row] = IndexSet::kSeparating;
    } else if (NormalHolds(row - 1) && FrictionHolds(row)) {
      const bool presses = Sign(state_.f[row - 1], scale_.force) > 0;
      if (!presses && state_.sets[row - 1] != IndexSet::kSeparating) continue;
      Consult(PolicySwitch::kFile);
      if (request_.policy.file == File::kNo) continue;
      if (presses) {
        FileBySign(row);
      } else {
        state_.sets[row] = IndexSet::kSuspended;
      }
    }
  }
}

template <class Scalar, int Rows>
void PublishedAlgorithm<Scalar, Rows>::FileBySign(int row) {
  const int a = Sign(state_.a[row], scale_.acceleration);
  state_.sets[row] = a < 0 ? IndexSet::kAtUpper : a > 0 ? IndexSet::kAtLower : IndexSet::kSticking;
}

template <class Scalar, int Rows>
int PublishedAlgorithm<Scalar, Rows>::ScanForViolated() {
  ++verdict_.statistics.outer_scans;
  const Policy& policy = request_.policy;
  const int picked = Pick(policy.scan, policy.resume);
  // Over enclosures no more is asked than the policy asks.
  if (trace_ == nullptr || picked < 0 || kEncloses<Scalar>) return picked;
  bool any = false, by_scan = false, by_resume = false;  // whether some reading picks another variable
  for (int scan = 0; scan < 4; ++scan) {
    for (int resume = 0; resume < 2; ++resume) {
      if (Pick(static_cast<Scan>(scan), static_cast<Resume>(resume)) == picked) continue;
      any = true;
      by_scan |= static_cast<Resume>(resume) == policy.resume;
      by_resume |= static_cast<Scan>(scan) == policy.scan;
    }
  }
  if (any && (by_scan || !by_resume)) Consult(PolicySwitch::kScan);
  if (any && by_resume) Consult(PolicySwitch::kResume);
  return picked;
}

// The row of the variable to drive next, -1 if no condition is violated.
template <class Scalar, int Rows>
int PublishedAlgorithm<Scalar, Rows>::Pick(Scan scan, Resume resume) const {
  const auto worse = [this](int row, int other) {
    return layout_.IsNormal(row) ? state_.a[row] < state_.a[other] : Abs(state_.a[row]) > Abs(state_.a[other]);
  };
  return PickViolated(
      layout_, scan, resume, last_driven_contact_, [this](int row) { return Violated(row); }, worse);
}

// Establishes the conditions of a violated variable; a friction force that rests from before it was given
// up is first driven to zero (5.5).
template <class Scalar, int Rows>
void PublishedAlgorithm<Scalar, Rows>::Establish(int row) {
  if (layout_.IsNormal(row) || Sign(state_.f[row], scale_.force) == 0) {
    return DriveToZero(row, DriveGoal::kEstablish);
  }
  DriveToZero(row, DriveGoal::kZero);
  if (Ended() || !Violated(row)) return;
  Consult(PolicySwitch::kRezero);
  if (request_.policy.rezero == Rezero::kContinue) DriveToZero(row, DriveGoal::kEstablish);
}

// ---- One drive: 4.3 drive-to-zero, 5.2-5.5 ---------------------------------------------------

template <class Scalar, int Rows>
void PublishedAlgorithm<Scalar, Rows>::DriveToZero(int driven, DriveGoal goal) {
  Statistics& statistics = verdict_.statistics;
  ++statistics.drives;
  last_driven_contact_ = layout_.ContactOf(driven);
  Reset<IndexSet, Rows>(last_left_, problem_->rows(), IndexSet::kNone);
  last_step_zero_ = false;
  zero_run_ = 0;
  inner_states_.clear();
  const bool normal = layout_.IsNormal(driven);
  if (normal && layout_.HasFriction(driven) && state_.sets[driven + 1] == IndexSet::kSuspended) {
    FileBySign(driven + 1);
  }
  const int sign = normal ? 1 : goal == DriveGoal::kZero ? -Sign(state_.f[driven]) : -Sign(state_.a[driven]);
  if constexpr (kEncloses<Scalar>) left_at_[driven] = -1;
  while (true) {
    if (InnerStateRecurs() || BudgetSpent()) return;
    const Status status = SolveDirection(driven, sign);
    if (status != Status::kRegular) ++statistics.singular_directions;
    if (status == Status::kInconsistent) return End(Outcome::kSingular);
    if constexpr (kEncloses<Scalar>) MeetDependentZeros(dependent_rows_, direction_.da());
    const Step<Scalar> step =
        step_size_.Find(*problem_, layout_, state_, direction_, driven, goal, request_.policy.ties, scale_);
    if (step.limiting < 0) return End(Outcome::kRay);
    if (step.order_matters) Consult(PolicySwitch::kTies);
    const bool zero = Sign(step.s, scale_.force) == 0;
    if (kEncloses<Scalar> && !zero) step_size_.LeaveBounds();
    Advance(step.s, step.limiting, step.wants, driven);
    ++statistics.steps;
    statistics.zero_steps += zero;
    zero_run_ = zero ? zero_run_ + 1 : 0;
    statistics.longest_zero_run = std::max(statistics.longest_zero_run, zero_run_);
    const IndexSet from = state_.sets[step.limiting];
    const bool wants_back = step.limiting != driven && step.wants == last_left_[step.limiting];
    const bool gives_up = GivesUp(request_.policy.give_up, wants_back, zero, last_step_zero_);
    if (wants_back && zero != last_step_zero_) Consult(PolicySwitch::kGiveUp);
    statistics.bounces += wants_back && zero;
    statistics.give_ups += gives_up;
    if (gives_up) {
      if constexpr (kEncloses<Scalar>) NoteLeaving(step, driven, status);
      GiveUpLimiting(step.limiting, driven);
    } else {
      MoveLimiting(step.limiting, step.wants);
    }
    statistics.pivots += state_.sets[step.limiting] != from;
    last_step_zero_ = zero;
    Record(driven, goal, step, from, gives_up);
    if (step.limiting == driven) return;
  }
}

// Over balls that leave a pivot open, as often where the system is singular, rationals may tell.
template <class Scalar, int Rows>
auto PublishedAlgorithm<Scalar, Rows>::SolveDirection(int driven, int sign) -> Status {
  const auto solve = [&] { return direction_.Solve(*problem_, layout_, state_.sets, driven, sign, scale_); };
  if constexpr (kEncloses<Scalar> && Rows == Eigen::Dynamic) {
    if (exact_directions_ != nullptr) {
      try {
        return solve();
      } catch (const UnsureSign&) {
        return exact_directions_->Solve(state_.sets, driven, sign, direction_.df(), direction_.da());
      }
    }
  }
  return solve();
}

// What is known of the forces after a step decides them where its direction is the only one: along it, the
// condition of the limiting variable holds at one point.
template <class Scalar, int Rows>
void PublishedAlgorithm<Scalar, Rows>::NoteLeaving(const Step<Scalar>& step, int driven, Status status) {
  Leaving leaving = {{}, left_at_, status == Status::kRegular};
  leaving.known.assign(left_at_.size(), {});
  for (int row = 0; row < problem_->rows(); ++row) {
    const IndexSet set = state_.sets[row];
    const int limit = LimitSign(row == step.limiting && LimitSign(step.wants) != 0 ? step.wants : set);
    const bool is_zero = IsSurelyZero(state_.f[row]), rests = IsSurelyZero(state_.a[row]);
    const bool is_left = !is_zero && limit == 0 && !IsUnknown(set) && row != driven;
    leaving.known[row] = {rests, is_zero, is_zero ? 0 : limit};
    leaving.before[row] = is_left ? LeftAt(row) : -1;
    leaving.decided &= (!is_left || LeftAt(row) >= 0) && (rests || !IsUnknown(set));
  }
  const auto same = leaving.decided ? std::find(leavings_.begin(), leavings_.end(), leaving) : leavings_.end();
  const int number = static_cast<int>(same - leavings_.begin());
  if (same == leavings_.end()) leavings_.push_back(std::move(leaving));
  const bool with_friction = layout_.IsNormal(step.limiting) && layout_.HasFriction(step.limiting);
  for (int row = step.limiting; row <= step.limiting + with_friction; ++row) left_at_[row] = number;
}

// f += s df, a += s da. Over inexact scalars and enclosures the limit that was reached is then met exactly;
// over enclosures all friction at a limit is, which where fN = 0 is zero.
template <class Scalar, int Rows>
void PublishedAlgorithm<Scalar, Rows>::Advance(const Scalar& s, int limiting, IndexSet wants, int driven) {
  (void)driven;
  for (int row = 0; row < problem_->rows(); ++row) {
    state_.f[row] += s * direction_.df()[row];
    state_.a[row] += s * direction_.da()[row];
  }
  if constexpr (kMeetsLimits<Scalar>) {
    Scalar& f = state_.f[limiting];
    switch (wants) {
      case IndexSet::kClamped:
      case IndexSet::kSticking:
        state_.a[limiting] = Scalar(0);
        break;
      case IndexSet::kAtLower:
      case IndexSet::kAtUpper: {
        const Scalar bound = problem_->contacts[layout_.ContactOf(limiting)].mu * state_.f[limiting - 1];
        f = wants == IndexSet::kAtUpper ? bound : -bound;
        break;
      }
      case IndexSet::kNone:
      case IndexSet::kSeparating:
      case IndexSet::kSuspended:
        f = Scalar(0);
        break;
    }
  }
  if constexpr (kEncloses<Scalar>) {
    FollowLimits(*problem_, layout_, state_.sets, state_.f);
    MeetDependentZeros(dependent_rows_, state_.a);
  }
}

template <class Scalar, int Rows>
void PublishedAlgorithm<Scalar, Rows>::Move(int row, IndexSet to) {
  last_left_[row] = state_.sets[row];
  state_.sets[row] = to;
}

// The limiting variable changes its set, and its partner with it where the contact opens or closes.
template <class Scalar, int Rows>
void PublishedAlgorithm<Scalar, Rows>::MoveLimiting(int row, IndexSet wants) {
  if constexpr (kEncloses<Scalar>) {
    if (wants == IndexSet::kSticking) step_size_.MeetBound(row, LimitSign(state_.sets[row]));
  }
  Move(row, wants);
  if (!layout_.IsNormal(row) || !layout_.HasFriction(row)) return;
  const int friction = row + 1;
  if (wants == IndexSet::kSeparating && IsFrictionSet(state_.sets[friction])) {
    Consult(PolicySwitch::kApex);
    if (request_.policy.apex == Apex::kSuspended) Move(friction, IndexSet::kSuspended);
  } else if (wants == IndexSet::kClamped && state_.sets[friction] == IndexSet::kSuspended) {
    last_left_[friction] = IndexSet::kSuspended;
    FileBySign(friction);
  }
}

// "j is removed from whatever index set it was in" (5.5).
template <class Scalar, int Rows>
void PublishedAlgorithm<Scalar, Rows>::GiveUpLimiting(int row, int driven) {
  Move(row, IndexSet::kNone);
  if (!layout_.IsNormal(row) || !layout_.HasFriction(row)) return;
  const int friction = row + 1;
  if (friction == driven || state_.sets[friction] == IndexSet::kNone) return;
  Consult(PolicySwitch::kDrop);
  if (request_.policy.drop == Drop::kContact) Move(friction, IndexSet::kNone);
}

// ---- Repeated states and budgets -------------------------------------------------------------

template <class Scalar, int Rows>
std::uint64_t PublishedAlgorithm<Scalar, Rows>::RoundedHash() const {
  std::uint64_t hash = 0x9e3779b97f4a7c15u;
  const auto mix = [&hash](std::uint64_t word) {
    hash = (hash ^ word) * 0xff51afd7ed558ccdu;
    hash ^= hash >> 32;
  };
  for (int row = 0; row < problem_->rows(); ++row) {
    // The offset keeps numbers that are round in the problem's scale away from the edges of the grains.
    std::int64_t rounded = 0;
    if constexpr (!kIsExact<Scalar>) {
      const Scalar grains = state_.f[row] * scale_.inverse_grain + Scalar(0.318309886);
      if (Abs(grains) < Scalar(9e18)) rounded = static_cast<std::int64_t>(grains);
    }
    mix(static_cast<std::uint64_t>(rounded) * 8 + static_cast<std::uint64_t>(state_.sets[row]));
  }
  return hash;
}

// Over enclosures: whether some force is surely another one now.
template <class Scalar, int Rows>
bool PublishedAlgorithm<Scalar, Rows>::SurelyDiffers(const Vector& f) const {
  for (int row = 0; row < problem_->rows(); ++row) {
    const Scalar change = state_.f[row] - f[row];
    if (Unsure<Scalar>::TellsSign(change) && !IsSurelyZero(change)) return true;
  }
  return false;
}

// Over enclosures: whether the forces, now and in an earlier state of the same sets, are the one solution of
// the equations of these sets, where some forces were left the same.
template <class Scalar, int Rows>
bool PublishedAlgorithm<Scalar, Rows>::SetsDecideForces(const OuterState& earlier) {
  for (int row = 0; row < problem_->rows(); ++row) {
    const bool decided = IsUnknown(state_.sets[row]) || LimitSign(state_.sets[row]) != 0;
    const bool left = LeftAt(row) >= 0 && LeftAt(row) == earlier.left_at[row];
    if (!decided && !left && !(IsSurelyZero(state_.f[row]) && IsSurelyZero(earlier.f[row]))) return false;
  }
  const SetUnknowns<Scalar, Rows> unknowns{*problem_, layout_, state_.sets};
  return direction_.SolveForces(*problem_, unknowns, scale_) == Status::kRegular;
}

template <class Scalar, int Rows>
bool PublishedAlgorithm<Scalar, Rows>::OuterStateRecurs() {
  const int contact = request_.policy.resume == Resume::kRound ? last_driven_contact_ : -1;
  std::uint64_t rounded = 0;
  if constexpr (!kIsExact<Scalar>) rounded = RoundedHash();
  for (const OuterState& earlier : outer_states_) {
    if (earlier.contact != contact) continue;
    if constexpr (kEncloses<Scalar>) {
      if (earlier.sets != state_.sets || SurelyDiffers(earlier.f)) continue;
      if (!SetsDecideForces(earlier)) Unsure<Scalar>::Refuse();
    } else if constexpr (kIsExact<Scalar>) {
      if (earlier.sets != state_.sets || earlier.f != state_.f) continue;
    } else {
      if (earlier.rounded != rounded) continue;
    }
    verdict_.start = earlier.drives;
    verdict_.period = verdict_.statistics.drives - earlier.drives;
    Consult(PolicySwitch::kResume);  // it remembers the contact driven last, which need not recur
    End(Outcome::kCycle);
    return true;
  }
  OuterState& now = outer_states_.emplace_back();
  now.drives = verdict_.statistics.drives;
  now.rounded = rounded;
  now.contact = contact;
  if constexpr (kIsExact<Scalar>) {
    now.sets = state_.sets;
    now.f = state_.f;
  }
  if constexpr (kEncloses<Scalar>) now.left_at = left_at_;
  return false;
}

// Forces rest during zero steps, and driving moves f_d one way: a state of a drive can only recur within
// one run of zero steps, and not at the state before its first one.
template <class Scalar, int Rows>
bool PublishedAlgorithm<Scalar, Rows>::InnerStateRecurs() {
  if (!last_step_zero_) {
    inner_states_.clear();
    return false;
  }
  for (const InnerState& earlier : inner_states_) {
    if (earlier.sets != state_.sets || earlier.last_left != last_left_) continue;
    verdict_.start = earlier.steps;
    verdict_.period = verdict_.statistics.steps - earlier.steps;
    End(Outcome::kStall);
    return true;
  }
  inner_states_.push_back({verdict_.statistics.steps, state_.sets, last_left_});
  return false;
}

template <class Scalar, int Rows>
bool PublishedAlgorithm<Scalar, Rows>::BudgetSpent() {
  const Limits& limits = request_.limits;
  if (verdict_.statistics.drives > limits.drives) {
    End(Outcome::kLimit, "drives");
  } else if (verdict_.statistics.steps >= limits.pivots) {
    End(Outcome::kLimit, "pivots");
  } else if (limits.Stopped()) {
    End(Outcome::kUndecided, kStopped);
  } else if constexpr (kIsExact<Scalar>) {
    for (int row = 0; row < problem_->rows(); ++row) {
      if (BitLength<Scalar>::Of(state_.f[row]) > limits.bits) End(Outcome::kLimit, "bits");
    }
  } else {
    IsFinite();
  }
  return Ended();
}

// x - x is zero for finite x only.
template <class Scalar, int Rows>
bool PublishedAlgorithm<Scalar, Rows>::IsFinite(const Problem& problem) {
  if constexpr (!kIsExact<Scalar>) {
    Scalar zero = Scalar(0);
    for (const auto& contact : problem.contacts) zero += contact.mu - contact.mu;
    for (int j = 0; j < problem.rows(); ++j) {
      zero += problem.b[j] - problem.b[j];
      for (int i = 0; i < problem.rows(); ++i) zero += problem.A(i, j) - problem.A(i, j);
    }
    return zero == 0;
  }
  return true;
}

// Ends an inexact run that has met infinity or what is not a number.
template <class Scalar, int Rows>
bool PublishedAlgorithm<Scalar, Rows>::IsFinite() {
  if constexpr (!kIsExact<Scalar>) {
    Scalar sum = Scalar(0);
    for (int row = 0; row < problem_->rows(); ++row) sum += Abs(state_.f[row]) + Abs(state_.a[row]);
    if (!(sum <= std::numeric_limits<Scalar>::max())) End(Outcome::kUndecided, kNotFinite);
  }
  return !Ended();
}

template <class Scalar, int Rows>
void PublishedAlgorithm<Scalar, Rows>::Record(int driven, DriveGoal goal, const Step<Scalar>& step,
                                              IndexSet from, bool gave_up) {
  if (trace_ == nullptr || !trace_->keep_pivots) return;
  Pivot<Scalar>& pivot = trace_->pivots.emplace_back();
  pivot.drive = static_cast<int>(verdict_.statistics.drives);
  pivot.driven = driven;
  pivot.goal = goal;
  pivot.df = direction_.df();
  pivot.da = direction_.da();
  pivot.s = step.s;
  pivot.limiting = step.limiting;
  pivot.from = from;
  pivot.to = state_.sets[step.limiting];
  pivot.wanted = step.wants;
  pivot.gave_up = gave_up;
  pivot.f = state_.f;
  pivot.a = state_.a;
  pivot.sets.assign(state_.sets.begin(), state_.sets.end());
}

}  // namespace stiction
