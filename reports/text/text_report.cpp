// SPDX-License-Identifier: Apache-2.0
#include "reports/text/text_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <vector>

#include "corpus/grouped.h"
#include "corpus/json_text.h"
#include "corpus/plain_text.h"
#include "corpus/program_name.h"
#include "corpus/record/kinds.h"
#include "corpus/record/problem_file.h"
#include "corpus/store/finding_words.h"
#include "corpus/store/store_totals.h"
#include "reports/tables/campaign_tables.h"
#include "reports/told/facts.h"
#include "reports/told/report_txt.h"

namespace stiction {
namespace {

constexpr std::size_t kShown = 10;       // loops of a list
constexpr std::size_t kShownOfTwo = 5;   // likewise on two screens
constexpr int kMostRowsInNumbers = 12;   // of a matrix on the page
constexpr std::size_t kLongestWord = 9;  // of its numbers

// What a label means, for someone who has not read the paper.
std::string InWords(const std::string& label) {
  static const std::map<std::string, std::string> words = {
      {"safe-cycle", "loop for ever though safe, which ties alone can make"},
      {"disagreement-of-methods", "methods that prove contradict each other"},
      {"cycle", "loop for ever"},
      {"stall", "loop inside one drive"},
      {"singular", "no direction of the forces exists"},
      {"ray", "a step without limit"},
      {"limit", "budget spent before an end"},
      {"undecided", "intervals cannot tell"},
      {"wrong-answer", "doubles: solved, and it is not"}};
  const auto found = words.find(label);
  if (found != words.end()) return found->second;
  constexpr std::string_view kDisagreement = "disagreement-";
  if (!label.starts_with(kDisagreement)) return label;
  const std::string ends = label.substr(kDisagreement.size());
  const std::size_t dash = ends.find('-');
  return dash == ends.npos ? label
                           : fmt::format("doubles: {}, exact: {}", ends.substr(0, dash), ends.substr(dash + 1));
}

// How the algorithm fails, in exact arithmetic or, in space, over intervals.
Table Failures(const StoreTotals& t) {
  Table table{"failures", "", Columns("repeated_exactly* outcome* runs in_a_million_[95_%]")};
  table.keys = 2;
  for (int i = 0; i < kOutcomeCount; ++i) {
    const std::string name(kOutcomeNames[i]);
    const std::int64_t count = t.counts.exact[i];
    if (i != static_cast<int>(Outcome::kSolved) && count > 0)
      table.Add({InWords(name), name, count, RateOf(count, t.counts.runs)});
  }
  return table;
}

// What a label of doubles says, which is no disagreement of the exact methods.
std::string OfDoublesText(const std::string& label) {
  const std::string words = InWords(label);
  return IsOfDoubles(KindOf(label + "-")) && words != label ? fmt::format(" ({})", words) : "";
}

// Groups of findings, by kind.
std::string GroupsByKind(const StoreTotals& t) {
  std::vector<std::string> parts;
  for (const auto& [label, count] : t.groups)
    parts.push_back(fmt::format("{} of {}{}", Grouped(count), label, OfDoublesText(label)));
  return fmt::format("{}", fmt::join(parts, ", "));
}

// What happens to a finished finding, minimized.
std::string FindingText(const Finding& finding) {
  const SharedJson values = MinimizedFacts(finding);
  const JsonPlace facts(values, finding.signature, "");
  std::string text = Counted(facts.Required("contacts", "a count").Integer(0, INT64_MAX, "a count"), "contact");
  if (IsLoopKind(finding.kind)) {
    text += ", " + LoopClause(ProvedRunOf(finding, FindingForm::kMinimized), UnitOfLoop(finding));
  } else {
    text += ", " + InWords(finding.kind);
  }
  std::string grid;
  for (const auto& [outcome, count] : facts.Required("grid", "outcomes").Members())
    grid += fmt::format("{}{} {}", grid.empty() ? "" : ", ", JsonText(count.json()), outcome);
  return text + (grid.empty() ? "; in space, over intervals" : "; policies: " + grid);
}

// A table of failures for each policy; `names` stand before the runs.
std::vector<Table> FailuresByPolicy(const Record& record, const By& names, const char* title = "Policy {}:") {
  By by = names;
  by.insert(by.begin(), "policy");
  Table table = CountedBy("rates", by, GroupsBy(record, by));
  for (Column& column : table.columns)
    if (column.name == "friction") column.head = "mu";
  return SplitByPolicy(table, title);
}

// That of the policy paper, or of the first.
std::vector<Table> FailuresOfOnePolicy(const Record& record) {
  std::vector<Table> tables = FailuresByPolicy(record, {"generator"});
  const auto paper = std::ranges::find(tables, "Policy paper:", &Table::caption);
  if (paper != tables.end()) return {*paper};
  tables.resize(std::min<std::size_t>(tables.size(), 1));
  return tables;
}

// A and b, and mu, if they fit.
void AddNumbers(Facts& facts, const ExactProblem& problem) {
  Table table{"problem", "", std::vector<Column>(static_cast<std::size_t>(problem.rows()) + 2)};
  table.columns.front().name = "A";
  table.columns.back().name = "b";
  std::size_t longest = 0;
  for (int row = 0; row < problem.rows() && problem.rows() <= kMostRowsInNumbers; ++row) {
    std::vector<TableCell> cells = {""};
    for (int column = 0; column < problem.rows(); ++column)
      cells.emplace_back(ToString(problem.A(row, column)));
    cells.emplace_back(ToString(problem.b[row]));
    for (const TableCell& cell : cells) longest = std::max(longest, Shown(cell).size());
    table.Add(std::move(cells));
  }
  std::vector<std::string> mu;
  for (const auto& contact : problem.contacts)
    mu.push_back(contact.HasFrictionRows() ? ToString(contact.mu) : std::string(Name(contact.kind)));
  facts.tables["numbers"] = [table] { return std::vector<Table>{table}; };
  facts.texts["mu"] = fmt::format("{}", fmt::join(mu, ", "));
  facts.texts["numbers_are"] = problem.rows() > kMostRowsInNumbers ? "many" : "long";
  facts.numbers["simplest_fits"] = problem.rows() <= kMostRowsInNumbers && longest <= kLongestWord;
}

void AddSimplest(Facts& facts, const StoreTotals& t) {
  const auto first = std::ranges::find_if(t.simplest, [](const Finding& f) { return IsLoopKind(f.kind); });
  if (first == t.simplest.end()) return;
  facts.texts["simplest"] = first->signature;
  facts.texts["simplest_story"] = FindingText(*first);
  facts.texts["simplest_file"] = "report/findings/" + FileName(first->signature) + ".json";
  facts.texts["replay_options"] = ReplayOptionsOf(*first);
  facts.texts["simplest_unit"] = std::to_string(first->unit);
  facts.texts["simplest_index"] = std::to_string(first->index);
  AddNumbers(facts, ParseProblem(first->minimized, first->signature).problem);
}

void AddNewLoops(Facts& facts, const StoreTotals& t, const KnownCase& known_as, std::size_t shown) {
  std::vector<std::pair<std::string, std::int64_t>> unknown;
  for (const auto& [signature, count] : t.record.signatures)
    if (IsLoopKind(KindOf(signature)) && known_as(signature).empty()) unknown.emplace_back(signature, count);
  facts.numbers["new_loops"] = std::ssize(unknown);
  facts.numbers["new_shown"] = static_cast<std::int64_t>(shown);
  facts.numbers["too_many_new"] = unknown.size() > shown;
  std::ranges::stable_sort(unknown, std::greater(), &std::pair<std::string, std::int64_t>::second);
  unknown.resize(std::min(shown, unknown.size()));
  Table table{"new", "", Columns("signature* runs")};
  for (const auto& [signature, count] : unknown) table.Add({signature, count});
  facts.tables["new"] = [table] { return std::vector<Table>{table}; };
}

// "0.1.0 2060e9f249a5, GNU 12.2.0 Release" of a build, whose flags follow.
std::string WithoutFlags(const std::string& build) {
  const std::size_t first = build.find(',');
  return first == build.npos ? build : build.substr(0, build.find(',', first + 1));
}

// But for machines and processor times, which `status` tells: equal searches give equal reports. On two screens
// what makes its problems.
void AddSearched(Facts& facts, const CampaignIdentity& identity, const StoreTotals& t) {
  Lines &all = facts.lists["searched"], &short_one = facts.lists["makes_problems"];
  for (const auto& [key, value] : PlainValues(ToldDefinition(identity))) {
    if (key == "format" || key == "version") continue;
    all.emplace_back(fmt::format("{}: {}", key, value), "");
    if (key == "generators" || key == "contacts" || key == "mu" || key == "note")
      short_one.push_back(all.back());
  }
  if (all.empty()) all = short_one = {{identity.definition, ""}};
  all.emplace_back("policies: " + PlainValue(JsonOrText(identity.policies)), "");
  Lines& builds = facts.lists["builds"];
  for (const std::string& build : t.work.builds) builds.emplace_back("build: " + WithoutFlags(build), "");
  facts.lists["build"] = builds.empty() ? Lines() : Lines{builds.front()};
}

Facts TextFacts(const Store& store, const StoreTotals& t, const std::string& file) {
  Facts facts = FactsOf(t, store.identity());
  facts.texts.insert({{"file", file},
                      {"file_word", ShellWord(file)},
                      {"program", ProgramName()},
                      {"groups_by_kind", GroupsByKind(t)},
                      {"finish", FinishCommand(file)},
                      {"time", TimeText(t.work.time)},
                      {"simplest", ""}});
  facts.numbers["fails"] = t.counts.runs > 0 && !Failures(t).rows.empty();
  facts.tables["failures"] = [&t] { return std::vector<Table>{Failures(t)}; };
  Lines &grave = facts.lists["grave"], &remarks = facts.lists["remarks"],
        &simplest = facts.lists["simplest_ones"];
  for (const Finding& finding : t.grave)
    grave.emplace_back(fmt::format("GRAVE: {}: {}", finding.kind, finding.signature), "");
  for (const auto& [name, value] : PlainValues(RemarksOf(store.identity())))
    remarks.emplace_back(fmt::format("{}: {}", name, value), "");
  for (std::size_t i = 0; i < std::min(kShown, t.simplest.size()); ++i)
    simplest.emplace_back(t.simplest[i].signature, FindingText(t.simplest[i]));
  return facts;
}

}  // namespace

std::string SummaryText(const Store& store, const std::string& file) {
  const StoreTotals t = TotalsOf(store);
  return ToText(Tell(kReportTxt, TextFacts(store, t, file), {"summary"}), "summary");
}

std::string TextReport(const Store& store, const std::string& file, const KnownCase& known_as, Extent extent) {
  const StoreTotals t = TotalsOf(store);
  Facts facts = TextFacts(store, t, file);
  AddSimplest(facts, t);
  AddNewLoops(facts, t, known_as, extent == Extent::kAll ? kShown : kShownOfTwo);
  AddSearched(facts, store.identity(), t);
  facts.tables["rates"] = [&t] { return FailuresOfOnePolicy(t.record); };
  facts.tables["all_rates"] = [&t] { return FailuresByPolicy(t.record, {"generator", "contacts"}); };
  facts.tables["friction_rates"] = [&t] {
    return FailuresByPolicy(t.record, {"friction"}, "Policy {}, all generators together:");
  };
  const std::string medium = extent == Extent::kAll ? "all" : "text";
  return ToText(Tell(kReportTxt, facts, {medium}), medium);
}

}  // namespace stiction
