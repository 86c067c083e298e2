// SPDX-License-Identifier: Apache-2.0
// Sections of the page that say what was counted.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "corpus/counts.h"
#include "corpus/intervals.h"
#include "corpus/kinds.h"
#include "reports/page/page.h"

namespace stiction {
namespace {

constexpr std::array<std::string_view, kOutcomeCount> kMeaning = {
    "forces that satisfy every condition",
    "the outer state recurs exactly: the algorithm never ends",
    "within one drive the inner state recurs exactly: the drive never ends",
    "nothing limits the step",
    "the direction system has no solution",
    "a budget of drives, pivots or bits is spent",
    "a sign could not be told"};

using Outcomes = Tally::Outcomes;

std::int64_t Sum(const Outcomes& counts) {
  std::int64_t sum = 0;
  for (const std::int64_t count : counts) sum += count;
  return sum;
}

HtmlCell Count(std::int64_t count, const std::string& style = "") {
  return {Text(Grouped(count)), count == 0 ? "zero" : style};
}

// Of `count` in `total` per million, as a colour: one class per factor of ten.
std::string Heat(std::int64_t count, std::int64_t total) {
  if (count == 0 || total == 0) return "";
  const double rate = 1e6 * static_cast<double>(count) / static_cast<double>(total);
  int level = 1;
  for (double limit = 10; level < 5 && rate >= limit; limit *= 10) ++level;
  return fmt::format("h{}", level);
}

// A count above its rate per million and the interval of that.
HtmlCell CountAndRate(std::int64_t count, std::int64_t total, bool heat) {
  if (count == 0) return Count(0);
  return {Text(Grouped(count)) + Tag("small")(RateText(count, total)), heat ? Heat(count, total) : ""};
}

using GeneratorAndContacts = std::pair<std::string, int>;
GeneratorAndContacts ByGeneratorAndContacts(const TallyKey& key) { return {key.generator, key.contacts}; }

std::string ByGenerator(const TallyKey& key) { return key.generator; }

Tally AllOf(const Record& total) { return MergeBy(total, [](const TallyKey&) { return 0; })[0]; }

// Method and arithmetic are named only where they are not the published algorithm in doubles.
std::string PolicyText(const TallyKey& key) {
  const TallyKey usual;
  if (key.method == usual.method && key.arithmetic == usual.arithmetic) return key.policy;
  return fmt::format("{} ({}, {})", key.policy, key.method, key.arithmetic);
}

// Tells where the next group of rows starts.
class Groups {
 public:
  std::string Style(const std::string& group) {
    const bool starts = !first_ && group != group_;
    first_ = false;
    group_ = group;
    return starts ? "group" : "";
  }

 private:
  bool first_ = true;
  std::string group_;
};

// ---- Outcomes ----

// Generators down, contacts across: how often a run is not solved.
Html UnsolvedMap(const Record& total) {
  const auto merged = MergeBy(total, &ByGeneratorAndContacts);
  std::set<std::string> generators;
  std::set<int> contacts;
  for (const auto& [key, tally] : merged) {
    generators.insert(key.first);
    contacts.insert(key.second);
  }
  std::vector<Column> columns = {{"generator", "", false}};
  for (const int n : contacts) columns.push_back({Counted(n, "contact")});
  Table table("Runs not solved in doubles, per million", columns);
  for (const std::string& generator : generators) {
    std::vector<HtmlCell> cells = {{Text(generator)}};
    for (const int n : contacts) {
      const auto found = merged.find({generator, n});
      const std::int64_t problems = found == merged.end() ? 0 : found->second.problems;
      const std::int64_t unsolved = problems == 0 ? 0 : problems - found->second.outcomes[0];
      cells.push_back({Text(RateText(unsolved, problems)), unsolved == 0 ? "zero" : Heat(unsolved, problems)});
    }
    table.AddRow(cells);
  }
  return table.Done();
}

// No rate of what is solved, which differs from all in digits that a rate does not show.
std::vector<HtmlCell> OutcomeCells(const Tally& tally) {
  std::vector<HtmlCell> cells = {Count(tally.problems)};
  for (int i = 0; i < kOutcomeCount; ++i) {
    const std::int64_t count = tally.outcomes[i];
    const bool solved = i == static_cast<int>(Outcome::kSolved);
    cells.push_back(solved ? Count(count) : CountAndRate(count, tally.problems, true));
  }
  return cells;
}

std::vector<HtmlCell> Joined(std::vector<HtmlCell> left, const std::vector<HtmlCell>& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

Html OutcomeTable(const Record& total) {
  std::vector<Column> columns = {{"generator", "", false}, {"contacts"}, {"policy", "", false}, {"problems"}};
  for (int i = 0; i < kOutcomeCount; ++i)
    columns.push_back({std::string(kOutcomeNames[i]), std::string(kMeaning[i])});
  Table table("Outcomes per generator, number of contacts and policy", columns);
  Groups groups;
  for (const auto& [key, tally] : MergeBy(total, [](const TallyKey& key) { return key; })) {
    const std::vector<HtmlCell> names = {
        {Text(key.generator)}, {Text(Grouped(key.contacts))}, {Text(PolicyText(key))}};
    table.AddRow(Joined(names, OutcomeCells(tally)), 3, groups.Style(key.generator));
  }
  table.AddRow(Joined({{Text("all")}, {}, {}}, OutcomeCells(AllOf(total))), 3, "total");
  return table.Done();
}

// ---- Doubles ----

std::string InexactName(int outcome) {
  return outcome == static_cast<int>(Outcome::kSolved) ? "solved, but wrong"
                                                       : std::string(kOutcomeNames[outcome]);
}

std::vector<HtmlCell> VerdictCells(const Outcomes& exact, int confirmed) {
  std::vector<HtmlCell> cells = {Count(Sum(exact))};
  for (int i = 0; i < kOutcomeCount; ++i) cells.push_back(Count(exact[i], i == confirmed ? "same" : ""));
  return cells;
}

Html VerdictTable(const Tally& all) {
  std::vector<Column> columns = {{"in doubles", "how the run ended in double arithmetic", false},
                                 {"runs", "all of these are repeated exactly"}};
  for (const std::string_view name : kOutcomeNames)
    columns.push_back({std::string(name), "outcome of the exact run"});
  columns.push_back({"confirmed", "the exact run ended in the same outcome"});
  Table table("Suspicious runs in doubles and their exact outcome", columns);
  for (int inexact = 0; inexact < kOutcomeCount; ++inexact) {
    const Outcomes& exact = all.verdicts[inexact];
    if (Sum(exact) == 0) continue;
    // A solution that is wrong is never confirmed by another one that is right.
    const int same = inexact == static_cast<int>(Outcome::kSolved) ? -1 : inexact;
    const HtmlCell confirmed = {same < 0 ? Text("–") : Text(Percent(exact[same], Sum(exact)))};
    table.AddRow(Joined(Joined({{Text(InexactName(inexact))}}, VerdictCells(exact, same)), {confirmed}));
  }
  return table.Done();
}

struct Suspicions {
  std::int64_t all = 0;
  std::int64_t refuted = 0;  // the exact run is solved
};

Suspicions SuspicionsOf(const Tally& tally) {
  Suspicions suspicions;
  for (const Outcomes& exact : tally.verdicts) {
    suspicions.all += Sum(exact);
    suspicions.refuted += exact[static_cast<int>(Outcome::kSolved)];
  }
  return suspicions;
}

std::vector<HtmlCell> TrustCells(const Tally& tally) {
  const Suspicions suspicions = SuspicionsOf(tally);
  return {Count(tally.problems),
          CountAndRate(suspicions.all, tally.problems, false),
          {Text(Grouped(suspicions.refuted)) + Tag("small")(Percent(suspicions.refuted, suspicions.all)),
           suspicions.refuted == 0 ? "zero" : ""},
          Count(tally.audited),
          Count(tally.misjudged),
          CountAndRate(tally.wrong, tally.problems, true)};
}

Html TrustTable(const Record& total) {
  Table table(
      "Suspicions, audits and wrong answers per generator",
      {{"generator", "", false},
       {"runs"},
       {"suspicious", "not solved, or with a wrong answer; below: per million"},
       {"refuted", "the exact run of a suspicious problem is solved; below: share of the suspicious"},
       {"audited", "run again exactly without a suspicion, as a sample"},
       {"misjudged", "audited with another exact outcome"},
       {"wrong answers", "called solved with an error above the bound of the gate; below: per million"}});
  for (const auto& [generator, tally] : MergeBy(total, &ByGenerator)) {
    table.AddRow(Joined({{Text(generator)}}, TrustCells(tally)));
  }
  table.AddRow(Joined({{Text("all")}}, TrustCells(AllOf(total))), 1, "total");
  return table.Done();
}

// ---- Pivots ----

std::vector<HtmlCell> PivotCells(const Tally& tally) {
  std::vector<HtmlCell> cells = {Count(tally.problems)};
  std::vector<std::int64_t> maxima;
  ForEachField(tally.maxima, [&](const char*, const char*, std::int64_t value) { maxima.push_back(value); });
  ForEachField(tally.sums, [&](const char*, const char*, std::int64_t sum) {
    const std::int64_t maximum = maxima[cells.size() - 1];
    cells.push_back(
        {Text(Mean(sum, tally.problems)) + Tag("small")(Grouped(maximum)), maximum == 0 ? "zero" : ""});
  });
  return cells;
}

Html PivotTable(const Record& total) {
  std::vector<Column> columns = {{"generator", "", false}, {"contacts"}, {"runs"}};
  const Statistics names;
  ForEachField(names, [&columns](const char* name, const char* help, std::int64_t) {
    std::string title = name;
    std::replace(title.begin(), title.end(), '_', ' ');
    columns.push_back({title, help});
  });
  Table table("Work per problem: mean, and maximum below", columns);
  Groups groups;
  for (const auto& [key, tally] : MergeBy(total, &ByGeneratorAndContacts)) {
    const std::vector<HtmlCell> keys = {{Text(key.first)}, {Text(Grouped(key.second))}};
    table.AddRow(Joined(keys, PivotCells(tally)), 2, groups.Style(key.first));
  }
  table.AddRow(Joined({{Text("all")}, {}}, PivotCells(AllOf(total))), 2, "total");
  return table.Done();
}

// ---- Loops ----

HtmlCell LoopsAndShare(std::int64_t count, const LoopTally& tally) {
  return {Text(Grouped(count)) + Tag("small")(ShareText(count, tally.loops)), count == 0 ? "zero" : ""};
}

Html LoopTable(const Record& total) {
  if (total.loops.empty())
    return Tag("p",
               {{"class", "note"}})(std::any_of(total.signatures.begin(), total.signatures.end(),
                                                [](const auto& met) { return IsLoopKind(KindOf(met.first)); })
                                        ? "Not counted here: those of space, and of searches with an objective."
                                        : "No loop was met.") +
           Html("\n");
  Table table("Loops in exact arithmetic, by number of contacts in the period",
              {{"contacts"},
               {"loops"},
               {"drives", "of a period: mean"},
               {"steps", "of a period: mean"},
               {"zero steps", "of a period: mean"},
               {"none", "loops without a step of length zero in the period; below: their share"},
               {"nothing else", "loops whose period has no other steps; below: their share"}});
  for (const auto& [contacts, t] : total.loops) {
    table.AddRow({{Text(Grouped(contacts))},
                  Count(t.loops),
                  {Text(Mean(t.drives, t.loops))},
                  {Text(Mean(t.steps, t.loops))},
                  {Text(Mean(t.zero_steps, t.loops))},
                  LoopsAndShare(t.without_zero_steps, t),
                  LoopsAndShare(t.of_zero_steps_alone, t)});
  }
  return table.Done();
}

}  // namespace

Html OutcomesSection(const Record& total) {
  return Section(
      "outcomes", "Outcomes",
      Html("<p>As the runs in doubles ended. Runs not solved, per million, with exact intervals at 95 %; the "
           "deeper the colour, the more, one shade for each factor of ten:</p>\n") +
          UnsolvedMap(total) +
          Html(
              "<p>All outcomes; below each count of what was not solved its rate per million problems:</p>\n") +
          OutcomeTable(total));
}

Html StepsSection(const Record& total) {
  return Section(
      "steps", "Steps per problem",
      FigurePlace("steps",
                  "Runs in doubles by the number of their steps, by number of contacts; up: their share, on a "
                  "logarithmic scale. The last bar is of all that took more.") +
          FigurePlace("pivoting",
                      "Share of the runs in doubles with a step of length zero, and of those in which a "
                      "variable was given up, by generator and number of contacts; lines: exact "
                      "intervals at 95 %.") +
          Html("<h3>Work per problem</h3>\n<p>Of the runs in doubles: the mean, and below it the maximum. A "
               "loop "
               "counts up to where it was noticed.</p>\n") +
          PivotTable(total) +
          Html("<h3>Zero steps of loops</h3>\n<p>What one period of a loop consists of, in exact "
               "arithmetic:</p>\n") +
          (total.loops.empty() ? Html()
                               : FigurePlace("loop-steps",
                                             "Loops in exact arithmetic by the number of steps of "
                                             "length zero in their period, by number of contacts.")) +
          LoopTable(total));
}

Html DoublesSection(const Record& total) {
  return Section(
      "doubles", "How often doubles lie",
      Html("<p>A run in doubles is suspicious if it does not end in a solution, or if its solution "
           "has an error above the bound of the gate. Every suspicious problem is run again in exact "
           "rational arithmetic, and so is a sample of the others. Where a generator rounds its "
           "problems to doubles, the exact run is that of the problem before rounding. Rows: "
           "how the suspicious runs ended in doubles; columns: how they end exactly.</p>\n") +
          FigurePlace("doubles",
                      "Suspicious runs by what doubles said, and what exact arithmetic says of "
                      "them.") +
          VerdictTable(AllOf(total)) + Html("<h3>By generator</h3>\n") +
          FigurePlace("trust",
                      "Share of the audited runs that doubles misjudged, and of all runs that "
                      "ended in a wrong answer; lines: exact intervals at 95 %.") +
          TrustTable(total));
}

}  // namespace stiction
