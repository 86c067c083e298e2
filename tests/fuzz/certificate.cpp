// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/certificate.h"

#include <functional>
#include <map>

#include "certify/claims/existence.h"
#include "certify/claims/safe.h"
#include "certify/exact/enumerate.h"
#include "certify/exact/exact.h"
#include "certify/exact/hypothesis.h"
#include "certify/exact/properties.h"
#include "corpus/json.h"
#include "corpus/record/problem_file.h"
#include "solver/problem/check.h"
#include "tests/fuzz/claims.h"
#include "tests/fuzz/targets.h"

namespace stiction::fuzz {
namespace {

constexpr std::size_t kMostContactsDecided = 4;
constexpr std::int64_t kPrograms = 2000;

bool IsPlanar(const ExactProblem& problem) { return problem.dimension == 2; }

bool ProvesNoSolution(const ExactProblem& problem) {
  const Request request = {.limits = {.programs = kPrograms}};
  return (IsPlanar(problem) ? EnumerateModes(problem, request, UntilSolved) : RefuteInSpace(problem, request))
      .ProvesNoSolution();
}

bool HasSolution(const ExactProblem& problem) {
  const Json certificate =
      DecideExistence(problem, {.law = FrictionLaw::kBaraff, .limits = {.programs = kPrograms}}).certificate;
  return certificate.is_object() && certificate["claim"] == "solution-exists";
}

// Whether (H) is decided, and decided against `claim`.
bool ContradictsHypothesis(const ExactProblem& problem, const char* claim) {
  if (HasSlidingContact(problem)) return false;
  const Json decided = HypothesisCertificate(problem);
  return decided.is_object() && decided["claim"] != claim;
}

// Of asymmetric matrices (A + A')/2 is meant.
bool HasPivots(const ExactProblem& problem) {
  return std::holds_alternative<LdltFactors>(DecideDefinite(problem.A));
}
bool IsDefinite(const ExactProblem& problem) { return IsSymmetric(problem) && HasPivots(problem); }

bool IsSafe(const ExactProblem& problem) { return !DecideSafety(problem).unsafe_word.has_value(); }

// Whether the problem contradicts the claim.
using Contradicts = std::function<bool(const ExactProblem&)>;

const std::map<std::string, Contradicts>& Contradictions() {
  using P = const ExactProblem&;
  static const std::map<std::string, Contradicts> contradictions = {
      {"solution-exists", ProvesNoSolution},
      {"coulomb-solution", ProvesNoSolution},
      {"coulomb-exact", ProvesNoSolution},
      {"no-solution", HasSolution},
      {"symmetric", [](P p) { return !IsSymmetric(p); }},
      {"not-symmetric", [](P p) { return IsSymmetric(p); }},
      {"psd", [](P p) { return !IsSymmetric(p) || !IsPositiveSemidefinite(p); }},
      {"not-psd", [](P p) { return std::holds_alternative<LdltFactors>(DecideSemidefinite(p.A)); }},
      {"definite", [](P p) { return !IsDefinite(p); }},
      {"not-definite", HasPivots},
      {"in-range", [](P p) { return !IsInRange(p); }},
      {"not-in-range", [](P p) { return IsInRange(p); }},
      {"h", [](P p) { return ContradictsHypothesis(p, "h"); }},
      {"not-h", [](P p) { return ContradictsHypothesis(p, "not-h"); }},
      {"exists",
       [](P p) {
         return !IsSymmetric(p) || !IsPositiveSemidefinite(p) || ContradictsHypothesis(p, "h") ||
                ProvesNoSolution(p);
       }},
      {"safe", [](P p) { return !IsSafe(p); }},
      {"unsafe", IsSafe},
      {"safe-by-condition", [](P p) { return !IsSafe(p); }},
  };
  return contradictions;
}

// Under every policy that a cycle is claimed of.
bool AllCycle(const ExactProblem& problem, const Json& certificate) {
  for (const Policy& policy : CertifiedPolicies(certificate)) {
    if (RunExact(problem, {.policy = policy}).verdict.outcome != Outcome::kCycle) return false;
  }
  return true;
}

bool IsCounterexample(const ExactProblem& problem, const Json& certificate) {
  return IsDefinite(problem) && !ProvesNoSolution(problem) && AllCycle(problem, certificate);
}

}  // namespace

std::string FaultOfClaim(const Json& certificate) {
  const ExactProblem problem = ProblemFromJson(certificate["problem"], "certificate", "problem", true);
  if (problem.contacts.size() > kMostContactsDecided) return "";
  const std::string claim = certificate["claim"].get<std::string>();
  if (claim == "cycle" && !AllCycle(problem, certificate)) return "a policy does not cycle";
  if (claim == "counterexample" && !IsCounterexample(problem, certificate)) return "it is no counterexample";
  const auto contradiction = Contradictions().find(claim);
  const bool wrong = contradiction != Contradictions().end() && contradiction->second(problem);
  return wrong ? "the claim " + claim + " is false" : "";
}

bool FuzzCertificate(std::string_view bytes) {
  const auto certificate = Unrefused([bytes] { return ParseJson(bytes, "input"); });
  if (!certificate) return false;
  const CheckReport report = CheckCertificate(*certificate, "input");
  STICTION_CHECK(report.accepted == report.reason.empty(),
                 "a rejection without a reason, or a reason to accept");
  if (!report.accepted) return false;
  const std::string fault = FaultOfClaim(*certificate);
  STICTION_CHECK(fault.empty(), "accepted, though " + fault);
  return true;
}

}  // namespace stiction::fuzz
