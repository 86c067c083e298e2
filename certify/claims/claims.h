// SPDX-License-Identifier: Apache-2.0
// The table of claims. A new claim is a row in a file of its own (claim.h); the checkers in Python have its
// check once more.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "certify/claims/claim.h"

namespace stiction {

// Every claim, in the order in which they are told.
std::vector<Claim> AllClaims();

// The answer to a claim, as JSON (claim_answer.h, Claim::Decide). InputError for a name that is not in the
// table, and, by its place in `source`, for a problem of which the claim is not made.
SharedJson CertifyClaim(const ExactProblem& problem, const std::string& source, std::string_view claim,
                        const Request& request, const std::vector<Policy>& policies = {Policy{}},
                        const ExactFactors* factors = nullptr, const EnumerationWatch& watch = {});

}  // namespace stiction
