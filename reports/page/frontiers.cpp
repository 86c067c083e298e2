// SPDX-License-Identifier: Apache-2.0
#include "reports/page/frontiers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "corpus/rational.h"

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

Table RecordsTable(const std::vector<FrontierLine>& lines) {
  Table table = Described("records");
  for (const FrontierLine& line : lines) {
    table.Add({{line.what, line.status},
               ValueText(line.value),
               Worse(line),
               line.random.empty() ? "nothing" : ValueText(line.random),
               line.evaluations,
               {line.command, "", "code"}});
  }
  return table;
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

Table OwnTable(const std::vector<FrontierLine>& lines, const std::vector<OwnBest>& own) {
  Table table = Described("own");
  for (const OwnBest& best : own)
    table.Add({best.objective, best.generator, best.contacts, best.mu, best.value, RecordsOf(lines, best)});
  return table;
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

void AddFrontiers(Facts& facts, const std::vector<FrontierLine>& lines, const std::vector<OwnBest>& own) {
  facts.numbers["records"] = std::ssize(lines);
  facts.numbers["own"] = std::ssize(own);
  facts.tables["records"] = [&lines] { return std::vector<Table>{RecordsTable(lines)}; };
  facts.tables["own"] = [&lines, &own] { return std::vector<Table>{OwnTable(lines, own)}; };
}

}  // namespace stiction
