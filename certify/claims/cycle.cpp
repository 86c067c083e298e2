// SPDX-License-Identifier: Apache-2.0
// Runs of the published algorithm that repeat a state, or in space stay in a box for ever: `cycle`; that end in
// a step which nothing limits: `ray`, in space; that repeat no state: `endless`, in space; and
// `counterexample`, where A is definite and there is a solution besides.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "certify/claims/certificate.h"
#include "certify/claims/claim.h"
#include "certify/claims/existence.h"
#include "certify/claims/policy_ends.h"
#include "certify/exact/exact.h"
#include "certify/exact/loops_in_space.h"
#include "certify/exact/properties.h"
#include "corpus/grouped.h"
#include "corpus/json.h"
#include "corpus/record/loop_sentence.h"
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
Json CyclesToJson(const ExactProblem& problem, const std::vector<PolicyEnds>& ends, const Limits& limits) {
  const std::vector<std::string> names = VariableNames(problem);
  Json runs = Json::array();
  for (const PolicyEnds& equal : ends) {
    if (equal.outcome != Outcome::kCycle) continue;
    Json run = RunToJson(RunExact(problem, {.policy = equal.policies.front(), .limits = limits}), names);
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
  Json state = {{"sets", SetsToJson(run.sets, names)}, {"f", ListJson(run.f)}};
  if (run.policy.resume == Resume::kRound && run.last_driven_contact >= 0) {
    state["contact"] = run.last_driven_contact + 1;
  }
  return state;
}

namespace {

// Of a ray without a period.
Json RunToJson(const Policy& policy, const RunInSpace& run) {
  if (run.period == 0) return {{"policy", PolicyName(policy)}, {"bits", run.bits}, {"word", run.word}};
  Json witness = {{"policy", PolicyName(policy)},
                  {"kind", run.punctured ? "punctured"
                           : run.IsBox() ? "box"
                                         : "states"},
                  {"bits", run.bits},
                  {"start", run.start},
                  {"period", run.period},
                  {"word", run.word}};
  if (run.IsBox()) {
    witness["charts"] = run.charts;
    witness["centre"] = ListJson(run.centre);
    witness["radii"] = ListJson(run.radii);
  }
  return witness;
}

using ProveInSpace = std::optional<RunInSpace>(const ExactProblem&, const Policy&, const Limits&);

// Of the first of the policies of which it is proved.
Json CertificateInSpace(const char* claim, const ExactProblem& problem, const std::vector<Policy>& policies,
                        const Limits& limits, ProveInSpace& prove) {
  for (const Policy& policy : policies) {
    if (!PublishedReadsInSpace(policy)) continue;
    if (const auto run = prove(problem, policy, limits))
      return MakeCertificate(claim, problem, RunToJson(policy, *run));
  }
  return nullptr;
}

Json CyclesCertificate(const ExactProblem& problem, const std::vector<PolicyEnds>& ends, const Limits& limits) {
  const Json runs = CyclesToJson(problem, ends, limits);
  return runs.empty() ? Json() : MakeCertificate("cycle", problem, {{"runs", runs}});
}

}  // namespace

SharedJson CycleCertificate(const ExactProblem& problem, const std::vector<Policy>& policies,
                            const Limits& limits) {
  if (problem.dimension == 3) return CertificateInSpace("cycle", problem, policies, limits, ProveLoopInSpace);
  return CyclesCertificate(problem, EndsUnder(policies, problem, limits), limits);
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
    ExactRun run = RunExact(problem, {.policy = policy, .limits = limits});
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
  for (int i = 0; i < f.size(); ++i) RequireEqual(f[i], run.f[i], ElementPath(path + ".f", i));
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
  return JsonText(steps);
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

// One step more than are stated, for every policy.
void RequireFewSteps(const ExactProblem& problem, const Json& runs) {
  double operations = 0;
  for (const Json& run : runs)
    operations += StepOperations(problem.rows(), static_cast<double>(LengthOf(run, "policies"))) *
                  static_cast<double>(LengthOf(run, "pivots") + 1);
  Cost(operations).AllRows(problem);
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

// One step more than are stated, with a derivative for every coordinate.
void RequireFewStepsInSpace(const ExactProblem& problem, const Json& witness) {
  if (!witness.is_object() || !witness.contains("bits")) return;  // refused where it is read
  const double steps = static_cast<double>(LengthOf(witness, "word") + 1);
  const double coordinates = static_cast<double>(LengthOf(witness, "radii"));
  Cost(StepInSpaceOperations(problem.rows(), coordinates, steps))
      .AddBits(ReadBits(witness))
      .LongestRow(problem);
}

RunInSpace ReadLoop(const ExactProblem& problem, const Json& witness) {
  const bool punctured = witness.contains("kind") && witness["kind"] == "punctured";
  const bool box = punctured || (witness.contains("kind") && witness["kind"] == "box");
  std::set<std::string> keys = {"policy", "kind", "bits", "start", "period", "word"};
  if (box) keys.insert({"charts", "centre", "radii"});
  RequireKeys(witness, "witness", keys);
  if (!box && witness["kind"] != "states")
    throw Rejected{"witness.kind", Shown(witness["kind"]), "states, box or punctured"};
  RunInSpace loop;
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
  RequireFewStepsInSpace(problem, witness);
  RunInSpace loop = ReadLoop(problem, witness);
  loop.endless = endless;
  const Policy policy = ReadPolicy(witness["policy"], "witness.policy", 3);
  if (const auto fault = FindLoopFault(problem, policy, loop))
    throw Rejected{"witness." + fault->path, fault->found, fault->expected};
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
  RequireFewStepsInSpace(problem, witness);
  const RunInSpace ray = {.bits = ReadBits(witness), .word = ReadWord(witness)};
  if (const auto fault = FindRayFault(problem, policy, ray))
    throw Rejected{"witness." + fault->path, fault->found, fault->expected};
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

// Of which policies the certificate speaks, where these are not all; of one policy how its run goes on.
void TellCertified(ClaimAnswer& answer) {
  if (!answer.certificate) return;
  const std::vector<Policy> named = CertifiedPolicies(answer.certificate);
  PolicyCounts& counts = *answer.policies;
  counts.certified = static_cast<std::int64_t>(named.size());
  if (counts.asked == 1) {
    const std::string policy = PolicyName(named.front());
    answer.reason = fmt::format("under {} {}", policy, LoopSentence(ProvedRunOf(answer.certificate, policy)));
  } else if (counts.certified < counts.asked) {
    answer.reason += fmt::format("; the certificate is of {} of the {}", Grouped(counts.certified),
                                 Counted(counts.asked, "policy"));
  }
}

// In space, of one policy: that it loops refutes that it ends in a ray, and the other way round.
Json OppositeInSpace(const ExactProblem& problem, const PolicyEnds& end, const Limits& limits) {
  if (end.outcome == Outcome::kCycle) return CycleCertificate(problem, end.policies, limits);
  if (end.outcome == Outcome::kRay)
    return CertificateInSpace("ray", problem, end.policies, limits, ProveRayInSpace);
  return nullptr;
}

// Those under which it is so.
std::vector<Policy> PoliciesOf(const std::vector<PolicyEnds>& ends, const EndState& state) {
  std::vector<Policy> policies;
  for (const PolicyEnds& end : ends) {
    if (state(end) == ClaimState::kProved)
      policies.insert(policies.end(), end.policies.begin(), end.policies.end());
  }
  return policies;
}

// Of the first policy that a proof is found for; where the only one ends otherwise, of how it does.
ClaimAnswer AnswerInSpace(const char* claim, const ExactProblem& problem, const Limits& limits,
                          const std::vector<Policy>& policies, const ClaimedVerb& verb, const EndState& state,
                          ProveInSpace& prove) {
  const std::vector<PolicyEnds> ends = EndsUnder(policies, problem, limits);
  ClaimAnswer answer = AnswerOfEnds(ends, verb, state);
  answer.certificate = CertificateInSpace(claim, problem, PoliciesOf(ends, state), limits, prove);
  // A certificate in space is of one policy.
  if (answer.state == ClaimState::kProved && (!answer.certificate || answer.policies->asked > 1)) {
    answer.state = ClaimState::kNotDecided;
    answer.reason += ", as intervals say";
    if (!answer.certificate) answer.reason += "; no certificate of it was found";
  }
  if (ends.size() == 1 && answer.state == ClaimState::kDisproved)
    answer.certificate = OppositeInSpace(problem, ends.front(), limits);
  TellCertified(answer);
  return answer;
}

constexpr ClaimedVerb kLoops = {"loops", "loop"};

ClaimAnswer OfCycle(const ExactProblem& problem, const Request& request, const std::vector<Policy>& policies,
                    const EnumerationWatch&) {
  const EndState loops = EndsIn(Outcome::kCycle);
  if (problem.dimension == 3)
    return AnswerInSpace("cycle", problem, request.limits, policies, kLoops, loops, ProveLoopInSpace);
  const std::vector<PolicyEnds> ends = EndsUnder(policies, problem, request.limits);
  ClaimAnswer answer = AnswerOfEnds(ends, kLoops, loops);
  answer.certificate = CyclesCertificate(problem, ends, request.limits);
  TellCertified(answer);
  return answer;
}

ClaimAnswer OfRay(const ExactProblem& problem, const Request& request, const std::vector<Policy>& policies,
                  const EnumerationWatch&) {
  return AnswerInSpace("ray", problem, request.limits, policies,
                       {"comes to a step that nothing limits", "come to a step that nothing limits"},
                       EndsIn(Outcome::kRay), ProveRayInSpace);
}

// Of a run that loops: whether no state recurs, whether one does, or neither is shown.
ClaimState RepeatsNoState(const ExactProblem& problem, const PolicyEnds& end, const Limits& limits) {
  const ClaimState ends = EndsIn(Outcome::kCycle)(end);
  if (ends != ClaimState::kProved) return ends;
  const Policy& policy = end.policies.front();
  if (ProveEndlessInSpace(problem, policy, limits)) return ClaimState::kProved;
  const auto loop = ProveLoopInSpace(problem, policy, limits);
  return loop && !loop->IsBox() ? ClaimState::kDisproved : ClaimState::kNotDecided;
}

ClaimAnswer OfEndless(const ExactProblem& problem, const Request& request, const std::vector<Policy>& policies,
                      const EnumerationWatch&) {
  std::map<std::string, ClaimState> known;  // by policy: each is looked at once
  const EndState repeats_none = [&](const PolicyEnds& end) {
    const std::string name = PolicyName(end.policies.front());
    const auto found = known.find(name);
    if (found != known.end()) return found->second;
    return known[name] = RepeatsNoState(problem, end, request.limits);
  };
  return AnswerInSpace("endless", problem, request.limits, policies,
                       {"never ends and repeats no state", "never end and repeat no state"}, repeats_none,
                       ProveEndlessInSpace);
}

// Of A and of solutions first, then of the policies.
ClaimAnswer OfCounterexample(const ExactProblem& problem, const Request& request,
                             const std::vector<Policy>& policies, const EnumerationWatch& watch) {
  if (!IsSymmetric(problem)) return ByCertificate(SymmetryCertificate(problem));
  const auto decision = DecideDefinite(problem.A);
  const auto* factors = std::get_if<LdltFactors>(&decision);
  if (factors == nullptr) return ByCertificate(DefiniteCertificate(problem));
  const std::vector<PolicyEnds> ends = EndsUnder(policies, problem, request.limits);
  ClaimAnswer answer = AnswerOfEnds(ends, kLoops, EndsIn(Outcome::kCycle));
  Json runs = CyclesToJson(problem, ends, request.limits);
  if (runs.empty()) return answer;
  const ClaimAnswer existence = DecideExistence(problem, request, watch);
  const SharedJson& solution = existence.certificate;
  if (solution && solution->at("claim") == "no-solution")
    return ByCertificate(solution);  // as where contacts slide
  if (!solution || solution->at("claim") != "solution-exists")
    return ByCertificate(
        {}, existence.reason.empty() ? "no solution was found" : "no solution was found: " + existence.reason);
  Json witness = FactorsToJson(*factors);
  witness.update(solution->at("witness"));
  witness["runs"] = std::move(runs);
  answer.certificate = MakeCertificate("counterexample", problem, std::move(witness));
  TellCertified(answer);
  return answer;
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
            "it does, though A is symmetric and definite and there is a solution: all in one file",
            OfCounterexample, RequirePlanar}};
  return {70, kClaims};
}

}  // namespace stiction
