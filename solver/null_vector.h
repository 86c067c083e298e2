// SPDX-License-Identifier: Apache-2.0
// The null vector of a k x (k + 1) matrix, oriented by Cramer's rule.
//
//   M z = 0,  z_j = c (-1)^(k-j) det(M without column j),  c > 0
//
// So z is continuous where columns are replaced (complete_driving.md, 4), and the sign of its last component is
// that of the determinant of the first k columns. If that determinant is not zero, the last component is +-1.
// Cost: O(k^3). Over inexact scalars the largest entry of a column is its pivot, and what is at most
// `tolerance` is zero.

#ifndef STICTION_SOLVER_NULL_VECTOR_H_
#define STICTION_SOLVER_NULL_VECTOR_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "solver/scalar.h"

namespace stiction {

template <class Scalar>
using RowMajorMatrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Empty if the rank of M is below k. Destroys M.
template <class Scalar>
std::optional<std::vector<Scalar>> OrientedNullVector(RowMajorMatrix<Scalar>& M, const Scalar& tolerance) {
  const int k = static_cast<int>(M.rows());
  std::vector<int> pivot_column;
  int free = k, sign = 1;
  for (int column = 0; column <= k && static_cast<int>(pivot_column.size()) < k; ++column) {
    const int rank = static_cast<int>(pivot_column.size());
    int best = -1;
    for (int i = rank; i < k; ++i) {
      if (Sign(M(i, column), tolerance) == 0) continue;
      if (best < 0 || (!kIsExact<Scalar> && Abs(M(i, column)) > Abs(M(best, column)))) best = i;
      if (kIsExact<Scalar>) break;
    }
    if (best < 0) {
      if (free < k || column == k) return std::nullopt;
      free = column;
      continue;
    }
    if (best != rank) {
      M.row(rank).swap(M.row(best));
      sign = -sign;
    }
    sign *= Sign(M(rank, column));
    for (int i = rank + 1; i < k; ++i) {
      if (Sign(M(i, column)) == 0) continue;
      const Scalar factor = M(i, column) / M(rank, column);
      for (int j = column + 1; j <= k; ++j) {
        if (kIsExact<Scalar> && Sign(M(rank, j)) == 0) continue;
        M(i, j) -= factor * M(rank, j);
      }
    }
    pivot_column.push_back(column);
  }
  std::vector<Scalar> z(k + 1, Scalar(0));
  z[free] = Scalar((k - free) % 2 == 0 ? sign : -sign);
  for (int i = k - 1; i >= 0; --i) {
    Scalar value(0);
    for (int j = pivot_column[i] + 1; j <= k; ++j) {
      if (kIsExact<Scalar> && Sign(z[j]) == 0) continue;
      value -= M(i, j) * z[j];
    }
    z[pivot_column[i]] = value / M(i, pivot_column[i]);
  }
  return z;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_NULL_VECTOR_H_
