// SPDX-License-Identifier: Apache-2.0
// Whether everything can stay at rest: `rests`, `cannot-rest` (certify/exact/rest.h).
#include <fmt/format.h>

#include "certify/claims/certificate.h"
#include "certify/claims/claim.h"
#include "certify/exact/bodies.h"
#include "certify/exact/hypothesis.h"
#include "certify/exact/rest.h"
#include "certify/exact/verify_solution.h"
#include "corpus/json.h"

namespace stiction {
namespace {

void RequireNoneSlides(const ExactProblem& problem, const std::string& source) {
  for (std::size_t i = 0; i < problem.contacts.size(); ++i)
    if (problem.contacts[i].kind == ContactKind::kSliding)
      throw InputError(source, fmt::format("contacts[{}].kind", i), "sliding",
                       "bilateral, frictionless or static: what slides does not rest");
}

Json OfRest(const ExactProblem& problem) {
  if (problem.rows() > kQuickRows)
    return fmt::format("it has {} rows, and programs take {}", problem.rows(), kQuickRows);
  const Rest rest = DecideRest(problem);
  if (rest.f) return MakeCertificate("rests", problem, {{"f", ListJson(*rest.f)}});
  if (!rest.y) return "it hangs on a force at the edge of a friction cone";
  return MakeCertificate("cannot-rest", problem,
                         {{"y", ListJson(*rest.y)}, {"value", ToString(problem.b.dot(*rest.y))}});
}

SharedJson RestByFactors(const ExactProblem& problem, const ExactFactors& factors, const Request& request) {
  if (problem.rows() <= MostExactRows(problem.dimension)) return {};
  const ExactAnswer answer = SolveByBodiesExactly(factors, request);
  if (!answer.Solved() || !answer.a.isZero(0)) return {};
  return MakeCertificate("rests", problem, {{"f", ListJson(answer.f)}});
}

ExactVector ReadFactor(const ExactProblem& problem, const Json& witness, const char* name) {
  if (HasSlidingContact(problem))
    throw Rejected{"problem.contacts", "a sliding contact", "bilateral, frictionless and static ones"};
  return ReadVector(witness[name], std::string("witness.") + name, problem.rows());
}

Json CheckRests(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"f"});
  const ExactVector f = ReadFactor(problem, witness, "f");
  RequireCheapProduct(problem, f);
  const ExactVector a = Accelerations(problem, f);
  for (int i = 0; i < problem.rows(); ++i) RequireEqual(a[i], 0, fmt::format("(A f + b)[{}]", i));
  if (const auto violation = FindConeViolation(problem, f)) throw Rejected{"witness.f", *violation, "f in K"};
  return Json::object();
}

Json CheckCannotRest(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"value", "y"});
  const ExactVector y = ReadFactor(problem, witness, "y");
  RequireCheapSquare(problem, y);
  if (const auto violation = FindDualConeViolation(problem, problem.A.transpose() * y))
    throw Rejected{"A'y", *violation, "a vector of the dual cone"};
  const Rational product = problem.b.dot(y);
  RequireEqual(ReadNumber(witness["value"], "witness.value"), product, "witness.value");
  if (product <= 0) throw Rejected{"witness.value", ToString(product), "y'b > 0"};
  return Json::object();
}

}  // namespace

ClaimRows RestsClaims() {
  static constexpr Claim kClaims[] = {
      Claim{.name = "rests",
            .check = CheckRests,
            .meaning = "a solution with no acceleration: everything can stay at rest",
            .certify = Alone<OfRest>,
            .require = RequireNoneSlides,
            .proves = "forces under which nothing accelerates",
            .by_factors = RestByFactors},
      Claim{.name = "cannot-rest",
            .check = CheckCannotRest,
            .meaning = "every solution accelerates something, if there is one",
            .negative = true}};
  return {17, kClaims};
}

}  // namespace stiction
