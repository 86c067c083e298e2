// SPDX-License-Identifier: Apache-2.0
// Problems in factors, for tests, from a J.

#pragma once

#include <vector>

#include "solver/problem/forms.h"

namespace stiction::testing {

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

}  // namespace stiction::testing
