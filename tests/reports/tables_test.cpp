// SPDX-License-Identifier: Apache-2.0
// The tables of the page: every row says what the counters say.

#include <catch2/catch.hpp>
#include <regex>
#include <string>
#include <vector>

#include "corpus/intervals.h"
#include "corpus/json.h"
#include "reports/tables/campaign_tables.h"

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

Html ShownOf(const char* name) {
  const Record record = SmallRecord();
  return ToHtml(ShownTables(record).at(name)().front());
}

// Two groups, a rate and a share of each.
Table Sample() {
  Table table{"sample",
              "A <caption> of 100 %",
              {{"generator", "", kText},
               {"policy", "", kText},
               {"loops,runs,rate,low,high", "", false, "loops"},
               {"lost_ones", "a hint"}},
              {},
              {},
              2};
  table.Add({"a_b", "paper", RateOf(3, 4000000), ShareOf(1, 4)});
  table.Add({"<c>", "other", RateOf(0, 1000), ShareOf(0, 0)});
  return table;
}

TEST_CASE("tables: one table says the same in every medium") {
  const Table table = Sample();
  CHECK(ToCsv(table) ==
        "generator,policy,loops,runs,rate,low,high,lost_ones\r\n"
        "a_b,paper,3,4000000,0.75,0.154668,2.19182,1\r\n<c>,other,0,1000,0,0,3688.88,0\r\n");
  CHECK(ToJson(table)->at("rows")[0] == Json({"a_b", "paper", 3, 4000000, 0.75, 0.154668, 2.19182, 1}));
  CHECK(ToJson(table)->at("columns").size() == 8);
  Table shown{
      "sample",
      "A <caption>",
      {{"generator", "", kText}, {"policy", "", kText}, {"so_many"}, {"in_a_million"}, {"lost_ones", "a hint"}},
      {},
      {},
      2};
  for (const Table::Row& row : table.rows)
    shown.Add(
        {row.cells[0], row.cells[1], std::get<Ratio>(row.cells[2].value).count, row.cells[2], row.cells[3]});
  const std::string rate = RateText(3, 4000000), share = ShareText(1, 4);
  const std::string text = ToText(shown), page = ToHtml(shown).markup(), paper = ToLatex(shown);
  CHECK(std::regex_search(text, std::regex("^  generator  policy  so many +in a million +lost ones\n")));
  CHECK(text.find("\n  a_b        paper         3  ") != std::string::npos);
  CHECK(
      (text.find(rate) < text.find(share) && text.find(share) < text.find("\n  <c>        other         0  ")));
  for (const std::string& part :
       {std::string("<caption>A &lt;caption&gt;</caption>"), std::string("title=\"a hint\">lost ones</th>"),
        std::string("<th scope=\"row\">&lt;c&gt;</th>"), "<td class=\"n\">3<small>" + rate + "</small></td>",
        "<td class=\"n\">1<small>" + share + "</small></td>", std::string("<td class=\"n zero\">0</td>")}) {
    INFO(part);
    CHECK(page.find(part) != std::string::npos);
  }
  CHECK(paper.find("\\begin{longtable}{llrrr}") != std::string::npos);
  CHECK(paper.find("a\\_b & paper & 3 & " + LatexText(rate) + " & " + LatexText(share) + " \\\\\n") !=
        std::string::npos);
}

TEST_CASE("tables: parts, pivots and melted tables keep every cell") {
  const Table table = Sample();
  const auto parts = SplitBy(table, "policy");
  REQUIRE(parts.size() == 2);
  CHECK(ToCsv(parts.at("paper")) ==
        "generator,loops,runs,rate,low,high,lost_ones\r\na_b,3,4000000,0.75,0.154668,2.19182,1\r\n");
  const std::string across = ToText(Pivoted(table, "policy", "lost_ones", "–"));
  CHECK(std::regex_search(across, std::regex("^  generator  other +paper\n  a_b +– +25 %.*\n  <c> +–\n$")));
  CHECK(ToCsv(Melted(table, "count,of")) ==
        "generator,policy,what,count,of\r\na_b,paper,loops,3,4000000\r\na_b,paper,lost ones,1,4\r\n"
        "<c>,other,loops,0,1000\r\n");
  CHECK((NaturalLess("1/10", "1/2") && NaturalLess("1/2", "2") && NaturalLess("2", "10")));
  CHECK(NaturalLess("2", "mixed"));
}

TEST_CASE("tables: suspicions beside their exact outcomes, a wrong answer never confirmed") {
  const Html section = ShownOf("suspicions");
  const std::string caption = "Suspicious runs in doubles and their exact outcome";
  CHECK(RowOf(section, caption, "cycle") ==
        Cells{"cycle", "6", "1", "5", "0", "0", "0", "0", "0", "5 " + ShareText(5, 6)});
  CHECK(RowOf(section, caption, "ray") ==
        Cells{"ray", "2", "2", "0", "0", "0", "0", "0", "0", "0 " + ShareText(0, 2)});
  CHECK(RowOf(section, caption, "solved, but wrong") ==
        Cells{"solved, but wrong", "4", "4", "0", "0", "0", "0", "0", "0", "–"});
}

TEST_CASE("tables: what doubles said, by generator and in all") {
  const Html section = ShownOf("trust");
  const std::string caption = "Suspicions, audits and wrong answers per generator";
  for (const char* row : {"psd", "all"}) {
    CHECK(RowOf(section, caption, row) == Cells{row, "100", "12 120,000 [63,500, 201,000]",
                                                "7 " + ShareText(7, 12), "7", "3",
                                                "4 40,000 [11,000, 99,300]"});
  }
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

TEST_CASE("tables: of a loop whose policies were not looked at nothing is said of them") {
  Discovery in_space;
  in_space.found.emplace();
  CHECK_FALSE(in_space.SawPolicies());
  in_space.found->grid.counts[static_cast<int>(Outcome::kSolved)] = 1;
  CHECK(in_space.SawPolicies());
}

TEST_CASE("tables: what must be zero stands where it is not") {
  const Html driving = ShownOf("driving"), methods = ShownOf("agreement");
  for (const char* row : {"2", "all"}) {
    const Cells existence = RowOf(driving, "Complete driving on the problems that were given to it", row);
    CHECK(Cells(existence.begin(), existence.begin() + 4) == Cells{row, "30", "19", "11"});
    const Cells agreement = RowOf(methods, "Methods", row);
    CHECK(Cells(agreement.begin(), agreement.begin() + 4) == Cells{row, "23", "0", "9"});
    CHECK(agreement[6] == "8");
    CHECK(agreement.back() == "6");
  }
}

}  // namespace
}  // namespace stiction
