// SPDX-License-Identifier: Apache-2.0
// Definitions for direction.h.

#pragma once

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
  if constexpr (kFractionFree<Scalar>) ScaleToIntegers(problem);
}

// In space the rows of a contact have one scale, so that rests may combine them.
template <class Scalar, int Rows>
void DirectionSystem<Scalar, Rows>::ScaleToIntegers(const Problem& problem) {
  const int rows = problem.rows();
  integer_A_.resize(rows, rows);
  row_scale_.resize(rows);
  numerator_.resize(rows);
  forces_.resize(rows + 1);
  rests_.resize(rows);
  const auto scale_rows = [&](int first, int count) {
    const Entry scale = CommonDenominator<Scalar>(problem.A.middleRows(first, count).reshaped());
    for (int i = first; i < first + count; ++i) {
      row_scale_[i] = scale;
      for (int j = 0; j < rows; ++j) integer_A_(i, j) = Fractions<Scalar>::Numerator(problem.A(i, j), scale);
    }
  };
  if (problem.dimension == 2) {
    for (int i = 0; i < rows; ++i) scale_rows(i, 1);
    return;
  }
  int first = 0;
  for (const auto& contact : problem.contacts) {
    const int count = contact.HasFrictionRows() ? problem.dimension : 1;
    scale_rows(first, count);
    first += count;
  }
}

template <class Scalar, int Rows>
template <class Unknowns>
auto DirectionSystem<Scalar, Rows>::Solve(const Problem& problem, const Unknowns& unknowns,
                                          const Scale<Scalar>& scale) -> Status {
  if constexpr (kUpdates) {
    if (updated_.Solve(problem, unknowns, scale, df_, da_)) return Status::kRegular;
  }
  Assemble(problem, unknowns);
  const Status status = Eliminate(scale);
  if (status != Status::kInconsistent) Spread(problem, unknowns, unknowns_, 1);
  return status;
}

template <class Scalar, int Rows>
template <class Unknowns>
std::optional<int> DirectionSystem<Scalar, Rows>::SolveOriented(const Problem& problem,
                                                                const Unknowns& unknowns,
                                                                const Scale<Scalar>& scale) {
  if constexpr (kUpdates) {
    if (updated_.Solve(problem, unknowns, scale, df_, da_)) {
      if (updated_.determinant_sign() < 0) {
        df_ = -df_;
        da_ = -da_;
      }
      return updated_.determinant_sign();
    }
  }
  Assemble(problem, unknowns);
  const Status status = Eliminate(scale);
  if (status == Status::kSingular || system_.rank() + 1 < unknowns_) return std::nullopt;
  if (status == Status::kInconsistent) {
    Spread(problem, unknowns, SolveHomogeneous(), 0);
    return 0;
  }
  const int sign = system_.Orientation();
  if (sign < 0) {
    for (int i = 0; i < unknowns_; ++i) system_.numerator(i) = -system_.numerator(i);
  }
  Spread(problem, unknowns, unknowns_, sign);
  return sign;
}

template <class Scalar, int Rows>
template <class Unknowns>
auto DirectionSystem<Scalar, Rows>::SolveForces(const Problem& problem, const Unknowns& unknowns,
                                                const Scale<Scalar>& scale) -> Status {
  if constexpr (kUpdates) {
    if (updated_.Solve(problem, unknowns, scale, df_, da_, Updated::Load::kFree)) return Status::kRegular;
  }
  std::vector<int> rows;
  for (int row = 0; row < problem.rows(); ++row) {
    if (unknowns.IsUnknown(row)) rows.push_back(row);
  }
  const int size = static_cast<int>(rows.size());
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> M(size, size + 1);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j)
      M(i, j) = EntryOf<Scalar>(unknowns.Rest(rows[i]), problem.A, unknowns.Force(rows[j]));
    M(i, size) = -Dot(unknowns.Rest(rows[i]), problem.b);
  }
  Elimination<Scalar> system;
  system.Assign(M);
  system.Run(size, size, size + 1, scale.rate);
  if (!system.IsConsistent(size, scale.rate)) return Status::kInconsistent;
  system.BackSubstitute(size);
  for (int row = 0; row < problem.rows(); ++row) df_[row] = Scalar(0);
  for (int i = 0; i < size; ++i) AddTo<Scalar>(df_, unknowns.Force(rows[i]), system.Solution(i));
  da_ = problem.A * df_ + problem.b;
  for (const int row : rows) {
    if (unknowns.Rests(row)) da_[row] = Scalar(0);
  }
  return system.rank() == size ? Status::kRegular : Status::kSingular;
}

// The reduced system of equation (9): A_CC x = -v_1, where a normal's column takes +-mu times the column
// of its friction along while that friction is in NC+ or NC- (5.3).
template <class Scalar, int Rows>
template <class Unknowns>
void DirectionSystem<Scalar, Rows>::Assemble(const Problem& problem, const Unknowns& unknowns) {
  const int rows = problem.rows();
  unknowns_ = 0;
  for (int row = 0; row < rows; ++row) {
    if (unknowns.IsUnknown(row)) unknown_[unknowns_++] = row;
  }
  if constexpr (kFractionFree<Scalar>) {
    for (int j = 0; j < unknowns_; ++j) {
      Convert(unknowns.Force(unknown_[j]), forces_[j]);
      Convert(unknowns.Rest(unknown_[j]), rests_[j]);
    }
    Convert(unknowns.Driven(), forces_[unknowns_]);
    for (int j = 0; j <= unknowns_; ++j) {
      for (int i = 0; i < unknowns_; ++i)
        system_(i, j) = EntryOf<Scalar>(rests_[i].combination, integer_A_, forces_[j].combination);
    }
    for (int i = 0; i < unknowns_; ++i) system_(i, unknowns_) = -system_(i, unknowns_);
  } else {
    for (int j = 0; j < unknowns_; ++j) {
      const auto column = unknowns.Column(unknown_[j]);
      for (int i = 0; i < unknowns_; ++i) system_(i, j) = column(unknown_[i]);
    }
    const auto driven = unknowns.DrivenColumn();
    for (int i = 0; i < unknowns_; ++i) system_(i, unknowns_) = -driven(unknown_[i]);
  }
}

template <class Scalar, int Rows>
void DirectionSystem<Scalar, Rows>::Convert(const RowCombination<Scalar>& combination, Scaled& scaled) {
  scaled.combination.row = combination.row;
  scaled.combination.size = combination.size;
  scaled.combination.unit = combination.unit;
  scaled.scale = 1;
  if (combination.unit) return;
  for (int r = 0; r < combination.size; ++r) Fractions<Scalar>::Include(scaled.scale, combination.factors[r]);
  for (int r = 0; r < combination.size; ++r)
    scaled.combination.factors[r] = Fractions<Scalar>::Numerator(combination.factors[r], scaled.scale);
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

// df from the unknowns and the driven force; da = A df, exactly zero where rows rest. `held` is the column
// whose change is given: the driven one, whose force changes by `rate` times itself, or the free unknown of a
// homogeneous system.
template <class Scalar, int Rows>
template <class Unknowns>
void DirectionSystem<Scalar, Rows>::Spread(const Problem& problem, const Unknowns& unknowns, int held,
                                           int rate) {
  if constexpr (kFractionFree<Scalar>) {
    SpreadIntegers(unknowns, held, rate);
    return;
  }
  const int rows = problem.rows();
  for (int row = 0; row < rows; ++row) df_[row] = Scalar(0);
  for (int i = 0; i < unknowns_; ++i) unknowns.Place(unknown_[i], system_.numerator(i), df_);  // over 1
  if (rate != 0) unknowns.PlaceDriven(Scalar(rate), df_);
  int used = rows;  // df is zero from here on
  if constexpr (Rows == Eigen::Dynamic) {
    while (used > 0 && IsSurelyZero(df_[used - 1])) --used;
  }
  for (int row = 0; row < rows; ++row) {
    Scalar change = Scalar(0);
    if (!unknowns.Rests(row)) {
      for (int j = 0; j < used; ++j) {
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
template <class Unknowns>
void DirectionSystem<Scalar, Rows>::SpreadIntegers(const Unknowns& unknowns, int held, int rate) {
  using F = Fractions<Scalar>;
  const int rows = static_cast<int>(numerator_.size());
  for (Entry& numerator : numerator_) numerator = 0;
  Entry denominator = system_.denominator();
  for (int i = 0; i < unknowns_; ++i) {
    const Entry& x = system_.numerator(i);
    AddTo<Scalar>(numerator_, forces_[i].combination, x);
  }
  if (rate != 0) AddTo<Scalar>(numerator_, forces_[unknowns_].combination, Entry(rate * denominator));
  denominator *= forces_[held].scale;
  for (int row = 0; row < rows; ++row) df_[row] = F::Quotient(numerator_[row], denominator);
  for (int row = 0; row < rows; ++row) {
    da_[row] = Scalar(0);
    if (unknowns.Rests(row)) continue;
    Entry change(0);
    for (int j = 0; j < rows; ++j) F::AddProduct(change, integer_A_(row, j), numerator_[j]);
    da_[row] = F::Quotient(change, Entry(denominator * row_scale_[row]));
  }
}

}  // namespace stiction
