// SPDX-License-Identifier: Apache-2.0
// Definitions for step_size.h.

#pragma once

#include "solver/linear/direction.h"
#include "solver/published/step_size.h"

namespace stiction {

template <class Scalar, int Rows>
void StepSize<Scalar, Rows>::Resize(int rows) {
  if constexpr (Rows == Eigen::Dynamic) limits_.resize(rows);
  if constexpr (kEncloses<Scalar>) Reset<int, Rows>(met_bound_, rows, 0);
}

template <class Scalar, int Rows>
void StepSize<Scalar, Rows>::Offer(Limit& limit, const Scalar& gap, const Scalar& rate, IndexSet wants,
                                   const Scalar& tolerance) {
  if constexpr (kEncloses<Scalar>) {
    if (!Unsure<Scalar>::MayBePositive(rate)) return;
    if (!Unsure<Scalar>::TellsSign(rate)) return limit.MayExistFrom(Unsure<Scalar>::Earliest(gap, rate));
  }
  if (Sign(rate, tolerance) <= 0) return;
  Scalar s = gap / rate;
  if (!kIsExact<Scalar> && s < 0) s = Scalar(0);  // gap < 0 by rounding only
  if constexpr (kEncloses<Scalar>) {
    if (limit.exists &&
        !Unsure<Scalar>::TellsSign(s - limit.s)) {  // two of one variable; either may be the first
      limit.exists = false;
      limit.MayExistFrom(Unsure<Scalar>::Earliest(limit.s, Scalar(1)));
      return limit.MayExistFrom(Unsure<Scalar>::Earliest(s, Scalar(1)));
    }
  }
  if (limit.exists && !(s < limit.s)) return;
  limit.s = std::move(s);
  limit.wants = wants;
  limit.exists = true;
}

template <class Scalar, int Rows>
void StepSize<Scalar, Rows>::LimitDriven(const Problem& problem, const RowLayout<Rows>& layout,
                                         const State& state, const DirectionSystem<Scalar, Rows>& direction,
                                         int driven, DriveGoal goal, const Scale<Scalar>& scale) {
  Limit& limit = limits_[driven];
  const auto& df = direction.df();
  const auto& da = direction.da();
  if (layout.IsNormal(driven)) {
    return Offer(limit, Scalar(-state.a[driven]), da[driven], IndexSet::kClamped, scale.rate);
  }
  if (goal == DriveGoal::kZero) {
    return Offer(limit, Abs(state.f[driven]), Scalar(1), IndexSet::kNone, Scalar(0));
  }
  // aF = 0 first, so that it wins a tie with the bound. Driving goes against aF: df = -sign(aF).
  const int sign = Sign(df[driven]);
  const Scalar toward = sign > 0 ? Scalar(da[driven]) : Scalar(-da[driven]);
  Offer(limit, Abs(state.a[driven]), toward, IndexSet::kSticking, scale.rate);
  const Scalar& mu = problem.contacts[layout.ContactOf(driven)].mu;
  const Scalar bound = mu * state.f[driven - 1];
  const Scalar gap = sign > 0 ? Scalar(bound - state.f[driven]) : Scalar(bound + state.f[driven]);
  Offer(limit, gap, Scalar(1 - mu * df[driven - 1]), sign > 0 ? IndexSet::kAtUpper : IndexSet::kAtLower,
        scale.pivot);
}

template <class Scalar, int Rows>
void StepSize<Scalar, Rows>::LimitMaintained(const Problem& problem, const RowLayout<Rows>& layout,
                                             const State& state, const DirectionSystem<Scalar, Rows>& direction,
                                             int row, const Scale<Scalar>& scale) {
  Limit& limit = limits_[row];
  const auto& df = direction.df();
  const auto& da = direction.da();
  switch (state.sets[row]) {
    case IndexSet::kClamped:
      return Offer(limit, state.f[row], Scalar(-df[row]), IndexSet::kSeparating, scale.pivot);
    case IndexSet::kSeparating:
      return Offer(limit, state.a[row], Scalar(-da[row]), IndexSet::kClamped, scale.rate);
    case IndexSet::kSticking: {
      const Scalar& mu = problem.contacts[layout.ContactOf(row)].mu;
      const Scalar bound = mu * state.f[row - 1];
      const Scalar growth = mu * df[row - 1];
      Offer(limit, GapToBound(bound, state.f[row], row, 1), Scalar(df[row] - growth), IndexSet::kAtUpper,
            scale.pivot);
      return Offer(limit, GapToBound(bound, state.f[row], row, -1), Scalar(-df[row] - growth),
                   IndexSet::kAtLower, scale.pivot);
    }
    case IndexSet::kAtUpper:
      return Offer(limit, Scalar(-state.a[row]), da[row], IndexSet::kSticking, scale.rate);
    case IndexSet::kAtLower:
      return Offer(limit, state.a[row], Scalar(-da[row]), IndexSet::kSticking, scale.rate);
    case IndexSet::kNone:
    case IndexSet::kSuspended:
      return;
  }
}

template <class Scalar, int Rows>
Scalar StepSize<Scalar, Rows>::GapToBound(const Scalar& bound, const Scalar& f, int row, int sign) const {
  if constexpr (kEncloses<Scalar>) {
    if (met_bound_[row] == sign) return Scalar(0);
  }
  return sign > 0 ? Scalar(bound - f) : Scalar(bound + f);
}

// C, NC, CF, NC-, NC+: the order of the enumerators. The nearest is within reach, and not compared.
template <class Scalar, int Rows>
int StepSize<Scalar, Rows>::FirstOf(const State& state, int driven, Ties ties, int nearest,
                                    const Scalar& reach) const {
  const auto within_reach = [&](int row) -> bool {
    if (!limits_[row].exists || row == nearest) return row == nearest;
    if constexpr (kEncloses<Scalar>) return Order(row, nearest) <= 0;
    return !(limits_[row].s > reach);
  };
  if (within_reach(driven)) return driven;
  int first = -1;
  for (int row = 0; row < static_cast<int>(limits_.size()); ++row) {
    if (!within_reach(row)) continue;
    if (first < 0 || (ties == Ties::kSets && state.sets[row] < state.sets[first])) first = row;
  }
  return first;
}

// Over enclosures: of two limits, which is reached first; 0: both at once. Accelerations may be known to reach
// zero together where their ends do not tell.
template <class Scalar, int Rows>
int StepSize<Scalar, Rows>::Order(int row, int other) const {
  const Scalar later = limits_[row].s - limits_[other].s;
  if (Unsure<Scalar>::TellsSign(later)) return Sign(later);
  const bool of_accelerations = IsUnknown(limits_[row].wants) && IsUnknown(limits_[other].wants);
  if (dependent_rows_ == nullptr || !of_accelerations) Unsure<Scalar>::Refuse();
  std::vector<bool> zero = resting_;
  zero[other] = true;
  if (!dependent_rows_->Follows(zero, row)) Unsure<Scalar>::Refuse();
  return 0;
}

template <class Scalar, int Rows>
bool StepSize<Scalar, Rows>::IsSurelyBefore(int row, int other) const {
  const Scalar later = limits_[row].s - limits_[other].s;
  return Unsure<Scalar>::TellsSign(later) && Sign(later) < 0;
}

// No limit is before the nearest. Those that may not exist do not matter if they are surely beyond it.
template <class Scalar, int Rows>
void StepSize<Scalar, Rows>::RequireBeyond(int nearest) const {
  for (int row = 0; row < static_cast<int>(limits_.size()); ++row) {
    const Limit& limit = limits_[row];
    if (limit.exists && row != nearest && Order(row, nearest) < 0) Unsure<Scalar>::Refuse();
    if (limit.may_exist && (nearest < 0 || !(limit.earliest > limits_[nearest].s))) Unsure<Scalar>::Refuse();
  }
}

template <class Scalar, int Rows>
Step<Scalar> StepSize<Scalar, Rows>::Find(const Problem& problem, const RowLayout<Rows>& layout,
                                          const State& state, const DirectionSystem<Scalar, Rows>& direction,
                                          int driven, DriveGoal goal, Ties ties, const Scale<Scalar>& scale) {
  const int rows = problem.rows();
  int nearest = -1;
  if constexpr (kEncloses<Scalar>) {
    if (dependent_rows_ != nullptr) {
      resting_ = SureZeros(state.a);
      for (int row = 0; row < rows; ++row) resting_[row] = resting_[row] && IsSurelyZero(direction.da()[row]);
    }
  }
  for (int row = 0; row < rows; ++row) {
    limits_[row].exists = limits_[row].may_exist = false;
    if (row == driven) {
      LimitDriven(problem, layout, state, direction, driven, goal, scale);
    } else {
      LimitMaintained(problem, layout, state, direction, row, scale);
    }
    if (!limits_[row].exists) continue;
    if constexpr (kEncloses<Scalar>) {  // those far away may tie: what is nearest is held against all below
      if (nearest < 0 || IsSurelyBefore(row, nearest)) nearest = row;
    } else {
      if (nearest < 0 || limits_[row].s < limits_[nearest].s) nearest = row;
    }
  }
  if constexpr (kEncloses<Scalar>) RequireBeyond(nearest);
  if (nearest < 0) return {};
  const Scalar reach = limits_[nearest].s + scale.force;
  const int limiting = FirstOf(state, driven, ties, nearest, reach);
  const Ties opposite = ties == Ties::kSets ? Ties::kContacts : Ties::kSets;
  const int other = FirstOf(state, driven, opposite, nearest, reach);
  return {limits_[limiting].s, limiting, limits_[limiting].wants, limiting != other};
}

}  // namespace stiction
