// SPDX-License-Identifier: Apache-2.0
// B = inv(M) and the sign of det(M), kept while M gains and loses rows and columns.
//
//   append   row r', column c, corner d    s = d - r'B c    B := [ B + (B c)(r'B) / s   -B c / s ]
//                                                                [ -r'B / s              1 / s   ]
//   replace  column p by c                 s = (B c)_p      B_p. := B_p. / s,  B_i. := B_i. - (B c)_i B_p.
//   remove   row and column p              s = B_pp         B := B - B_.p B_p. / s, without row and column p
//
// Each multiplies det(M) by s. Where s is too small for the change to keep accuracy, it is refused, and nothing
// changes. Errors add up over changes: callers look at residuals, and invert M anew.
//
// Source     bordering and the formula of Sherman and Morrison.
// Shapes     M: k x k, k at most the size reserved.
// Cost       O(k^2) a change, which reads and writes B once; O(k^3) for Invert, which alone allocates.

#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/problem/scalar.h"

namespace stiction {

template <class Scalar>
class Inverse {
 public:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using In = Eigen::Ref<const Vector>;

  // Memory for k = size. M becomes empty.
  void Reserve(int size) {
    size_ = 0;
    sign_ = 1;
    if (B_.rows() >= size) return;
    B_.resize(size, size);
    u_.resize(size);
    v_.resize(size);
  }

  int size() const { return size_; }
  int determinant_sign() const { return sign_; }

  // M_ij = entry(i, j). Returns false, with M empty, where a pivot of its LU is at most `zero`.
  template <class Entry>
  bool Invert(int size, Entry entry, Scalar zero) {
    size_ = size;
    for (int j = 0; j < size; ++j) {
      for (int i = 0; i < size; ++i) B_(i, j) = entry(i, j);
    }
    lu_.compute(Block());
    const auto pivots = lu_.matrixLU().diagonal();  // of no rows none is too small
    if (size > 0 && !(pivots.cwiseAbs().minCoeff() > zero)) {
      size_ = 0;
      return false;
    }
    sign_ = lu_.permutationP().determinant();
    for (int i = 0; i < size; ++i) sign_ = pivots[i] < 0 ? -sign_ : sign_;
    Block() = lu_.inverse();
    return true;
  }

  bool Append(const In& row, const In& column, Scalar corner) {
    const int k = size_;
    auto u = u_.head(k), v = v_.head(k);
    u.noalias() = Block() * column;
    v.noalias() = Block().transpose() * row;
    const Scalar s = corner - row.dot(u);
    if (!IsPivot(s, std::max(Scalar(Abs(corner)), Largest(column)))) return false;
    u /= -s;
    Block().noalias() -= u * v.transpose();
    B_.col(k).head(k) = u;
    B_.row(k).head(k) = -v.transpose() / s;
    B_(k, k) = 1 / s;
    ++size_;
    return true;
  }

  bool ReplaceColumn(int p, const In& column) {
    auto u = u_.head(size_), v = v_.head(size_);
    u.noalias() = Block() * column;
    const Scalar s = u[p];
    if (!IsPivot(s, Largest(u))) return false;
    v = B_.row(p).head(size_).transpose() / s;
    u[p] -= 1;
    Block().noalias() -= u * v.transpose();
    return true;
  }

  // The last row and column take the place of those removed.
  bool Remove(int p) {
    auto u = u_.head(size_), v = v_.head(size_);
    u = B_.col(p).head(size_);
    v = B_.row(p).head(size_).transpose();
    const Scalar s = u[p];
    if (!IsPivot(s, std::max(Largest(u), Largest(v)))) return false;
    u /= s;
    const int last = size_ - 1;
    B_.col(p).head(size_) = B_.col(last).head(size_);
    B_.row(p).head(size_) = B_.row(last).head(size_);
    u[p] = u[last];
    v[p] = v[last];
    --size_;
    Block().noalias() -= u.head(last) * v.head(last).transpose();
    return true;
  }

  // x = B y
  void Multiply(const In& y, Eigen::Ref<Vector> x) const { x.noalias() = B_.topLeftCorner(size_, size_) * y; }

 private:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  auto Block() { return B_.topLeftCorner(size_, size_); }

  static Scalar Largest(const In& x) { return x.size() == 0 ? Scalar(0) : x.cwiseAbs().maxCoeff(); }

  // What the determinant is multiplied by; counts its sign if the change is made. Below the root of the
  // rounding of `entries` the sign, and half of the digits, would be in doubt.
  bool IsPivot(Scalar s, Scalar entries) {
    using std::sqrt;
    if (!(Abs(s) > sqrt(std::numeric_limits<Scalar>::epsilon()) * entries)) return false;
    if (s < 0) sign_ = -sign_;
    return true;
  }

  Matrix B_;
  Vector u_, v_;
  Eigen::PartialPivLU<Matrix> lu_;
  int size_ = 0;
  int sign_ = 1;
};

}  // namespace stiction
