// SPDX-License-Identifier: Apache-2.0
// Definitions for updated_system.h.

#ifndef STICTION_SOLVER_LINEAR_UPDATED_SYSTEM_IPP_
#define STICTION_SOLVER_LINEAR_UPDATED_SYSTEM_IPP_

#include <algorithm>

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
  if (rows < least) return;
  inverse_.Reserve(rows);
  row_of_.clear();
  limit_of_.clear();
  slot_of_.assign(rows, -1);
  for (Vector* v : {&row_, &column_, &x_, &correction_}) v->resize(rows);
  largest_ = problem.A.cwiseAbs().maxCoeff();
}

template <class Scalar>
bool UpdatedSystem<Scalar>::Solve(const Problem& problem, const Layout& layout, const Sets& sets, int driven,
                                  const Scale<Scalar>& scale, Vector& df, Vector& da) {
  if (problem.rows() < least_) return false;
  const std::int64_t inverted = counts_.inverted;
  bool found = Follow(problem, layout, sets, scale);
  if (found && !FindDirection(problem, layout, sets, driven, df, da)) {
    found = counts_.inverted == inverted && InvertAnew(problem, layout, sets, scale) &&
            FindDirection(problem, layout, sets, driven, df, da);
    if (!found) pause_ = kPause;
  }
  if (found) {
    ++counts_.solved;
  } else {
    ++counts_.refused;
  }
  return found;
}

// Brings the inverse from the sets that it was made for to those of now. Unknowns come before columns change,
// and go after that: between sticking and sliding a column operation apart, M then stays what it was.
template <class Scalar>
bool UpdatedSystem<Scalar>::Follow(const Problem& problem, const Layout& layout, const Sets& sets,
                                   const Scale<Scalar>& scale) {
  int unknowns = 0, changes = 0;
  for (int row = 0; row < problem.rows(); ++row) {
    const bool unknown = IsUnknown(sets[row]);
    const int slot = slot_of_[row];
    unknowns += unknown;
    changes += unknown != (slot >= 0) || (unknown && limit_of_[slot] != FrictionLimitSign(layout, sets, row));
  }
  if (unknowns < least_) return false;
  if (pause_ > 0) {
    --pause_;
    return false;
  }
  if (!valid_ || 3 * changes > unknowns) return InvertAnew(problem, layout, sets, scale);
  while (changes > 0) {
    int made = AppendNew(problem, layout, sets);
    made += ReplaceColumns(problem, layout, sets);
    made += RemoveOld(sets);
    if (made == 0) return false;
    changes -= made;
  }
  return true;
}

template <class Scalar>
bool UpdatedSystem<Scalar>::InvertAnew(const Problem& problem, const Layout& layout, const Sets& sets,
                                       const Scale<Scalar>& scale) {
  ++counts_.inverted;
  row_of_.clear();
  limit_of_.clear();
  for (int row = 0; row < problem.rows(); ++row) {
    slot_of_[row] = -1;
    if (!IsUnknown(sets[row])) continue;
    slot_of_[row] = static_cast<int>(row_of_.size());
    row_of_.push_back(row);
    limit_of_.push_back(FrictionLimitSign(layout, sets, row));
  }
  const auto entry = [&](int i, int j) {
    return ReducedEntry(problem, layout, row_of_[i], row_of_[j], limit_of_[j]);
  };
  valid_ = inverse_.Invert(static_cast<int>(row_of_.size()), entry, scale.rate);
  if (!valid_) pause_ = kPause;
  return valid_;
}

template <class Scalar>
int UpdatedSystem<Scalar>::AppendNew(const Problem& problem, const Layout& layout, const Sets& sets) {
  int made = 0;
  for (int row = 0; row < problem.rows(); ++row) {
    if (!IsUnknown(sets[row]) || slot_of_[row] >= 0) continue;
    const int size = inverse_.size(), limit = FrictionLimitSign(layout, sets, row);
    GatherColumn(problem, layout, row, limit);
    for (int j = 0; j < size; ++j) row_[j] = ReducedEntry(problem, layout, row, row_of_[j], limit_of_[j]);
    const Scalar corner = ReducedEntry(problem, layout, row, row, limit);
    if (!inverse_.Append(row_.head(size), column_.head(size), corner)) continue;
    slot_of_[row] = size;
    row_of_.push_back(row);
    limit_of_.push_back(limit);
    ++made;
  }
  return made;
}

template <class Scalar>
int UpdatedSystem<Scalar>::ReplaceColumns(const Problem& problem, const Layout& layout, const Sets& sets) {
  int made = 0;
  for (int slot = 0; slot < inverse_.size(); ++slot) {
    const int row = row_of_[slot], limit = FrictionLimitSign(layout, sets, row);
    if (!IsUnknown(sets[row]) || limit == limit_of_[slot]) continue;
    GatherColumn(problem, layout, row, limit);
    if (!inverse_.ReplaceColumn(slot, column_.head(inverse_.size()))) continue;
    limit_of_[slot] = limit;
    ++made;
  }
  return made;
}

template <class Scalar>
int UpdatedSystem<Scalar>::RemoveOld(const Sets& sets) {
  int made = 0;
  for (int slot = inverse_.size() - 1; slot >= 0; --slot) {
    if (IsUnknown(sets[row_of_[slot]]) || !inverse_.Remove(slot)) continue;
    slot_of_[row_of_.back()] = slot;
    slot_of_[row_of_[slot]] = -1;
    row_of_[slot] = row_of_.back();
    limit_of_[slot] = limit_of_.back();
    row_of_.pop_back();
    limit_of_.pop_back();
    ++made;
  }
  return made;
}

template <class Scalar>
void UpdatedSystem<Scalar>::GatherColumn(const Problem& problem, const Layout& layout, int column, int limit) {
  for (int i = 0; i < inverse_.size(); ++i)
    column_[i] = ReducedEntry(problem, layout, row_of_[i], column, limit);
}

template <class Scalar>
void UpdatedSystem<Scalar>::GatherRightSide(const Problem& problem, const Layout& layout, const Sets& sets,
                                            int driven) {
  if (driven == kLoads) {
    for (int i = 0; i < inverse_.size(); ++i) column_[i] = problem.b[row_of_[i]];
  } else {
    GatherColumn(problem, layout, driven, FrictionLimitSign(layout, sets, driven));
  }
  column_.head(inverse_.size()) *= Scalar(-1);
}

// The residuals of the unknowns are told beside the rounding of da, and have to be as small; more than the root
// of rounding is more than a step of refinement mends.
template <class Scalar>
bool UpdatedSystem<Scalar>::FindDirection(const Problem& problem, const Layout& layout, const Sets& sets,
                                          int driven, Vector& df, Vector& da) {
  constexpr Scalar kEpsilon = std::numeric_limits<Scalar>::epsilon();
  const int size = inverse_.size();
  GatherRightSide(problem, layout, sets, driven);
  const Scalar load = driven == kLoads ? problem.b.cwiseAbs().maxCoeff() : Scalar(0);
  inverse_.Multiply(column_.head(size), x_.head(size));
  for (const bool refined : {false, true}) {
    Spread(problem, layout, sets, driven, df, da);
    for (int i = 0; i < size; ++i) column_[i] = da[row_of_[i]];
    const Scalar residual = column_.head(size).cwiseAbs().maxCoeff();
    const Scalar unit = load + largest_ * df.cwiseAbs().maxCoeff();
    if (residual <= 64 * kEpsilon * unit) {
      for (int i = 0; i < size; ++i) da[row_of_[i]] = Scalar(0);
      counts_.refined += refined;
      return true;
    }
    if (refined || !(residual <= std::sqrt(kEpsilon) * unit)) return false;
    inverse_.Multiply(column_.head(size), correction_.head(size));
    x_.head(size) -= correction_.head(size);
  }
  return false;
}

// df from the unknowns and the limits; da = A df, in the unknowns' rows too.
template <class Scalar>
void UpdatedSystem<Scalar>::Spread(const Problem& problem, const Layout& layout, const Sets& sets, int driven,
                                   Vector& df, Vector& da) const {
  df.setZero();
  for (int i = 0; i < inverse_.size(); ++i) df[row_of_[i]] = x_[i];
  if (driven != kLoads) df[driven] = Scalar(1);
  FollowLimits(problem, layout, sets, df);
  if (driven == kLoads) {
    da = problem.b;
  } else {
    da.setZero();
  }
  for (int j = 0; j < problem.rows(); ++j) {
    if (df[j] != Scalar(0)) da += df[j] * problem.A.col(j);
  }
}

}  // namespace stiction

#endif  // STICTION_SOLVER_LINEAR_UPDATED_SYSTEM_IPP_
