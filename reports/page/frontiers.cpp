// SPDX-License-Identifier: Apache-2.0
#include "reports/page/frontiers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "corpus/grouped.h"
#include "corpus/rational.h"
#include "reports/page/page.h"

namespace stiction {
namespace {

// As it stands while it is short; otherwise its decimal.
std::string ValueText(const std::string& value) {
  constexpr std::size_t kShort = 11;
  if (value.size() <= kShort) return value;
  return fmt::format("{:.6g}", ToDouble(*ParseRational(value)));
}

// In six digits; nothing for what is none.
TableCell NumberOf(const std::string& value) {
  if (value.empty()) return {};
  return RoundedTo(6, ToDouble(*ParseRational(value)));
}

const char* Worse(const FrontierLine& line) { return line.high ? "higher" : "lower"; }

Html RecordsTable(const std::vector<FrontierLine>& lines) {
  Table table{"records",
              "The worst problems that are known, each beside random problems",
              {{"frontier", "", kText},
               {"worst known"},
               {"worse is", "", kText},
               {"best of random problems"},
               {"of so many"},
               {"found by", "", kText}}};
  for (const FrontierLine& line : lines) {
    table.Add({Text(line.what) + Html(" ") + Tag("small")(line.status), ValueText(line.value), Worse(line),
               line.random.empty() ? "nothing" : ValueText(line.random), line.evaluations,
               Tag("code")(line.command)});
  }
  return ToHtml(table);
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
  Table table{"own",
              "The best of this search",
              {{"sought", "", kText},
               {"generator", "", kText},
               {"contacts"},
               {"mu"},
               {"best here"},
               {"records", "of this objective and number of contacts", kText}}};
  for (const OwnBest& best : own)
    table.Add({best.objective, best.generator, best.contacts, best.mu, best.value, RecordsOf(lines, best)});
  return Html("<p>What this search has found worst, of each generator and number of contacts:</p>\n") +
         ToHtml(table);
}

Html Records(const std::vector<FrontierLine>& lines) {
  if (lines.empty()) return {};
  return Html(
             "<p>How bad it can get, whatever campaign found it: the records that stand beside the program, "
             "and are no part of a store. Each is an exact problem with its certificate; <code>stiction "
             "records --check</code> computes every value anew. Exact values, and what drew the random "
             "problems, stand in <a href=\"frontiers.csv\">frontiers.csv</a>.</p>\n") +
         FigurePlace(
             "frontiers",
             "From the best of random problems, an open ring, to the worst that is known, a dot; a dot without "
             "a ring: "
             "random problems reached nothing. Of condition and friction lower is worse, of all else higher.",
             "stiction records --json") +
         RecordsTable(lines);
}

}  // namespace

Table FrontiersFigure(const std::vector<FrontierLine>& lines) {
  Table table{"frontiers", "", Columns("frontier* objective* worse* record random evaluations what*")};
  for (const FrontierLine& line : lines) {
    table.Add({line.name, line.objective, Worse(line), NumberOf(line.value), NumberOf(line.random),
               line.evaluations, line.what});
  }
  return table;
}

Table FrontiersTable(const std::vector<FrontierLine>& lines) {
  Table table{"frontiers", "",
              Columns("frontier what objective worse value status command random_value random_evaluations "
                      "random_command")};
  for (const FrontierLine& line : lines) {
    table.Add({line.name, line.what, line.objective, line.high ? "high" : "low", line.value, line.status,
               line.command, line.random, line.evaluations, line.random_command});
  }
  return table;
}

Html FrontiersSection(const std::vector<FrontierLine>& lines, const std::vector<OwnBest>& own) {
  if (lines.empty() && own.empty()) return {};
  return Section("frontiers", "Frontiers", OwnTable(lines, own) + Records(lines));
}

}  // namespace stiction
