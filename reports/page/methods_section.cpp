// SPDX-License-Identifier: Apache-2.0
// The section of the page on the published algorithm beside complete driving, Lemke's method and Ipopt.

#include <map>
#include <string>
#include <vector>

#include "corpus/intervals.h"
#include "reports/page/figures.h"
#include "reports/page/page.h"

namespace stiction {
namespace {

// Lines of one method, by contacts.
class MethodCounts {
 public:
  MethodCounts(std::string method, std::string asked_about)
      : method_(std::move(method)), asked_about_(std::move(asked_about)) {}

  void Add(int contacts, std::int64_t asked, std::int64_t solved) {
    auto& [all, good] = counts_[contacts];
    all += asked;
    good += solved;
  }
  void AppendTo(std::vector<MethodLine>& lines) const {
    for (const auto& [contacts, count] : counts_) {
      if (count.first > 0) lines.push_back({method_, asked_about_, contacts, count.first, count.second});
    }
  }

 private:
  std::string method_, asked_about_;
  std::map<int, std::pair<std::int64_t, std::int64_t>> counts_;
};

}  // namespace

std::vector<MethodLine> MethodLines(const ReportContent& content) {
  constexpr int kSolvedOutcome = static_cast<int>(Outcome::kSolved);
  MethodCounts doubles("published, in doubles", "every run"),
      exact("published, exact", "runs repeated on suspicion"),
      complete("complete driving", "problems given to it"), lemke("Lemke’s method", "problems compared"),
      published_on("published, exact", "finished findings"), ipopt("Ipopt", "finished findings"),
      certified("certified to have a solution", "finished findings");
  for (const auto& [key, tally] : content.total.tallies) {
    doubles.Add(key.contacts, tally.problems, tally.outcomes[kSolvedOutcome] - tally.wrong);
    for (const Tally::Outcomes& row : tally.verdicts) {
      for (int i = 0; i < kOutcomeCount; ++i) exact.Add(key.contacts, row[i], i == kSolvedOutcome ? row[i] : 0);
    }
  }
  for (const auto& [contacts, tally] : content.total.existence)
    complete.Add(contacts, tally.problems, tally.solved);
  for (const auto& [contacts, tally] : content.total.agreement)
    lemke.Add(contacts, tally.compared, tally.compared - tally.disagreements);
  for (const Discovery& discovery : content.discoveries) {
    if (!discovery.Finished() || !discovery.ipopt || discovery.ipopt->outcome == "unavailable") continue;
    const Finding& finding = *discovery.representative;
    published_on.Add(finding.contacts, 1, finding.exact_outcome == Name(Outcome::kSolved));
    ipopt.Add(finding.contacts, 1, discovery.ipopt->outcome == "solved");
    certified.Add(finding.contacts, 1, finding.existence.find("solution-exists") != std::string::npos);
  }
  std::vector<MethodLine> lines;
  for (const MethodCounts* counts : {&doubles, &exact, &complete, &lemke, &published_on, &ipopt, &certified})
    counts->AppendTo(lines);
  return lines;
}

Html MethodsSection(const ReportContent& content) {
  const std::vector<MethodLine> lines = MethodLines(content);
  Table table("What each method made of what it was asked",
              {{"method", "", false},
               {"asked about", "", false},
               {"contacts"},
               {"asked"},
               {"solved", "below: the share, with its exact interval at 95 %"}});
  std::string before;
  for (const MethodLine& line : lines) {
    const bool starts = !before.empty() && before != line.method + line.asked_about;
    before = line.method + line.asked_about;
    table.AddRow({{Text(line.method)},
                  {Text(line.asked_about)},
                  {Text(Grouped(line.contacts))},
                  {Text(Grouped(line.asked))},
                  {Text(Grouped(line.solved)) + Tag("small")(ShareText(line.solved, line.asked))}},
                 3, starts ? "group" : "");
  }
  return Section(
      "methods", "Methods side by side",
      Html(
          "<p>Each was asked about problems of its own: the published algorithm ran on all, and exactly where "
          "doubles were suspicious; complete driving got what the published algorithm did not solve, audits, "
          "and "
          "a sample; Lemke’s method a sample of these, where solved means that no method contradicts another. "
          "The same problems for all are the finished findings, in the last rows: what the published algorithm "
          "makes of them exactly, whether Ipopt’s feasibility solve led to a solution, and whether a "
          "certificate "
          "says that there is one. A solution counts only if it is verified; over doubles, if its "
          "errors are at most 1e-6.</p>\n") +
          FigurePlace("methods",
                      "Share of the problems that each method solved, of those that it was asked about, "
                      "by number of contacts; lines: exact intervals at 95 %.") +
          table.Done());
}

}  // namespace stiction
