// SPDX-License-Identifier: Apache-2.0
// Definitions for direction.h.

#ifndef STICTION_SOLVER_DIRECTION_IPP_
#define STICTION_SOLVER_DIRECTION_IPP_

#include <utility>

#include "solver/direction.h"

namespace stiction {

template <class Scalar, int Rows>
void DirectionSystem<Scalar, Rows>::Resize(int rows) {
  Reset<int, Rows>(unknown_, rows, 0);
  Reset<int, Rows>(pivot_column_, rows, 0);
  if constexpr (Rows == Eigen::Dynamic) {
    M_.resize(rows, rows + 1);
    x_.resize(rows);
    df_.resize(rows);
    da_.resize(rows);
  }
}

template <class Scalar, int Rows>
auto DirectionSystem<Scalar, Rows>::Solve(const Problem& problem, const RowLayout<Rows>& layout,
                                          const IndexSets<Rows>& sets, int driven, int sign,
                                          const Scale<Scalar>& scale) -> Status {
  Assemble(problem, layout, sets, driven, sign);
  const Status status = Eliminate(scale);
  if (status != Status::kInconsistent) Spread(problem, layout, sets, driven, sign);
  return status;
}

template <class Scalar, int Rows>
std::optional<int> DirectionSystem<Scalar, Rows>::SolveOriented(const Problem& problem,
                                                                const RowLayout<Rows>& layout,
                                                                const IndexSets<Rows>& sets, int driven,
                                                                int side, const Scale<Scalar>& scale) {
  Assemble(problem, layout, sets, driven, side);
  const Status status = Eliminate(scale);
  if (status == Status::kSingular || rank_ + 1 < unknowns_) return std::nullopt;
  int sign = odd_swaps_ ? -1 : 1;
  for (int i = 0; i < rank_; ++i) sign *= Sign(M_(i, pivot_column_[i]));
  if (status == Status::kInconsistent) {
    SolveHomogeneous(sign);
    Spread(problem, layout, sets, driven, 0);
    return 0;
  }
  if (sign < 0) {
    for (int i = 0; i < unknowns_; ++i) x_[i] = -x_[i];
  }
  Spread(problem, layout, sets, driven, sign * side);
  return sign;
}

// The sign of the limit at which the friction of a normal row is held, 0 if it is not.
template <int Rows>
int FrictionLimitSign(const RowLayout<Rows>& layout, const IndexSets<Rows>& sets, int row) {
  return layout.IsNormal(row) && layout.HasFriction(row) ? LimitSign(sets[row + 1]) : 0;
}

// The reduced system of equation (9): A_CC x = -v_1, where a normal's column takes +-mu times the column
// of its friction along while that friction is in NC+ or NC- (5.3).
template <class Scalar, int Rows>
void DirectionSystem<Scalar, Rows>::Assemble(const Problem& problem, const RowLayout<Rows>& layout,
                                             const IndexSets<Rows>& sets, int driven, int sign) {
  const int rows = problem.rows();
  unknowns_ = 0;
  for (int row = 0; row < rows; ++row) {
    if (IsUnknown(sets[row])) unknown_[unknowns_++] = row;
  }
  const auto fill_column = [&](int column, int row, int factor) {
    const int limit = FrictionLimitSign(layout, sets, row);
    for (int i = 0; i < unknowns_; ++i) {
      Scalar entry = problem.A(unknown_[i], row);
      if (limit != 0) {
        const Scalar along = problem.contacts[layout.ContactOf(row)].mu * problem.A(unknown_[i], row + 1);
        if (limit > 0) {
          entry += along;
        } else {
          entry -= along;
        }
      }
      if (factor > 0) {
        M_(i, column) = std::move(entry);
      } else {
        M_(i, column) = -entry;
      }
    }
  };
  for (int j = 0; j < unknowns_; ++j) fill_column(j, unknown_[j], 1);
  fill_column(unknowns_, driven, -sign);
}

// Row echelon form, columns in row order. Over inexact scalars the largest entry is the pivot, over exact
// ones the first that is not zero.
template <class Scalar, int Rows>
auto DirectionSystem<Scalar, Rows>::Eliminate(const Scale<Scalar>& scale) -> Status {
  int rank = 0;
  odd_swaps_ = false;
  for (int column = 0; column < unknowns_; ++column) {
    int best = -1;
    for (int i = rank; i < unknowns_; ++i) {
      if (Sign(M_(i, column), scale.rate) == 0) continue;
      if (best < 0 || (!kIsExact<Scalar> && Abs(M_(i, column)) > Abs(M_(best, column)))) best = i;
      if (kIsExact<Scalar>) break;
    }
    if (best < 0) continue;
    if (best != rank) {
      M_.row(rank).swap(M_.row(best));
      odd_swaps_ = !odd_swaps_;
    }
    pivot_column_[rank] = column;
    for (int i = rank + 1; i < unknowns_; ++i) {
      if (Sign(M_(i, column)) == 0) continue;
      const Scalar factor = M_(i, column) / M_(rank, column);
      for (int j = column + 1; j <= unknowns_; ++j) M_(i, j) -= factor * M_(rank, j);
    }
    ++rank;
  }
  rank_ = rank;
  for (int i = rank; i < unknowns_; ++i) {
    if (Sign(M_(i, unknowns_), scale.rate) != 0) return Status::kInconsistent;
  }
  BackSubstitute(rank);
  return rank == unknowns_ ? Status::kRegular : Status::kSingular;
}

template <class Scalar, int Rows>
void DirectionSystem<Scalar, Rows>::BackSubstitute(int rank) {
  for (int i = 0; i < unknowns_; ++i) x_[i] = Scalar(0);
  for (int i = rank - 1; i >= 0; --i) {
    const int column = pivot_column_[i];
    Scalar value = M_(i, unknowns_);
    for (int k = i + 1; k < rank; ++k) value -= M_(i, pivot_column_[k]) * x_[pivot_column_[k]];
    x_[column] = value / M_(i, column);
  }
}

// Cramer's rule where the determinant is zero, for rank k - 1: with the right side in place of the one column
// without a pivot, the determinant is the product of the pivots and the last right side, times the sign of
// the permutation that brings that column, whose pivot is in the last row, into place.
template <class Scalar, int Rows>
void DirectionSystem<Scalar, Rows>::SolveHomogeneous(int orientation) {
  int free = 0;
  while (free < rank_ && pivot_column_[free] == free) ++free;
  int sign = orientation * Sign(M_(rank_, unknowns_));
  if ((rank_ - free) % 2 != 0) sign = -sign;
  for (int i = 0; i < rank_; ++i) {
    if (sign > 0) {
      M_(i, unknowns_) = -M_(i, free);
    } else {
      M_(i, unknowns_) = M_(i, free);
    }
  }
  // A row below the free column's place has no entry in it: it was eliminated, or is zero by choice.
  for (int i = free; i < rank_; ++i) M_(i, unknowns_) = Scalar(0);
  BackSubstitute(rank_);
  x_[free] = Scalar(sign);
}

// df from the unknowns, the driven variable and the limits; da = A df, exactly zero in C and CF.
template <class Scalar, int Rows>
void DirectionSystem<Scalar, Rows>::Spread(const Problem& problem, const RowLayout<Rows>& layout,
                                           const IndexSets<Rows>& sets, int driven, int sign) {
  const int rows = problem.rows();
  for (int row = 0; row < rows; ++row) df_[row] = Scalar(0);
  for (int i = 0; i < unknowns_; ++i) df_[unknown_[i]] = x_[i];
  df_[driven] = Scalar(sign);
  for (int row = 0; row < rows; ++row) {
    const int limit = FrictionLimitSign(layout, sets, row);
    if (limit == 0) continue;
    const Scalar bound = problem.contacts[layout.ContactOf(row)].mu * df_[row];
    if (limit > 0) {
      df_[row + 1] = bound;
    } else {
      df_[row + 1] = -bound;
    }
  }
  for (int row = 0; row < rows; ++row) {
    Scalar change = Scalar(0);
    if (!IsUnknown(sets[row])) {
      for (int j = 0; j < rows; ++j) {
        if (kIsExact<Scalar> && Sign(df_[j]) == 0) continue;
        change += problem.A(row, j) * df_[j];
      }
    }
    da_[row] = std::move(change);
  }
}

}  // namespace stiction

#endif  // STICTION_SOLVER_DIRECTION_IPP_
