// SPDX-License-Identifier: Apache-2.0
// Two contacts pressed down: the first sticks, the second slides. f = (1, -1/2, 2, -2).

#include <stiction.h>

#include <iostream>

#include "solver/solve.h"

int main() {
  stiction::ContactProblem<double> problem;
  problem.contacts = {{stiction::ContactKind::kStatic, 1.0}, {stiction::ContactKind::kStatic, 1.0}};
  problem.A.setIdentity(4, 4);
  problem.A(0, 0) = problem.A(2, 2) = 2;
  problem.A(0, 2) = problem.A(2, 0) = 1;
  problem.b = Eigen::Vector4d(-4, 0.5, -5, 3);

  const stiction::Answer<double> answer = stiction::Solve(problem);
  std::cout << Name(answer.outcome) << " by " << answer.method << ", f = " << answer.f.transpose() << '\n';
  std::cout << "stiction " << stiction_version() << '\n';
  return answer.Solved() && (answer.f - Eigen::Vector4d(1, -0.5, 2, -2)).norm() < 1e-7 ? 0 : 1;
}
