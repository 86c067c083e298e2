// SPDX-License-Identifier: Apache-2.0
// stiction replay: a path method on one problem, step by step, exactly where it is built so.

#include <fmt/format.h>

#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "answers/followed.h"
#include "answers/narrate_text.h"
#include "answers/problem_text.h"
#include "answers/version.h"
#include "certify/exact.h"
#include "certify/published_space.h"
#include "certify/solve.h"
#include "cli/replay_file.h"
#include "cli/shared.h"
#include "cli/verbs.h"
#include "cli/words.h"
#include "corpus/digest.h"
#include "corpus/json_text.h"
#include "corpus/rounded.h"
#include "reports/text/plain_text.h"
#include "reports/viewer.h"
#include "solver/published/published_space.h"

namespace stiction {
namespace {

struct ReplayOptions {
  std::string file;
  std::string policy = "paper";
  std::string method = "baraff";
  std::string arithmetic;  // empty: exact where it is built, otherwise double
  int sides = 8;
  bool all_policies = false;
  bool step = false;
  bool json = false;
  bool list = false;       // with all_policies: every policy
  bool fractions = false;  // for people, in full
  std::string record, html;
  Limits limits;

  PathOptions path() const { return {method, policy, limits}; }
  FractionText as() const { return fractions ? FractionText::kFull : FractionText::kShort; }
};

SolveRequest RequestOf(const ReplayOptions& o, const ProblemFile& file, const Policy& policy) {
  SolveRequest request{.method = o.method, .trace = KeepTrace::kYes};
  request.options.policy = policy;
  request.options.limits = o.limits;
  request.options.sides = o.sides;
  const int dimension = file.problem.dimension;
  const bool exact = o.arithmetic.empty() && Refusal(o.method, dimension, Arithmetic::kExact).empty();
  request.arithmetic = exact                  ? Arithmetic::kExact
                       : o.arithmetic.empty() ? Arithmetic::kDouble
                                              : *FindArithmetic(o.arithmetic);
  const std::string refusal = Refusal(o.method, dimension, request.arithmetic);
  if (!refusal.empty()) throw InputError(o.file + ": " + refusal);
  return request;
}

Solution SolveFile(const ReplayOptions& o, const ProblemFile& file, const SolveRequest& request) {
  try {
    return SolveIn(file.problem, request);
  } catch (const InputError& error) {
    throw InputError(o.file + ": " + error.what());
  }
}

// ---- One policy ------------------------------------------------------------------------------

template <class Scalar>
std::string WholeEnd(const TracedAnswer<Scalar>& answer, const Solution& solution) {
  const bool proved = kIsExact<Scalar>;
  std::string text;
  if (solution.suspected)
    text = fmt::format("{}\nrun again{}: ", EndText(*solution.suspected, false),
                       proved ? ", exactly" : " in long double, with finer tolerances");
  text += EndText(answer, proved) + "\n";
  if (!proved && answer.outcome == Outcome::kCycle) text += fmt::format("({})\n", kNoProof);
  return answer.word.empty() ? text : text + fmt::format("cells {}\n", answer.word);
}

// The run as text, to its outcome.
std::string ToldForPeople(const ReplayOptions& o, const ProblemFile& file, const Solution& solution,
                          const Narration& narration) {
  return std::visit(
      [&](const auto& answer) {
        const std::string reading = o.method == "baraff" ? "policy " + o.policy : "method " + o.method;
        return fmt::format("{}: {} contacts{}, {}, {}\n{}{}{}", file.name, file.problem.contacts.size(),
                           file.problem.dimension == 3 ? " in space" : "", reading, Name(answer.arithmetic),
                           o.step ? ProblemText(file.problem, o.as()) : "",
                           o.step ? narration.steps : narration.table, WholeEnd(answer, solution));
      },
      solution.answer);
}

// What intervals say of a run in space that does not end solved over floating-point numbers.
std::optional<Verdict> OverIntervals(const ReplayOptions& o, const ProblemFile& file, const Policy& policy,
                                     Outcome outcome) {
  const bool in_space = file.problem.dimension == 3 && o.method == "baraff" && PublishedReadsInSpace(policy);
  if (!in_space || outcome == Outcome::kSolved) return std::nullopt;
  return RunIntervalsInSpace(file.problem, {policy, {}, o.limits}).verdict;
}

// "over intervals, proved: cycle: ..."
std::string OverIntervalsText(const Verdict& verdict) {
  const bool open = verdict.outcome == Outcome::kUndecided || verdict.outcome == Outcome::kLimit;
  return fmt::format("over intervals, {}: {}", open ? "which do not decide it" : "proved", Describe(verdict));
}

int ExitOf(Outcome outcome, const std::string& expected) {
  if (Name(outcome) == (expected.empty() ? Name(Outcome::kSolved) : std::string_view(expected)))
    return kExitDone;
  const bool open = outcome == Outcome::kLimit || outcome == Outcome::kUndecided;
  return open ? kExitUndecided : kExitNotSo;
}

// ---- The page ----------------------------------------------------------------------------------

// The command with what is not as usual; where the page goes is said by who makes it again.
std::string CommandOf(const ReplayOptions& o) {
  const ReplayOptions usual;
  std::string command = "stiction replay " + ShellWord(o.file);
  const auto add = [&command](const std::string& name, const auto& value, const auto& as_usual) {
    if (value != as_usual) command += fmt::format(" --{} {}", name, ShellWord(fmt::format("{}", value)));
  };
  add("policy", o.policy, usual.policy);
  add("method", o.method, usual.method);
  add("arithmetic", o.arithmetic, usual.arithmetic);
  add("sides", o.sides, usual.sides);
  Limits limits = o.limits, usual_limits;
  ForEachField(limits, [&](const NumberRow& row, std::int64_t value) {
    ForEachField(usual_limits, [&](const NumberRow& other, std::int64_t as_usual) {
      if (std::string_view(row.name) == other.name) add(std::string(row.name), value, as_usual);
    });
  });
  return command + " --html OUT";
}

// The run itself, with what intervals say of it, and beside it complete driving.
void WritePage(const ReplayOptions& o, const ReplayFile& replay, const Solution& solution,
               const std::optional<Verdict>& over_intervals) {
  const ProblemFile& file = replay.file;
  std::vector<FollowedRun> runs = {Followed(o.path(), file, solution)};
  if (over_intervals) runs[0].end += "; " + OverIntervalsText(*over_intervals);
  ReplayOptions beside = o;
  beside.method = "complete";
  beside.arithmetic = "";
  if (o.method != beside.method)
    runs.push_back(Followed(beside.path(), file, SolveFile(beside, file, RequestOf(beside, file, {}))));
  WriteText(o.html, ViewerPage(file.name + ", step by step", ReplayPageData(file, replay.picture, runs),
                               {CommandOf(o), Version(), ProblemDigest(file.problem)}));
}

int ReplayOne(const ReplayOptions& o, const ReplayFile& replay) {
  const ProblemFile& file = replay.file;
  const Policy policy = ParsePolicy(o.policy);
  const Solution solution = SolveFile(o, file, RequestOf(o, file, policy));
  const std::string expected = o.method == "baraff" ? Expected(file, policy) : "";
  Narration narration = Narrate(o.method, file, solution, {o.step || !o.json, o.as()});
  const auto proved = OverIntervals(o, file, policy, solution.outcome());
  if (!o.html.empty()) WritePage(o, replay, solution, proved);
  if (o.html == "-") return ExitOf(solution.outcome(), expected);
  if (o.json) {
    Json json = ReplayToJson(o.path(), file, solution, std::move(narration), o.step);
    if (proved) json["over_intervals"] = EndToJson(*proved);
    json["expected"] = expected;
    std::cout << JsonText(json) << "\n";
  } else {
    std::string told = ToldForPeople(o, file, solution, narration);
    if (proved) told += OverIntervalsText(*proved) + "\n";
    if (!expected.empty() && expected != Name(solution.outcome())) told += "expected: " + expected + "\n";
    fmt::print("{}", told);
    if (o.step)
      fmt::print("\nThe words (numbers in brackets are sections of the paper):\n{}", GlossaryOf(told));
  }
  return ExitOf(solution.outcome(), expected);
}

// ---- All policies ----------------------------------------------------------------------------

// `expect` for the whole grid: the most frequent outcome as "*", the policies that differ by name.
std::map<std::string, std::string> ExpectFrom(const Json& outcomes, const Json& counts) {
  std::string most;
  for (const auto& [outcome, count] : counts.items()) {
    if (most.empty() || count > counts[most]) most = outcome;
  }
  std::map<std::string, std::string> expect = {{"*", most}};
  for (const auto& [policy, entry] : outcomes.items()) {
    if (entry["outcome"] != most) expect[policy] = entry["outcome"].get<std::string>();
  }
  return expect;
}

// Outcomes by the names of the policies.
using Outcomes = std::map<std::string, Json>;

// The policies that are built for space: the planar grid with file=no and apex=kept, for each reading of
// `slip`.
std::vector<Policy> GridInSpace() {
  std::vector<Policy> grid;
  for (const Slip slip : {Slip::kLiteral, Slip::kRedirect}) {
    for (Policy policy : PlanarGrid()) {
      policy.slip = slip;
      if (PublishedReadsInSpace(policy)) grid.push_back(policy);
    }
  }
  return grid;
}

// Without the reason, which is a run's own.
template <class End>
Json OutcomeToJson(const End& end) {
  Json entry = EndToJson(end);
  entry.erase("reason");
  return entry;
}

Outcomes RunGrid(const ReplayOptions& o, const ExactProblem& problem) {
  Outcomes outcomes;
  for (const PolicyClass& equal : RunPolicies(problem, PlanarGrid(), o.limits)) {
    for (const Policy& policy : equal.policies) outcomes[PolicyName(policy)] = OutcomeToJson(equal.verdict);
  }
  return outcomes;
}

Outcomes RunGridInSpace(const ReplayOptions& o, const ProblemFile& file) {
  Outcomes outcomes;
  for (const Policy& policy : GridInSpace()) {
    SolveRequest request = RequestOf(o, file, policy);
    request.trace = KeepTrace::kNo;
    outcomes[PolicyName(policy)] = std::visit([](const auto& answer) { return OutcomeToJson(answer); },
                                              SolveFile(o, file, request).answer);
  }
  return outcomes;
}

// What the policies have in common on a switch that others of the grid have not: "file=yes", "scan=lowest or
// highest"; empty: nothing.
std::string InCommon(const PolicySwitchRow& row, const std::vector<Policy>& some,
                     const std::vector<Policy>& grid) {
  const auto values = [&row](const std::vector<Policy>& policies) {
    std::set<int> found;
    for (const Policy& policy : policies) found.insert(row.get(policy));
    return found;
  };
  const std::set<int> of_some = values(some);
  if (of_some == values(grid)) return "";
  std::vector<std::string_view> names;
  for (const int value : of_some) names.push_back(row.values[value].name);
  return fmt::format("{}={}", row.name, fmt::join(names, " or "));
}

// "cycle: 768 of 1536 policies, all with file=yes". With --list a line for every policy before that.
void PrintOutcomes(const ReplayOptions& o, const std::vector<Policy>& grid, const Json& outcomes) {
  std::map<std::string, std::vector<Policy>> by_outcome;
  for (const Policy& policy : grid) {
    const std::string name = PolicyName(policy), outcome = outcomes[name]["outcome"].get<std::string>();
    by_outcome[outcome].push_back(policy);
    if (o.list) fmt::print("{:10} {}\n", outcome, name);
  }
  for (const auto& [outcome, some] : by_outcome) {
    std::vector<std::string> common;
    for (const PolicySwitchRow& row : PolicySwitches()) {
      if (const std::string text = InCommon(row, some, grid); !text.empty()) common.push_back(text);
    }
    const bool all = some.size() == grid.size();
    fmt::print("{}: {} policies{}{}\n", outcome,
               all ? fmt::format("all {}", grid.size()) : fmt::format("{} of {}", some.size(), grid.size()),
               common.empty() ? "" : ", all with ", fmt::join(common, ", "));
  }
  if (!o.list && by_outcome.size() > 1) fmt::print("(--list: a line for every policy)\n");
}

int ReplayAll(const ReplayOptions& o, const ProblemFile& file) {
  const bool in_space = file.problem.dimension == 3;
  const Outcomes by_name = in_space ? RunGridInSpace(o, file) : RunGrid(o, file.problem);
  Json outcomes = Json::object(), counts = Json::object(), unexpected = Json::array();
  for (const Policy& policy : in_space ? GridInSpace() : PlanarGrid()) {
    const std::string name = PolicyName(policy);
    const std::string outcome = by_name.at(name)["outcome"].get<std::string>();
    outcomes[name] = by_name.at(name);
    counts[outcome] = counts.value(outcome, 0) + 1;
    const std::string expected = Expected(file, policy);
    if (outcome != (expected.empty() ? "solved" : expected)) unexpected.push_back(name);
  }
  if (!o.record.empty()) {
    ProblemFile recorded = file;
    recorded.expect = ExpectFrom(outcomes, counts);
    WriteText(o.record, Print(recorded));
    return kExitDone;
  }
  if (o.json) {
    std::cout << JsonText({{"policies", outcomes}, {"counts", counts}, {"unexpected", unexpected}}) << "\n";
  } else {
    PrintOutcomes(o, in_space ? GridInSpace() : PlanarGrid(), outcomes);
    if (!unexpected.empty())
      fmt::print("{}: {} policies\n", file.expect.empty() ? "not solved" : "not as expected",
                 unexpected.size());
  }
  return unexpected.empty() ? kExitDone : kExitNotSo;
}

int Replay(const ReplayOptions& o) {
  const ReplayFile replay = ReadReplayFile(o.file);
  const ProblemFile& file = replay.file;
  if (!o.all_policies) return ReplayOne(o, replay);
  if (!o.html.empty()) throw InputError("--html: found --all-policies, expected one policy");
  if (o.method != "baraff") throw InputError("--all-policies: expected --method baraff");
  const bool exact = o.arithmetic.empty() || o.arithmetic == "exact";
  if (file.problem.dimension == 2 && !exact)
    throw InputError(
        fmt::format("--arithmetic {}: expected exact for all policies in the plane", o.arithmetic));
  return ReplayAll(o, file);
}

std::vector<AllowedValue> PathMethodChoices() {
  std::vector<AllowedValue> choices;
  for (const MethodFacts& facts : AllMethods()) {
    if (facts.has_path) choices.push_back({std::string(facts.name), std::string(facts.title)});
  }
  return choices;
}

}  // namespace

void AddReplay(CommandLine& program) {
  auto [verb, o] = program.Add("replay", "Follow a path method step by step, exactly where it can be", Replay);
  verb.Positional("FILE", o.file, "stiction-problem file, or stiction-scene file of one problem").Required();
  AddPolicyOption(verb, o.policy, Grid::kRefused);
  verb.Flag("--all-policies", o.all_policies,
            "the outcome under every policy of the planar grid, or of those that are built for space");
  verb.Flag("--list", o.list, "a line for every policy, before the summary").Needs("--all-policies");
  verb.Option("--record", o.record, "write the problem with what happened as its `expect`")
      .Needs("--all-policies");
  verb.Option("--method", o.method, "what to follow").Choices(PathMethodChoices());
  verb.Option("--arithmetic", o.arithmetic, "exact where it is built, otherwise double, by default")
      .OneOf({"exact", "float", "double", "long-double", "quad", "filtered"});
  verb.Option("--sides", o.sides, "sides of the friction polygons in space, a multiple of 4").Check(CheckSides);
  verb.Flag("--step", o.step, "the problem; directions, forces and sets at every step; what the words mean");
  verb.Flag("--fractions", o.fractions,
            "long fractions in full, which are rounded otherwise, in text for people");
  verb.Option("--html", o.html,
              "write a page to step through the run, beside complete driving; - is standard output");
  verb.Flag("--json", o.json, "machine output");
  AddLimits(verb, o.limits);
}

}  // namespace stiction
