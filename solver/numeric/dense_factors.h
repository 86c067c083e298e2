// SPDX-License-Identifier: Apache-2.0
// A problem of a dense A in factors, for the methods that take them.

#ifndef STICTION_SOLVER_NUMERIC_DENSE_FACTORS_H_
#define STICTION_SOLVER_NUMERIC_DENSE_FACTORS_H_

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <optional>

#include "solver/problem/factored.h"

namespace stiction {

// A = J J', by LDL' with pivots of a semidefinite A: bodies of unit mass, as many as A has rank; w = 0. None
// where A is not semidefinite but for rounding, or so large that the blocks of contacts, each as wide as J,
// would take too much memory. Forces are to be judged on A itself.
inline std::optional<FactoredProblem<double>> FactorsOf(const ContactProblem<double>& problem) {
  constexpr double kSymmetric = 1e-9, kMostEntries = 2e7;
  const int rows = problem.rows();
  if (rows == 0) return {};
  const double largest = problem.A.cwiseAbs().maxCoeff(),
               rounding = rows * std::numeric_limits<double>::epsilon() * largest;
  if ((problem.A - problem.A.transpose()).cwiseAbs().maxCoeff() > kSymmetric * largest) return {};
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(problem.A);
  const Eigen::VectorXd D = ldlt.vectorD();
  if (ldlt.info() != Eigen::Success || !D.allFinite() || D.minCoeff() < -rounding) return {};
  const auto rank = (D.array() > rounding).count();
  if (static_cast<double>(problem.contacts.size()) * rank * rank > kMostEntries) return {};
  const Eigen::MatrixXd L = ldlt.matrixL();
  Eigen::MatrixXd J(rows, rank);
  for (int j = 0, k = 0; j < rows; ++j) {
    if (D[j] > rounding) J.col(k++) = L.col(j) * std::sqrt(D[j]);
  }
  J = ldlt.transpositionsP().transpose() * J;
  FactoredProblem<double> factored;
  factored.dimension = problem.dimension;
  factored.contacts = problem.contacts;
  factored.M.resize(rank, rank);
  factored.M.setIdentity();
  factored.A = {J.sparseView(1, 0), factored.M};
  factored.w.setZero(rank);
  factored.b = factored.c = problem.b;
  return factored;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_NUMERIC_DENSE_FACTORS_H_
