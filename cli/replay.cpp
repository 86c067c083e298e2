// SPDX-License-Identifier: Apache-2.0
// stiction replay: the published algorithm on one problem, pivot by pivot, in the plane exactly.

#include <fmt/format.h>

#include <iostream>

#include "certify/certificate.h"
#include "certify/verify_solution.h"
#include "cli/replay_space.h"
#include "cli/shared.h"
#include "cli/verbs.h"
#include "corpus/json_text.h"

namespace stiction {
namespace {

struct ReplayOptions {
  std::string file;
  std::string policy = "paper";
  std::string method = "baraff";
  std::string arithmetic;  // empty: exact, in space double for the published algorithm
  int sides = 8;
  bool all_policies = false;
  bool step = false;
  bool json = false;
  std::string record;
  Limits limits;
};

// ---- The trace for people --------------------------------------------------------------------

class Narrator {
 public:
  Narrator(const ProblemFile& file, const ExactRun& run)
      : problem_(file.problem), run_(run), names_(VariableNames(file.problem)) {
    layout_.Assign(problem_.contacts);
  }

  void Table() const {
    fmt::print("{}", Kinds());
    fmt::print("{:>4} {:>5} {:>6} {:>9} {:>14}  {}\n", "step", "drive", "driven", "goal", "length",
               "what happens");
    for (std::size_t k = 0; k < run_.trace.pivots.size(); ++k) {
      const Pivot<Rational>& pivot = run_.trace.pivots[k];
      fmt::print("{:>4} {:>5} {:>6} {:>9} {:>14}  {}\n", k + 1, pivot.drive, names_[pivot.driven],
                 Name(pivot.goal), ToString(pivot.s), Event(pivot));
    }
    Ray();
  }

  void Steps() const {
    ExactProblem::Vector a = Accelerations(problem_, run_.initial_f);
    const std::string kinds = Kinds();
    if (kinds.empty()) {
      fmt::print("f = 0, a = b = {}; all sets are empty (4.3).\n", List(a));
    } else {
      fmt::print("{}Before the first drive f = {}, a = {}; all other variables are in no set (4.3).\n", kinds,
                 List(run_.initial_f), List(a));
    }
    int drive = 0;
    for (const Pivot<Rational>& pivot : run_.trace.pivots) {
      if (pivot.drive != drive) StartDrive(pivot, a);
      drive = pivot.drive;
      a = pivot.a;
      Step(pivot);
    }
    fmt::print("\n");
    Ray();
  }

 private:
  std::string List(const ExactProblem::Vector& values) const {
    std::vector<std::string> numbers;
    for (const Rational& value : values) numbers.push_back(ToString(value));
    return fmt::format("({})", fmt::join(numbers, ", "));
  }

  // What bilateral and sliding contacts do all the time, one line each.
  std::string Kinds() const {
    std::string text;
    for (int i = 0; i < layout_.ContactCount(); ++i) {
      const Contact<Rational>& contact = problem_.contacts[i];
      const int row = layout_.NormalRowOf(i);
      if (contact.kind == ContactKind::kBilateral)
        text += fmt::format("Contact {} is bilateral: {} stays in C, a_{} = 0 (4.5).\n", i + 1, names_[row],
                            names_[row]);
      if (contact.kind == ContactKind::kSliding) {
        const Rational factor = -contact.mu * contact.slip[0];
        text += fmt::format("Contact {} slides: f_{} = {} f_{} (24).\n", i + 1, names_[row + 1],
                            ToString(factor), names_[row]);
      }
    }
    return text;
  }

  // The direction without an end; with sliding contacts the impulsive direction of section 6.
  void Ray() const {
    if (run_.ray.size() > 0) fmt::print("no limit to the step along df = {}\n", List(run_.ray));
  }

  // Sets in the paper's names, with their members.
  std::string Sets(const std::vector<IndexSet>& sets) const {
    std::string text;
    for (int set = 1; set < kIndexSetCount; ++set) {
      std::vector<std::string> members;
      for (std::size_t row = 0; row < sets.size(); ++row) {
        if (static_cast<int>(sets[row]) == set) members.push_back(names_[row]);
      }
      const bool paper_set = static_cast<IndexSet>(set) != IndexSet::kSuspended;
      if (!paper_set && members.empty()) continue;
      text +=
          fmt::format("{}{} = {{{}}}", text.empty() ? "" : "  ", kIndexSetNames[set], fmt::join(members, " "));
    }
    return text;
  }

  // Why this variable is driven, and toward what.
  void StartDrive(const Pivot<Rational>& pivot, const ExactProblem::Vector& a) const {
    const int row = pivot.driven;
    fmt::print("\nDrive {}: {}", pivot.drive, names_[row]);
    if (layout_.IsNormal(row)) {
      fmt::print(". a_{} = {} < 0: increase f_{} until it is 0 (4.1).\n", names_[row], ToString(a[row]),
                 names_[row]);
    } else if (pivot.goal == DriveGoal::kZero) {
      fmt::print(". Its friction was given up earlier: first drive f_{} to zero (5.5).\n", names_[row]);
    } else {
      const bool up = pivot.df[row] > 0;
      fmt::print(". a_{} = {}: {} f_{} until a_{} = 0 or f_{} = {}mu f_{} (5.2).\n", names_[row],
                 ToString(a[row]), up ? "increase" : "decrease", names_[row], names_[row], names_[row],
                 up ? "" : "-", names_[row - 1]);
    }
  }

  void Step(const Pivot<Rational>& pivot) const {
    fmt::print("  df = {}   da = {}\n", List(pivot.df), List(pivot.da));
    fmt::print("  s = {}: {}\n", ToString(pivot.s), Event(pivot));
    fmt::print("    f = {}   a = {}\n", List(pivot.f), List(pivot.a));
    fmt::print("    {}\n", Sets(pivot.sets));
  }

  std::string Reached(const Pivot<Rational>& pivot) const {
    const std::string& name = names_[pivot.limiting];
    switch (pivot.wanted) {
      case IndexSet::kClamped:
      case IndexSet::kSticking:
        return fmt::format("a_{} = 0", name);
      case IndexSet::kAtUpper:
        return fmt::format("f_{} = mu f_{}", name, names_[pivot.limiting - 1]);
      case IndexSet::kAtLower:
        return fmt::format("f_{} = -mu f_{}", name, names_[pivot.limiting - 1]);
      default:
        return fmt::format("f_{} = 0", name);
    }
  }

  std::string Event(const Pivot<Rational>& pivot) const {
    const std::string& name = names_[pivot.limiting];
    if (pivot.gave_up) {
      return fmt::format("{}; {} is in {} and wants back into {}: given up (5.4, 5.5)", Reached(pivot), name,
                         Name(pivot.from), Name(pivot.wanted));
    }
    if (pivot.limiting != pivot.driven) {
      return fmt::format("{}; {} moves from {} to {}", Reached(pivot), name, Name(pivot.from), Name(pivot.to));
    }
    if (pivot.to == IndexSet::kNone)
      return fmt::format("{}; the drive ends, {} is in no set", Reached(pivot), name);
    return fmt::format("{}; the drive ends, {} joins {}", Reached(pivot), name, Name(pivot.to));
  }

  const ExactProblem& problem_;
  const ExactRun& run_;
  std::vector<std::string> names_;
  RowLayout<Eigen::Dynamic> layout_;
};

// ---- One policy, or all ----------------------------------------------------------------------

int ReplayOne(const ReplayOptions& o, const ProblemFile& file) {
  const Policy policy = ParsePolicy(o.policy);
  const ExactRun run = RunExact(file.problem, {policy, {}, o.limits});
  const std::string expected = Expected(file, policy);
  if (o.json) {
    Json pivots = Json::array();
    for (const Pivot<Rational>& pivot : run.trace.pivots) {
      pivots.push_back(PivotToJson(pivot, VariableNames(file.problem)));
      if (o.step) {
        pivots.back()["df"] = VectorToJson(pivot.df);
        pivots.back()["f"] = VectorToJson(pivot.f);
        pivots.back()["a"] = VectorToJson(pivot.a);
      }
    }
    Json result = {{"outcome", Name(run.verdict.outcome)},
                   {"start", run.verdict.start},
                   {"period", run.verdict.period},
                   {"policy", PolicyName(policy)},
                   {"expected", expected},
                   {"statistics", StatisticsToJson(run.verdict.statistics)},
                   {"f", VectorToJson(run.state.f)},
                   {"pivots", pivots}};
    if (!run.verdict.reason.empty()) result["reason"] = run.verdict.reason;
    if (run.ray.size() > 0) result["ray"] = VectorToJson(run.ray);
    if (o.step)
      result["initial"] = {{"f", VectorToJson(run.initial_f)},
                           {"a", VectorToJson(Accelerations(file.problem, run.initial_f))}};
    std::cout << JsonText(result) << "\n";
  } else {
    fmt::print("{}: {} contacts, policy {}\n", file.name, file.problem.contacts.size(), PolicyName(policy));
    const Narrator narrator(file, run);
    if (o.step) {
      narrator.Steps();
    } else {
      narrator.Table();
    }
    fmt::print("{}\n", Describe(run.verdict));
    if (!expected.empty() && expected != Name(run.verdict.outcome)) fmt::print("expected: {}\n", expected);
  }
  const std::string_view wanted = expected.empty() ? Name(Outcome::kSolved) : std::string_view(expected);
  if (Name(run.verdict.outcome) == wanted) return kExitDone;
  return run.verdict.outcome == Outcome::kLimit ? kExitUndecided : kExitNotSo;
}

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

Json OutcomeToJson(const Verdict& verdict) {
  Json entry = {{"outcome", Name(verdict.outcome)}};
  if (IsLoop(verdict.outcome)) {
    entry["start"] = verdict.start;
    entry["period"] = verdict.period;
  }
  return entry;
}

Outcomes RunGrid(const ReplayOptions& o, const ExactProblem& problem) {
  Outcomes outcomes;
  for (const PolicyClass& equal : RunPolicies(problem, PlanarGrid(), o.limits)) {
    for (const Policy& policy : equal.policies) outcomes[PolicyName(policy)] = OutcomeToJson(equal.verdict);
  }
  return outcomes;
}

Outcomes RunGridInSpace(const ReplayOptions& o, const ExactProblem& problem) {
  Outcomes outcomes;
  for (const Policy& policy : GridInSpace()) {
    const PublishedOptions options{policy, {}, o.limits};
    outcomes[PolicyName(policy)] = OutcomeToJson(DecideRounded(problem, options, o.arithmetic));
  }
  return outcomes;
}

int ReplayAll(const ReplayOptions& o, const ProblemFile& file) {
  const bool in_space = file.problem.dimension == 3;
  const Outcomes by_name = in_space ? RunGridInSpace(o, file.problem) : RunGrid(o, file.problem);
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
    for (const auto& [name, entry] : outcomes.items()) {
      fmt::print("{:10} {}\n", entry["outcome"].get<std::string>(), name);
    }
    for (const auto& [outcome, count] : counts.items()) fmt::print("{}: {} policies\n", outcome, count.dump());
    if (!unexpected.empty()) fmt::print("not as expected: {} policies\n", unexpected.size());
  }
  return unexpected.empty() ? kExitDone : kExitNotSo;
}

// In space, by one method: from f = 0 through its pivots, or its pieces.
int ReplayInSpace(const ReplayOptions& o, const ProblemFile& file) {
  const std::string expected = o.method == "baraff" ? Expected(file, ParsePolicy(o.policy)) : "";
  SpaceReplay replay =
      o.method == "complete"
          ? ReplayComplete(file, o.sides, o.limits)
          : ReplayPublishedInSpace(file, {ParsePolicy(o.policy), {}, o.limits}, o.arithmetic, o.step);
  if (o.json) {
    replay.json["expected"] = expected;
    std::cout << JsonText(replay.json) << "\n";
  } else {
    fmt::print("{}", o.step ? replay.steps : replay.table);
    if (!expected.empty() && expected != Name(replay.outcome)) fmt::print("expected: {}\n", expected);
  }
  if (Name(replay.outcome) == (expected.empty() ? Name(Outcome::kSolved) : std::string_view(expected)))
    return kExitDone;
  const bool open = replay.outcome == Outcome::kLimit || replay.outcome == Outcome::kUndecided;
  return open ? kExitUndecided : kExitNotSo;
}

int Replay(const ReplayOptions& given) {
  ReplayOptions o = given;
  const ProblemFile file = ReadProblem(o.file);
  const bool in_space = file.problem.dimension == 3, published = o.method == "baraff";
  if (!in_space && !published) {
    throw InputError(o.file, "dimension", "2", "3: in the plane only method baraff is replayed");
  }
  if (!published && o.all_policies) throw InputError("--all-policies: expected --method baraff");
  if (o.arithmetic.empty()) o.arithmetic = in_space && published ? "double" : "exact";
  if (in_space && published && o.arithmetic == "exact") {
    throw InputError(
        "--arithmetic exact: expected float, double or long-double for the published algorithm in space, "
        "which takes square roots");
  }
  if (!(in_space && published) && o.arithmetic != "exact")
    throw InputError(fmt::format("--arithmetic {}: expected exact", o.arithmetic));
  if (o.all_policies) return ReplayAll(o, file);
  return in_space ? ReplayInSpace(o, file) : ReplayOne(o, file);
}

}  // namespace

void AddReplay(CommandLine& program) {
  auto [verb, o] =
      program.Add("replay", "Follow the published algorithm pivot by pivot; in the plane exactly", Replay);
  verb.Positional("FILE", o.file, "stiction-problem file").Required();
  AddPolicyOption(verb, o.policy, Grid::kRefused);
  verb.Flag("--all-policies", o.all_policies,
            "the outcome under every policy of the planar grid, or of those that are built for space");
  verb.Option("--record", o.record, "write the problem with what happened as its `expect`")
      .Needs("--all-policies");
  verb.Option("--method", o.method, "what to follow")
      .Choices(
          {{"baraff", "the published algorithm"}, {"complete", "complete driving on polygons, in space only"}});
  verb.Option("--arithmetic", o.arithmetic, "exact; for the published algorithm in space double by default")
      .OneOf({"exact", "float", "double", "long-double"});
  verb.Option("--sides", o.sides, "sides of the friction polygons of --method complete, a multiple of 4")
      .Check([](const std::string& text) {
        const int sides = std::atoi(text.c_str());
        return sides >= 4 && sides % 4 == 0 ? "" : "expected a multiple of 4, at least 4";
      });
  verb.Flag("--step", o.step, "directions, forces and sets at every step");
  verb.Flag("--json", o.json, "machine output");
  AddLimits(verb, o.limits);
}

}  // namespace stiction
