// SPDX-License-Identifier: Apache-2.0
// Checking certificates: structure to the letter, then the claim from the problem alone.

#include <fmt/format.h>

#include <map>
#include <set>

#include "certify/certificate.h"
#include "certify/condition.h"
#include "certify/exact.h"
#include "certify/hypothesis.h"
#include "certify/no_solution.h"
#include "certify/properties.h"
#include "certify/safe.h"
#include "certify/verify_solution.h"
#include "certify/witness.h"

namespace stiction {
namespace {

// ---- Claims about a solution and about A and b -----------------------------------------------

// witness.f, once witness.a is A f + b.
ExactVector ReadForces(const ExactProblem& problem, const Json& witness) {
  const ExactVector f = ReadVector(witness["f"], "witness.f", problem.rows());
  const ExactVector a = ReadVector(witness["a"], "witness.a", problem.rows());
  const ExactVector answer = Accelerations(problem, f);
  for (int i = 0; i < problem.rows(); ++i) RequireEqual(a[i], answer[i], fmt::format("witness.a[{}]", i));
  return f;
}

Json CheckSolution(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"a", "f"});
  const ExactVector f = ReadForces(problem, witness);
  const auto violation = problem.dimension == 3 ? FindWeakViolation(problem, f) : FindViolation(problem, f);
  if (violation) throw Rejected{"witness.f", *violation, "a solution"};
  return Json::object();
}

Json CheckCoulomb(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"a", "bound", "f"});
  if (problem.dimension != 3) throw Rejected{"problem.dimension", "2", "3: this claim is checked in space"};
  const Rational bound = ReadNumber(witness["bound"], "witness.bound");
  if (bound <= 0 || bound > 1) throw Rejected{"witness.bound", ToString(bound), "0 < bound <= 1"};
  const ExactVector f = ReadForces(problem, witness);
  if (const auto violation = FindCoulombViolation(problem, f, bound)) {
    throw Rejected{"witness.f", *violation, "a solution within the bound"};
  }
  return {{"bound", ToString(bound)}};
}

Json CheckSymmetric(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {});
  if (const auto pair = FindAsymmetry(problem.A)) {
    throw Rejected{fmt::format("problem.A[{}][{}]", pair->first, pair->second), "an entry unlike its mirror",
                   "A = A'"};
  }
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

Json CheckSemidefinite(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"D", "L"});
  const int rows = problem.rows();
  const ExactVector D = ReadVector(witness["D"], "witness.D", rows);
  RequireList(witness["L"], "witness.L", static_cast<std::size_t>(rows), "rows");
  ExactMatrix L(rows, rows);
  for (int i = 0; i < rows; ++i) {
    L.row(i) = ReadVector(witness["L"][i], fmt::format("witness.L[{}]", i), rows).transpose();
    if (D[i] < 0) throw Rejected{fmt::format("witness.D[{}]", i), ToString(D[i]), "a number >= 0"};
    for (int j = i; j < rows; ++j)
      RequireEqual(L(i, j), i == j ? 1 : 0, fmt::format("witness.L[{}][{}]", i, j));
  }
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < rows; ++j) {
      Rational entry = 0;
      for (int k = 0; k <= std::min(i, j); ++k) entry += L(i, k) * D[k] * L(j, k);
      RequireEqual(problem.A(i, j), entry, fmt::format("problem.A[{}][{}]", i, j));
    }
  }
  return Json::object();
}

Json CheckNotSemidefinite(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"value", "x"});
  const ExactVector x = ReadVector(witness["x"], "witness.x", problem.rows());
  const Rational curvature = x.dot(problem.A * x);
  RequireEqual(ReadNumber(witness["value"], "witness.value"), curvature, "witness.value");
  if (curvature >= 0) throw Rejected{"witness.value", ToString(curvature), "x'Ax < 0"};
  return Json::object();
}

Json CheckInRange(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"x"});
  const ExactVector x = ReadVector(witness["x"], "witness.x", problem.rows());
  const ExactVector image = problem.A * x;
  for (int i = 0; i < problem.rows(); ++i) RequireEqual(image[i], problem.b[i], fmt::format("(A x)[{}]", i));
  return Json::object();
}

Json CheckNotInRange(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"value", "y"});
  const ExactVector y = ReadVector(witness["y"], "witness.y", problem.rows());
  const ExactVector image = problem.A.transpose() * y;
  for (int j = 0; j < problem.rows(); ++j) RequireEqual(image[j], 0, fmt::format("(y'A)[{}]", j));
  const Rational product = y.dot(problem.b);
  RequireEqual(ReadNumber(witness["value"], "witness.value"), product, "witness.value");
  if (product == 0) throw Rejected{"witness.value", "0", "y'b /= 0"};
  return Json::object();
}

void RequireCones(const ExactProblem& problem) {
  if (HasSlidingContact(problem)) {
    throw Rejected{"problem.contacts", "a sliding contact", "bilateral, frictionless and static ones"};
  }
}

Json CheckHypothesis(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"y"});
  RequireCones(problem);
  const ExactVector y = ReadVector(witness["y"], "witness.y", problem.rows());
  if (const auto violation = FindDualConeViolation(problem, DualRest(problem, y))) {
    throw Rejected{"b - A'y", *violation, "a vector of the dual cone"};
  }
  return Json::object();
}

Json CheckNotHypothesis(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"v", "value"});
  RequireCones(problem);
  const ExactVector v = ReadVector(witness["v"], "witness.v", problem.rows());
  const ExactVector image = problem.A * v;
  for (int i = 0; i < problem.rows(); ++i) RequireEqual(image[i], 0, fmt::format("(A v)[{}]", i));
  const Rational product = problem.b.dot(v);
  if (const auto violation = FindConeViolation(problem, v)) throw Rejected{"witness.v", *violation, "v in K"};
  RequireEqual(ReadNumber(witness["value"], "witness.value"), product, "witness.value");
  if (product >= 0) throw Rejected{"witness.value", ToString(product), "b'v < 0"};
  return Json::object();
}

// ---- Loops -----------------------------------------------------------------------------------

Policy ReadPolicy(const Json& json, const std::string& path) {
  if (!json.is_string()) throw Rejected{path, Shown(json), "a policy"};
  const std::string name = json.get<std::string>();
  try {
    const Policy policy = ParsePolicy(name);
    if (PolicyName(policy) != name) throw Rejected{path, Shown(json), PolicyName(policy)};
    if (policy.slip != Slip{}) throw Rejected{path, Shown(json), "a policy of the planar grid"};
    return policy;
  } catch (const std::invalid_argument& error) {
    throw Rejected{path, Shown(json), error.what()};
  }
}

// The run that the certificate describes, against the run that the algorithm makes.
void CompareRun(const ExactRun& run, const Json& described, const std::string& path, Outcome loop,
                const std::vector<std::string>& names) {
  if (run.verdict.outcome != loop) {
    throw Rejected{path, fmt::format("outcome {} under {}", Name(run.verdict.outcome), PolicyName(run.policy)),
                   std::string(Name(loop))};
  }
  const auto compare = [&path](const Json& found, const Json& expected, const std::string& where) {
    const bool same_type = !expected.is_number_integer() || found.is_number_integer();
    // nlohmann::json, unlike ordered_json, compares objects whatever the order of their keys.
    if (!same_type || nlohmann::json(found) != nlohmann::json(expected)) {
      throw Rejected{path + where, Shown(found), Shown(expected)};
    }
  };
  const Json& pivots = described["pivots"];
  RequireList(pivots, path + ".pivots");
  for (std::size_t k = 0; k < std::min(pivots.size(), run.trace.pivots.size()); ++k) {
    const std::string where = fmt::format("{}.pivots[{}]", path, k);
    Json found = pivots[k];
    RequireKeys(found, where, {"drive", "driven", "from", "goal", "limiting", "step", "to"});
    RequireEqual(ReadNumber(found["step"], where + ".step"), run.trace.pivots[k].s, where + ".step");
    ReadInteger(found["drive"], where + ".drive", 1);
    found["step"] = ToString(run.trace.pivots[k].s);  // any spelling of the same number
    compare(found, PivotToJson(run.trace.pivots[k], names), fmt::format(".pivots[{}]", k));
  }
  compare(pivots.size(), run.trace.pivots.size(), ".pivots: number");
  compare(ReadInteger(described["start"], path + ".start", 0), run.verdict.start, ".start");
  compare(ReadInteger(described["period"], path + ".period", 1), run.verdict.period, ".period");
  const Json expected = LoopStateToJson(run, names);
  std::set<std::string> keys;
  for (const auto& [key, value] : expected.items()) keys.insert(key);
  Json state = described["state"];
  RequireKeys(state, path + ".state", keys);
  const ExactVector f = ReadVector(state["f"], path + ".state.f", static_cast<int>(names.size()));
  for (int i = 0; i < f.size(); ++i) RequireEqual(f[i], run.state.f[i], fmt::format("{}.state.f[{}]", path, i));
  for (const std::string& key : keys) {
    if (key == "f") continue;
    compare(state[key], expected[key], ".state." + key);
  }
}

// Tells runs apart, however a certificate writes their numbers.
std::string StepsAsText(const ExactRun& run, const std::vector<std::string>& names) {
  Json steps = Json::array({LoopStateToJson(run, names)});
  for (const Pivot<Rational>& pivot : run.trace.pivots) steps.push_back(PivotToJson(pivot, names));
  return steps.dump();
}

template <Outcome loop>
Json CheckLoop(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"runs"});
  if (problem.dimension != 2) throw Rejected{"problem.dimension", "3", "2: this claim is checked in the plane"};
  const Json& runs = witness["runs"];
  if (!runs.is_array() || runs.empty()) throw Rejected{"witness.runs", Shown(runs), "at least one run"};
  const std::vector<std::string> names = VariableNames(problem);
  std::set<std::string> policies;
  std::set<std::string> described;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const std::string path = fmt::format("witness.runs[{}]", k);
    RequireKeys(runs[k], path, {"period", "pivots", "policies", "start", "state"});
    const Json& named = runs[k]["policies"];
    if (!named.is_array() || named.empty())
      throw Rejected{path + ".policies", Shown(named), "at least one policy"};
    // A run of as many steps as the certificate describes is enough to confirm or refute it.
    Limits limits;
    limits.pivots = static_cast<std::int64_t>(runs[k]["pivots"].size()) + 1;
    for (std::size_t p = 0; p < named.size(); ++p) {
      const std::string where = fmt::format("{}.policies[{}]", path, p);
      const Policy policy = ReadPolicy(named[p], where);
      if (!policies.insert(PolicyName(policy)).second)
        throw Rejected{where, Shown(named[p]), "each policy once"};
      const ExactRun run = RunExact(problem, {policy, {}, limits});
      CompareRun(run, runs[k], path, loop, names);
      if (p == 0 && !described.insert(StepsAsText(run, names)).second) {
        throw Rejected{path, "a run that stands before", "different runs"};
      }
    }
  }
  return {{"policies", policies.size()},
          {"runs", runs.size()},
          {"start", runs[0]["start"]},
          {"period", runs[0]["period"]}};
}

const std::map<std::string, WitnessCheck*>& Checks() {
  static const std::map<std::string, WitnessCheck*> checks = {
      {"solution-exists", CheckSolution},
      {"coulomb-solution", CheckCoulomb},
      {"no-solution", CheckNoSolution},
      {"safe", CheckSafe},
      {"safe-by-condition", CheckSafeByCondition},
      {"unsafe", CheckUnsafe},
      {"symmetric", CheckSymmetric},
      {"not-symmetric", CheckNotSymmetric},
      {"psd", CheckSemidefinite},
      {"not-psd", CheckNotSemidefinite},
      {"in-range", CheckInRange},
      {"not-in-range", CheckNotInRange},
      {"h", CheckHypothesis},
      {"not-h", CheckNotHypothesis},
      {"cycle", CheckLoop<Outcome::kCycle>},
      {"stall", CheckLoop<Outcome::kStall>},
  };
  return checks;
}

}  // namespace

CheckReport CheckCertificate(const Json& certificate, const std::string& source) {
  CheckReport report;
  try {
    RequireKeys(certificate, "certificate", {"claim", "format", "problem", "version", "witness"});
    if (certificate["format"] != "stiction-certificate") {
      throw Rejected{"format", Shown(certificate["format"]), "\"stiction-certificate\""};
    }
    if (!certificate["version"].is_number_integer() || certificate["version"] != 1) {
      throw Rejected{"version", Shown(certificate["version"]), "1"};
    }
    if (certificate["claim"].is_string()) report.claim = certificate["claim"].get<std::string>();
    const auto check = Checks().find(report.claim);
    if (check == Checks().end()) {
      std::vector<std::string> claims;
      for (const auto& known : Checks()) claims.push_back(known.first);
      throw Rejected{"claim", Shown(certificate["claim"]), fmt::format("one of {}", fmt::join(claims, ", "))};
    }
    const ExactProblem problem = ProblemFromJson(certificate["problem"], source, "problem", true);
    report.facts = check->second(problem, certificate["witness"]);
    report.accepted = true;
  } catch (const Rejected& rejected) {
    report.reason = rejected.path + ": found " + rejected.found + ", expected " + rejected.expected;
  } catch (const InputError& error) {
    report.reason = error.what();
  }
  return report;
}

std::vector<Policy> CertifiedPolicies(const Json& loop_certificate) {
  std::vector<Policy> policies;
  for (const Json& run : loop_certificate["witness"]["runs"]) {
    for (const Json& name : run["policies"]) policies.push_back(ParsePolicy(name.get<std::string>()));
  }
  return policies;
}

}  // namespace stiction
