// SPDX-License-Identifier: Apache-2.0
// The section of the page on existence, and on what the methods say of each other.

#include <fmt/format.h>

#include <map>
#include <set>
#include <vector>

#include "reports/page/page.h"

namespace stiction {
namespace {

HtmlCell CountCell(std::int64_t count) { return {Text(Grouped(count)), count == 0 ? "zero" : ""}; }

// What must be zero.
HtmlCell Exception(std::int64_t count) { return {Text(Grouped(count)), count == 0 ? "zero" : "h5"}; }

HtmlCell CountAndShare(std::int64_t count, std::int64_t total) {
  if (count == 0) return CountCell(0);
  return {Text(Grouped(count)) + Tag("small")(Percent(count, total))};
}

template <class Tally>
Tally SumOf(const std::map<int, Tally>& tallies) {
  Record sum;
  for (const auto& [contacts, tally] : tallies) {
    Record one;
    if constexpr (std::is_same_v<Tally, ExistenceTally>) one.existence[0] = tally;
    if constexpr (std::is_same_v<Tally, AgreementTally>) one.agreement[0] = tally;
    sum.Merge(one);
  }
  if constexpr (std::is_same_v<Tally, ExistenceTally>) return sum.existence[0];
  if constexpr (std::is_same_v<Tally, AgreementTally>) return sum.agreement[0];
}

void AddExistence(Table& table, const std::string& contacts, const ExistenceTally& t, const char* style = "") {
  table.AddRow({{Text(contacts)},
                CountCell(t.problems),
                CountCell(t.solved),
                Exception(t.problems - t.solved),
                {Text(Mean(t.pieces, t.problems))},
                CountAndShare(t.with_folds, t.problems),
                CountAndShare(t.with_descents, t.problems),
                CountAndShare(t.with_ties, t.problems)},
               1, style);
}

Html ExistenceTable(const Record& total) {
  Table table("Complete driving on the problems that were given to it, by number of contacts",
              {{"contacts"},
               {"problems", "that the published algorithm did not solve, audited, or drawn"},
               {"solved", "complete driving returned a solution that stood exact verification"},
               {"not solved"},
               {"pieces", "of the path, mean"},
               {"with folds", "the path turns back: where the published algorithm gives up"},
               {"with descents", "a driven force returns to zero"},
               {"with ties", "decided by symbolic perturbation"}});
  for (const auto& [contacts, tally] : total.existence) AddExistence(table, Grouped(contacts), tally);
  AddExistence(table, "all", SumOf(total.existence), "total");
  return table.Done();
}

void AddAgreement(Table& table, const std::string& contacts, const AgreementTally& t, const char* style = "") {
  table.AddRow({{Text(contacts)},
                CountCell(t.compared),
                CountCell(t.enumerated),
                Exception(t.disagreements),
                CountAndShare(t.continua, t.enumerated),
                CountAndShare(t.regular, t.enumerated),
                Exception(t.signs_not_one),
                CountCell(t.safety_decided),
                CountAndShare(t.safe, t.safety_decided),
                CountCell(t.safe_gave_up),
                Exception(t.safe_gave_up_no_ties)},
               1, style);
}

Html AgreementTable(const Record& total) {
  Table table(
      "Methods held against each other, by number of contacts",
      {{"contacts"},
       {"compared", "published algorithm, complete driving and Lemke's method"},
       {"all modes tried", "of these, with every word of contact modes decided by exact linear programs"},
       {"disagreements",
        "a wrong solution, a method that ends otherwise than it must, a solution that another misses"},
       {"continua", "a word of modes with more than one solution; below: of those with all modes tried"},
       {"regular", "every solution stands inside one word, alone; below: of those with all modes tried"},
       {"signs not 1",
        "regular, and the signs of the reduced determinants do not sum to 1; A singular, or it is a "
        "disagreement"},
       {"safety decided", "audited problems of at most three contacts"},
       {"safe", "all reduced determinants are positive"},
       {"gave up", "safe, and something was given up under apex=suspended"},
       {"without ties", "of these, without any tie: a disagreement"}});
  for (const auto& [contacts, tally] : total.agreement) AddAgreement(table, Grouped(contacts), tally);
  AddAgreement(table, "all", SumOf(total.agreement), "total");
  return table.Done();
}

using Histogram = std::map<int, std::int64_t>;

// Contacts down, counts across.
Html HistogramTable(const Record& total, const std::string& caption, Histogram AgreementTally::*histogram) {
  std::set<int> values;
  for (const auto& [contacts, tally] : total.agreement) {
    for (const auto& [value, problems] : tally.*histogram) values.insert(value);
  }
  if (values.empty()) return Html("<p class=\"note\">None.</p>\n");
  std::vector<Column> columns = {{"contacts"}};
  for (const int value : values) columns.push_back({Grouped(value)});
  Table table(caption, columns);
  for (const auto& [contacts, tally] : total.agreement) {
    if ((tally.*histogram).empty()) continue;
    std::vector<HtmlCell> cells = {{Text(Grouped(contacts))}};
    for (const int value : values) {
      const auto found = (tally.*histogram).find(value);
      cells.push_back(CountCell(found == (tally.*histogram).end() ? 0 : found->second));
    }
    table.AddRow(cells);
  }
  return table.Done();
}

}  // namespace

Html ExistenceSection(const Record& total) {
  const AgreementTally all = SumOf(total.agreement);
  const std::string verdict = fmt::format("{} of {} compared problems show a disagreement between methods.",
                                          Grouped(all.disagreements), Grouped(all.compared));
  return Section(
      "existence", "Existence and agreement",
      Html("<p>Every problem here, those with sliding contacts apart, has a symmetric positive semidefinite A "
           "and b in its range. So it has a solution, for every mu: a theorem, in the plane and in space. "
           "Complete "
           "driving looks for it wherever the published algorithm does not solve, and on problems that are "
           "audited or drawn; the solution is verified exactly:</p>\n") +
          FigurePlace("driving",
                      "Share of the paths of complete driving with folds, with descents, and with ties, by "
                      "number of contacts; lines: exact intervals at 95 %.") +
          ExistenceTable(total) + Html("<h3>Do the methods agree?</h3>\n") + Tag("p")(verdict) + Html("\n") +
          AgreementTable(total) +
          Html("<h3>How many solutions</h3>\n<p>Regular problems by the number of their solutions (in rows: "
               "contacts), which is odd where A is definite:</p>\n") +
          HistogramTable(total, "Regular problems by number of solutions", &AgreementTally::solutions) +
          Html("<p>All problems whose modes were all tried, by the number of mode words that have "
               "solutions:</p>\n") +
          HistogramTable(total, "Problems by number of mode words with solutions", &AgreementTally::words));
}

}  // namespace stiction
