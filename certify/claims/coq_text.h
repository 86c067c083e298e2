// SPDX-License-Identifier: Apache-2.0
// A certificate as a file for Coq, which proves the claim anew: certify/coq/README.md.

#pragma once

#include <string>
#include <vector>

#include "corpus/exact_problem.h"
#include "corpus/json_text.h"

namespace stiction {

// The claims that have such a file.
std::vector<std::string> ClaimsForCoq();

// InputError that names `source`: a certificate of another claim, of factors; a `counterexample` of contacts
// that are not all static. `problem` is that of the certificate, which CheckCertificate accepts.
std::string CoqText(const Json& certificate, const ExactProblem& problem, const std::string& source);

}  // namespace stiction
