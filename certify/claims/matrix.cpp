// SPDX-License-Identifier: Apache-2.0
// The assumptions of the paper on A and b: `symmetric`, `psd`, `definite`, `in-range`, and their negations.
#include <fmt/format.h>

#include "certify/claims/by_factors.h"
#include "certify/claims/certificate.h"
#include "certify/claims/claim.h"
#include "certify/exact/bounds.h"
#include "certify/exact/properties.h"
#include "corpus/json.h"

namespace stiction {

Json FactorsToJson(const LdltFactors& factors) {
  return {{"L", RowsJson(factors.L)}, {"D", ListJson(factors.D)}};
}

void RequireSymmetricToClaim(const ExactProblem& problem, const std::string& claim) {
  if (IsSymmetric(problem)) return;
  throw InputError(
      fmt::format("claim {}: A is not symmetric, and its symmetric part meets the claim; it is made "
                  "of symmetric A only",
                  claim));
}

// ---- Making ------------------------------------------------------------------------------------

Json SymmetryCertificate(const ExactProblem& problem) {
  const auto asymmetry = FindAsymmetry(problem.A);
  if (!asymmetry) return MakeCertificate("symmetric", problem, Json::object());
  return MakeCertificate("not-symmetric", problem, {{"i", asymmetry->first}, {"j", asymmetry->second}});
}

namespace {

Json ObstacleCertificate(const char* claim, const char* vector, const ExactProblem& problem,
                         const Obstacle& obstacle) {
  return MakeCertificate(claim, problem, {{vector, ListJson(obstacle.x)}, {"value", ToString(obstacle.value)}});
}

// Of a matrix whose elimination takes minutes: what doubles find, and rationals confirm.
std::optional<Obstacle> FindNegativeCurvature(const ExactProblem& problem) {
  if (problem.rows() <= kQuickRows) return std::nullopt;
  return BoundCurvature(problem).negative;
}

}  // namespace

Json SemidefiniteCertificate(const ExactProblem& problem) {
  if (const auto found = FindNegativeCurvature(problem))
    return ObstacleCertificate("not-psd", "x", problem, *found);
  const auto decision = DecideSemidefinite(problem.A);
  if (const auto* negative = std::get_if<Obstacle>(&decision))
    return ObstacleCertificate("not-psd", "x", problem, *negative);
  RequireSymmetricToClaim(problem, "psd");
  return MakeCertificate("psd", problem, FactorsToJson(std::get<LdltFactors>(decision)));
}

Json DefiniteCertificate(const ExactProblem& problem) {
  const auto decision = DecideDefinite(problem.A);
  if (const auto* flat = std::get_if<Obstacle>(&decision))
    return ObstacleCertificate("not-definite", "x", problem, *flat);
  RequireSymmetricToClaim(problem, "definite");
  return MakeCertificate("definite", problem, FactorsToJson(std::get<LdltFactors>(decision)));
}

Json RangeCertificate(const ExactProblem& problem) {
  const auto decision = DecideRange(problem.A, problem.b);
  if (const auto* x = std::get_if<ExactVector>(&decision))
    return MakeCertificate("in-range", problem, {{"x", ListJson(*x)}});
  return ObstacleCertificate("not-in-range", "y", problem, std::get<Obstacle>(decision));
}

// ---- Checking ----------------------------------------------------------------------------------

void RequireSymmetric(const ExactProblem& problem) {
  if (const auto pair = FindAsymmetry(problem.A)) {
    throw Rejected{fmt::format("problem.A[{}][{}]", pair->first, pair->second), "an entry unlike its mirror",
                   "A = A'"};
  }
}

namespace {

Json CheckSymmetric(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {});
  RequireSymmetric(problem);
  return Json::object();
}

Json CheckNotSymmetric(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"i", "j"});
  const std::int64_t i = ReadInteger(witness["i"], "witness.i", 0),
                     j = ReadInteger(witness["j"], "witness.j", 0);
  if (i >= problem.rows() || j >= problem.rows()) throw Rejected{"witness", Shown(witness), "indices of A"};
  if (problem.A(i, j) == problem.A(j, i)) throw Rejected{"witness", "A_ij = A_ji", "different entries"};
  return Json::object();
}

}  // namespace

// D, once A = L diag(D) L' with D >= 0, which is symmetric. One column of L after the other is taken away, so
// that no number grows beyond the minors of A, whatever L and D are.
ExactVector RequireFactors(const ExactProblem& problem, const Json& witness) {
  const int rows = problem.rows();
  Cost(EliminationOperations(rows, 1)).AllRows(problem);
  const ExactVector D = ReadVector(witness["D"], "witness.D", rows);
  RequireList(witness["L"], "witness.L", static_cast<std::size_t>(rows), "rows");
  ExactMatrix L(rows, rows);
  for (int i = 0; i < rows; ++i) {
    L.row(i) = ReadVector(witness["L"][i], fmt::format("witness.L[{}]", i), rows).transpose();
    if (D[i] < 0) throw Rejected{fmt::format("witness.D[{}]", i), ToString(D[i]), "a number >= 0"};
    for (int j = i; j < rows; ++j)
      RequireEqual(L(i, j), i == j ? 1 : 0, fmt::format("witness.L[{}][{}]", i, j));
  }
  RequireSymmetric(problem);
  ExactMatrix rest = problem.A;
  for (int k = 0; k < rows; ++k) {
    for (int i = k; i < rows; ++i)
      RequireEqual(rest(i, k), L(i, k) * D[k], fmt::format("(A - L diag(D) L')[{}][{}]", i, k));
    for (int i = k + 1; i < rows; ++i) {
      for (int j = k + 1; j <= i && D[k] != 0; ++j) rest(i, j) -= L(i, k) * rest(j, k);
    }
  }
  return D;
}

void RequireDefinite(const ExactProblem& problem, const Json& witness) {
  const ExactVector D = RequireFactors(problem, witness);
  for (int i = 0; i < D.size(); ++i) {
    if (D[i] <= 0) throw Rejected{fmt::format("witness.D[{}]", i), ToString(D[i]), "a number > 0"};
  }
}

namespace {

Json CheckSemidefinite(const ExactProblem& problem, const Json& witness) {
  if (HasFactors(witness)) {
    RequireFactorsOfProblem(problem, witness);
    return Json::object();
  }
  RequireKeys(witness, "witness", {"D", "L"});
  RequireFactors(problem, witness);
  return Json::object();
}

Json CheckDefinite(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"D", "L"});
  RequireDefinite(problem, witness);
  return Json::object();
}

// witness.x, and x'Ax, which must be witness.value.
std::pair<ExactVector, Rational> ReadCurvature(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"value", "x"});
  const ExactVector x = ReadVector(witness["x"], "witness.x", problem.rows());
  RequireCheapSquare(problem, x);
  const Rational curvature = x.dot(problem.A * x);
  RequireEqual(ReadNumber(witness["value"], "witness.value"), curvature, "witness.value");
  return {x, curvature};
}

Json CheckNotSemidefinite(const ExactProblem& problem, const Json& witness) {
  const auto [x, curvature] = ReadCurvature(problem, witness);
  if (curvature >= 0) throw Rejected{"witness.value", ToString(curvature), "x'Ax < 0"};
  return Json::object();
}

Json CheckNotDefinite(const ExactProblem& problem, const Json& witness) {
  const auto [x, curvature] = ReadCurvature(problem, witness);
  if (x.isZero()) throw Rejected{"witness.x", "0", "another vector"};
  if (curvature > 0) throw Rejected{"witness.value", ToString(curvature), "x'Ax <= 0"};
  return Json::object();
}

Json CheckInRange(const ExactProblem& problem, const Json& witness) {
  if (HasFactors(witness)) {
    const ExactVector c = RequireFactorsOfProblem(problem, witness);
    for (int i = 0; i < c.size(); ++i) RequireEqual(c[i], 0, fmt::format("witness.factors.c[{}]", i));
    return Json::object();
  }
  RequireKeys(witness, "witness", {"x"});
  const ExactVector x = ReadVector(witness["x"], "witness.x", problem.rows());
  RequireCheapProduct(problem, x);
  const ExactVector image = problem.A * x;
  for (int i = 0; i < problem.rows(); ++i) RequireEqual(image[i], problem.b[i], fmt::format("(A x)[{}]", i));
  return Json::object();
}

Json CheckNotInRange(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"value", "y"});
  const ExactVector y = ReadVector(witness["y"], "witness.y", problem.rows());
  RequireCheapSquare(problem, y);
  const ExactVector image = problem.A.transpose() * y;
  for (int j = 0; j < problem.rows(); ++j) RequireEqual(image[j], 0, fmt::format("(y'A)[{}]", j));
  const Rational product = y.dot(problem.b);
  RequireEqual(ReadNumber(witness["value"], "witness.value"), product, "witness.value");
  if (product == 0) throw Rejected{"witness.value", "0", "y'b /= 0"};
  return Json::object();
}

SharedJson SemidefiniteByFactors(const ExactProblem& problem, const ExactFactors& factors, const Request&) {
  return MakeCertificate("psd", problem, FactorsWitness(factors));
}

SharedJson RangeByFactors(const ExactProblem& problem, const ExactFactors& factors, const Request&) {
  return IsInRangeByFactors(factors) ? MakeCertificate("in-range", problem, FactorsWitness(factors)) : Json();
}

}  // namespace

ClaimRows MatrixClaims() {
  static constexpr Claim kClaims[] = {
      Claim{"symmetric", CheckSymmetric, "A = A'", Alone<SymmetryCertificate>},
      Claim{.name = "not-symmetric",
            .check = CheckNotSymmetric,
            .meaning = "an entry of A is unlike its mirror",
            .negative = true},
      Claim{.name = "psd",
            .check = CheckSemidefinite,
            .meaning = "A is positive semidefinite",
            .certify = Alone<SemidefiniteCertificate>,
            .by_factors = SemidefiniteByFactors},
      Claim{
          .name = "not-psd", .check = CheckNotSemidefinite, .meaning = "x'Ax < 0 for some x", .negative = true},
      Claim{"definite", CheckDefinite, "A is positive definite", Alone<DefiniteCertificate>},
      Claim{.name = "not-definite",
            .check = CheckNotDefinite,
            .meaning = "x'Ax <= 0 for some x that is not zero",
            .negative = true},
      Claim{.name = "in-range",
            .check = CheckInRange,
            .meaning = "b is in the range of A",
            .certify = Alone<RangeCertificate>,
            .by_factors = RangeByFactors},
      Claim{.name = "not-in-range",
            .check = CheckNotInRange,
            .meaning = "some y has y'A = 0 and y'b /= 0",
            .negative = true}};
  return {30, kClaims};
}

}  // namespace stiction
