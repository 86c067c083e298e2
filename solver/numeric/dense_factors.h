// SPDX-License-Identifier: Apache-2.0
// A problem of a dense A in factors, for the methods that take them.

#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <optional>

#include "solver/problem/forms.h"

namespace stiction {

// A = J J' but for `rounding`, by LDL' with pivots; where rounding leaves pivots of a singular A below zero, by
// eigenvalues. None where A is indefinite. Shape: rows x rank.
inline std::optional<Eigen::MatrixXd> RootOf(const Eigen::MatrixXd& A, double rounding) {
  const auto columns = [rounding](const Eigen::VectorXd& squares, const Eigen::MatrixXd& V) {
    Eigen::MatrixXd J(V.rows(), (squares.array() > rounding).count());
    for (int j = 0, k = 0; j < V.cols(); ++j)
      if (squares[j] > rounding) J.col(k++) = V.col(j) * std::sqrt(squares[j]);
    return J;
  };
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(A);
  const Eigen::VectorXd D = ldlt.vectorD();
  if (ldlt.info() == Eigen::Success && D.allFinite() && D.minCoeff() >= -rounding)
    return ldlt.transpositionsP().transpose() * columns(D, ldlt.matrixL());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(A);
  if (eigen.info() != Eigen::Success || !(eigen.eigenvalues().minCoeff() >= -4 * rounding)) return {};
  return columns(eigen.eigenvalues(), eigen.eigenvectors());
}

// Bodies of unit mass, as many as A has rank; w = 0. None where A is not semidefinite but for rounding, or so
// large that the blocks of contacts, each as wide as J, would take too much memory. Forces are to be judged on
// A itself.
inline std::optional<FactoredProblem<double>> FactorsOf(const ContactProblem<double>& problem) {
  constexpr double kSymmetric = 1e-9, kMostEntries = 2e7;
  const int rows = problem.rows();
  if (rows == 0) return {};
  const double largest = problem.A.cwiseAbs().maxCoeff(),
               rounding = rows * std::numeric_limits<double>::epsilon() * largest;
  if ((problem.A - problem.A.transpose()).cwiseAbs().maxCoeff() > kSymmetric * largest) return {};
  const auto J = RootOf(problem.A, rounding);
  if (!J) return {};
  const auto rank = J->cols();
  if (static_cast<double>(problem.contacts.size()) * rank * rank > kMostEntries) return {};
  FactoredProblem<double> factored;
  factored.dimension = problem.dimension;
  factored.contacts = problem.contacts;
  factored.M.resize(rank, rank);
  factored.M.setIdentity();
  factored.A = {J->sparseView(1, 0), factored.M};
  factored.w.setZero(rank);
  factored.b = factored.c = problem.b;
  return factored;
}

}  // namespace stiction
