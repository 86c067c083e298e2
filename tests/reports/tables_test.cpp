// SPDX-License-Identifier: Apache-2.0
// The tables of the page: every row says what the counters say.

#include <catch2/catch.hpp>
#include <regex>
#include <string>
#include <vector>

#include "reports/page/page.h"

namespace stiction {
namespace {

using Cells = std::vector<std::string>;

// The texts of the cells of one row of the table with this caption; what is small stands behind a blank.
Cells RowOf(const Html& section, const std::string& caption, const std::string& first) {
  const std::string& page = section.markup();
  const std::size_t begin = page.find("<caption>" + caption);
  REQUIRE(begin != std::string::npos);
  const std::string table = page.substr(begin, page.find("</table>", begin) - begin);
  static const std::regex row("<tr[^>]*>(.*?)</tr>"), cell("<t[dh][^>]*>(.*?)</t[dh]>"), tag("<[^>]*>");
  for (std::sregex_iterator at(table.begin(), table.end(), row), end; at != end; ++at) {
    const std::string inner = (*at)[1];
    Cells cells;
    for (std::sregex_iterator k(inner.begin(), inner.end(), cell); k != end; ++k) {
      const std::string spaced = std::regex_replace(std::string((*k)[1]), std::regex("<small>"), " ");
      cells.push_back(std::regex_replace(spaced, tag, ""));
    }
    if (!cells.empty() && cells[0] == first) return cells;
  }
  FAIL("no row " << first << " in " << caption);
  return {};
}

Record SmallRecord() {
  Record record;
  const auto at = [](Outcome outcome) { return static_cast<int>(outcome); };
  Tally& tally = record.tallies[{"psd", 2, "paper"}];
  tally.problems = 100;
  tally.outcomes[at(Outcome::kSolved)] = 92;
  tally.outcomes[at(Outcome::kCycle)] = 6;
  tally.outcomes[at(Outcome::kRay)] = 2;
  tally.verdicts[at(Outcome::kCycle)][at(Outcome::kSolved)] = 1;
  tally.verdicts[at(Outcome::kCycle)][at(Outcome::kCycle)] = 5;
  tally.verdicts[at(Outcome::kRay)][at(Outcome::kSolved)] = 2;
  tally.verdicts[at(Outcome::kSolved)][at(Outcome::kSolved)] = 4;
  tally.audited = 7;
  tally.misjudged = 3;
  tally.wrong = 4;
  record.existence[2].problems = 30;
  record.existence[2].solved = 19;
  record.agreement[2].compared = 23;
  record.agreement[2].disagreements = 9;
  record.agreement[2].signs_not_one = 8;
  record.agreement[2].safe_gave_up_no_ties = 6;
  return record;
}

TEST_CASE("tables: suspicions beside their exact outcomes, a wrong answer never confirmed") {
  const Html section = DoublesSection(SmallRecord());
  const std::string caption = "Suspicious runs in doubles and their exact outcome";
  CHECK(RowOf(section, caption, "cycle") == Cells{"cycle", "6", "1", "5", "0", "0", "0", "0", "0", "83.3%"});
  CHECK(RowOf(section, caption, "ray") == Cells{"ray", "2", "2", "0", "0", "0", "0", "0", "0", "0%"});
  CHECK(RowOf(section, caption, "solved, but wrong") ==
        Cells{"solved, but wrong", "4", "4", "0", "0", "0", "0", "0", "0", "–"});
}

TEST_CASE("tables: what doubles said, by generator and in all") {
  const Html section = DoublesSection(SmallRecord());
  const std::string caption = "Suspicions, audits and wrong answers per generator";
  for (const char* row : {"psd", "all"}) {
    CHECK(RowOf(section, caption, row) ==
          Cells{row, "100", "12 120,000 [62,000, 210,000]", "7 58.3%", "7", "3", "4 40,000 [10,800, 103,000]"});
  }
}

TEST_CASE("tables: problems count once, runs for every policy, and what was only counted is not pending") {
  ReportContent content;
  content.units = 1;
  for (const char* policy : {"paper", "ties=contacts"})
    content.total.tallies[{"psd", 2, policy}].problems = 1234;
  Finding finding;
  finding.signature = "cycle-2c-4d-10s-00";
  finding.kind = finding.exact_outcome = "cycle";
  finding.contacts = 2;
  finding.problem = R"({"format":"stiction-problem","version":1,"name":"n","dimension":2,)"
                    R"("contacts":[{"kind":"frictionless"}],"A":[["1"]],"b":["1"]})";
  Record record;
  record.signatures = {{finding.signature, 7}, {"cycle-2c-4d-12s-00", 5}};
  const std::vector<Finding> findings = {finding};
  content.discoveries = Discoveries(record, findings);
  const Html section = FoundSection(content);
  CHECK(section.markup().find("<strong>1,234</strong> <span>problems run</span>") != std::string::npos);
  CHECK(section.markup().find("<strong>2,468</strong>") != std::string::npos);
  // groups, finished, pending, only counted
  const Cells all = RowOf(section, "Of the algorithm, in exact arithmetic", "all");
  CHECK(Cells(all.begin(), all.begin() + 5) == Cells{"all", "2", "0", "1", "1"});
}

TEST_CASE("tables: every policy loops if all of the grid do") {
  GridOutcomes grid;
  CHECK_FALSE(grid.AllLoop());
  grid.counts[static_cast<int>(Outcome::kCycle)] = 3;
  CHECK(grid.AllLoop());
  grid.counts[static_cast<int>(Outcome::kStall)] = 2;
  CHECK(grid.AllLoop());
  grid.counts[static_cast<int>(Outcome::kSolved)] = 1;
  CHECK_FALSE(grid.AllLoop());
}

TEST_CASE("tables: what must be zero stands where it is not") {
  const Html section = ExistenceSection(SmallRecord());
  for (const char* row : {"2", "all"}) {
    const Cells existence = RowOf(section, "Complete driving on the problems that were given to it", row);
    CHECK(Cells(existence.begin(), existence.begin() + 4) == Cells{row, "30", "19", "11"});
    const Cells agreement = RowOf(section, "Methods", row);
    CHECK(Cells(agreement.begin(), agreement.begin() + 4) == Cells{row, "23", "0", "9"});
    CHECK(agreement[6] == "8");
    CHECK(agreement.back() == "6");
  }
}

}  // namespace
}  // namespace stiction
