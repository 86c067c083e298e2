// SPDX-License-Identifier: Apache-2.0
#include "reports/frontiers.h"

#include <fmt/format.h>

#include "corpus/grouped.h"
#include "corpus/rational.h"
#include "reports/csv.h"
#include "reports/page.h"

namespace stiction {
namespace {

// As it stands while it is short; otherwise its decimal.
std::string ValueText(const std::string& value) {
  constexpr std::size_t kShort = 11;
  if (value.size() <= kShort) return value;
  return fmt::format("{:.6g}", ToDouble(*ParseRational(value)));
}

Html CommandCell(const std::string& command) { return Tag("code")(command); }

}  // namespace

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

Html FrontiersSection(const std::vector<FrontierLine>& lines) {
  if (lines.empty()) return {};
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
  return Section(
      "frontiers", "Frontiers",
      Html("<p>How bad it can get, whatever campaign found it: not what the store of this report "
           "holds, but the records that stand beside the program. Each is an exact problem with its "
           "certificate; <code>stiction records --check</code> computes every value anew. Exact values, "
           "and what drew the random problems, stand in <a href=\"frontiers.csv\">frontiers.csv</a>.</p>\n") +
          table.Done());
}

}  // namespace stiction
