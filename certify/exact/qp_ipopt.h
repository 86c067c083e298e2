// SPDX-License-Identifier: Apache-2.0
// Method `qp` over doubles: equation (5) by Ipopt, in its process (feasibility_nlp.h). One start, its point
// taken as it is and measured.

#ifndef STICTION_CERTIFY_EXACT_QP_IPOPT_H_
#define STICTION_CERTIFY_EXACT_QP_IPOPT_H_

#include <string_view>
#include <vector>

#include "certify/exact/feasibility_nlp.h"
#include "solver/problem/solution.h"

namespace stiction {

struct RoundedQpRun {
  Outcome outcome = Outcome::kUndecided;  // solved, or undecided: nothing is concluded from Ipopt's failure
  std::string_view reason;
  std::vector<double> f, a;  // Ipopt's point and a = A f + b; empty if there was no answer
  double residual = 0;       // the largest error of f
  std::int64_t iterations = 0;
};

// Solved: errors of at most `tolerance`. InputError as for SolveQp, but A is not looked at.
RoundedQpRun SolveQpByIpopt(const ExactProblem& problem, IpoptProposer& ipopt, double tolerance = 1e-6);

}  // namespace stiction

#endif  // STICTION_CERTIFY_EXACT_QP_IPOPT_H_
