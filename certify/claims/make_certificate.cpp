// SPDX-License-Identifier: Apache-2.0
// Making certificates.

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "certify/claims/certificate.h"
#include "certify/claims/existence.h"
#include "certify/claims/witness.h"
#include "certify/exact/bounds.h"
#include "certify/exact/exact.h"
#include "certify/exact/hypothesis.h"
#include "certify/exact/properties.h"
#include "certify/exact/verify_solution.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

Json MatrixToJson(const ExactMatrix& matrix) {
  Json rows = Json::array();
  for (int i = 0; i < matrix.rows(); ++i) rows.push_back(VectorToJson(matrix.row(i).transpose()));
  return rows;
}

Json SetsToJson(const std::vector<IndexSet>& sets, const std::vector<std::string>& names) {
  Json json = Json::object();
  for (std::size_t row = 0; row < sets.size(); ++row) json[names[row]] = Name(sets[row]);
  return json;
}

Json FactorsToJson(const LdltFactors& factors) {
  return {{"L", MatrixToJson(factors.L)}, {"D", VectorToJson(factors.D)}};
}

void RequireSymmetric(const ExactProblem& problem, const std::string& claim) {
  if (IsSymmetric(problem)) return;
  throw InputError(
      fmt::format("claim {}: A is not symmetric, and its symmetric part meets the claim; it is made "
                  "of symmetric A only",
                  claim));
}

Json RunToJson(const ExactRun& run, const std::vector<std::string>& names) {
  Json pivots = Json::array();
  for (const Pivot<Rational>& pivot : run.trace.pivots) pivots.push_back(PivotToJson(pivot, names));
  return {{"policies", Json::array()},
          {"start", run.verdict.start},
          {"period", run.verdict.period},
          {"pivots", std::move(pivots)},
          {"state", CycleStateToJson(run, names)}};
}

// A run for each sequence of steps that ends in a cycle, whichever policies led to it.
Json CyclesToJson(const ExactProblem& problem, const std::vector<Policy>& policies, const Limits& limits) {
  const std::vector<std::string> names = VariableNames(problem);
  Json runs = Json::array();
  for (const PolicyClass& equal : RunPolicies(problem, policies, limits)) {
    if (equal.verdict.outcome != Outcome::kCycle) continue;
    Json run = RunToJson(RunExact(problem, {equal.policies.front(), {}, limits}), names);
    Json named = Json::array();
    for (const Policy& policy : equal.policies) named.push_back(PolicyName(policy));
    const auto same = std::find_if(runs.begin(), runs.end(), [&run](const Json& other) {
      return other["pivots"] == run["pivots"] && other["state"] == run["state"];
    });
    if (same == runs.end()) {
      run["policies"] = std::move(named);
      runs.push_back(std::move(run));
    } else {
      (*same)["policies"].insert((*same)["policies"].end(), named.begin(), named.end());
    }
  }
  return runs;
}

}  // namespace

Json VectorToJson(const ExactVector& values) {
  Json json = Json::array();
  for (const Rational& value : values) json.push_back(ToString(value));
  return json;
}

Json PivotToJson(const Pivot<Rational>& pivot, const std::vector<std::string>& names) {
  return {{"drive", pivot.drive},      {"driven", names[pivot.driven]},     {"goal", Name(pivot.goal)},
          {"step", ToString(pivot.s)}, {"limiting", names[pivot.limiting]}, {"from", Name(pivot.from)},
          {"to", Name(pivot.to)}};
}

Json CycleStateToJson(const ExactRun& run, const std::vector<std::string>& names) {
  Json state = {{"sets", SetsToJson(run.state.sets, names)}, {"f", VectorToJson(run.state.f)}};
  if (run.policy.resume == Resume::kRound && run.state.last_driven_contact >= 0) {
    state["contact"] = run.state.last_driven_contact + 1;
  }
  return state;
}

Json SolutionCertificate(const ExactProblem& problem, const ExactVector& f) {
  const auto violation = problem.dimension == 3 ? FindWeakViolation(problem, f) : FindViolation(problem, f);
  STICTION_CHECK(!violation, "a solution to certify is none: " + violation.value_or(""));
  return MakeCertificate("solution-exists", problem,
                         {{"f", VectorToJson(f)}, {"a", VectorToJson(Accelerations(problem, f))}});
}

Json CoulombCertificate(const ExactProblem& problem, const ExactVector& f, const Rational& bound) {
  const auto violation = FindCoulombViolation(problem, f, bound);
  STICTION_CHECK(!violation, "a solution to certify is none: " + violation.value_or(""));
  return MakeCertificate(
      "coulomb-solution", problem,
      {{"f", VectorToJson(f)}, {"a", VectorToJson(Accelerations(problem, f))}, {"bound", ToString(bound)}});
}

Json SymmetryCertificate(const ExactProblem& problem) {
  const auto asymmetry = FindAsymmetry(problem.A);
  if (!asymmetry) return MakeCertificate("symmetric", problem, Json::object());
  return MakeCertificate("not-symmetric", problem, {{"i", asymmetry->first}, {"j", asymmetry->second}});
}

namespace {

Json NegativeCertificate(const ExactProblem& problem, const NegativeCurvature& negative) {
  return MakeCertificate("not-psd", problem,
                         {{"x", VectorToJson(negative.x)}, {"value", ToString(negative.value)}});
}

// Of a matrix whose elimination takes minutes: what doubles find, and rationals confirm.
std::optional<NegativeCurvature> FindNegativeCurvature(const ExactProblem& problem) {
  constexpr int kEliminatedRows = 60;
  if (problem.rows() <= kEliminatedRows) return std::nullopt;
  ProblemFile file;
  file.problem = problem;
  return BoundCurvature(ToSparse(file)).negative;
}

}  // namespace

Json SemidefiniteCertificate(const ExactProblem& problem) {
  if (const auto found = FindNegativeCurvature(problem)) return NegativeCertificate(problem, *found);
  const auto decision = DecideSemidefinite(problem.A);
  if (const auto* negative = std::get_if<NegativeCurvature>(&decision))
    return NegativeCertificate(problem, *negative);
  RequireSymmetric(problem, "psd");
  return MakeCertificate("psd", problem, FactorsToJson(std::get<LdltFactors>(decision)));
}

Json DefiniteCertificate(const ExactProblem& problem) {
  const auto decision = DecideDefinite(problem.A);
  if (const auto* flat = std::get_if<NoCurvature>(&decision)) {
    return MakeCertificate("not-definite", problem,
                           {{"x", VectorToJson(flat->x)}, {"value", ToString(flat->value)}});
  }
  RequireSymmetric(problem, "definite");
  return MakeCertificate("definite", problem, FactorsToJson(std::get<LdltFactors>(decision)));
}

Json RangeCertificate(const ExactProblem& problem) {
  const auto decision = DecideRange(problem.A, problem.b);
  if (const auto* point = std::get_if<RangePoint>(&decision)) {
    return MakeCertificate("in-range", problem, {{"x", VectorToJson(point->x)}});
  }
  const auto& obstacle = std::get<RangeObstacle>(decision);
  return MakeCertificate("not-in-range", problem,
                         {{"y", VectorToJson(obstacle.y)}, {"value", ToString(obstacle.value)}});
}

// Where A is symmetric, A x = b is a proof, and the cheapest.
Json HypothesisCertificate(const ExactProblem& problem) {
  if (HasSlidingContact(problem)) {
    throw InputError("claim h: stated for bilateral, frictionless and static contacts; found a sliding one");
  }
  if (IsSymmetric(problem)) {
    const auto range = DecideRange(problem.A, problem.b);
    if (const auto* point = std::get_if<RangePoint>(&range)) {
      return MakeCertificate("h", problem, {{"y", VectorToJson(point->x)}});
    }
  }
  const auto decision = DecideHypothesis(problem);
  if (const auto* proof = std::get_if<HypothesisProof>(&decision)) {
    return MakeCertificate("h", problem, {{"y", VectorToJson(proof->y)}});
  }
  const auto* obstacle = std::get_if<HypothesisObstacle>(&decision);
  if (obstacle == nullptr) return nullptr;
  return MakeCertificate("not-h", problem,
                         {{"v", VectorToJson(obstacle->v)}, {"value", ToString(obstacle->value)}});
}

Json ExistsCertificate(const ExactProblem& problem) {
  RequireSymmetric(problem, "exists");
  const Json hypothesis = HypothesisCertificate(problem);
  if (hypothesis.is_null() || hypothesis["claim"] != "h") return nullptr;
  Json semidefinite = SemidefiniteCertificate(problem);
  if (semidefinite["claim"] != "psd") return nullptr;
  Json& witness = semidefinite["witness"];
  witness.update(hypothesis["witness"]);
  return MakeCertificate("exists", problem, std::move(witness));
}

Json CycleCertificate(const ExactProblem& problem, const std::vector<Policy>& policies, const Limits& limits) {
  const Json runs = CyclesToJson(problem, policies, limits);
  return runs.empty() ? Json() : MakeCertificate("cycle", problem, {{"runs", runs}});
}

Json CounterexampleCertificate(const ExactProblem& problem, const std::vector<Policy>& policies,
                               const Limits& limits) {
  if (!IsSymmetric(problem)) return nullptr;
  const auto decision = DecideDefinite(problem.A);
  const auto* factors = std::get_if<LdltFactors>(&decision);
  const Json solution = DecideExistence(problem, limits).certificate;
  if (factors == nullptr || solution.is_null()) return nullptr;  // a definite A has a solution
  const Json runs = CyclesToJson(problem, policies, limits);
  if (runs.empty()) return nullptr;
  Json witness = FactorsToJson(*factors);
  witness.update(solution["witness"]);
  witness["runs"] = runs;
  return MakeCertificate("counterexample", problem, std::move(witness));
}

}  // namespace stiction
