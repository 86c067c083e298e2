// SPDX-License-Identifier: Apache-2.0
// P K Q = L U of a sparse square matrix by KLU, whose ordering and pivots serve further matrices of one
// pattern.
//
// T. A. Davis, E. Palamadai Natarajan, Algorithm 907: KLU, ACM Transactions on Mathematical Software 37, 2010.
// Without a choice of pivots a factorization costs a part of one with it; solutions whose residuals show that
// the pivots do not suit are taken again with pivots of their own.
// Shapes: K n x n, compressed; y n x 1. Doubles alone.

#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace stiction {

class SparseLu {
 public:
  using Matrix = Eigen::SparseMatrix<double>;
  using Vector = Eigen::VectorXd;

  SparseLu();
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;

  // The ordering, from the pattern alone.
  void Order(const Matrix& K);
  // The next Factor chooses pivots.
  void ForgetPivots();
  // Of a K with the pattern ordered last. False where K is singular.
  bool Factor(const Matrix& K);
  // inv(K) y, of the K factored last.
  Vector Solve(const Matrix& K, const Vector& y);

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace stiction
