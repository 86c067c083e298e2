// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/qp_ipopt.h"

#include "corpus/rounded.h"
#include "solver/problem/gate.h"

namespace stiction {

RoundedQpRun SolveQpByIpopt(const ExactProblem& problem, IpoptProposer& ipopt, double tolerance) {
  ProposalOptions options;
  options.formulation = Formulation::kQuadratic;
  ProposalStatistics statistics;
  const auto point = ipopt.ProposePoint(problem, options, statistics);
  RoundedQpRun run;
  run.iterations = statistics.iterations;
  if (!point) {
    run.reason = "no answer from Ipopt";
    return run;
  }
  const ContactProblem<double> rounded = Rounded<double>(problem);
  const Eigen::VectorXd f = Eigen::VectorXd::Map(point->data(), rounded.rows());
  const Eigen::VectorXd a = rounded.A * f + rounded.b;
  run.f = *point;
  run.a.assign(a.begin(), a.end());
  run.residual = BoundErrors(rounded, FrictionLaw::kCoulomb, f.cast<LongDouble>()).Largest();
  const bool solved = run.residual <= tolerance;  // false for what is not a number
  run.outcome = solved ? Outcome::kSolved : Outcome::kUndecided;
  if (!solved) run.reason = "the errors are above the tolerance";
  return run;
}

}  // namespace stiction
