// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>

#include "certify/claims/certificate.h"
#include "certify/claims/claim.h"
#include "certify/claims/existence.h"
#include "certify/exact/farkas.h"
#include "corpus/json.h"
#include "solver/problem/check.h"

namespace stiction {
SharedJson NoSolutionCertificate(const ExactProblem& problem, const Enumeration& enumeration) {
  STICTION_CHECK(enumeration.ProvesNoSolution(), "a certificate of no solution needs a complete enumeration");
  Json prefixes = Json::array();
  for (const RefutedPrefix& refuted : enumeration.refuted) {
    prefixes.push_back({{"modes", WordToJson(refuted.modes)}, {"y", ListJson(refuted.y)}});
  }
  const Json witness = {{"prefixes", std::move(prefixes)}};
  const auto fault = FindFault(CheckNoSolution, problem, witness);
  STICTION_CHECK(!fault, "a certificate of no solution is none: " + fault->path);
  return MakeCertificate("no-solution", problem, witness);
}

// ---- Checking ----------------------------------------------------------------------------------

namespace {

// No prefix begins another, so their completions are disjoint; then counting them is enough.
void RequireCover(const ExactProblem& problem, const std::vector<ModeWord>& prefixes) {
  const std::string path = "witness.prefixes";
  const std::set<ModeWord> listed(prefixes.begin(), prefixes.end());
  if (listed.size() < prefixes.size()) throw Rejected{path, "a prefix twice", "each once"};
  mpz_class covered = 0;
  for (std::size_t k = 0; k < prefixes.size(); ++k) {
    covered += Completions(problem, prefixes[k].size());
    for (ModeWord shorter = prefixes[k]; !shorter.empty();) {
      shorter.pop_back();
      if (listed.contains(shorter)) {
        throw Rejected{ElementPath(path, k) + ".modes", "an extension of another prefix", "none"};
      }
    }
  }
  const mpz_class words = Completions(problem, 0);
  if (covered != words) throw Rejected{path, covered.get_str() + " words", words.get_str() + ", all of them"};
}

}  // namespace

Json CheckNoSolution(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"prefixes"});
  const Json& listed = witness["prefixes"];
  RequireList(listed, "witness.prefixes");
  std::vector<ModeWord> prefixes;
  const Cost cost =
      Cost(ProductOperations(problem.rows(), static_cast<double>(listed.size()))).LongestRow(problem);
  for (std::size_t k = 0; k < listed.size(); ++k) {
    const std::string path = ElementPath("witness.prefixes", k);
    RequireKeys(listed[k], path, {"modes", "y"});
    prefixes.push_back(ReadPrefix(listed[k]["modes"], path + ".modes", problem));
    const ExactVector y = ReadVector(listed[k]["y"], path + ".y", problem.rows());
    Cost(cost).Vector(y, 2);
    if (const auto gap = FindRefutationGap(problem, prefixes.back(), MakeFarkasVector(problem, y))) {
      throw Rejected{path + ".y", *gap, "a refutation of the prefix"};
    }
  }
  RequireCover(problem, prefixes);
  return {{"words", Completions(problem, 0).get_str()}, {"prefixes", prefixes.size()}};
}

ClaimRows NoSolutionClaims() {
  static constexpr Claim kClaims[] = {Claim{.name = "no-solution",
                                            .check = CheckNoSolution,
                                            .proves = "no forces meet all conditions",
                                            .negative = true}};
  return {20, kClaims};
}

}  // namespace stiction
