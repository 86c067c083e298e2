// SPDX-License-Identifier: Apache-2.0
// (H), which existence needs of b (certify/exact/hypothesis.h): `h`, `not-h`; and `exists`, theorem 1 of
// existence.md.
#include "certify/exact/hypothesis.h"

#include <fmt/format.h>

#include <algorithm>

#include "certify/claims/by_factors.h"
#include "certify/claims/certificate.h"
#include "certify/claims/claim.h"
#include "certify/claims/existence.h"
#include "corpus/json.h"

namespace stiction {

// ---- Making ------------------------------------------------------------------------------------

// Where A is symmetric, A x = b is a proof, and the cheapest.
Json HypothesisCertificate(const ExactProblem& problem) {
  if (HasSlidingContact(problem)) {
    throw InputError("claim h: stated for bilateral, frictionless and static contacts; found a sliding one");
  }
  if (IsSymmetric(problem)) {
    const auto range = DecideRange(problem.A, problem.b);
    if (const auto* x = std::get_if<ExactVector>(&range))
      return MakeCertificate("h", problem, {{"y", ListJson(*x)}});
  }
  const auto decision = DecideHypothesis(problem);
  if (const auto* y = std::get_if<ExactVector>(&decision))
    return MakeCertificate("h", problem, {{"y", ListJson(*y)}});
  const auto* obstacle = std::get_if<Obstacle>(&decision);
  if (obstacle == nullptr) return nullptr;
  return MakeCertificate("not-h", problem,
                         {{"v", ListJson(obstacle->x)}, {"value", ToString(obstacle->value)}});
}

Json ExistsCertificate(const ExactProblem& problem) {
  RequireSymmetricToClaim(problem, "exists");
  const Json hypothesis = HypothesisCertificate(problem);
  if (hypothesis.is_null() || hypothesis["claim"] != "h") return nullptr;
  Json semidefinite = SemidefiniteCertificate(problem);
  if (semidefinite["claim"] != "psd") return nullptr;
  Json& witness = semidefinite["witness"];
  witness.update(hypothesis["witness"]);
  return MakeCertificate("exists", problem, std::move(witness));
}

// ---- Checking ----------------------------------------------------------------------------------

namespace {

void RequireCones(const ExactProblem& problem) {
  if (HasSlidingContact(problem)) {
    throw Rejected{"problem.contacts", "a sliding contact", "bilateral, frictionless and static ones"};
  }
}

void RequireHypothesis(const ExactProblem& problem, const Json& witness) {
  RequireCones(problem);
  const ExactVector y = ReadVector(witness["y"], "witness.y", problem.rows());
  RequireCheapProduct(problem, y);
  if (const auto violation = FindDualConeViolation(problem, DualRest(problem, y))) {
    throw Rejected{"b - A'y", *violation, "a vector of the dual cone"};
  }
}

// b = J w + c with c in K*.
Json CheckFactoredHypothesis(const ExactProblem& problem, const Json& witness) {
  RequireCones(problem);
  const ExactVector c = RequireFactorsOfProblem(problem, witness);
  if (const auto violation = FindDualConeViolation(problem, c)) {
    throw Rejected{"witness.factors.c", *violation, "a vector of the dual cone"};
  }
  return Json::object();
}

Json CheckHypothesis(const ExactProblem& problem, const Json& witness) {
  if (HasFactors(witness)) return CheckFactoredHypothesis(problem, witness);
  RequireKeys(witness, "witness", {"y"});
  RequireHypothesis(problem, witness);
  return Json::object();
}

// The assumptions of theorem 1 of existence.md, whose conclusion is that a solution exists.
Json CheckExists(const ExactProblem& problem, const Json& witness) {
  if (HasFactors(witness)) return CheckFactoredHypothesis(problem, witness);
  RequireKeys(witness, "witness", {"D", "L", "y"});
  RequireFactors(problem, witness);
  RequireHypothesis(problem, witness);
  return Json::object();
}

Json CheckNotHypothesis(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"v", "value"});
  RequireCones(problem);
  const ExactVector v = ReadVector(witness["v"], "witness.v", problem.rows());
  RequireCheapSquare(problem, v);
  const ExactVector image = problem.A * v;
  for (int i = 0; i < problem.rows(); ++i) RequireEqual(image[i], 0, fmt::format("(A v)[{}]", i));
  const Rational product = problem.b.dot(v);
  if (const auto violation = FindConeViolation(problem, v)) throw Rejected{"witness.v", *violation, "v in K"};
  RequireEqual(ReadNumber(witness["value"], "witness.value"), product, "witness.value");
  if (product >= 0) throw Rejected{"witness.value", ToString(product), "b'v < 0"};
  return Json::object();
}

// ---- Rows --------------------------------------------------------------------------------------

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

constexpr char kHypothesis[] = "h", kExists[] = "exists";

// The claim of this name, where the factors show (H).
template <const char* kClaim>
SharedJson HypothesisByFactors(const ExactProblem& problem, const ExactFactors& factors, const Request&) {
  if (HasSlidingContact(problem) || FindDualConeViolation(problem, factors.c)) return {};
  return MakeCertificate(kClaim, problem, FactorsWitness(factors));
}

Json OfHypothesis(const ExactProblem& problem) {
  Json found = HypothesisCertificate(problem);
  if (!found.is_null()) return found;
  return "it hangs on the sign of b'v at a point of a friction cone that is not rational, or at its edge";
}

// That there is none refutes it; that the theorem does not speak of a problem refutes nothing.
ClaimAnswer OfExists(const ExactProblem& problem, const Request& request, const std::vector<Policy>&,
                     const EnumerationWatch& watch) {
  constexpr std::size_t kFewContacts = 6;  // whose modes are all tried
  Json certificate = ExistsCertificate(problem);
  if (certificate.is_null() && problem.contacts.size() <= kFewContacts) {
    const SharedJson found =
        DecideExistence(problem, {.law = FrictionLaw::kBaraff, .limits = request.limits}, watch).certificate;
    if (found && found->at("claim") == "no-solution") certificate = found;
  }
  return ByCertificate(std::move(certificate),
                       "the theorem does not speak of it: '--claim psd' and '--claim h' say what is missing; "
                       "'--claim existence' looks for forces");
}

}  // namespace

ClaimRows HypothesisClaims() {
  static constexpr Claim kClaims[] = {
      Claim{.name = "h",
            .check = CheckHypothesis,
            .meaning = "b'v >= 0 for all v in the friction cones with A v = 0",
            .certify = Alone<OfHypothesis>,
            .by_factors = HypothesisByFactors<kHypothesis>},
      Claim{.name = "not-h",
            .check = CheckNotHypothesis,
            .meaning = "b'v < 0 for some v in the friction cones with A v = 0",
            .negative = true},
      Claim{.name = "exists",
            .check = CheckExists,
            .meaning = "psd and h: by a theorem there is a solution, of any size; no forces are given",
            .certify = OfExists,
            .require = RequireTheoremSpeaksOf,
            .proves = "there is a solution, by the theorem of certify/existence.md; its forces are not given",
            .by_factors = HypothesisByFactors<kExists>}};
  return {40, kClaims};
}

}  // namespace stiction
