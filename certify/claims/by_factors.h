// SPDX-License-Identifier: Apache-2.0
// Factors of the problem as a witness: A = J inv(M) J' and b = J w + c, each block of M symmetric and definite.
//
//   psd        x'Ax = (J'x)' inv(M) (J'x) >= 0
//   in-range   c = 0: b = J w is in range(J) = range(A), inv(M) being definite
//   h          c in K*: b'v = w'J'v + c'v, and A v = 0 makes J'v = 0, so b'v = c'v >= 0 for v in K
//   exists     psd and h

#pragma once

#include "certify/claims/witness.h"
#include "corpus/record/factors.h"

namespace stiction {

// {"factors": {"J", "M", "w"}}, with "c" where it is not zero.
Json FactorsWitness(const ExactFactors& factors);
bool HasFactors(const Json& witness);

// c, once the witness, of this key alone, states factors of the problem. Rejected otherwise.
ExactVector RequireFactorsOfProblem(const ExactProblem& problem, const Json& witness);

}  // namespace stiction
