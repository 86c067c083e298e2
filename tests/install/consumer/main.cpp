// SPDX-License-Identifier: Apache-2.0
// Two contacts pressed down: the first sticks, the second slides. f = (1, -1/2, 2, -2).

#include <iostream>

#include "solver/published/published.h"

int main() {
  stiction::ContactProblem<double> problem;
  problem.contacts = {{stiction::ContactKind::kStatic, 1.0}, {stiction::ContactKind::kStatic, 1.0}};
  problem.A.setIdentity(4, 4);
  problem.A(0, 0) = problem.A(2, 2) = 2;
  problem.A(0, 2) = problem.A(2, 0) = 1;
  problem.b = Eigen::Vector4d(-4, 0.5, -5, 3);

  stiction::PublishedAlgorithm<double> algorithm;
  const stiction::Verdict verdict = algorithm.Run(problem);
  const Eigen::VectorXd& f = algorithm.state().f;
  std::cout << Name(verdict.outcome) << ", f = " << f.transpose() << '\n';
  const bool right = (f - Eigen::Vector4d(1, -0.5, 2, -2)).norm() < 1e-9;
  return verdict.outcome == stiction::Outcome::kSolved && right ? 0 : 1;
}
