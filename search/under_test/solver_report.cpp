// SPDX-License-Identifier: Apache-2.0
#include "search/under_test/solver_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "corpus/grouped.h"
#include "corpus/intervals.h"
#include "corpus/json.h"
#include "corpus/plain_text.h"
#include "corpus/program_name.h"
#include "corpus/record/fields.ipp"
#include "corpus/record/kinds.h"
#include "corpus/record/problem_file.h"
#include "corpus/store/store_totals.h"
#include "search/campaign.h"
#include "search/families.h"

namespace stiction {
namespace {

// Counters that tell how it fails, by kind; what is 0 is left out.
std::map<std::string, std::int64_t> FailuresOf(const UnderTestTally& tally) {
  std::map<std::string, std::int64_t> failures;
  ForEachCounter(tally, [&failures](std::string_view name, std::int64_t count) {
    std::string kind(name);
    std::ranges::replace(kind, '_', '-');
    if (count > 0 && IsOfSolver(kind)) failures[kind] = count;
  });
  return failures;
}

// What problems are like, each with its values in order.
struct Aspect {
  const char* name;
  std::string (*value)(const UnderTestKey& key);
};
constexpr auto kAspects = std::to_array<Aspect>({
    {"generator", [](const UnderTestKey& key) { return key.generator; }},
    {"contacts", [](const UnderTestKey& key) { return std::to_string(key.contacts); }},
    {"mu", [](const UnderTestKey& key) { return key.friction; }},
    {"rank", [](const UnderTestKey& key) { return std::to_string(key.rank); }},
    {"spread", [](const UnderTestKey& key) { return fmt::format("1e{}", key.spread); }},
});

// Numbers as numbers: of texts the shorter first.
struct ByValue {
  bool operator()(const std::string& left, const std::string& right) const {
    return std::pair(left.size(), left) < std::pair(right.size(), right);
  }
};
using TallyByValue = std::map<std::string, UnderTestTally, ByValue>;

TallyByValue By(const Aspect& aspect, const Record& record) {
  TallyByValue tallies;
  for (const auto& [key, tally] : record.under_test) AddCounters(tallies[aspect.value(key)], tally);
  return tallies;
}

struct TestedStore {
  const Store& store;
  Campaign campaign;
  StoreTotals totals;
  UnderTestTally sum;

  static TestedStore Of(const Store& store, const std::string& file) {
    TestedStore tested = {store, CampaignOf(store.identity(), file), TotalsOf(store), {}};
    for (const auto& [key, tally] : tested.totals.record.under_test) AddCounters(tested.sum, tally);
    return tested;
  }
};

// Finished findings first, the smallest of them first.
std::vector<Finding> BySize(const Store& store) {
  std::vector<Finding> findings = store.Findings();
  const auto size = [](const Finding& finding) {
    const std::string& problem = finding.minimized.empty() ? finding.problem : finding.minimized;
    return std::tuple(finding.minimized.empty(), problem.size());
  };
  std::ranges::stable_sort(findings, {}, size);
  return findings;
}

Json ShareToJson(std::int64_t count, std::int64_t of) {
  const Interval share = ShareInterval(count, of);
  return {{"count", count}, {"low", share.low}, {"high", share.high}};
}

Json AspectsToJson(const TestedStore& s) {
  Json rows = Json::array();
  for (const Aspect& aspect : kAspects) {
    for (const auto& [value, tally] : By(aspect, s.totals.record)) {
      Json failures = Json::object();
      for (const auto& [kind, count] : FailuresOf(tally)) failures[kind] = ShareToJson(count, tally.problems);
      rows.push_back(
          {{"aspect", aspect.name}, {"value", value}, {"problems", tally.problems}, {"failures", failures}});
    }
  }
  return rows;
}

Json CountersOf(const TestedStore& s) {
  Json counters = Json::object();
  ForEachCounter(s.sum, [&counters](const char* name, std::int64_t value) { counters[name] = value; });
  return counters;
}

using T = TestedStore;
constexpr auto kTestedMembers = std::to_array<ToldOf<T>>({
    {"seed", "integer", "", [](const T& s) -> Json { return s.campaign.seed; }},
    {"solver", "{name: text, version: text, law: text, accuracy: text}", "the solver under test",
     [](const T& s) { return kSolverForm.write(s.campaign); }},
    {"units", "integer", "", [](const T& s) -> Json { return s.totals.units; }},
    {"families", "{tried: integer, of: integer, not_reached: [text]}", "generators at numbers of contacts",
     [](const T& s) -> Json { return FamiliesToJson(s.store); }},
    {"counts", "counters", "problems by what came of them", CountersOf},
    {"passed", "{count: integer, low: number, high: number}", "with the interval of its share at 95 %",
     [](const T& s) { return ShareToJson(s.sum.passed, s.sum.problems); }},
    {"aspects", "[{aspect: text, value: text, problems: integer, failures: {*: any}}]",
     "how often it fails, by what problems are like", AspectsToJson},
    {"groups", "[{signature: text, kind: text, count: integer, facts: object}]", "findings, the smallest first",
     [](const T& s) { return GroupsToJson(s.store); }},
    {"finished", "integer", "", [](const T& s) -> Json { return s.totals.finished; }},
    {"pending", "integer", "", [](const T& s) -> Json { return s.totals.pending; }},
    {"builds", "[text]", "", [](const T& s) -> Json { return s.totals.work.builds; }},
    {"machines", "[text]", "", [](const T& s) -> Json { return s.totals.work.machines; }},
});

// "crash 3: 12 [2.4, 35.1] in a million"
std::string FailuresText(const UnderTestTally& tally) {
  std::string text;
  for (const auto& [kind, count] : FailuresOf(tally))
    text += fmt::format("{}{} {}: {} in a million", text.empty() ? "" : ", ", kind, Grouped(count),
                        RateText(count, tally.problems));
  return text.empty() ? "no failure" : text;
}

std::string GroupText(const Finding& finding, std::int64_t count) {
  const Json facts = ParseJson(finding.facts, finding.signature);
  std::string text = fmt::format("  {:44} {} times", finding.signature, Grouped(count));
  if (facts.contains("minimized")) {
    const int contacts = facts["minimized"]["contacts"].get<int>();
    text += fmt::format(", minimized to {} contact{}", contacts, contacts == 1 ? "" : "s");
  }
  if (facts.contains("scene")) {
    const int contacts = facts["scene"]["contacts"].get<int>();
    text += fmt::format(", as a scene to {}", contacts);
  }
  if (facts.contains("alone") && !facts["alone"].get<bool>()) text += ", not by its problem alone";
  if (!finding.done) text += ", not finished";
  return text + "\n";
}

}  // namespace

bool TestsSolver(const Store& store, const std::string& file) {
  return !CampaignOf(store.identity(), file).solver.name.empty();
}

std::string FinishTestedCommand(const std::string& file, const std::string& solver) {
  return fmt::format("{} --solver {}", FinishCommand(file), solver);
}

std::string SolverText(const Store& store, const std::string& file, const std::string& solver_file) {
  const TestedStore s = TestedStore::Of(store, file);
  const SolverUnderTest& solver = s.campaign.solver;
  std::string text = fmt::format(
      "{}: {} problems for {} {}, seed {}\n  law {}, judged to the accuracy that it states, {}\n  passed: {}\n",
      file, Grouped(s.sum.problems), solver.name, solver.version, s.campaign.seed,
      kSolverLawNames[static_cast<std::size_t>(solver.law)], solver.accuracy,
      ShareText(s.sum.passed, s.sum.problems));
  text += fmt::format("  failures: {}\n", FailuresText(s.sum));
  const auto tell = [&text](const char* what, std::int64_t count) {
    if (count > 0) text += fmt::format("  {}: {}\n", what, Grouped(count));
  };
  // Bounds of findex are not unique where the matrix of the normals is singular.
  const bool by_findex = solver.law == SolverLaw::kFindex;
  tell(by_findex ? "given up, where bounds of friction are not unique: nothing is said of these"
                 : "given up, where no solution of its law is known: nothing is said of these",
       s.sum.refused);
  tell("called solved, where bounds of friction are not unique: not judged", s.sum.unjudged);
  tell("passed, and further from Coulomb's law than its accuracy", s.sum.misses_coulomb);
  tell("passed by the largest units, and not solved by the strict ones", s.sum.neither);
  for (const auto& [name, value] : PlainValues(RemarksOf(store.identity())))
    text += fmt::format("  {}: {}\n", name, value);
  for (const Aspect& aspect : kAspects) {
    text += fmt::format("by {}{}:\n", aspect.name,
                        std::string_view(aspect.name) == "spread" ? " of A's diagonal, which masses make" : "");
    for (const auto& [value, tally] : By(aspect, s.totals.record))
      text += fmt::format("  {:16} {:>12} problems: {}\n", value, Grouped(tally.problems), FailuresText(tally));
  }
  text = Folded(text + GroupsText(store));
  if (s.totals.pending > 0)
    text +=
        fmt::format("What is not finished is finished by:\n    {}\n", FinishTestedCommand(file, solver_file));
  if (const std::vector<Finding> findings = BySize(store); !findings.empty())
    text += fmt::format(
        "More --problems or --minutes go on from here.\nA finding as a problem file, and as a "
        "program:\n    {0} problem {1} {2}\n"
        "    {0} export {1}:{2} --reproducer c -o {2}.c\n",
        ProgramName(), file, findings.front().signature);
  return text;
}

// At least once: its unit may not be whole.
static std::int64_t CountOf(const Finding& finding, const std::map<std::string, std::int64_t>& signatures) {
  const auto counted = signatures.find(finding.signature);
  return counted == signatures.end() ? 1 : counted->second;
}

std::string GroupsText(const Store& store) {
  const auto signatures = store.Total().signatures;
  std::string text;
  for (const Finding& finding : BySize(store)) text += GroupText(finding, CountOf(finding, signatures));
  return text.empty() ? "" : "findings, the smallest first:\n" + text;
}

Json GroupsToJson(const Store& store) {
  const auto signatures = store.Total().signatures;
  Json groups = Json::array();
  for (const Finding& finding : BySize(store)) {
    groups.push_back({{"signature", finding.signature},
                      {"kind", finding.kind},
                      {"count", CountOf(finding, signatures)},
                      {"facts", ParseJson(finding.facts, finding.signature)}});
  }
  return groups;
}

Json SolverToJson(const Store& store) {
  Json json;
  WriteTold<T>(kTestedMembers, TestedStore::Of(store, "summary"), json);
  return json;
}

std::string ShapeOfSolver() { return ShapeOf<T>(kTestedMembers); }

}  // namespace stiction
