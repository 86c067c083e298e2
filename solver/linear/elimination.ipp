// SPDX-License-Identifier: Apache-2.0
// Definitions for elimination.h.

#pragma once

#include <algorithm>
#include <cmath>

#include "solver/linear/elimination.h"
#include "solver/problem/enclosure.h"

namespace stiction {

template <class Scalar, int Rows>
void Elimination<Scalar, Rows>::Resize(int rows, int columns) {
  Reset<int, Rows>(pivot_column_, rows, 0);
  if constexpr (Rows == Eigen::Dynamic) {
    M_.resize(rows, columns);
    x_.resize(columns);
  }
}

template <class Scalar, int Rows>
template <class Dense>
void Elimination<Scalar, Rows>::Assign(const Dense& M) {
  const int rows = static_cast<int>(M.rows()), columns = static_cast<int>(M.cols());
  Resize(rows, columns);
  scale_ = Entry(1);
  for (int i = 0; i < rows; ++i) {
    const Entry scale = CommonDenominator<Scalar>(M.row(i));
    for (int j = 0; j < columns; ++j) M_(i, j) = Fractions<Scalar>::Numerator(M(i, j), scale);
    scale_ *= scale;
  }
}

template <class Scalar, int Rows>
void Elimination<Scalar, Rows>::Run(int rows, int unknowns, int columns, const Scalar& zero) {
  rows_ = rows;
  unknowns_ = unknowns;
  columns_ = columns;
  rank_ = 0;
  odd_swaps_ = false;
  for (int column = 0; column < unknowns; ++column) {
    const int pivot = FindPivot(column, zero);
    if (pivot < 0) continue;
    if (pivot != rank_) {
      M_.row(rank_).swap(M_.row(pivot));
      odd_swaps_ = !odd_swaps_;
    }
    pivot_column_[rank_] = column;
    EliminateBelow(column);
    ++rank_;
  }
}

template <class Scalar, int Rows>
int Elimination<Scalar, Rows>::FindPivot(int column, const Scalar& zero) const {
  int best = -1;
  if constexpr (kEncloses<Scalar>) {
    bool unsure = false;  // whether some entry may be zero
    for (int i = rank_; i < rows_; ++i) {
      const auto size = [&](int row) { return std::abs(Approximation<Scalar>::Of(M_(row, column))); };
      const bool tells = Unsure<Scalar>::TellsSign(M_(i, column));
      unsure |= !tells;
      if (tells && !IsSurelyZero(M_(i, column)) && (best < 0 || size(i) > size(best))) best = i;
    }
    if (best < 0 && unsure) Unsure<Scalar>::Refuse();
    return best;
  }
  for (int i = rank_; i < rows_; ++i) {
    if constexpr (kIsExact<Scalar>) {
      if (Sign(M_(i, column)) != 0) return i;
    } else {
      if (Sign(M_(i, column), zero) == 0) continue;
      if (best < 0 || Abs(M_(i, column)) > Abs(M_(best, column))) best = i;
    }
  }
  return best;
}

// Clears the column below the pivot in row rank_. What stands there is not read again, and left as it is.
template <class Scalar, int Rows>
void Elimination<Scalar, Rows>::EliminateBelow(int column) {
  const Entry& pivot = M_(rank_, column);
  for (int i = rank_ + 1; i < rows_; ++i) {
    const Entry& below = M_(i, column);
    if constexpr (kFractionFree<Scalar>) {
      for (int j = column + 1; j < columns_; ++j) {
        Entry& entry = M_(i, j);
        entry *= pivot;
        Fractions<Scalar>::SubtractProduct(entry, below, M_(rank_, j));
        if (rank_ > 0) Fractions<Scalar>::DivideExactly(entry, Pivot(rank_ - 1));
      }
    } else {
      if (IsSurelyZero(below)) continue;
      const Scalar factor = below / pivot;
      for (int j = column + 1; j < columns_; ++j) M_(i, j) -= factor * M_(rank_, j);
    }
  }
}

template <class Scalar, int Rows>
bool Elimination<Scalar, Rows>::IsConsistent(int column, const Scalar& zero) const {
  for (int i = rank_; i < rows_; ++i) {
    if constexpr (kIsExact<Scalar>) {
      if (Sign(M_(i, column)) != 0) return false;
    } else {
      if (Sign(M_(i, column), zero) != 0) return false;
    }
  }
  return true;
}

// Over integers the last pivot is the minor.
template <class Scalar, int Rows>
int Elimination<Scalar, Rows>::Orientation() const {
  int sign = odd_swaps_ ? -1 : 1;
  for (int i = kFractionFree<Scalar> ? std::max(rank_ - 1, 0) : 0; i < rank_; ++i) sign *= Sign(Pivot(i));
  return sign;
}

template <class Scalar, int Rows>
int Elimination<Scalar, Rows>::Orientation(int column) const {
  const int last = Sign(M_(rank_, column));
  if constexpr (kFractionFree<Scalar>) return odd_swaps_ ? -last : last;
  return Orientation() * last;
}

template <class Scalar, int Rows>
Scalar Elimination<Scalar, Rows>::Determinant() const {
  if (rank_ < rows_) return Scalar(0);
  if constexpr (kFractionFree<Scalar>) {
    const Scalar determinant = Fractions<Scalar>::Quotient(denominator(), scale_);
    return odd_swaps_ ? Scalar(-determinant) : determinant;
  } else {
    Scalar determinant(odd_swaps_ ? -1 : 1);
    for (int i = 0; i < rank_; ++i) determinant *= Pivot(i);
    return determinant;
  }
}

template <class Scalar, int Rows>
void Elimination<Scalar, Rows>::BackSubstitute(int column) {
  for (int j = 0; j < unknowns_; ++j) x_[j] = Entry(0);
  for (int i = rank_ - 1; i >= 0; --i) {
    Entry& x = x_[pivot_column_[i]];
    if constexpr (kFractionFree<Scalar>) {
      x = Pivot(rank_ - 1) * M_(i, column);
      for (int k = i + 1; k < rank_; ++k) {
        Fractions<Scalar>::SubtractProduct(x, M_(i, pivot_column_[k]), x_[pivot_column_[k]]);
      }
      Fractions<Scalar>::DivideExactly(x, Pivot(i));
    } else {
      x = M_(i, column);
      for (int k = i + 1; k < rank_; ++k) x -= M_(i, pivot_column_[k]) * x_[pivot_column_[k]];
      x /= Pivot(i);
    }
  }
}

template <class Scalar, int Rows>
auto Elimination<Scalar, Rows>::denominator() const -> Entry {
  return kFractionFree<Scalar> && rank_ > 0 ? Pivot(rank_ - 1) : Entry(1);
}

template <class Scalar, int Rows>
Scalar Elimination<Scalar, Rows>::Solution(int j) const {
  return Fractions<Scalar>::Quotient(x_[j], denominator());
}

}  // namespace stiction
