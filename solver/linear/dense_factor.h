// SPDX-License-Identifier: Apache-2.0
// Factors of a reduced matrix M, which the caller fills in: inv(M) y in O(k^2) after one factorization.
//
//   symmetric   M = L D L', lower triangle of M only; one row and column more, or less, in O(k^2)
//   general     P M = L U, partial pivoting
//
// Columns that depend on those before them (a diagonal of the Schur complement at most `tolerance` times that
// of M) are dropped: their unknown is zero in every solution. Where M is semidefinite and the system
// consistent, their equations then hold by themselves.
// Shapes: M is k x k, k at most the size reserved. Nothing is allocated between calls of Reserve, except by
// Eigen's products of blocks above about 100 x 100.

#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <utility>
#include <vector>

#include "solver/problem/scalar.h"

namespace stiction {

template <class Scalar>
class DenseFactor {
 public:
  // Memory for k = size; what was factored is lost.
  void Reserve(int size) {
    if (W_.rows() >= size) return;
    W_.resize(size, size);
    inverse_.resize(size);
    work_.resize(size);
    swaps_.resize(size);
  }

  // Entries of column j of M, to be written before M is factored.
  Scalar* Column(int j) { return W_.data() + j * W_.rows(); }
  int size() const { return size_; }
  bool IsDropped(int j) const { return inverse_[j] == Scalar(0); }

  // Returns the number of dropped columns.
  int FactorSymmetric(int size, Scalar tolerance) {
    size_ = size;
    for (int j = 0; j < size; ++j) work_[j] = tolerance * Column(j)[j];
    return SymmetricColumns(0, size);
  }

  // y becomes inv(M) y.
  void SolveSymmetric(Scalar* y) const {
    for (int j = 0; j < size_; ++j) {
      Subtract(y[j], At(j), y, j + 1, size_);
      y[j] *= inverse_[j];
    }
    for (int j = size_ - 2; j >= 0; --j) {
      if (!IsDropped(j)) y[j] -= Dot(At(j), y, j + 1, size_);
    }
  }

  // M grows by the row and column (m, diagonal); m has size() entries and is overwritten. Returns false, and
  // changes nothing, where the new column depends on the others.
  bool Append(Scalar* m, Scalar diagonal, Scalar tolerance) {
    for (int j = 0; j < size_; ++j) Subtract(m[j], At(j), m, j + 1, size_);
    Scalar schur = diagonal;
    for (int j = 0; j < size_; ++j) {
      const Scalar l = m[j] * inverse_[j];
      schur -= m[j] * l;
      m[j] = l;
    }
    if (!(schur > tolerance * diagonal)) return false;
    for (int j = 0; j < size_; ++j) Column(j)[size_] = m[j];
    Column(size_)[size_] = schur;
    inverse_[size_++] = Scalar(1) / schur;
    return true;
  }

  // Row and column p leave M, which has no dropped columns: the factors of what follows take up
  // L(:, p) D(p) L(:, p)' (Bennett's update).
  void Remove(int p) {
    Scalar* w = work_.data();
    std::copy(Column(p) + p + 1, Column(p) + size_, w + p + 1);
    Scalar alpha = Column(p)[p];
    for (int j = 0; j < p; ++j) std::copy(Column(j) + p + 1, Column(j) + size_, Column(j) + p);
    for (int j = p + 1; j < size_; ++j) {
      const Scalar* from = Column(j);
      Scalar* to = Column(j - 1) - 1;  // row i becomes row i - 1
      const Scalar d = from[j] + alpha * w[j] * w[j];
      const Scalar beta = alpha * w[j] / d;
      alpha *= from[j] / d;
      to[j] = d;
      inverse_[j - 1] = Scalar(1) / d;
      for (int i = j + 1; i < size_; ++i) {
        w[i] -= w[j] * from[i];
        to[i] = from[i] + beta * w[i];
      }
    }
    --size_;
  }

  // Returns false where M is singular: a pivot of at most `tolerance` times the largest entry.
  bool FactorGeneral(int size, Scalar tolerance) {
    size_ = size;
    Scalar largest = Scalar(0);
    for (int j = 0; j < size; ++j) {
      for (int i = 0; i < size; ++i) largest = std::max(largest, Scalar(Abs(Column(j)[i])));
    }
    least_pivot_ = tolerance * largest;
    return GeneralColumns(0, size);
  }

  void SolveGeneral(Scalar* y) const {
    for (int j = 0; j < size_; ++j) std::swap(y[j], y[swaps_[j]]);
    for (int j = 0; j < size_; ++j) Subtract(y[j], At(j), y, j + 1, size_);
    for (int j = size_ - 1; j >= 0; --j) {
      y[j] *= inverse_[j];
      Subtract(y[j], At(j), y, 0, j);
    }
  }

 private:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  static constexpr int kPanel = 16;  // columns that plain loops factor best

  const Scalar* At(int j) const { return W_.data() + j * W_.rows(); }

  // y(i) -= factor column(i), begin <= i < end
  static void Subtract(Scalar factor, const Scalar* __restrict column, Scalar* __restrict y, int begin,
                       int end) {
    for (int i = begin; i < end; ++i) y[i] -= factor * column[i];
  }

  static Scalar Dot(const Scalar* x, const Scalar* y, int begin, int end) {
    if (end - begin < 8) {
      Scalar sum = Scalar(0);
      for (int i = begin; i < end; ++i) sum += x[i] * y[i];
      return sum;
    }
    using Segment = Eigen::Map<const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>>;
    return Segment(x + begin, end - begin).dot(Segment(y + begin, end - begin));
  }

  // Factors the columns [first, end) of all rows below; the columns before them are done. work_ holds the
  // diagonals below which a column is dropped.
  int SymmetricColumns(int first, int end) {
    if (end - first <= kPanel) return SymmetricPanel(first, end);
    const int middle = first + (end - first) / 2, left = middle - first, right = end - middle;
    const int dropped = SymmetricColumns(first, middle);
    auto upper = W_.block(first, middle, left, right);  // D L'
    for (int j = first; j < middle; ++j) {
      W_.row(j).segment(middle, right) = Column(j)[j] * W_.col(j).segment(middle, right).transpose();
    }
    W_.block(middle, middle, right, right).template triangularView<Eigen::Lower>() -=
        W_.block(middle, first, right, left) * upper;
    W_.block(end, middle, size_ - end, right).noalias() -= W_.block(end, first, size_ - end, left) * upper;
    return dropped + SymmetricColumns(middle, end);
  }

  int SymmetricPanel(int first, int end) {
    int dropped = 0;
    for (int j = first; j < end; ++j) {
      Scalar* column = Column(j);
      const bool drop = !(column[j] > work_[j]);
      dropped += drop;
      inverse_[j] = drop ? Scalar(0) : Scalar(1) / column[j];
      for (int k = j + 1; k < end; ++k) Subtract(column[k] * inverse_[j], column, Column(k), k, size_);
      for (int i = j + 1; i < size_; ++i) column[i] *= inverse_[j];
    }
    return dropped;
  }

  bool GeneralColumns(int first, int end) {
    if (end - first <= kPanel) return GeneralPanel(first, end);
    const int middle = first + (end - first) / 2, left = middle - first, right = end - middle;
    if (!GeneralColumns(first, middle)) return false;
    for (int j = middle; j < end; ++j) Swap(first, middle, j);
    auto upper = W_.block(first, middle, left, right);
    W_.block(first, first, left, left).template triangularView<Eigen::UnitLower>().solveInPlace(upper);
    W_.block(middle, middle, size_ - middle, right).noalias() -=
        W_.block(middle, first, size_ - middle, left) * upper;
    if (!GeneralColumns(middle, end)) return false;
    for (int j = first; j < middle; ++j) Swap(middle, end, j);
    return true;
  }

  // The row exchanges of the columns [first, end), in column j.
  void Swap(int first, int end, int j) {
    for (int i = first; i < end; ++i) std::swap(Column(j)[i], Column(j)[swaps_[i]]);
  }

  bool GeneralPanel(int first, int end) {
    for (int j = first; j < end; ++j) {
      Scalar* column = Column(j);
      int pivot = j;
      for (int i = j + 1; i < size_; ++i) {
        if (Abs(column[i]) > Abs(column[pivot])) pivot = i;
      }
      if (!(Abs(column[pivot]) > least_pivot_)) return false;
      swaps_[j] = pivot;
      if (pivot != j) {
        for (int k = first; k < end; ++k) std::swap(Column(k)[j], Column(k)[pivot]);
      }
      inverse_[j] = Scalar(1) / column[j];
      for (int i = j + 1; i < size_; ++i) column[i] *= inverse_[j];
      for (int k = j + 1; k < end; ++k) Subtract(Column(k)[j], column, Column(k), j + 1, size_);
    }
    return true;
  }

  Matrix W_;
  int size_ = 0;
  std::vector<Scalar> inverse_;  // of the diagonal of D or U; 0 in dropped columns
  std::vector<Scalar> work_;
  std::vector<int> swaps_;
  Scalar least_pivot_ = Scalar(0);
};

}  // namespace stiction
