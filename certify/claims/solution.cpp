// SPDX-License-Identifier: Apache-2.0
// Forces that solve a problem: `solution-exists`, `coulomb-solution`; and `existence`, which is one of these or
// another answer to whether there are any.
#include <fmt/format.h>

#include "certify/claims/certificate.h"
#include "certify/claims/claim.h"
#include "certify/claims/existence.h"
#include "certify/exact/bodies.h"
#include "certify/exact/hypothesis.h"
#include "certify/exact/verify_solution.h"
#include "corpus/json.h"
#include "solver/problem/check.h"

namespace stiction {

// ---- Making ------------------------------------------------------------------------------------

SharedJson SolutionCertificate(const ExactProblem& problem, const ExactVector& f) {
  const auto violation = FindViolation(problem, f);
  STICTION_CHECK(!violation, "a solution to certify is none: " + violation.value_or(""));
  return MakeCertificate("solution-exists", problem,
                         {{"f", ListJson(f)}, {"a", ListJson(Accelerations(problem, f))}});
}

SharedJson CoulombCertificate(const ExactProblem& problem, const ExactVector& f, const Rational& bound) {
  const auto violation = FindViolation(problem, f, FrictionLaw::kCoulomb, bound);
  STICTION_CHECK(!violation, "a solution to certify is none: " + violation.value_or(""));
  return MakeCertificate(
      "coulomb-solution", problem,
      {{"f", ListJson(f)}, {"a", ListJson(Accelerations(problem, f))}, {"bound", ToString(bound)}});
}

// ---- Checking ----------------------------------------------------------------------------------

namespace {

// witness.f, once witness.a is A f + b.
ExactVector ReadForces(const ExactProblem& problem, const Json& witness) {
  const ExactVector f = ReadVector(witness["f"], "witness.f", problem.rows());
  const ExactVector a = ReadVector(witness["a"], "witness.a", problem.rows());
  RequireCheapProduct(problem, f);
  const ExactVector answer = Accelerations(problem, f);
  for (int i = 0; i < problem.rows(); ++i) RequireEqual(a[i], answer[i], fmt::format("witness.a[{}]", i));
  return f;
}

}  // namespace

void RequireSolution(const ExactProblem& problem, const Json& witness) {
  const ExactVector f = ReadForces(problem, witness);
  const auto violation = FindViolation(problem, f);
  if (violation) throw Rejected{"witness.f", *violation, "a solution"};
}

namespace {

Json CheckSolution(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"a", "f"});
  RequireSolution(problem, witness);
  return Json::object();
}

Json CheckCoulomb(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"a", "bound", "f"});
  if (problem.dimension != 3) throw Rejected{"problem.dimension", "2", "3: this claim is checked in space"};
  const Rational bound = ReadNumber(witness["bound"], "witness.bound");
  if (bound <= 0 || bound > 1) throw Rejected{"witness.bound", ToString(bound), "0 < bound <= 1"};
  const ExactVector f = ReadForces(problem, witness);
  if (const auto violation = FindViolation(problem, f, FrictionLaw::kCoulomb, bound)) {
    throw Rejected{"witness.f", *violation, "a solution within the bound"};
  }
  return {{"bound", ToString(bound)}};
}

// ---- Rows --------------------------------------------------------------------------------------

bool TheoremSpeaksOf(const ExactProblem& problem) {
  return IsSymmetric(problem) && !HasSlidingContact(problem);
}

// Forces, or that there are none; where neither is found, by the theorem.
ClaimAnswer OfExistence(const ExactProblem& problem, const Request& request, const std::vector<Policy>&,
                        const EnumerationWatch& watch) {
  ClaimAnswer answer = DecideExistence(problem, request, watch);
  if (answer.certificate || !TheoremSpeaksOf(problem)) return answer;
  return ByCertificate(ExistsCertificate(problem), answer.reason + "; nor does the theorem speak of it");
}

// In the modes of the interior point method; of few rows other methods find shorter numbers.
template <FrictionLaw kLaw>
SharedJson SolutionByFactors(const ExactProblem& problem, const ExactFactors& factors, const Request& request) {
  if (problem.rows() <= MostExactRows(problem.dimension)) return {};
  const ExactAnswer answer = SolveByBodiesExactly(factors, request);
  if (answer.bound && kLaw == FrictionLaw::kCoulomb)
    return CoulombCertificate(problem, answer.f, *answer.bound);
  if (!answer.Solved()) return {};
  return FindViolation(problem, answer.f, answer.a) ? SharedJson() : SolutionCertificate(problem, answer.f);
}

SharedJson ExistenceByFactors(const ExactProblem& problem, const ExactFactors& factors,
                              const Request& request) {
  return request.law == FrictionLaw::kBaraff
             ? SolutionByFactors<FrictionLaw::kBaraff>(problem, factors, request)
             : SolutionByFactors<FrictionLaw::kCoulomb>(problem, factors, request);
}

// Of Coulomb's law the best bound that was found.
template <FrictionLaw kLaw>
ClaimAnswer ExistingUnder(const ExactProblem& problem, const Request& request, const std::vector<Policy>&,
                          const EnumerationWatch& watch) {
  return DecideExistence(problem, {.law = kLaw, .limits = request.limits}, watch);
}

}  // namespace

ClaimRows SolutionClaims() {
  static constexpr Claim kClaims[] = {
      Claim{"existence", nullptr,
            "there is a solution: solution-exists, in space by default coulomb-solution (--law), exists; or "
            "no-solution",
            OfExistence, RequireAny, "", false, ExistenceByFactors},
      Claim{"solution-exists", CheckSolution, "forces that meet all conditions, in space (21), (22)",
            ExistingUnder<FrictionLaw::kBaraff>, RequireAny, "forces that meet all conditions", false,
            SolutionByFactors<FrictionLaw::kBaraff>},
      Claim{"coulomb-solution", CheckCoulomb, "the same for Coulomb's law, in space",
            ExistingUnder<FrictionLaw::kCoulomb>, RequireSpace,
            "forces that meet Coulomb's law up to the bound", false, SolutionByFactors<FrictionLaw::kCoulomb>}};
  return {10, kClaims};
}

}  // namespace stiction
