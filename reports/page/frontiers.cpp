// SPDX-License-Identifier: Apache-2.0
#include "reports/page/frontiers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

// All records of an objective and number of contacts, by their names: "friction-gravity-4-contacts 1/54; ...".
std::string RecordsOf(const std::vector<FrontierLine>& lines, const OwnBest& best) {
  const std::string end = fmt::format("-{}-contacts", best.contacts);
  std::vector<std::string> texts;
  for (const FrontierLine& line : lines) {
    if (line.objective == best.objective && line.name.ends_with(end))
      texts.push_back(line.name + " " + ValueText(line.value));
  }
  return fmt::format("{}", fmt::join(texts, "; "));
}

Html OwnTable(const std::vector<FrontierLine>& lines, const std::vector<OwnBest>& own) {
  if (own.empty()) return {};
  Table table("The best of this search", {{"sought", "", false},
                                          {"generator", "", false},
                                          {"contacts"},
                                          {"mu"},
                                          {"best here"},
                                          {"records", "of this objective and number of contacts", false}});
  for (const OwnBest& best : own) {
    table.AddRow({{Text(best.objective)},
                  {Text(best.generator)},
                  {Text(std::to_string(best.contacts))},
                  {Text(best.mu)},
                  {Text(best.value)},
                  {Text(RecordsOf(lines, best))}});
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
             "From the best of random problems, an open ring, to the worst that is known, a dot; a dot without "
             "a ring: "
             "random problems reached nothing. Of condition and friction lower is worse, of all else higher.",
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
