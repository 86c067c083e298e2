// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "certify/claims/certificate.h"
#include "certify/claims/condition.h"
#include "certify/claims/existence.h"
#include "certify/claims/safe.h"
#include "certify/exact/hypothesis.h"
#include "certify/exact/properties.h"
#include "corpus/input_error.h"

namespace stiction {
namespace {

// A row for each claim: what it says, of which problems, and what makes its certificate.
struct ClaimRow {
  Claim claim;
  void (*require)(const ExactProblem&, const std::string& source);
  Json (*certify)(const ExactProblem&, const ClaimOptions&);
};

void RequireNothing(const ExactProblem&, const std::string&) {}
void RequireSafetyIsSaid(const ExactProblem& problem, const std::string& source) {
  RequireHandled(problem, source, "safety");
}
void RequireSpace(const ExactProblem& problem, const std::string& source) {
  if (problem.dimension != 3)
    throw InputError(source, "dimension", "2", "3: in the plane the claim is solution-exists");
}

Json ExistingUnder(FrictionLaw law, const ExactProblem& problem, const ClaimOptions& o) {
  return DecideExistence(problem, o.limits, o.enumeration, law).certificate;
}

bool TheoremSpeaksOf(const ExactProblem& problem) {
  return IsSymmetric(problem) && !HasSlidingContact(problem);
}

// Forces, or that there are none; where neither is found, by the theorem.
Json OfExistence(const ExactProblem& problem, const ClaimOptions& o) {
  Json found = ExistingUnder(o.law, problem, o);
  return found.is_null() && TheoremSpeaksOf(problem) ? ExistsCertificate(problem) : found;
}

Json OfSolution(const ExactProblem& problem, const ClaimOptions& o) {
  return ExistingUnder(FrictionLaw::kBaraff, problem, o);
}

void RequireTheoremSpeaksOf(const ExactProblem& problem, const std::string& source) {
  if (const auto pair = FindAsymmetry(problem.A))
    throw InputError(source, fmt::format("A[{}][{}]", pair->first, pair->second), "an entry unlike its mirror",
                     "a symmetric A: the theorem speaks of no other");
  const auto sliding = std::find_if(problem.contacts.begin(), problem.contacts.end(),
                                    [](const auto& contact) { return contact.kind == ContactKind::kSliding; });
  if (sliding != problem.contacts.end())
    throw InputError(source, fmt::format("contacts[{}].kind", sliding - problem.contacts.begin()), "sliding",
                     "bilateral, frictionless or static: with sliding contacts there may be no solution");
}

// The best bound that was found, or null.
Json OfCoulomb(const ExactProblem& problem, const ClaimOptions& o) {
  return ExistingUnder(FrictionLaw::kCoulomb, problem, o);
}

// Makers that take the problem alone.
template <Json (*Make)(const ExactProblem&)>
Json Alone(const ExactProblem& problem, const ClaimOptions&) {
  return Make(problem);
}
Json ByCondition(const ExactProblem& problem) { return ConditionCertificate(problem).value_or(Json()); }

Json OfCycle(const ExactProblem& problem, const ClaimOptions& o) {
  return CycleCertificate(problem, o.policies, o.limits);
}
Json OfCounterexample(const ExactProblem& problem, const ClaimOptions& o) {
  return CounterexampleCertificate(problem, o.policies, o.limits);
}

const std::array kRows = {
    ClaimRow{
        {"existence", "solution-exists, in space by default coulomb-solution (--law), exists or no-solution"},
        RequireNothing,
        OfExistence},
    ClaimRow{{"solution-exists", "forces that meet all conditions, in space (21), (22)"},
             RequireNothing,
             OfSolution},
    ClaimRow{{"coulomb-solution", "the same for Coulomb's law, in space"}, RequireSpace, OfCoulomb},
    ClaimRow{{"symmetric", "A = A'"}, RequireNothing, Alone<SymmetryCertificate>},
    ClaimRow{{"psd", "A is positive semidefinite"}, RequireNothing, Alone<SemidefiniteCertificate>},
    ClaimRow{{"definite", "A is positive definite"}, RequireNothing, Alone<DefiniteCertificate>},
    ClaimRow{{"in-range", "b is in the range of A"}, RequireNothing, Alone<RangeCertificate>},
    ClaimRow{{"h", "b'v >= 0 for all v in the friction cones with A v = 0"},
             RequireNothing,
             Alone<HypothesisCertificate>},
    ClaimRow{{"exists", "psd and h: by a theorem there is a solution, of any size; no forces are given"},
             RequireTheoremSpeaksOf,
             Alone<ExistsCertificate>},
    ClaimRow{{"safe", "A is safe: ties apart, the published algorithm under apex=suspended ends"},
             RequireSafetyIsSaid,
             Alone<SafetyCertificate>},
    ClaimRow{{"safe-by-condition", "its condition number alone shows that it is"},
             RequireSafetyIsSaid,
             Alone<ByCondition>},
    ClaimRow{{"cycle", "the published algorithm repeats a state of its outer loop"}, RequirePlanar, OfCycle},
    ClaimRow{{"counterexample", "it does, though A is definite and there is a solution: all in one file"},
             RequirePlanar,
             OfCounterexample},
};

std::vector<Claim> MakeClaims() {
  std::vector<Claim> claims;
  for (const ClaimRow& row : kRows) claims.push_back(row.claim);
  return claims;
}

std::string ClaimNames() {
  std::vector<std::string_view> names;
  for (const ClaimRow& row : kRows) names.push_back(row.claim.name);
  return fmt::format("one of {}", fmt::join(names, ", "));
}

}  // namespace

std::span<const Claim> AllClaims() {
  static const std::vector<Claim> claims = MakeClaims();
  return claims;
}

Json CertifyClaim(const ExactProblem& problem, const std::string& source, std::string_view claim,
                  const ClaimOptions& options) {
  const auto row =
      std::find_if(kRows.begin(), kRows.end(), [claim](const ClaimRow& r) { return r.claim.name == claim; });
  if (row == kRows.end()) throw InputError(source, "claim", std::string(claim), ClaimNames());
  row->require(problem, source);
  return row->certify(problem, options);
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
