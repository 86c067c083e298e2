// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/claims.h"

#include <fmt/format.h>

#include <algorithm>

#include "corpus/input_error.h"

namespace stiction {

// Of every file; CMakeLists.txt writes it.
std::vector<ClaimRows> RowsOfAllClaims();

std::vector<Claim> AllClaims() {
  std::vector<ClaimRows> files = RowsOfAllClaims();
  std::ranges::sort(files, {}, &ClaimRows::place);
  std::vector<Claim> all;
  for (const ClaimRows& file : files) all.insert(all.end(), file.claims.begin(), file.claims.end());
  return all;
}

ClaimAnswer Claim::Decide(const ExactProblem& problem, const Request& request,
                          const std::vector<Policy>& policies, const ExactFactors* factors,
                          const EnumerationWatch& watch) const {
  const bool tries = factors != nullptr && by_factors != nullptr;
  const SharedJson found = tries ? by_factors(problem, *factors, request) : SharedJson();
  return found ? ByCertificate(found) : certify(problem, request, policies, watch);
}

SharedJson CertifyClaim(const ExactProblem& problem, const std::string& source, std::string_view name,
                        const Request& request, const std::vector<Policy>& policies,
                        const ExactFactors* factors, const EnumerationWatch& watch) {
  std::vector<std::string_view> names;
  for (const Claim& claim : AllClaims()) {
    if (claim.certify == nullptr) continue;
    names.push_back(claim.name);
    if (claim.name != name) continue;
    claim.require(problem, source);
    return ToJson(claim.Decide(problem, request, policies, factors, watch), name);
  }
  throw InputError(source, "claim", std::string(name), fmt::format("one of {}", fmt::join(names, ", ")));
}

void RequirePlanar(const ExactProblem& problem, const std::string& source) {
  if (problem.dimension != 2)
    throw InputError(source, "dimension", std::to_string(problem.dimension), "2: built for the plane only");
}

void RequireSpace(const ExactProblem& problem, const std::string& source) {
  if (problem.dimension != 3)
    throw InputError(source, "dimension", "2", "3: in the plane the claim is solution-exists");
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
