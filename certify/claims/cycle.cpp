// SPDX-License-Identifier: Apache-2.0
// Runs of the published algorithm that repeat a state, or in space stay in a box for ever: `cycle`; that end in
// a step which nothing limits: `ray`, in space; that repeat no state: `endless`, in space; and
// `counterexample`, where A is definite and there is a solution besides.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "certify/claims/certificate.h"
#include "certify/claims/claim.h"
#include "certify/claims/existence.h"
#include "certify/exact/exact.h"
#include "certify/exact/loops_in_space.h"
#include "certify/exact/properties.h"
#include "corpus/json.h"
#include "solver/published/published_space.h"

namespace stiction {

// ---- Making ------------------------------------------------------------------------------------

namespace {

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

namespace {

Json LoopToJson(const Policy& policy, const LoopInSpace& loop) {
  Json witness = {{"policy", PolicyName(policy)},
                  {"kind", loop.punctured ? "punctured"
                           : loop.IsBox() ? "box"
                                          : "states"},
                  {"bits", loop.bits},
                  {"start", loop.start},
                  {"period", loop.period},
                  {"word", loop.word}};
  if (loop.IsBox()) {
    witness["charts"] = loop.charts;
    witness["centre"] = VectorToJson(loop.centre);
    witness["radii"] = VectorToJson(loop.radii);
  }
  return witness;
}

Json RayToJson(const Policy& policy, const RayInSpace& ray) {
  return {{"policy", PolicyName(policy)}, {"bits", ray.bits}, {"word", ray.word}};
}

// Of the first of the policies of which it is proved.
template <class Prove, class ToJson>
Json CertificateInSpace(const char* claim, const ExactProblem& problem, const std::vector<Policy>& policies,
                        const Limits& limits, Prove prove, ToJson to_json) {
  for (const Policy& policy : policies) {
    if (!PublishedReadsInSpace(policy)) continue;
    if (const auto proof = prove(problem, policy, limits))
      return MakeCertificate(claim, problem, to_json(policy, *proof));
  }
  return nullptr;
}

}  // namespace

Json CycleCertificate(const ExactProblem& problem, const std::vector<Policy>& policies, const Limits& limits) {
  if (problem.dimension == 3)
    return CertificateInSpace("cycle", problem, policies, limits, ProveLoopInSpace, LoopToJson);
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

// ---- Checking ----------------------------------------------------------------------------------

namespace {

Policy ReadPolicy(const Json& json, const std::string& path, int dimension = 2) {
  if (!json.is_string()) throw Rejected{path, Shown(json), "a policy"};
  const std::string name = json.get<std::string>();
  try {
    const Policy policy = ParsePolicy(name);
    if (PolicyName(policy) != name) throw Rejected{path, Shown(json), PolicyName(policy)};
    if (dimension == 2 && policy.slip != Slip{})
      throw Rejected{path, Shown(json), "a policy of the planar grid"};
    if (dimension == 3 && !PublishedReadsInSpace(policy))
      throw Rejected{path, Shown(json), "a policy in space"};
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
  if (problem.dimension != 2) throw Rejected{"problem.dimension", "3", "2: runs are checked in the plane"};
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

// ---- A run in space ----

constexpr int kLeastBits = 64, kMostBits = 4096;

int ReadBits(const Json& witness) {
  const std::int64_t bits = ReadInteger(witness["bits"], "witness.bits", kLeastBits);
  if (bits > kMostBits)
    throw Rejected{"witness.bits", Shown(witness["bits"]), fmt::format("at most {}", kMostBits)};
  return static_cast<int>(bits);
}

std::vector<std::string> ReadWord(const Json& witness) {
  RequireList(witness["word"], "witness.word");
  std::vector<std::string> word;
  for (const Json& step : witness["word"]) {
    if (!step.is_string()) throw Rejected{"witness.word", Shown(step), "a step as a text"};
    word.push_back(step.get<std::string>());
  }
  return word;
}

LoopInSpace ReadLoop(const ExactProblem& problem, const Json& witness) {
  const bool punctured = witness.contains("kind") && witness["kind"] == "punctured";
  const bool box = punctured || (witness.contains("kind") && witness["kind"] == "box");
  std::set<std::string> keys = {"policy", "kind", "bits", "start", "period", "word"};
  if (box) keys.insert({"charts", "centre", "radii"});
  RequireKeys(witness, "witness", keys);
  if (!box && witness["kind"] != "states")
    throw Rejected{"witness.kind", Shown(witness["kind"]), "states, box or punctured"};
  LoopInSpace loop;
  loop.punctured = punctured;
  loop.bits = ReadBits(witness);
  loop.start = ReadInteger(witness["start"], "witness.start", 0);
  loop.period = ReadInteger(witness["period"], "witness.period", 1);
  loop.word = ReadWord(witness);
  if (!box) return loop;
  RequireList(witness["charts"], "witness.charts");
  const std::size_t size = witness["charts"].size();
  if (size == 0 || size > 3 * problem.contacts.size())
    throw Rejected{"witness.charts", std::to_string(size), "as many as a state remembers"};
  for (const Json& chart : witness["charts"])
    loop.charts.push_back(
        static_cast<int>(std::min<std::int64_t>(ReadInteger(chart, "witness.charts", -1), 2)));
  loop.centre = ReadVector(witness["centre"], "witness.centre", static_cast<int>(size));
  loop.radii = ReadVector(witness["radii"], "witness.radii", static_cast<int>(size));
  return loop;
}

void RequireRunInSpace(const ExactProblem& problem) {
  if (problem.dimension != 3) throw Rejected{"problem.dimension", "2", "3: in the plane runs are stated"};
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const ContactKind kind = problem.contacts[i].kind;
    if (kind != ContactKind::kFrictionless && kind != ContactKind::kStatic)
      throw Rejected{fmt::format("problem.contacts[{}].kind", i), std::string(Name(kind)),
                     "frictionless or static"};
  }
}

Json CheckLoopInSpace(const ExactProblem& problem, const Json& witness, bool endless) {
  RequireRunInSpace(problem);
  LoopInSpace loop = ReadLoop(problem, witness);
  loop.endless = endless;
  const Policy policy = ReadPolicy(witness["policy"], "witness.policy", 3);
  const auto steps = static_cast<double>(loop.word.size() + 1) * static_cast<double>(1 + loop.charts.size());
  Cost(ReducedOperations(problem, 8 * steps)).AddBits(2 * loop.bits).LongestRow(problem);
  if (const auto fault = FindLoopFault(problem, policy, loop))
    throw Rejected{"witness." + fault->place, fault->found, fault->expected};
  return {{"policies", 1},
          {"kind", witness["kind"]},
          {"coordinates", loop.charts.size()},
          {"start", Json::array({loop.start})},
          {"period", Json::array({loop.period})}};
}

Json CheckRay(const ExactProblem& problem, const Json& witness) {
  RequireRunInSpace(problem);
  RequireKeys(witness, "witness", {"policy", "bits", "word"});
  const Policy policy = ReadPolicy(witness["policy"], "witness.policy", 3);
  const RayInSpace ray = {ReadBits(witness), ReadWord(witness)};
  const auto steps = static_cast<double>(ray.word.size() + 1);
  Cost(ReducedOperations(problem, 8 * steps)).AddBits(2 * ray.bits).LongestRow(problem);
  if (const auto fault = FindRayFault(problem, policy, ray))
    throw Rejected{"witness." + fault->place, fault->found, fault->expected};
  return {{"policies", 1}, {"steps", ray.word.size()}};
}

Json CheckCycle(const ExactProblem& problem, const Json& witness) {
  if (witness.is_object() && witness.contains("word")) return CheckLoopInSpace(problem, witness, false);
  RequireKeys(witness, "witness", {"runs"});
  return CheckRuns(problem, witness);
}

Json CheckEndless(const ExactProblem& problem, const Json& witness) {
  return CheckLoopInSpace(problem, witness, true);
}

Json CheckCounterexample(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"D", "L", "a", "f", "runs"});
  RequireDefinite(problem, witness);
  RequireSolution(problem, witness);
  return CheckRuns(problem, witness);
}

// ---- Rows --------------------------------------------------------------------------------------

Json OfCycle(const ExactProblem& problem, const ClaimOptions& o) {
  return CycleCertificate(problem, o.policies, o.limits);
}
Json OfRay(const ExactProblem& problem, const ClaimOptions& o) {
  return CertificateInSpace("ray", problem, o.policies, o.limits, ProveRayInSpace, RayToJson);
}
Json OfEndless(const ExactProblem& problem, const ClaimOptions& o) {
  return CertificateInSpace("endless", problem, o.policies, o.limits, ProveEndlessInSpace, LoopToJson);
}
Json OfCounterexample(const ExactProblem& problem, const ClaimOptions& o) {
  return CounterexampleCertificate(problem, o.policies, o.limits);
}

}  // namespace

// Planar, or in space of the contacts that its loops are proved of.
void RequireLoops(const ExactProblem& problem, const std::string& source) {
  if (problem.dimension == 2 || PublishedHandlesInSpace(problem)) return;
  throw InputError(source, "contacts", "a bilateral or sliding contact",
                   "frictionless and static ones: of these loops in space are certified");
}

void RequireLoopsInSpace(const ExactProblem& problem, const std::string& source) {
  if (problem.dimension != 3) throw InputError(source, "dimension", "2", "3: this is a claim of runs in space");
  RequireLoops(problem, source);
}

ClaimRows CycleClaims() {
  static constexpr Claim kClaims[] = {
      Claim{"cycle", CheckCycle,
            "the published algorithm repeats a state of its outer loop, or in space never ends", OfCycle,
            RequireLoops},
      Claim{"ray", CheckRay, "in space the published algorithm comes to a step that nothing limits", OfRay,
            RequireLoopsInSpace},
      Claim{"endless", CheckEndless, "in space the published algorithm never ends, and repeats no state",
            OfEndless, RequireLoopsInSpace},
      Claim{"counterexample", CheckCounterexample,
            "it does, though A is definite and there is a solution: all in one file", OfCounterexample,
            RequirePlanar}};
  return {70, kClaims};
}

}  // namespace stiction
