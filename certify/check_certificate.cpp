// SPDX-License-Identifier: Apache-2.0
// Checking certificates: structure to the letter, then the claim from the problem alone.

#include <fmt/format.h>

#include <functional>
#include <set>

#include "certify/certificate.h"
#include "certify/hypothesis.h"
#include "certify/no_solution.h"
#include "certify/properties.h"
#include "certify/safe.h"
#include "certify/verify_solution.h"
#include "corpus/json_text.h"

namespace stiction {
namespace {

struct Rejected {
  std::string path, found, expected;
};

// An object with exactly these keys, in any order.
void RequireKeys(const Json& json, const std::string& path, const std::set<std::string>& keys) {
  if (!json.is_object()) throw Rejected{path, Shown(json), "an object"};
  for (const auto& [key, value] : json.items()) {
    if (!keys.contains(key))
      throw Rejected{path + "." + key, "an unknown key", fmt::format("{}", fmt::join(keys, ", "))};
  }
  for (const std::string& key : keys) {
    if (!json.contains(key))
      throw Rejected{path, "no key '" + key + "'", fmt::format("{}", fmt::join(keys, ", "))};
  }
}

Rational ReadNumber(const Json& json, const std::string& path) {
  if (json.is_string()) {
    if (const auto value = ParseRational(json.get_ref<const std::string&>())) return *value;
  }
  throw Rejected{path, Shown(json), "an exact number as a string"};
}

std::int64_t ReadInteger(const Json& json, const std::string& path, std::int64_t least) {
  if (json.is_number_integer() && json.get<std::int64_t>() >= least) return json.get<std::int64_t>();
  throw Rejected{path, Shown(json), fmt::format("an integer >= {}", least)};
}

ExactVector ReadVector(const Json& json, const std::string& path, int size) {
  if (!json.is_array() || static_cast<int>(json.size()) != size) {
    throw Rejected{path, Shown(json), fmt::format("a list of {} numbers", size)};
  }
  ExactVector values(size);
  for (int i = 0; i < size; ++i) values[i] = ReadNumber(json[i], fmt::format("{}[{}]", path, i));
  return values;
}

void RequireEqual(const Rational& found, const Rational& expected, const std::string& path) {
  if (found != expected) throw Rejected{path, ToString(found), ToString(expected)};
}

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
  const auto violation = problem.dimension == 3 ? FindWeakViolation(problem, f) : FindLawViolation(problem, f);
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
  if (!witness["L"].is_array() || static_cast<int>(witness["L"].size()) != rows) {
    throw Rejected{"witness.L", Shown(witness["L"]), fmt::format("{} rows", rows)};
  }
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
  Rational curvature = 0;
  for (int i = 0; i < problem.rows(); ++i) {
    for (int j = 0; j < problem.rows(); ++j) curvature += x[i] * problem.A(i, j) * x[j];
  }
  RequireEqual(ReadNumber(witness["value"], "witness.value"), curvature, "witness.value");
  if (curvature >= 0) throw Rejected{"witness.value", ToString(curvature), "x'Ax < 0"};
  return Json::object();
}

Json CheckInRange(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"x"});
  const ExactVector x = ReadVector(witness["x"], "witness.x", problem.rows());
  for (int i = 0; i < problem.rows(); ++i) {
    Rational image = 0;
    for (int j = 0; j < problem.rows(); ++j) image += problem.A(i, j) * x[j];
    RequireEqual(image, problem.b[i], fmt::format("(A x)[{}]", i));
  }
  return Json::object();
}

Json CheckNotInRange(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"value", "y"});
  const ExactVector y = ReadVector(witness["y"], "witness.y", problem.rows());
  Rational product = 0;
  for (int j = 0; j < problem.rows(); ++j) {
    Rational entry = 0;
    for (int i = 0; i < problem.rows(); ++i) entry += y[i] * problem.A(i, j);
    RequireEqual(entry, 0, fmt::format("(y'A)[{}]", j));
    product += y[j] * problem.b[j];
  }
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
  Rational product = 0;
  for (int i = 0; i < problem.rows(); ++i) {
    Rational image = 0;
    for (int j = 0; j < problem.rows(); ++j) image += problem.A(i, j) * v[j];
    RequireEqual(image, 0, fmt::format("(A v)[{}]", i));
    product += problem.b[i] * v[i];
  }
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
  if (!pivots.is_array()) throw Rejected{path + ".pivots", Shown(pivots), "a list"};
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

Json CheckLoop(const ExactProblem& problem, const Json& witness, Outcome loop) {
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

Json CheckNone(const ExactProblem& problem, const Json& witness) {
  if (problem.dimension != 2) throw Rejected{"problem.dimension", "3", "2: this claim is checked in the plane"};
  const NoSolutionCheck check = CheckNoSolution(problem, witness);
  if (check.fault) throw Rejected{check.fault->path, check.fault->found, check.fault->expected};
  return check.facts;
}

// Claims of safe.h.
template <SafetyCheck (*check)(const ExactProblem&, const Json&)>
Json CheckSafety(const ExactProblem& problem, const Json& witness) {
  const SafetyCheck result = check(problem, witness);
  if (result.fault) throw Rejected{result.fault->path, result.fault->found, result.fault->expected};
  return result.facts;
}

using Checker = std::function<Json(const ExactProblem&, const Json&)>;

const std::map<std::string, Checker>& Checkers() {
  static const std::map<std::string, Checker> checkers = {
      {"solution-exists", CheckSolution},
      {"coulomb-solution", CheckCoulomb},
      {"no-solution", CheckNone},
      {"safe", CheckSafety<CheckSafe>},
      {"unsafe", CheckSafety<CheckUnsafe>},
      {"symmetric", CheckSymmetric},
      {"not-symmetric", CheckNotSymmetric},
      {"psd", CheckSemidefinite},
      {"not-psd", CheckNotSemidefinite},
      {"in-range", CheckInRange},
      {"not-in-range", CheckNotInRange},
      {"h", CheckHypothesis},
      {"not-h", CheckNotHypothesis},
      {"cycle",
       [](const auto& problem, const Json& witness) { return CheckLoop(problem, witness, Outcome::kCycle); }},
      {"stall",
       [](const auto& problem, const Json& witness) { return CheckLoop(problem, witness, Outcome::kStall); }},
  };
  return checkers;
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
    const auto checker = Checkers().find(report.claim);
    if (checker == Checkers().end()) {
      std::vector<std::string> claims;
      for (const auto& [claim, check] : Checkers()) claims.push_back(claim);
      throw Rejected{"claim", Shown(certificate["claim"]), fmt::format("one of {}", fmt::join(claims, ", "))};
    }
    const ExactProblem problem = ProblemFromJson(certificate["problem"], source, "problem", true);
    report.facts = checker->second(problem, certificate["witness"]);
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
