// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/claims.h"

#include <fmt/format.h>

#include "corpus/input_error.h"
#include "corpus/json.h"

namespace stiction {

// Of <name>.cpp, one file an idea.
std::span<const Claim> SolutionClaims();
std::span<const Claim> NoSolutionClaims();
std::span<const Claim> MatrixClaims();
std::span<const Claim> HypothesisClaims();
std::span<const Claim> SafetyClaims();
std::span<const Claim> ConditionClaims();
std::span<const Claim> CycleClaims();

std::vector<Claim> AllClaims() {
  std::vector<Claim> all;
  for (const auto claims : {SolutionClaims(), NoSolutionClaims(), MatrixClaims(), HypothesisClaims(),
                            SafetyClaims(), ConditionClaims(), CycleClaims()})
    all.insert(all.end(), claims.begin(), claims.end());
  return all;
}

Json CertifyClaim(const ExactProblem& problem, const std::string& source, std::string_view name,
                  const ClaimOptions& options) {
  std::vector<std::string_view> names;
  for (const Claim& claim : AllClaims()) {
    if (claim.certify == nullptr) continue;
    names.push_back(claim.name);
    if (claim.name != name) continue;
    claim.require(problem, source);
    return claim.certify(problem, options);
  }
  throw InputError(source, "claim", std::string(name), fmt::format("one of {}", fmt::join(names, ", ")));
}

void RequirePlanar(const ExactProblem& problem, const std::string& source) {
  if (problem.dimension != 2)
    throw InputError(source, "dimension", std::to_string(problem.dimension), "2: built for the plane only");
}

void RequireHandled(const ExactProblem& problem, const std::string& source, const std::string& what) {
  RequirePlanar(problem, source);
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const ContactKind kind = problem.contacts[i].kind;
    if (kind == ContactKind::kFrictionless || kind == ContactKind::kStatic) continue;
    throw InputError(source, fmt::format("contacts[{}].kind", i), std::string(Name(kind)),
                     fmt::format("frictionless or static: {} is a property of problems of these", what));
  }
}

}  // namespace stiction
