// SPDX-License-Identifier: Apache-2.0
// Problems in factors, for tests: from a J, and back to A.

#ifndef STICTION_TESTS_FACTORED_H_
#define STICTION_TESTS_FACTORED_H_

#include <vector>

#include "solver/problem/factored.h"

namespace stiction::testing {

// A, entry by entry.
template <class Scalar>
auto AllOf(const FactoredProblem<Scalar>& problem) {
  typename ContactProblem<Scalar>::Matrix A =
      ContactProblem<Scalar>::Matrix::Constant(problem.rows(), problem.rows(), Scalar(0));
  ForEachEntry(problem.A, [&A](int i, int j, const Scalar& x) { A(i, j) += x; });
  return A;
}

// With unit masses: A = J J', b = J w + c.
inline FactoredProblem<double> InFactors(int dimension, const std::vector<Contact<double>>& contacts,
                                         const Eigen::MatrixXd& J, const Eigen::VectorXd& w,
                                         const Eigen::VectorXd& c) {
  FactoredProblem<double> problem;
  problem.dimension = dimension;
  problem.contacts = contacts;
  problem.M.resize(J.cols(), J.cols());
  problem.M.setIdentity();
  problem.A = {J.sparseView(), problem.M};
  problem.w = w;
  problem.c = c;
  problem.b = J * w + c;
  return problem;
}

inline ContactProblem<double> Dense(const FactoredProblem<double>& problem) {
  return {problem.dimension, problem.contacts, AllOf(problem), problem.b};
}

}  // namespace stiction::testing

#endif  // STICTION_TESTS_FACTORED_H_
