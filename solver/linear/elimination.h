// SPDX-License-Identifier: Apache-2.0
// Elimination: a matrix to row echelon form, columns in order; solutions, rank and orientation.
//
// Over a field (Gauss)      M_ij := M_ij - (M_ic / M_rc) M_rj
// Over integers (Bareiss)   M_ij := (M_rc M_ij - M_ic M_rj) / p,   p the pivot before, 1 at first
//
// for a pivot M_rc and the rows i behind it. Exact scalars whose integers are known (Fractions) take the
// second: rows are scaled to integers, every entry stays a minor of the scaled matrix, so that the divisions
// are exact and no fraction is brought to lowest terms on the way. The last pivot D is the minor of the pivot
// rows and columns, and D x is a vector of integers (Cramer's rule).
//
// Source     E. H. Bareiss, Sylvester's identity and multistep integer-preserving Gaussian elimination,
//            Mathematics of Computation 22, 1968.
// Pivots     over inexact scalars the largest entry of the column, over exact ones the first that is not zero;
//            a column without one is free. Both eliminations choose the same rows and columns.
// Cost       O(rows^2 columns). Allocates nothing once sized, integers apart.

#pragma once

#include <Eigen/Core>

#include "solver/problem/problem.h"
#include "solver/problem/scalar.h"

namespace stiction {

template <class Scalar, int Rows = Eigen::Dynamic>
class Elimination {
 public:
  // Integers for fraction-free scalars, otherwise the scalar itself.
  using Entry = typename Fractions<Scalar>::Integer;

  // Room for rows x columns; fixed sizes have room for Rows x (Rows + 1). Entries are not set.
  void Resize(int rows, int columns);

  Entry& operator()(int i, int j) { return M_(i, j); }
  const Entry& operator()(int i, int j) const { return M_(i, j); }

  // Resizes, and sets all entries: the rows of M, each scaled to integers where entries are integers.
  template <class Dense>
  void Assign(const Dense& M);

  // Brings the first `rows` rows of the first `unknowns` columns into echelon form; the columns behind, up to
  // `columns`, are right sides. Over inexact scalars entries up to `zero` are no pivots.
  void Run(int rows, int unknowns, int columns, const Scalar& zero = Scalar(0));

  int rank() const { return rank_; }
  int pivot_column(int row) const { return pivot_column_[row]; }
  // Whether right side `column` is a combination of the first columns; entries up to `zero` count as zero.
  bool IsConsistent(int column, const Scalar& zero = Scalar(0)) const;
  // The sign of the minor of the pivot columns, and of the rows that were moved to the pivots' rows.
  int Orientation() const;
  // The same with the right side `column` behind the pivot columns. Requires rank() < rows.
  int Orientation(int column) const;
  // Of the matrix of Assign. Requires that Run was given all rows, and as many unknowns.
  Scalar Determinant() const;

  // x with M x = right side `column` in the pivots' rows, and zero in free columns:
  // x_j = numerator(j) / denominator().
  void BackSubstitute(int column);
  const Entry& numerator(int j) const { return x_[j]; }
  Entry& numerator(int j) { return x_[j]; }
  Entry denominator() const;
  Scalar Solution(int j) const;

 private:
  static constexpr int kColumns = Rows == Eigen::Dynamic ? Eigen::Dynamic : Rows + 1;

  int FindPivot(int column, const Scalar& zero) const;
  void EliminateBelow(int column);
  const Entry& Pivot(int row) const { return M_(row, pivot_column_[row]); }

  int rows_ = 0, unknowns_ = 0, columns_ = 0;
  int rank_ = 0;
  bool odd_swaps_ = false;            // whether rows were swapped an odd number of times
  RowArray<int, Rows> pivot_column_;  // by row
  Eigen::Matrix<Entry, Rows, kColumns, Eigen::RowMajor> M_;
  Eigen::Matrix<Entry, Rows, 1> x_;
  Entry scale_ = Entry(1);  // product of the scales of all rows
};

}  // namespace stiction
