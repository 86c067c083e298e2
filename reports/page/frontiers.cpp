// SPDX-License-Identifier: Apache-2.0
#include "reports/page/frontiers.h"

#include <fmt/format.h>

#include <algorithm>

#include "corpus/grouped.h"
#include "corpus/rational.h"
#include "reports/page/page.h"
#include "reports/tables/csv.h"

namespace stiction {
namespace {

// As it stands while it is short; otherwise its decimal.
std::string ValueText(const std::string& value) {
  constexpr std::size_t kShort = 11;
  if (value.size() <= kShort) return value;
  return fmt::format("{:.6g}", ToDouble(*ParseRational(value)));
}

Html CommandCell(const std::string& command) { return Tag("code")(command); }

// In six digits, as text and as a number alike; null for what is none.
Json NumberOf(const std::string& value) {
  if (value.empty()) return nullptr;
  return Json::parse(fmt::format("{:.6g}", ToDouble(*ParseRational(value))));
}

Html RecordsTable(const std::vector<FrontierLine>& lines) {
  Table table("The worst problems that are known, each beside random problems", {{"frontier", "", false},
                                                                                 {"worst known"},
                                                                                 {"worse is", "", false},
                                                                                 {"best of random problems"},
                                                                                 {"of so many"},
                                                                                 {"found by", "", false}});
  for (const FrontierLine& line : lines) {
    table.AddRow({{Text(line.what) + Html(" ") + Tag("small")(line.status)},
                  {Text(ValueText(line.value))},
                  {Text(line.high ? "higher" : "lower")},
                  {Text(line.random.empty() ? "nothing" : ValueText(line.random))},
                  {Text(Grouped(line.evaluations))},
                  {CommandCell(line.command)}});
  }
  return table.Done();
}

// The record of an objective and number of contacts; null where records ask for more than these.
const FrontierLine* RecordOf(const std::vector<FrontierLine>& lines, const OwnBest& best) {
  const std::string name = fmt::format("{}-{}-contacts", best.objective, best.contacts);
  const auto found =
      std::find_if(lines.begin(), lines.end(), [&name](const FrontierLine& line) { return line.name == name; });
  return found == lines.end() ? nullptr : &*found;
}

Html OwnTable(const std::vector<FrontierLine>& lines, const std::vector<OwnBest>& own) {
  if (own.empty()) return {};
  Table table("The best of this search",
              {{"sought", "", false},
               {"generator", "", false},
               {"contacts"},
               {"mu"},
               {"best here"},
               {"record", "of this objective and number of contacts, if there is one"}});
  for (const OwnBest& best : own) {
    const FrontierLine* const record = RecordOf(lines, best);
    table.AddRow({{Text(best.objective)},
                  {Text(best.generator)},
                  {Text(std::to_string(best.contacts))},
                  {Text(best.mu)},
                  {Text(best.value)},
                  {Text(record == nullptr ? "" : ValueText(record->value))}});
  }
  return Html("<p>What this search has found worst, of each generator and number of contacts:</p>\n") +
         table.Done();
}

Html Records(const std::vector<FrontierLine>& lines) {
  if (lines.empty()) return {};
  return Html(
             "<p>How bad it can get, whatever campaign found it: the records that stand beside the program, "
             "and "
             "are no part of a store. Each is an exact problem with its "
             "certificate; <code>stiction records --check</code> computes every value anew. Exact values, "
             "and what drew the random problems, stand in <a href=\"frontiers.csv\">frontiers.csv</a>.</p>\n") +
         FigurePlace(
             "frontiers",
             "From the best of random problems, open, to the worst that is known, filled; without an open one "
             "random problems reached nothing. Of condition and friction lower is worse, of all else "
             "higher.",
             "stiction records --json") +
         RecordsTable(lines);
}

}  // namespace

FigureTable FrontiersFigure(const std::vector<FrontierLine>& lines) {
  FigureTable figure{"frontiers",
                     {"frontier", "objective", "worse", "record", "random", "evaluations", "what"}};
  for (const FrontierLine& line : lines)
    figure.rows.push_back({line.name, line.objective, line.high ? "higher" : "lower", NumberOf(line.value),
                           NumberOf(line.random), line.evaluations, line.what});
  return figure;
}

std::string FrontiersCsv(const std::vector<FrontierLine>& lines) {
  Csv csv;
  for (const char* name : {"frontier", "what", "objective", "worse", "value", "status", "command",
                           "random_value", "random_evaluations", "random_command"}) {
    csv.Add(std::string_view(name));
  }
  csv.EndRow();
  for (const FrontierLine& line : lines) {
    csv.Add(line.name).Add(line.what).Add(line.objective).Add(std::string_view(line.high ? "high" : "low"));
    csv.Add(line.value).Add(line.status).Add(line.command).Add(line.random).Add(line.evaluations);
    csv.Add(line.random_command).EndRow();
  }
  return csv.text();
}

Html FrontiersSection(const std::vector<FrontierLine>& lines, const std::vector<OwnBest>& own) {
  if (lines.empty() && own.empty()) return {};
  return Section("frontiers", "Frontiers", OwnTable(lines, own) + Records(lines));
}

}  // namespace stiction
