// SPDX-License-Identifier: Apache-2.0
// Method `qp` over doubles: equation (5) by Ipopt, in its process (feasibility_nlp.h). One start, its point
// taken as it is and measured.

#ifndef STICTION_CERTIFY_EXACT_QP_IPOPT_H_
#define STICTION_CERTIFY_EXACT_QP_IPOPT_H_

#include "certify/exact/feasibility_nlp.h"
#include "solver/problem/answer.h"

namespace stiction {

// Ipopt's point; undecided, since nothing is concluded from its failure, and its point is for the gate to judge
// (solver/solve.h). Without f where there was no answer. InputError as for SolveQp, but A is not looked at.
Answer<double> SolveQpByIpopt(const ExactProblem& problem, IpoptProposer& ipopt);

}  // namespace stiction

#endif  // STICTION_CERTIFY_EXACT_QP_IPOPT_H_
