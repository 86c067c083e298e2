// SPDX-License-Identifier: Apache-2.0
// Newton's matrix of laws that each concern one contact: J = D + E A, where D and E have a block per contact.
// For a dense A of floating-point scalars, and for a sparse one of doubles.

#pragma once

#include <Eigen/LU>
#include <limits>
#include <vector>

#include "solver/linear/sparse_lu.h"

namespace stiction {

// Derivatives of the laws of one contact by its forces and by its accelerations. A contact of one row has its
// numbers in the first entries.
template <class Scalar>
struct ContactSlope {
  Eigen::Matrix<Scalar, 3, 3> by_f = Eigen::Matrix<Scalar, 3, 3>::Zero();
  Eigen::Matrix<Scalar, 3, 3> by_a = Eigen::Matrix<Scalar, 3, 3>::Zero();
};

template <class Scalar>
using DenseMatrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <class Scalar>
using DenseVector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

// A with `values`, one per row, added to its diagonal.
template <class Scalar>
DenseMatrix<Scalar> WithDiagonal(const DenseMatrix<Scalar>& A, const DenseVector<Scalar>& values) {
  DenseMatrix<Scalar> sum = A;
  sum.diagonal() += values;
  return sum;
}
template <class Scalar>
Eigen::SparseMatrix<Scalar> WithDiagonal(const Eigen::SparseMatrix<Scalar>& A,
                                         const DenseVector<Scalar>& values) {
  Eigen::SparseMatrix<Scalar> shift(A.rows(), A.cols());
  shift.setIdentity();
  shift.diagonal() = values;
  return A + shift;
}

// J. first_row: of each contact, and the number of rows.
template <class Scalar>
DenseMatrix<Scalar> JoinSlopes(const std::vector<ContactSlope<Scalar>>& slopes,
                               const std::vector<int>& first_row, const DenseMatrix<Scalar>& A) {
  DenseMatrix<Scalar> J(A.rows(), A.cols());
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    const int row = first_row[i], size = first_row[i + 1] - row;
    J.middleRows(row, size) = slopes[i].by_a.topLeftCorner(size, size) * A.middleRows(row, size);
    J.block(row, row, size, size) += slopes[i].by_f.topLeftCorner(size, size);
  }
  return J;
}
template <class Scalar>
Eigen::SparseMatrix<Scalar> JoinSlopes(const std::vector<ContactSlope<Scalar>>& slopes,
                                       const std::vector<int>& first_row,
                                       const Eigen::SparseMatrix<Scalar>& A) {
  std::vector<Eigen::Triplet<Scalar>> by_f, by_a;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    const int row = first_row[i], size = first_row[i + 1] - row;
    for (int j = 0; j < size; ++j) {
      for (int k = 0; k < size; ++k) {
        by_f.emplace_back(row + j, row + k, slopes[i].by_f(j, k));
        if (slopes[i].by_a(j, k) != 0) by_a.emplace_back(row + j, row + k, slopes[i].by_a(j, k));
      }
    }
  }
  Eigen::SparseMatrix<Scalar> D(A.rows(), A.cols()), E(A.rows(), A.cols());
  D.setFromTriplets(by_f.begin(), by_f.end());
  E.setFromTriplets(by_a.begin(), by_a.end());
  return D + Eigen::SparseMatrix<Scalar>(E * A);
}

// x with J x = y; not numbers where J is found singular.
template <class Scalar>
DenseVector<Scalar> SolveLinear(const DenseMatrix<Scalar>& J, const DenseVector<Scalar>& y) {
  return J.partialPivLu().solve(y);
}
template <class Scalar>
DenseVector<Scalar> SolveLinear(const Eigen::SparseMatrix<Scalar>& J, const DenseVector<Scalar>& y) {
  SparseLu lu;
  lu.Order(J);
  if (lu.Factor(J)) return lu.Solve(J, y);
  return DenseVector<Scalar>::Constant(y.size(), std::numeric_limits<Scalar>::quiet_NaN());
}

}  // namespace stiction
