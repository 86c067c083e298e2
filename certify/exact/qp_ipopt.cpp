// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/qp_ipopt.h"

namespace stiction {

Answer<double> SolveQpByIpopt(const ExactProblem& problem, IpoptProposer& ipopt) {
  ProposalOptions options;
  options.formulation = Formulation::kQuadratic;
  ProposalStatistics statistics;
  const auto point = ipopt.ProposePoint(problem, options, statistics);
  Answer<double> answer;
  answer.counters = {{Counter::kIterations, statistics.iterations}};
  if (point) {
    answer.f = Eigen::VectorXd::Map(point->data(), problem.rows());
    answer.reason =
        "the errors of Ipopt's point are above the bound";  // unless the gate finds that they are not
  } else {
    answer.reason = "no answer from Ipopt";
  }
  return answer;
}

}  // namespace stiction
