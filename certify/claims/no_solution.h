// SPDX-License-Identifier: Apache-2.0
// The claim `no-solution`: Farkas vectors (farkas.h) that refute every contact mode, made and checked.
//
// Independent of the linear programs: this file needs products and signs only.

#ifndef STICTION_CERTIFY_CLAIMS_NO_SOLUTION_H_
#define STICTION_CERTIFY_CLAIMS_NO_SOLUTION_H_

#include "certify/exact/enumerate.h"

namespace stiction {

// The certificate. Requires: enumeration.ProvesNoSolution(), of this problem; otherwise InternalError.
Json NoSolutionCertificate(const ExactProblem& problem, const Enumeration& enumeration);

// A WitnessCheck (witness.h). Facts: words, prefixes.
Json CheckNoSolution(const ExactProblem& problem, const Json& witness);

}  // namespace stiction

#endif  // STICTION_CERTIFY_CLAIMS_NO_SOLUTION_H_
