// SPDX-License-Identifier: Apache-2.0
// Checking certificates: structure to the letter, then the claim from the problem alone.

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <map>
#include <set>

#include "certify/claims/certificate.h"
#include "certify/claims/condition.h"
#include "certify/claims/no_solution.h"
#include "certify/claims/safe.h"
#include "certify/claims/witness.h"
#include "certify/exact/exact.h"
#include "certify/exact/hypothesis.h"
#include "certify/exact/properties.h"
#include "certify/exact/verify_solution.h"
#include "corpus/digest.h"
#include "corpus/exact_number.h"

namespace stiction {
namespace {

// ---- Claims about a solution and about A and b -----------------------------------------------

// A x and x'Ax are not too dear.
void RequireProduct(const ExactProblem& problem, const ExactVector& x) {
  Cost(ProductOperations(problem, 1)).LongestRow(problem).Vector(x, 2);
}

// witness.f, once witness.a is A f + b.
ExactVector ReadForces(const ExactProblem& problem, const Json& witness) {
  const ExactVector f = ReadVector(witness["f"], "witness.f", problem.rows());
  const ExactVector a = ReadVector(witness["a"], "witness.a", problem.rows());
  RequireProduct(problem, f);
  const ExactVector answer = Accelerations(problem, f);
  for (int i = 0; i < problem.rows(); ++i) RequireEqual(a[i], answer[i], fmt::format("witness.a[{}]", i));
  return f;
}

void RequireSolution(const ExactProblem& problem, const Json& witness) {
  const ExactVector f = ReadForces(problem, witness);
  const auto violation = problem.dimension == 3 ? FindWeakViolation(problem, f) : FindViolation(problem, f);
  if (violation) throw Rejected{"witness.f", *violation, "a solution"};
}

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
  if (const auto violation = FindCoulombViolation(problem, f, bound)) {
    throw Rejected{"witness.f", *violation, "a solution within the bound"};
  }
  return {{"bound", ToString(bound)}};
}

void RequireSymmetric(const ExactProblem& problem) {
  if (const auto pair = FindAsymmetry(problem.A)) {
    throw Rejected{fmt::format("problem.A[{}][{}]", pair->first, pair->second), "an entry unlike its mirror",
                   "A = A'"};
  }
}

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

// D, once A = L diag(D) L' with D >= 0, which is symmetric. One column of L after the other is taken away, so
// that no number grows beyond the minors of A, whatever L and D are.
ExactVector RequireFactors(const ExactProblem& problem, const Json& witness) {
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
  RequireSymmetric(problem);
  Cost(EliminationOperations(problem, 1)).AllRows(problem);
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

Json CheckSemidefinite(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"D", "L"});
  RequireFactors(problem, witness);
  return Json::object();
}

void RequireDefinite(const ExactProblem& problem, const Json& witness) {
  const ExactVector D = RequireFactors(problem, witness);
  for (int i = 0; i < D.size(); ++i) {
    if (D[i] <= 0) throw Rejected{fmt::format("witness.D[{}]", i), ToString(D[i]), "a number > 0"};
  }
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
  RequireProduct(problem, x);
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
  RequireKeys(witness, "witness", {"x"});
  const ExactVector x = ReadVector(witness["x"], "witness.x", problem.rows());
  RequireProduct(problem, x);
  const ExactVector image = problem.A * x;
  for (int i = 0; i < problem.rows(); ++i) RequireEqual(image[i], problem.b[i], fmt::format("(A x)[{}]", i));
  return Json::object();
}

Json CheckNotInRange(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"value", "y"});
  const ExactVector y = ReadVector(witness["y"], "witness.y", problem.rows());
  RequireProduct(problem, y);
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

void RequireHypothesis(const ExactProblem& problem, const Json& witness) {
  RequireCones(problem);
  const ExactVector y = ReadVector(witness["y"], "witness.y", problem.rows());
  RequireProduct(problem, y);
  if (const auto violation = FindDualConeViolation(problem, DualRest(problem, y))) {
    throw Rejected{"b - A'y", *violation, "a vector of the dual cone"};
  }
}

Json CheckHypothesis(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"y"});
  RequireHypothesis(problem, witness);
  return Json::object();
}

// The assumptions of theorem 1 of existence.md, whose conclusion is that a solution exists.
Json CheckExists(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"D", "L", "y"});
  RequireFactors(problem, witness);
  RequireHypothesis(problem, witness);
  return Json::object();
}

Json CheckNotHypothesis(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"v", "value"});
  RequireCones(problem);
  const ExactVector v = ReadVector(witness["v"], "witness.v", problem.rows());
  RequireProduct(problem, v);
  const ExactVector image = problem.A * v;
  for (int i = 0; i < problem.rows(); ++i) RequireEqual(image[i], 0, fmt::format("(A v)[{}]", i));
  const Rational product = problem.b.dot(v);
  if (const auto violation = FindConeViolation(problem, v)) throw Rejected{"witness.v", *violation, "v in K"};
  RequireEqual(ReadNumber(witness["value"], "witness.value"), product, "witness.value");
  if (product >= 0) throw Rejected{"witness.value", ToString(product), "b'v < 0"};
  return Json::object();
}

// ---- Cycles ----------------------------------------------------------------------------------

Policy ReadPolicy(const Json& json, const std::string& path) {
  if (!json.is_string()) throw Rejected{path, Shown(json), "a policy"};
  const std::string name = json.get<std::string>();
  try {
    const Policy policy = ParsePolicy(name);
    if (PolicyName(policy) != name) throw Rejected{path, Shown(json), PolicyName(policy)};
    if (policy.slip != Slip{}) throw Rejected{path, Shown(json), "a policy of the planar grid"};
    return policy;
  } catch (const std::invalid_argument& error) {
    throw Rejected{path, Shown(json), Shortened(error.what(), 200)};
  }
}

// nlohmann::json, unlike ordered_json, compares objects whatever the order of their keys.
void RequireSame(const Json& found, const Json& expected, const std::string& path) {
  const bool same_type = !expected.is_number_integer() || found.is_number_integer();
  if (same_type && nlohmann::json(found) == nlohmann::json(expected)) return;
  throw Rejected{path, Shown(found), Shown(expected)};
}

// What is stated of the steps that a run took, as far as either goes.
void CompareSteps(const ExactRun& run, const Json& pivots, const std::string& path,
                  const std::vector<std::string>& names) {
  for (std::size_t k = 0; k < std::min(pivots.size(), run.trace.pivots.size()); ++k) {
    const Pivot<Rational>& pivot = run.trace.pivots[k];
    const std::string where = ElementPath(path, k);
    Json found = pivots[k];
    RequireKeys(found, where, {"drive", "driven", "from", "goal", "limiting", "step", "to"});
    RequireEqual(ReadNumber(found["step"], where + ".step"), pivot.s, where + ".step");
    ReadInteger(found["drive"], where + ".drive", 1);
    found["step"] = ToString(pivot.s);  // any spelling of the same number
    RequireSame(found, PivotToJson(pivot, names), where);
  }
}

// The run of the algorithm, as long as its steps are those stated: in rounds, lest a long list of false steps
// take as long a run.
ExactRun RunAsStated(const ExactProblem& problem, const Policy& policy, const Json& pivots,
                     const std::string& path, const std::vector<std::string>& names) {
  const auto stated = static_cast<std::int64_t>(pivots.size());
  for (std::int64_t most = 64;; most *= 16) {
    Limits limits;
    limits.pivots = std::min(most, stated + 1);
    ExactRun run = RunExact(problem, {policy, {}, limits});
    CompareSteps(run, pivots, path, names);
    if (run.verdict.outcome != Outcome::kLimit || limits.pivots > stated) return run;
  }
}

void CompareState(const ExactRun& run, Json state, const std::string& path,
                  const std::vector<std::string>& names) {
  const Json expected = CycleStateToJson(run, names);
  std::set<std::string> keys;
  for (const auto& [key, value] : expected.items()) keys.insert(key);
  RequireKeys(state, path, keys);
  const ExactVector f = ReadVector(state["f"], path + ".f", static_cast<int>(names.size()));
  for (int i = 0; i < f.size(); ++i) RequireEqual(f[i], run.state.f[i], ElementPath(path + ".f", i));
  keys.erase("f");
  for (const std::string& key : keys) RequireSame(state[key], expected[key], path + "." + key);
}

// The run that the certificate describes, against the run that the algorithm makes, which is returned.
ExactRun RequireCycle(const ExactProblem& problem, const Policy& policy, const Json& stated,
                      const std::string& path, const std::vector<std::string>& names) {
  ExactRun run = RunAsStated(problem, policy, stated["pivots"], path + ".pivots", names);
  if (run.verdict.outcome != Outcome::kCycle) {
    throw Rejected{path, fmt::format("outcome {} under {}", Name(run.verdict.outcome), PolicyName(policy)),
                   "cycle"};
  }
  RequireSame(stated["pivots"].size(), run.trace.pivots.size(), path + ".pivots: number");
  RequireSame(ReadInteger(stated["start"], path + ".start", 0), run.verdict.start, path + ".start");
  RequireSame(ReadInteger(stated["period"], path + ".period", 1), run.verdict.period, path + ".period");
  CompareState(run, stated["state"], path + ".state", names);
  return run;
}

// Tells runs apart, however a certificate writes their numbers.
std::string StepsAsText(const ExactRun& run, const std::vector<std::string>& names) {
  Json steps = Json::array({CycleStateToJson(run, names)});
  for (const Pivot<Rational>& pivot : run.trace.pivots) steps.push_back(PivotToJson(pivot, names));
  return steps.dump();
}

// The different values of a key, in order.
Json NumbersOf(const Json& runs, const char* key) {
  std::set<std::int64_t> numbers;
  for (const Json& run : runs) numbers.insert(run[key].get<std::int64_t>());
  return numbers;
}

std::size_t LengthOf(const Json& run, const char* key) {
  return run.is_object() && run.contains(key) && run[key].is_array() ? run[key].size() : 0;
}

// As many steps as are stated of every policy, each by an elimination.
void RequireFewSteps(const ExactProblem& problem, const Json& runs) {
  double steps = 0;
  for (const Json& run : runs)
    steps += static_cast<double>(LengthOf(run, "policies")) * static_cast<double>(LengthOf(run, "pivots") + 1);
  Cost(ReducedOperations(problem, steps)).AllRows(problem);
}

Json CheckRuns(const ExactProblem& problem, const Json& witness) {
  if (problem.dimension != 2) throw Rejected{"problem.dimension", "3", "2: this claim is checked in the plane"};
  const Json& runs = witness["runs"];
  if (!runs.is_array() || runs.empty()) throw Rejected{"witness.runs", Shown(runs), "at least one run"};
  RequireFewSteps(problem, runs);
  const std::vector<std::string> names = VariableNames(problem);
  std::set<std::string> policies, different;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const std::string path = ElementPath("witness.runs", k);
    RequireKeys(runs[k], path, {"period", "pivots", "policies", "start", "state"});
    RequireList(runs[k]["pivots"], path + ".pivots");
    const Json& named = runs[k]["policies"];
    if (!named.is_array() || named.empty())
      throw Rejected{path + ".policies", Shown(named), "at least one policy"};
    for (std::size_t p = 0; p < named.size(); ++p) {
      const std::string where = ElementPath(path + ".policies", p);
      const Policy policy = ReadPolicy(named[p], where);
      if (!policies.insert(PolicyName(policy)).second)
        throw Rejected{where, Shown(named[p]), "each policy once"};
      const ExactRun run = RequireCycle(problem, policy, runs[k], path, names);
      if (p == 0 && !different.insert(StepsAsText(run, names)).second)
        throw Rejected{path, "a run that stands before", "different runs"};
    }
  }
  return {{"policies", policies.size()},
          {"runs", runs.size()},
          {"start", NumbersOf(runs, "start")},
          {"period", NumbersOf(runs, "period")}};
}

Json CheckCycle(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"runs"});
  return CheckRuns(problem, witness);
}

Json CheckCounterexample(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"D", "L", "a", "f", "runs"});
  RequireDefinite(problem, witness);
  RequireSolution(problem, witness);
  return CheckRuns(problem, witness);
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
      {"definite", CheckDefinite},
      {"not-definite", CheckNotDefinite},
      {"in-range", CheckInRange},
      {"not-in-range", CheckNotInRange},
      {"h", CheckHypothesis},
      {"not-h", CheckNotHypothesis},
      {"exists", CheckExists},
      {"cycle", CheckCycle},
      {"counterexample", CheckCounterexample},
  };
  return checks;
}

// The check of the claim, which the report names from now on.
WitnessCheck& ReadClaim(const Json& certificate, CheckReport& report) {
  RequireKeys(certificate, "certificate", {"claim", "format", "problem", "version", "witness"});
  if (certificate["format"] != "stiction-certificate") {
    throw Rejected{"format", Shown(certificate["format"]), "\"stiction-certificate\""};
  }
  if (!certificate["version"].is_number_integer() || certificate["version"] != 1) {
    throw Rejected{"version", Shown(certificate["version"]), "1"};
  }
  if (certificate["claim"].is_string()) report.claim = certificate["claim"].get<std::string>();
  const auto check = Checks().find(report.claim);
  if (check != Checks().end()) return *check->second;
  std::vector<std::string> claims;
  for (const auto& known : Checks()) claims.push_back(known.first);
  throw Rejected{"claim", Shown(certificate["claim"]), fmt::format("one of {}", fmt::join(claims, ", "))};
}

// Before a matrix is made of them. What is no list of contacts is refused where it is read.
void RequireFewRows(const Json& problem) {
  if (!problem.is_object() || !problem.contains("contacts") || !problem.contains("dimension")) return;
  const std::size_t with_friction = problem["dimension"] == 3 ? 3 : 2;
  std::size_t rows = 0;
  for (const Json& contact : problem["contacts"])
    rows += contact.is_object() && contact.contains("mu") ? with_friction : 1;
  if (rows <= kMostRowsOfCertificate) return;
  throw Rejected{"problem.contacts", fmt::format("contacts of {} rows", rows),
                 fmt::format("at most {}", kMostRowsOfCertificate)};
}

// Digits of numerator and denominator of what a text stands for, its exponent written out; 0 if it is no
// number, or one that is refused where it is read.
std::int64_t DigitsOf(std::string_view text) {
  std::int64_t digits = 0, places = 0, exponent = 0;
  bool in_fraction = false;
  if (text.size() > kMostCharactersOfNumber) return 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c >= '0' && c <= '9') {
      digits += digits > 0 || c != '0';
      places += in_fraction;
    } else if (c == '/') {
      return digits + DigitsOf(text.substr(k + 1));
    } else if (c == '.') {
      in_fraction = true;
    } else if (c == 'e' || c == 'E') {
      const auto sign = text.substr(k + 1).starts_with('+') ? 2 : 1;
      const auto end = std::from_chars(text.data() + k + sign, text.data() + text.size(), exponent);
      if (end.ec != std::errc() || std::abs(exponent) > 10000) return 0;
      break;
    } else if (c != '-') {
      return 0;
    }
  }
  return digits == 0 ? 0 : digits + std::abs(exponent - places);
}

std::int64_t AllDigits(const Json& json) {
  if (const auto* text = json.get_ptr<const std::string*>()) return DigitsOf(*text);
  std::int64_t digits = 0;
  if (json.is_structured())
    for (const Json& item : json) digits += AllDigits(item);
  return digits;
}

// Before any is read.
void RequireFewDigits(const Json& certificate) {
  const std::int64_t digits = AllDigits(certificate["problem"]) + AllDigits(certificate["witness"]);
  if (digits <= kMostDigitsOfCertificate) return;
  throw Rejected{"certificate", fmt::format("numbers of {} digits", digits),
                 fmt::format("at most {} in all", kMostDigitsOfCertificate)};
}

std::string ReasonOf(const Rejected& rejected) {
  return rejected.path + ": found " + rejected.found + ", expected " + rejected.expected;
}

}  // namespace

CheckReport CheckCertificate(const Json& certificate, const std::string& source, const std::string& digest) {
  CheckReport report;
  try {
    WitnessCheck& check = ReadClaim(certificate, report);
    RequireFewRows(certificate["problem"]);
    RequireFewDigits(certificate);
    const ExactProblem problem = ProblemFromJson(certificate["problem"], source, "problem", true);
    report.digest = ProblemDigest(problem);
    if (!digest.empty() && report.digest != digest) {
      throw Rejected{"problem", report.digest, digest + ", the problem that was asked for"};
    }
    report.facts = check(problem, certificate["witness"]);
    report.accepted = true;
  } catch (const TooDear& rejected) {
    report.is_too_dear = true;
    report.reason = ReasonOf(rejected);
  } catch (const Rejected& rejected) {
    report.reason = ReasonOf(rejected);
  } catch (const InputError& error) {
    report.reason = error.what();
  }
  return report;
}

std::vector<Policy> CertifiedPolicies(const Json& certificate) {
  std::vector<Policy> policies;
  for (const Json& run : certificate["witness"]["runs"]) {
    for (const Json& name : run["policies"]) policies.push_back(ParsePolicy(name.get<std::string>()));
  }
  return policies;
}

}  // namespace stiction
