// SPDX-License-Identifier: Apache-2.0
// Definitions for updated_system.h.

#pragma once

#include "solver/linear/updated_system.h"

namespace stiction {

inline constexpr int kPause = 8;  // directions that are left alone after M could not be inverted well

template <class Scalar>
void UpdatedSystem<Scalar>::Start(const Problem& problem, int least) {
  const int rows = problem.rows();
  least_ = least;
  valid_ = false;
  pause_ = 0;
  counts_ = {};
  if (rows == 0 || rows < least) return;
  inverse_.Reserve(rows);
  slots_.clear();
  slot_of_.assign(rows, -1);
  for (Vector* v : {&row_, &column_, &x_, &correction_}) v->resize(rows);
  largest_ = problem.A.cwiseAbs().maxCoeff();
}

template <class Scalar>
template <class Unknowns>
bool UpdatedSystem<Scalar>::Solve(const Problem& problem, const Unknowns& unknowns, const Scale<Scalar>& scale,
                                  Vector& df, Vector& da, Load load) {
  if (problem.rows() == 0 || problem.rows() < least_) return false;
  const std::int64_t inverted = counts_.inverted;
  bool found = Follow(problem, unknowns, scale);
  if (found && !FindDirection(problem, unknowns, load, df, da)) {
    found = counts_.inverted == inverted && InvertAnew(problem, unknowns, scale) &&
            FindDirection(problem, unknowns, load, df, da);
    if (!found) pause_ = kPause;
  }
  if (found) {
    ++counts_.solved;
  } else {
    ++counts_.refused;
  }
  return found;
}

// Brings the inverse from the unknowns that it was made for to those of now. Unknowns come before columns
// change, and go after that: between sticking and sliding a column operation apart, M then stays what it was.
template <class Scalar>
template <class Unknowns>
bool UpdatedSystem<Scalar>::Follow(const Problem& problem, const Unknowns& unknowns,
                                   const Scale<Scalar>& scale) {
  int count = 0;
  for (int row = 0; row < problem.rows(); ++row) count += unknowns.IsUnknown(row);
  if (count == 0 || count < least_) return false;
  if (pause_ > 0) {
    --pause_;
    return false;
  }
  int changes = CountChanges(problem, unknowns);
  if (!valid_ || 3 * changes > count) return InvertAnew(problem, unknowns, scale);
  while (changes > 0) {
    int made = AppendNew(problem, unknowns);
    made += ReplaceColumns(problem, unknowns);
    made += RemoveOld(unknowns);
    if (made == 0) return false;
    changes -= made;
  }
  return true;
}

// An unknown that keeps another acceleration at rest goes, and comes again.
template <class Scalar>
template <class Unknowns>
int UpdatedSystem<Scalar>::CountChanges(const Problem& problem, const Unknowns& unknowns) const {
  int changes = 0;
  for (int row = 0; row < problem.rows(); ++row) {
    const int slot = slot_of_[row];
    if (!unknowns.IsUnknown(row)) {
      changes += slot >= 0;
    } else if (slot < 0) {
      ++changes;
    } else if (!(slots_[slot].rest == unknowns.Rest(row))) {
      changes += 2;
    } else {
      changes += !(slots_[slot].force == unknowns.Force(row));
    }
  }
  return changes;
}

template <class Scalar>
template <class Unknowns>
bool UpdatedSystem<Scalar>::InvertAnew(const Problem& problem, const Unknowns& unknowns,
                                       const Scale<Scalar>& scale) {
  ++counts_.inverted;
  slots_.clear();
  for (int row = 0; row < problem.rows(); ++row) {
    slot_of_[row] = -1;
    if (!unknowns.IsUnknown(row)) continue;
    slot_of_[row] = static_cast<int>(slots_.size());
    slots_.push_back({row, unknowns.Force(row), unknowns.Rest(row)});
  }
  const auto entry = [&](int i, int j) { return EntryOf<Scalar>(slots_[i].rest, problem.A, slots_[j].force); };
  valid_ = inverse_.Invert(static_cast<int>(slots_.size()), entry, scale.rate);
  if (!valid_) pause_ = kPause;
  return valid_;
}

template <class Scalar>
template <class Unknowns>
int UpdatedSystem<Scalar>::AppendNew(const Problem& problem, const Unknowns& unknowns) {
  int made = 0;
  for (int row = 0; row < problem.rows(); ++row) {
    if (!unknowns.IsUnknown(row) || slot_of_[row] >= 0) continue;
    const int size = inverse_.size();
    const Slot slot = {row, unknowns.Force(row), unknowns.Rest(row)};
    GatherColumn(problem, slot.force);
    for (int j = 0; j < size; ++j) row_[j] = EntryOf<Scalar>(slot.rest, problem.A, slots_[j].force);
    const Scalar corner = EntryOf<Scalar>(slot.rest, problem.A, slot.force);
    if (!inverse_.Append(row_.head(size), column_.head(size), corner)) continue;
    slot_of_[row] = size;
    slots_.push_back(slot);
    ++made;
  }
  return made;
}

template <class Scalar>
template <class Unknowns>
int UpdatedSystem<Scalar>::ReplaceColumns(const Problem& problem, const Unknowns& unknowns) {
  int made = 0;
  for (int i = 0; i < inverse_.size(); ++i) {
    Slot& slot = slots_[i];
    if (!unknowns.IsUnknown(slot.row) || !(slot.rest == unknowns.Rest(slot.row))) continue;
    const RowCombination<Scalar>& force = unknowns.Force(slot.row);
    if (slot.force == force) continue;
    GatherColumn(problem, force);
    if (!inverse_.ReplaceColumn(i, column_.head(inverse_.size()))) continue;
    slot.force = force;
    ++made;
  }
  return made;
}

template <class Scalar>
template <class Unknowns>
int UpdatedSystem<Scalar>::RemoveOld(const Unknowns& unknowns) {
  int made = 0;
  for (int i = inverse_.size() - 1; i >= 0; --i) {
    const int row = slots_[i].row;
    if (unknowns.IsUnknown(row) && slots_[i].rest == unknowns.Rest(row)) continue;
    if (!inverse_.Remove(i)) continue;
    slot_of_[slots_.back().row] = i;
    slot_of_[row] = -1;
    slots_[i] = slots_.back();
    slots_.pop_back();
    ++made;
  }
  return made;
}

template <class Scalar>
void UpdatedSystem<Scalar>::GatherColumn(const Problem& problem, const RowCombination<Scalar>& force) {
  for (int i = 0; i < inverse_.size(); ++i) column_[i] = EntryOf<Scalar>(slots_[i].rest, problem.A, force);
}

// The residuals of the unknowns are told beside the rounding of da, and have to be as small; more than the root
// of rounding is more than a step of refinement mends.
template <class Scalar>
template <class Unknowns>
bool UpdatedSystem<Scalar>::FindDirection(const Problem& problem, const Unknowns& unknowns, Load load,
                                          Vector& df, Vector& da) {
  using std::sqrt;
  constexpr Scalar kEpsilon = std::numeric_limits<Scalar>::epsilon();
  const int size = inverse_.size();
  const bool driven = load == Load::kDriven;
  if (driven) {
    GatherColumn(problem, unknowns.Driven());
  } else {
    for (int i = 0; i < size; ++i) column_[i] = Dot(slots_[i].rest, problem.b);
  }
  column_.head(size) *= Scalar(-1);
  const Scalar free = driven ? Scalar(0) : Scalar(problem.b.cwiseAbs().maxCoeff());
  inverse_.Multiply(column_.head(size), x_.head(size));
  for (const bool refined : {false, true}) {
    Spread(problem, unknowns, load, df, da);
    for (int i = 0; i < size; ++i) column_[i] = Dot(slots_[i].rest, da);
    const Scalar residual = column_.head(size).cwiseAbs().maxCoeff();
    const Scalar unit = free + largest_ * df.cwiseAbs().maxCoeff();
    if (residual <= 64 * kEpsilon * unit) {
      for (const Slot& slot : slots_) {
        if (slot.rest.unit) da[slot.row] = Scalar(0);
      }
      counts_.refined += refined;
      return true;
    }
    if (refined || !(residual <= sqrt(kEpsilon) * unit)) return false;
    inverse_.Multiply(column_.head(size), correction_.head(size));
    x_.head(size) -= correction_.head(size);
  }
  return false;
}

// df from the unknowns and the driven force; da = A df, in the unknowns' rows too.
template <class Scalar>
template <class Unknowns>
void UpdatedSystem<Scalar>::Spread(const Problem& problem, const Unknowns& unknowns, Load load, Vector& df,
                                   Vector& da) const {
  df.setZero();
  for (int i = 0; i < inverse_.size(); ++i) AddTo<Scalar>(df, slots_[i].force, x_[i]);
  if (load == Load::kDriven) {
    AddTo<Scalar>(df, unknowns.Driven(), Scalar(1));
    da.setZero();
  } else {
    da = problem.b;
  }
  for (int j = 0; j < problem.rows(); ++j) {
    if (df[j] != Scalar(0)) da += df[j] * problem.A.col(j);
  }
}

}  // namespace stiction
