// SPDX-License-Identifier: Apache-2.0
// Definitions for direction.h.

#ifndef STICTION_SOLVER_LINEAR_DIRECTION_IPP_
#define STICTION_SOLVER_LINEAR_DIRECTION_IPP_

#include <utility>

#include "solver/linear/direction.h"
#include "solver/linear/elimination.ipp"
#include "solver/linear/updated_system.ipp"

namespace stiction {

template <class Scalar, int Rows>
void DirectionSystem<Scalar, Rows>::Start(const Problem& problem, int update_from) {
  const int rows = problem.rows();
  if constexpr (kUpdates) updated_.Start(problem, update_from);
  Reset<int, Rows>(unknown_, rows, 0);
  system_.Resize(rows, rows + 1);
  if constexpr (Rows == Eigen::Dynamic) {
    df_.resize(rows);
    da_.resize(rows);
  }
  if constexpr (kFractionFree<Scalar>) {
    integer_A_.resize(rows, rows);
    row_scale_.resize(rows);
    numerator_.resize(rows);
    for (int i = 0; i < rows; ++i) {
      row_scale_[i] = CommonDenominator<Scalar>(problem.A.row(i));
      for (int j = 0; j < rows; ++j) {
        integer_A_(i, j) = Fractions<Scalar>::Numerator(problem.A(i, j), row_scale_[i]);
      }
    }
  }
}

template <class Scalar, int Rows>
auto DirectionSystem<Scalar, Rows>::Solve(const Problem& problem, const RowLayout<Rows>& layout,
                                          const IndexSets<Rows>& sets, int driven, int sign,
                                          const Scale<Scalar>& scale) -> Status {
  if constexpr (kUpdates) {
    if (updated_.Solve(problem, layout, sets, driven, scale, df_, da_)) {
      if (sign < 0) TurnRound();
      return Status::kRegular;
    }
  }
  Assemble(problem, layout, sets, driven, sign);
  const Status status = Eliminate(scale);
  if (status != Status::kInconsistent) Spread(problem, layout, sets, driven, driven, sign);
  return status;
}

template <class Scalar, int Rows>
std::optional<int> DirectionSystem<Scalar, Rows>::SolveOriented(const Problem& problem,
                                                                const RowLayout<Rows>& layout,
                                                                const IndexSets<Rows>& sets, int driven,
                                                                int side, const Scale<Scalar>& scale) {
  if constexpr (kUpdates) {
    if (updated_.Solve(problem, layout, sets, driven, scale, df_, da_)) {
      if (updated_.determinant_sign() * side < 0) TurnRound();
      return updated_.determinant_sign();
    }
  }
  Assemble(problem, layout, sets, driven, side);
  const Status status = Eliminate(scale);
  if (status == Status::kSingular || system_.rank() + 1 < unknowns_) return std::nullopt;
  if (status == Status::kInconsistent) {
    const int free = SolveHomogeneous();
    Spread(problem, layout, sets, unknown_[free], driven, 0);
    return 0;
  }
  const int sign = system_.Orientation();
  if (sign < 0) {
    for (int i = 0; i < unknowns_; ++i) system_.numerator(i) = -system_.numerator(i);
  }
  Spread(problem, layout, sets, driven, driven, sign * side);
  return sign;
}

template <class Scalar, int Rows>
auto DirectionSystem<Scalar, Rows>::SolveForces(const Problem& problem, const RowLayout<Rows>& layout,
                                                const IndexSets<Rows>& sets, const Scale<Scalar>& scale)
    -> Status {
  if constexpr (kUpdates) {
    if (updated_.Solve(problem, layout, sets, Updated::kLoads, scale, df_, da_)) return Status::kRegular;
  }
  std::vector<int> unknowns;
  for (int row = 0; row < problem.rows(); ++row) {
    if (IsUnknown(sets[row])) unknowns.push_back(row);
  }
  const int size = static_cast<int>(unknowns.size());
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> M(size, size + 1);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) {
      const int limit = FrictionLimitSign(layout, sets, unknowns[j]);
      M(i, j) = ReducedEntry(problem, layout, unknowns[i], unknowns[j], limit);
    }
    M(i, size) = -problem.b[unknowns[i]];
  }
  Elimination<Scalar> system;
  system.Assign(M);
  system.Run(size, size, size + 1, scale.rate);
  if (!system.IsConsistent(size, scale.rate)) return Status::kInconsistent;
  system.BackSubstitute(size);
  for (int row = 0; row < problem.rows(); ++row) df_[row] = Scalar(0);
  for (int i = 0; i < size; ++i) df_[unknowns[i]] = system.Solution(i);
  FollowLimits(problem, layout, sets, df_);
  da_ = problem.A * df_ + problem.b;
  for (const int row : unknowns) da_[row] = Scalar(0);
  return system.rank() == size ? Status::kRegular : Status::kSingular;
}

template <class Scalar, int Rows>
void DirectionSystem<Scalar, Rows>::TurnRound() {
  df_ = -df_;
  da_ = -da_;
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
      Entry entry = ColumnEntry(problem, layout, unknown_[i], row, limit);
      if (factor > 0) {
        system_(i, column) = std::move(entry);
      } else {
        system_(i, column) = -entry;
      }
    }
  };
  for (int j = 0; j < unknowns_; ++j) fill_column(j, unknown_[j], 1);
  fill_column(unknowns_, driven, -sign);
}

// Entry of A in `row` for the variable of `column`, whose friction is at `limit` (0: it is not). Integers are
// those of A_ij row_scale_i, times the denominator of mu where there is a limit.
template <class Scalar, int Rows>
auto DirectionSystem<Scalar, Rows>::ColumnEntry(const Problem& problem, const RowLayout<Rows>& layout, int row,
                                                int column, int limit) const -> Entry {
  if constexpr (kFractionFree<Scalar>) {
    Entry entry = integer_A_(row, column);
    if (limit == 0) return entry;
    const Scalar& mu = problem.contacts[layout.ContactOf(column)].mu;
    entry *= Fractions<Scalar>::Denominator(mu);
    if (limit > 0) {
      Fractions<Scalar>::AddProduct(entry, Fractions<Scalar>::Numerator(mu), integer_A_(row, column + 1));
    } else {
      Fractions<Scalar>::SubtractProduct(entry, Fractions<Scalar>::Numerator(mu), integer_A_(row, column + 1));
    }
    return entry;
  } else {
    return ReducedEntry(problem, layout, row, column, limit);
  }
}

template <class Scalar, int Rows>
auto DirectionSystem<Scalar, Rows>::Eliminate(const Scale<Scalar>& scale) -> Status {
  system_.Run(unknowns_, unknowns_, unknowns_ + 1, scale.rate);
  if (!system_.IsConsistent(unknowns_, scale.rate)) return Status::kInconsistent;
  system_.BackSubstitute(unknowns_);
  if (system_.rank() < unknowns_) return Status::kSingular;
  if constexpr (kUpdates) updated_.Forget();
  return Status::kRegular;
}

// Cramer's rule where the determinant is zero, for rank k - 1: with the right side in place of the one column
// without a pivot, the determinant is that with the right side behind the pivot columns, times the sign of the
// permutation that brings it into place. Returns that column, whose unknown is +-1.
template <class Scalar, int Rows>
int DirectionSystem<Scalar, Rows>::SolveHomogeneous() {
  const int rank = system_.rank();
  int free = 0;
  while (free < rank && system_.pivot_column(free) == free) ++free;
  int sign = system_.Orientation(unknowns_);
  if ((rank - free) % 2 != 0) sign = -sign;
  for (int i = 0; i < rank; ++i) {
    if (sign > 0) {
      system_(i, unknowns_) = -system_(i, free);
    } else {
      system_(i, unknowns_) = system_(i, free);
    }
  }
  // A row below the free column's place has no entry in it: it was eliminated, or is zero by choice.
  for (int i = free; i < rank; ++i) system_(i, unknowns_) = Entry(0);
  system_.BackSubstitute(unknowns_);
  system_.numerator(free) = sign > 0 ? system_.denominator() : Entry(-system_.denominator());
  return free;
}

// df from the unknowns, the driven variable and the limits; da = A df, exactly zero in C and CF. `held` is the
// variable whose change is given: the driven one, or the free unknown of a homogeneous system.
template <class Scalar, int Rows>
void DirectionSystem<Scalar, Rows>::Spread(const Problem& problem, const RowLayout<Rows>& layout,
                                           const IndexSets<Rows>& sets, int held, int driven, int sign) {
  if constexpr (kFractionFree<Scalar>) {
    SpreadIntegers(problem, layout, sets, held, driven, sign);
    return;
  }
  const int rows = problem.rows();
  for (int row = 0; row < rows; ++row) df_[row] = Scalar(0);
  for (int i = 0; i < unknowns_; ++i) df_[unknown_[i]] = system_.numerator(i);  // over 1
  df_[driven] = Scalar(sign);
  FollowLimits(problem, layout, sets, df_);
  for (int row = 0; row < rows; ++row) {
    Scalar change = Scalar(0);
    if (!IsUnknown(sets[row])) {
      for (int j = 0; j < rows; ++j) {
        if (kIsExact<Scalar> && IsSurelyZero(df_[j])) continue;
        change += problem.A(row, j) * df_[j];
      }
    }
    da_[row] = std::move(change);
  }
}

// The same over integers. Columns were scaled, so that an unknown is its number times the scale of its column,
// over that of the held one.
template <class Scalar, int Rows>
void DirectionSystem<Scalar, Rows>::SpreadIntegers(const Problem& problem, const RowLayout<Rows>& layout,
                                                   const IndexSets<Rows>& sets, int held, int driven,
                                                   int sign) {
  using F = Fractions<Scalar>;
  const int rows = problem.rows();
  for (Entry& numerator : numerator_) numerator = 0;
  const auto place = [&](int row, const Entry& number) {
    numerator_[row] = number;
    const int limit = FrictionLimitSign(layout, sets, row);
    if (limit == 0) return;
    const Scalar& mu = problem.contacts[layout.ContactOf(row)].mu;
    numerator_[row] *= F::Denominator(mu);
    numerator_[row + 1] = limit * F::Numerator(mu) * number;
  };
  Entry denominator = system_.denominator();
  for (int i = 0; i < unknowns_; ++i) place(unknown_[i], system_.numerator(i));
  place(driven, sign * denominator);
  if (FrictionLimitSign(layout, sets, held) != 0) {
    denominator *= F::Denominator(problem.contacts[layout.ContactOf(held)].mu);
  }
  for (int row = 0; row < rows; ++row) df_[row] = F::Quotient(numerator_[row], denominator);
  for (int row = 0; row < rows; ++row) {
    da_[row] = Scalar(0);
    if (IsUnknown(sets[row])) continue;
    Entry change(0);
    for (int j = 0; j < rows; ++j) F::AddProduct(change, integer_A_(row, j), numerator_[j]);
    da_[row] = F::Quotient(change, Entry(denominator * row_scale_[row]));
  }
}

}  // namespace stiction

#endif  // STICTION_SOLVER_LINEAR_DIRECTION_IPP_
