// SPDX-License-Identifier: Apache-2.0
// The null vector of a k x (k + 1) matrix, oriented by Cramer's rule.
//
//   M z = 0,  z_j = c (-1)^(k-j) det(M without column j),  c > 0
//
// So z is continuous where columns are replaced (complete_driving.md, 4), and the sign of its last component is
// that of the determinant of the first k columns. If that determinant is not zero, the last component is +-1.
// Cost: O(k^3), by elimination.h; over inexact scalars pivots up to `tolerance` are zero.

#ifndef STICTION_SOLVER_LINEAR_NULL_VECTOR_H_
#define STICTION_SOLVER_LINEAR_NULL_VECTOR_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "solver/linear/elimination.ipp"

namespace stiction {

template <class Scalar>
using RowMajorMatrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Empty if the rank of M is below k.
template <class Scalar>
std::optional<std::vector<Scalar>> OrientedNullVector(const RowMajorMatrix<Scalar>& M,
                                                      const Scalar& tolerance) {
  const int k = static_cast<int>(M.rows());
  Elimination<Scalar> elimination;
  elimination.Assign(M);
  elimination.Run(k, k + 1, k + 1, tolerance);
  if (elimination.rank() < k) return std::nullopt;
  int free = 0;
  while (free < k && elimination.pivot_column(free) == free) ++free;
  // With z_free = +-1 the others solve the system whose right side is the free column. Its rows behind that
  // place are zero: eliminated, or zero by choice.
  for (int i = free; i < k; ++i) elimination(i, free) = typename Elimination<Scalar>::Entry(0);
  elimination.BackSubstitute(free);
  const int sign = (k - free) % 2 == 0 ? elimination.Orientation() : -elimination.Orientation();
  std::vector<Scalar> z;
  for (int j = 0; j <= k; ++j) {
    const Scalar x = j == free ? Scalar(-1) : elimination.Solution(j);
    z.push_back(sign > 0 ? Scalar(-x) : x);
  }
  return z;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_LINEAR_NULL_VECTOR_H_
