// SPDX-License-Identifier: Apache-2.0
// stiction replay: a path method on one problem, step by step, exactly where it is built so.

#include <fmt/format.h>

#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "certify/exact/answer_json.h"
#include "certify/request/request.h"
#include "certify/request/solve_in.h"
#include "cli/command_line.h"
#include "cli/narration/followed.h"
#include "cli/narration/narrate_text.h"
#include "cli/narration/published_ends.h"
#include "cli/playable.h"
#include "cli/shared.h"
#include "cli/words.h"
#include "corpus/grouped.h"
#include "corpus/json.h"
#include "corpus/plain_text.h"
#include "corpus/rounded.h"
#include "reports/pictures/moving_picture.h"
#include "reports/pictures/problem_picture.h"

namespace stiction {
namespace {

struct ReplayOptions : Wanted {
  ReplayOptions() { method = "baraff"; }

  std::string file;
  bool all_policies = false;
  bool step = false;
  bool json = false;
  bool list = false;       // with all_policies: every policy
  bool fractions = false;  // for people, in full
  std::string record, html, svg;

  FractionText as() const { return fractions ? FractionText::kFull : FractionText::kShort; }
};

// ---- What stands before a run ----------------------------------------------------------------

std::string FrictionText(const ExactProblem& problem, FractionText fractions) {
  std::string text;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const Contact<Rational>& contact = problem.contacts[i];
    const bool rubs = contact.kind == ContactKind::kStatic || contact.kind == ContactKind::kSliding;
    text += fmt::format("{}contact {} {}", i == 0 ? "  " : ", ", i + 1,
                        rubs ? "mu = " + Text(contact.mu, fractions) : std::string(Name(contact.kind)));
  }
  return text + "\n";
}

// A and b as a table with the names of the variables, and mu of every contact. Of many rows only how many there
// are.
std::string ProblemText(const ExactProblem& problem, FractionText fractions) {
  constexpr int kMostRows = 24;
  const int rows = static_cast<int>(problem.rows());
  if (rows == 0) return "The problem has no contact.\n";
  if (rows > kMostRows) return fmt::format("The problem a = A f + b has {} rows: see its file.\n", rows);
  const VariableTexts names(problem);
  std::vector<std::string> head = {"a = A f + b"};
  for (int j = 0; j < rows; ++j) head.push_back("f_" + names.Component(j));
  head.emplace_back("b");
  TextTable table(std::move(head), 1);
  for (int i = 0; i < rows; ++i) {
    std::vector<std::string> row = {"  a_" + names.Component(i)};
    for (int j = 0; j < rows; ++j) row.push_back(Text(problem.A(i, j), fractions));
    row.push_back(Text(problem.b[i], fractions));
    table.AddRow(std::move(row));
  }
  return "The problem:\n" + table.Done() + FrictionText(problem, fractions) + "\n";
}

// ---- One policy ------------------------------------------------------------------------------

template <class Scalar>
std::string WholeEnd(const Answer<Scalar>& answer, const Solution& solution) {
  const bool proved = kIsExact<Scalar>;
  std::string text;
  if (solution.suspected)
    text = fmt::format("{}\nrun again{}: ", EndText(*solution.suspected, false),
                       proved ? ", exactly" : " over quad, with finer tolerances");
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
        return fmt::format("{}: {}{}, {}, {}\n{}{}{}", file.name,
                           Counted(static_cast<std::int64_t>(file.problem.contacts().size()), "contact"),
                           file.problem.dimension() == 3 ? " in space" : "", reading, Name(answer.arithmetic),
                           o.step ? ProblemText(file.problem, o.as()) : "",
                           o.step ? narration.steps : narration.table, WholeEnd(answer, solution));
      },
      solution.answer);
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
  add("sides", o.request.sides, usual.request.sides);
  Limits limits = o.request.limits, usual_limits;
  ForEachField(limits, [&](const NumberRow& row, std::int64_t value) {
    ForEachField(usual_limits, [&](const NumberRow& other, std::int64_t as_usual) {
      if (std::string_view(row.name) == other.name) add(std::string(row.name), value, as_usual);
    });
  });
  return command + " --html OUT";
}

void WritePage(const ReplayOptions& o, const ProblemFile& file, const Solution& solution,
               const std::optional<InexactAnswer>& over_intervals) {
  const Playable playable =
      PlayableOf(o, file, PictureBeside(file, o.file), solution, over_intervals, o.file, CommandOf(o));
  WriteText(o.html, ViewerPage(file.name + ", step by step", playable.data, playable.origin));
}

// The period of a loop, again and again; all of another run.
void WriteMovingPicture(const ReplayOptions& o, const Request& request, const ProblemFile& file,
                        const Solution& solution) {
  constexpr std::size_t kMostStills = 200;
  constexpr double kSeconds = 1.1;
  const SharedJson picture = PictureBeside(file, o.file);
  if (!picture)
    throw InputError(o.file, "--svg", "a problem without its scene",
                     "a scene; --html makes a page of any problem");
  const FollowedRun run = Followed(request, file, solution);
  const Json& replay = run.replay;
  const bool loops = replay["outcome"] == "cycle";
  const std::int64_t start = loops ? replay["start"].get<std::int64_t>() : 0;
  std::vector<Still> stills;
  for (std::size_t k = 0; k < replay["pivots"].size(); ++k) {
    const Json &pivot = replay["pivots"][k], &told = run.narration.told[k];
    if (told["group"].get<std::int64_t>() <= start) continue;
    Still& still = stills.emplace_back();
    for (const Json& f : pivot["f"])
      still.forces.push_back(f.is_string() ? ToDouble(*ParseRational(f.get<std::string>())) : f.get<double>());
    still.caption =
        fmt::format("{} {}, {}: {}", o.method == "baraff" ? "drive" : "stage", JsonText(told["group"]),
                    told["label"].get<std::string>(), told["event"].get<std::string>());
  }
  if (stills.empty() || stills.size() > kMostStills)
    throw InputError(o.file, "--svg", fmt::format("a run of {} steps", stills.size()),
                     fmt::format("1 to {}; --html makes a page of more", kMostStills));
  const std::string title = loops ? fmt::format("{}: {}, again and again", file.name,
                                                Counted(replay["period"].get<std::int64_t>(), "drive"))
                                  : fmt::format("{}: {}", file.name, run.end);
  WriteText(o.svg, MovingPicture(picture, title, stills, kSeconds));
}

int ReplayOne(const ReplayOptions& o, const ProblemFile& file) {
  const Request request = PathRequestOf(o, file.problem, o.file);
  const Solution solution = SolveAsked(file.problem, request, o.file);
  const std::string expected = o.method == "baraff" ? Expected(file, request.policy) : "";
  Narration narration = Narrate(o.method, file, solution, {o.step || !o.json, o.as()});
  const auto proved = OverIntervals(file.problem, request, solution.outcome());
  if (!o.html.empty()) WritePage(o, file, solution, proved);
  if (!o.svg.empty()) WriteMovingPicture(o, request, file, solution);
  if (o.html == "-" || o.svg == "-") return ExitOf(solution.outcome(), expected);
  if (o.json) {
    Json json = ReplayToJson(request, file, solution, std::move(narration), o.step);
    if (proved) json["over_intervals"] = EndToJson(*proved);
    json["expected"] = expected;
    std::cout << JsonText(json) << "\n";
  } else {
    std::string told = ToldForPeople(o, file, solution, narration);
    if (proved) told += OverIntervalsText(*proved) + "\n";
    if (!expected.empty() && expected != Name(solution.outcome())) told += "expected: " + expected + "\n";
    Tell("{}", told);
    if (o.step) {
      Tell("\nThe words (numbers in brackets are sections of the paper):\n{}", GlossaryOf(told));
    } else {
      Tell("(--step: the problem, all forces, and what the words mean)\n");
    }
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
    if (o.list) Tell("{:10}  {}\n", outcome, name);
  }
  for (const auto& [outcome, some] : by_outcome) {
    std::vector<std::string> common;
    for (const PolicySwitchRow& row : PolicySwitches()) {
      if (const std::string text = InCommon(row, some, grid); !text.empty()) common.push_back(text);
    }
    const bool all = some.size() == grid.size();
    Tell("{}: {} policies{}{}\n", outcome,
         all ? fmt::format("all {}", grid.size()) : fmt::format("{} of {}", some.size(), grid.size()),
         common.empty() ? "" : ", all with ", fmt::join(common, ", "));
  }
  if (!o.list && by_outcome.size() > 1) Tell("(--list: a line for every policy)\n");
}

int ReplayAll(const ReplayOptions& o, const ProblemFile& file) {
  const auto by_name = OutcomesOf(o, file.problem, o.file);
  const std::vector<Policy> grid = GridOf(file.problem.dimension());
  const std::string_view arithmetic = Name(PathRequestOf(o, file.problem, o.file).arithmetic);
  Json outcomes = Json::object(), counts = Json::object(), unexpected = Json::array();
  for (const Policy& policy : grid) {
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
    std::cout << JsonText({{"policies", outcomes},
                           {"arithmetic", arithmetic},
                           {"counts", counts},
                           {"unexpected", unexpected}})
              << "\n";
  } else {
    PrintOutcomes(o, grid, outcomes);
    if (arithmetic != "exact") Tell("({}: rounded runs, which prove nothing about the file)\n", arithmetic);
    if (!unexpected.empty())
      Tell("{}: {}\n", file.expect.empty() ? "not solved" : "not as expected",
           Counted(static_cast<std::int64_t>(unexpected.size()), "policy"));
  }
  return unexpected.empty() ? kExitDone : kExitNotSo;
}

int Replay(const ReplayOptions& o) {
  const ProblemFile file = ReadProblem(o.file);
  if (!o.all_policies) return ReplayOne(o, file);
  if (!o.html.empty()) throw InputError("--html: found --all-policies, expected one policy");
  if (!o.svg.empty()) throw InputError("--svg: found --all-policies, expected one policy");
  return ReplayAll(o, file);
}

std::vector<AllowedValue> PathMethodChoices() {
  std::vector<AllowedValue> choices;
  for (const MethodFacts& facts : AllMethods()) {
    if (facts.HasPath()) choices.push_back({std::string(facts.name), std::string(facts.title)});
  }
  return choices;
}

}  // namespace

const ListedVerb kReplayVerb("Show", 10, [](CommandLine& program) {
  auto [verb, o] = program.Add("replay", "Follow a path method step by step, exactly where it can be", Replay);
  verb.Positional("FILE", o.file, kFileHelp).Required().Details(kFileDetails);
  AddPolicyOption(verb, o.policy, Grid::kRefused);
  verb.Flag("--all-policies", o.all_policies,
            "the outcome under every policy of the planar grid, or of those that are built for space");
  verb.Flag("--list", o.list, "a line for every policy, before the summary").Needs("--all-policies");
  verb.Option("--record", o.record, "write the problem with what happened as its `expect`")
      .Needs("--all-policies");
  verb.Option("-m,--method", o.method, "what to follow").Choices(PathMethodChoices());
  verb.Option("-a,--arithmetic", o.arithmetic, "exact where it is built, otherwise double, by default")
      .OneOf({kPathArithmetics.begin(), kPathArithmetics.end()});
  verb.Option("--sides", o.request.sides, "sides of the friction polygons in space, a multiple of 4")
      .Check(CheckSides);
  verb.Flag("--step", o.step, "the problem; directions, forces and sets at every step; what the words mean");
  verb.Flag("--fractions", o.fractions,
            "long fractions in full, which are rounded otherwise, in text for people");
  verb.Option("--html", o.html,
              "write a page to step through the run, beside complete driving; - is standard output");
  verb.Option("--svg", o.svg, "write a picture that moves, of a scene: the forces of a loop, again and again");
  verb.Prints(o.json, "a run, step by step; or how it ends under every policy", R"({
      ...solution, start: integer, period: integer,
      expected: text,  // what the file expects; empty: nothing
      initial?: {f: vector, a: vector}, over_intervals?: end,
      pivots: [{  // steps of the published algorithm, pieces of complete driving, or pivots of Lemke's method
        drive?: integer, driven?: text, goal?: "establish" | "zero", step: any_number, limiting?: text,
        from?: text, to?: text, df?: vector, f?: vector, a?: vector, word?: text, determinant?: -1 | 0 | 1,
        event?: text, pivot?: integer, entering?: text, leaving?: text, z0?: any_number, sets?: {*: text},
        recorded?: {*: [any_number]}, turned_away?: truth}]
    } | {
      policies: {*: end}, arithmetic: arithmetic, counts: counters,
      unexpected: [text]  // policies that end otherwise than the file expects, or, without, unsolved
    })");
  AddLimits(verb, o.request.limits);
});

}  // namespace stiction
