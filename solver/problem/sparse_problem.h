// SPDX-License-Identifier: Apache-2.0
// SparseContactProblem: a ContactProblem (problem.h) of any size whose A holds its nonzero entries only.

#ifndef STICTION_SOLVER_PROBLEM_SPARSE_PROBLEM_H_
#define STICTION_SOLVER_PROBLEM_SPARSE_PROBLEM_H_

#include <Eigen/SparseCore>
#include <vector>

#include "solver/problem/problem.h"

namespace stiction {

template <class Scalar>
struct SparseContactProblem {
  using Matrix = Eigen::SparseMatrix<Scalar>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  int dimension = 2;
  std::vector<Contact<Scalar>> contacts;
  Matrix A;
  Vector b;

  int rows() const { return static_cast<int>(b.size()); }
};

}  // namespace stiction

#endif  // STICTION_SOLVER_PROBLEM_SPARSE_PROBLEM_H_
