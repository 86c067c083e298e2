// SPDX-License-Identifier: Apache-2.0
// The claims that can be asked for by name, by the program and from Python.

#ifndef STICTION_CERTIFY_CLAIMS_CLAIMS_H_
#define STICTION_CERTIFY_CLAIMS_CLAIMS_H_

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "certify/exact/enumerate.h"
#include "corpus/problem_file.h"
#include "solver/problem/answer.h"
#include "solver/problem/options.h"

namespace stiction {

struct Claim {
  std::string_view name;
  std::string_view meaning;
};
std::span<const Claim> AllClaims();

struct ClaimOptions {
  std::vector<Policy> policies = {Policy{}};  // of which runs are claimed
  Limits limits;
  EnumerationOptions enumeration;
  FrictionLaw law = FrictionLaw::kCoulomb;  // in space, of `existence`
};

// The certificate of a claim or of its negation; null where nothing that was run shows either. InputError for a
// name that is not in the table, and, by its place in `source`, for a problem of which the claim is not made.
Json CertifyClaim(const ExactProblem& problem, const std::string& source, std::string_view claim,
                  const ClaimOptions& options);

// What claims are made of: planar problems; planar problems of frictionless and static contacts, of which alone
// `what` is said. InputError that names the place in `source` otherwise.
void RequirePlanar(const ExactProblem& problem, const std::string& source);
void RequireHandled(const ExactProblem& problem, const std::string& source, const std::string& what);

}  // namespace stiction

#endif  // STICTION_CERTIFY_CLAIMS_CLAIMS_H_
