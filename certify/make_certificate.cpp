// SPDX-License-Identifier: Apache-2.0
// Making certificates.

#include <algorithm>

#include "certify/certificate.h"
#include "certify/exact.h"
#include "certify/hypothesis.h"
#include "certify/properties.h"
#include "certify/verify_solution.h"
#include "certify/witness.h"
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

Json RunToJson(const ExactRun& run, const std::vector<std::string>& names) {
  Json pivots = Json::array();
  for (const Pivot<Rational>& pivot : run.trace.pivots) pivots.push_back(PivotToJson(pivot, names));
  return {{"policies", Json::array()},
          {"start", run.verdict.start},
          {"period", run.verdict.period},
          {"pivots", std::move(pivots)},
          {"state", LoopStateToJson(run, names)}};
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

Json LoopStateToJson(const ExactRun& run, const std::vector<std::string>& names) {
  Json state = {{"sets", SetsToJson(run.state.sets, names)}, {"f", VectorToJson(run.state.f)}};
  if (run.verdict.outcome == Outcome::kStall) {
    Json left = Json::object();
    for (std::size_t row = 0; row < names.size(); ++row) {
      if (run.state.last_left[row] != IndexSet::kNone) left[names[row]] = Name(run.state.last_left[row]);
    }
    state["left"] = std::move(left);
    state["zero"] = run.state.last_step_zero;
  } else if (run.policy.resume == Resume::kRound && run.state.last_driven_contact >= 0) {
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

Json SemidefiniteCertificate(const ExactProblem& problem) {
  const auto decision = DecideSemidefinite(problem.A);
  if (const auto* negative = std::get_if<NegativeCurvature>(&decision)) {
    return MakeCertificate("not-psd", problem,
                           {{"x", VectorToJson(negative->x)}, {"value", ToString(negative->value)}});
  }
  if (!IsSymmetric(problem)) {
    throw InputError(
        "claim psd: A is not symmetric, and x'Ax >= 0 for all x; `psd` is claimed of symmetric A only");
  }
  const auto& factors = std::get<LdltFactors>(decision);
  return MakeCertificate("psd", problem, {{"L", MatrixToJson(factors.L)}, {"D", VectorToJson(factors.D)}});
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

// Where A is symmetric, A x = b is a proof; it is the only one that is looked for in space.
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
  if (problem.dimension != 2) return nullptr;
  const auto decision = DecideHypothesis(problem);
  if (const auto* proof = std::get_if<HypothesisProof>(&decision)) {
    return MakeCertificate("h", problem, {{"y", VectorToJson(proof->y)}});
  }
  const auto& obstacle = std::get<HypothesisObstacle>(decision);
  return MakeCertificate("not-h", problem,
                         {{"v", VectorToJson(obstacle.v)}, {"value", ToString(obstacle.value)}});
}

Json LoopCertificate(const ExactProblem& problem, Outcome loop, const std::vector<Policy>& policies,
                     const Limits& limits) {
  const std::vector<std::string> names = VariableNames(problem);
  std::vector<Json> runs;  // one per sequence of steps, whichever switches led to it
  for (const PolicyClass& equal : RunPolicies(problem, policies, limits)) {
    if (equal.verdict.outcome != loop) continue;
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
  if (runs.empty()) return nullptr;
  return MakeCertificate(Name(loop).data(), problem, {{"runs", runs}});
}

}  // namespace stiction
