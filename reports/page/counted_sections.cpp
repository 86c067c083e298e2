// SPDX-License-Identifier: Apache-2.0
// Sections of the page that say what was counted: what its tables mean, in words.

#include <fmt/format.h>

#include <algorithm>

#include "corpus/record/kinds.h"
#include "reports/page/page.h"
#include "reports/tables/campaign_tables.h"

namespace stiction {
namespace {

const By kByRun = {"generator", "contacts", "policy"};

// Loops by what is known of a stratum, which stands across.
Html StrataLoops(const Record& total, const std::string& across, const char* caption) {
  By by = kByRun;
  by.push_back(across);
  Table table = Pivoted(FailuresTable(total, by), across, "loops", "–");
  table.caption = caption;
  return ToHtml(table);
}

Html LoopsOfPeriods(const Record& total) {
  if (!total.loops.empty())
    return FigurePlace(
               "loop-steps",
               "Loops in exact arithmetic by the number of steps of length zero in their period, by number of "
               "contacts.") +
           ToHtml(LoopsTable(total));
  const bool met = std::any_of(total.signatures.begin(), total.signatures.end(),
                               [](const auto& each) { return IsLoopKind(KindOf(each.first)); });
  return Tag("p",
             {{"class", "note"}})(met ? "Not counted here: those of space, and of searches with an objective."
                                      : "No loop was met.") +
         Html("\n");
}

// Contacts down, counts across.
Html HistogramTable(const Record& total, const std::string& counted, const char* caption) {
  const auto parts = SplitBy(SolutionsTable(total), "counted");
  const auto found = parts.find(counted);
  if (found == parts.end()) return Html("<p class=\"note\">None.</p>\n");
  Table table = Pivoted(found->second, "count", "problems", 0);
  table.caption = caption;
  return ToHtml(table);
}

}  // namespace

Html RateBounds(const Record& total) {
  const Counts all = CountAll(total);
  if (all.runs == all.audited + all.suspicious)
    return Text(" Every run was repeated exactly: none is missing but those that were misjudged.");
  return Text(fmt::format(
      " These rates are lower bounds: loops that doubles take for solutions are not among them. Of {} "
      "runs without a suspicion {} were audited.",
      Grouped(all.runs - all.suspicious), Grouped(all.audited)));
}

Html FrequenciesSection(const Record& total) {
  return Section(
      "frequencies", "How often it fails exactly",
      Tag("p")(
          Html("Suspicious runs whose failure exact arithmetic confirmed, and below each count its rate in a "
               "million runs with its exact interval at 95 % (Garwood; of shares, Clopper and Pearson).") +
          RateBounds(total)) +
          FigurePlace("rates.contacts",
                      "Failures confirmed exactly in a million runs, by generator and number of "
                      "contacts, on a logarithmic scale; lines: exact intervals at 95 %. An open "
                      "triangle: none was seen, and the rate is below its tip.") +
          FigurePlace("rates.friction",
                      "Failures confirmed exactly in a million runs, by generator and friction coefficient of "
                      "all contacts (mixed: they differ); colours: numbers of contacts. Only where some "
                      "were seen.") +
          FigurePlace("rates.rank",
                      "Failures confirmed exactly in a million runs, by generator and the rank that A has at "
                      "most; colours: numbers of contacts. Only where some were seen.") +
          ToHtml(FailuresTable(total, kByRun)) +
          Html("<h3>By friction</h3>\n<p>Loops confirmed exactly, where all contacts have the same "
               "coefficient, or different ones (mixed); below, in a million runs:</p>\n") +
          StrataLoops(total, "friction", "Loops by friction coefficient") +
          Html("<h3>By rank</h3>\n<p>The same by the rank that A has at most by construction: that of "
               "its factor J. By chance it is lower.</p>\n") +
          StrataLoops(total, "rank", "Loops by rank"));
}

Html OutcomesSection(const Record& total) {
  return Section(
      "outcomes", "Outcomes",
      Html("<p>As the runs in doubles ended. Runs not solved, per million, with exact intervals at 95 %; the "
           "deeper the colour, the more, one shade for each factor of ten:</p>\n") +
          ToHtml(UnsolvedTable(total)) +
          Html(
              "<p>All outcomes; below each count of what was not solved its rate per million problems:</p>\n") +
          ToHtml(OutcomesTable(total)));
}

Html DoublesSection(const Record& total) {
  return Section(
      "doubles", "How often doubles lie",
      Html("<p>A run in doubles is suspicious if it does not end in a solution, or if its solution "
           "has an error above the bound of the gate. Every suspicious problem is run again in exact "
           "rational arithmetic, and so is a sample of the others. Where a generator rounds its "
           "problems to doubles, the exact run is that of the problem before rounding. Rows: "
           "how the suspicious runs ended in doubles; columns: how they end exactly.</p>\n") +
          FigurePlace("doubles",
                      "Suspicious runs by what doubles said, and what exact arithmetic says of them.") +
          ToHtml(SuspicionsTable(total)) + Html("<h3>By generator</h3>\n") +
          FigurePlace("trust",
                      "Share of the audited runs that doubles misjudged, and of all runs that "
                      "ended in a wrong answer; lines: exact intervals at 95 %.") +
          ToHtml(TrustTable(total)));
}

Html StepsSection(const Record& total) {
  return Section(
      "steps", "Steps per problem",
      FigurePlace("steps",
                  "Runs in doubles by the number of their steps, by number of contacts; up: their share, on a "
                  "logarithmic scale. The last bar is of all that took more.") +
          FigurePlace("pivoting",
                      "Share of the runs in doubles with a step of length zero, and of those in which a "
                      "variable was given up, by generator and number of contacts; lines: exact "
                      "intervals at 95 %.") +
          Html("<h3>Work per problem</h3>\n<p>Of the runs in doubles: the mean, and below it the maximum. A "
               "loop counts up to where it was noticed.</p>\n") +
          ToHtml(PivotsTable(total)) +
          Html("<h3>Zero steps of loops</h3>\n<p>What one period of a loop consists of, in exact "
               "arithmetic:</p>\n") +
          LoopsOfPeriods(total));
}

Html MethodsSection(const ReportContent& content) {
  return Section(
      "methods", "Methods side by side",
      Html(
          "<p>Each was asked about problems of its own: the published algorithm ran on all, and exactly where "
          "doubles were suspicious; complete driving got the first of each group that the published algorithm "
          "did not solve in a unit, audits, and a sample; Lemke’s method a sample of these, where solved means "
          "that no method contradicts "
          "another. The same problems for all are the finished findings, in the last rows: what the published "
          "algorithm makes of them exactly, whether Ipopt’s feasibility solve led to a solution, and whether a "
          "certificate says that there is one. A solution counts only if it is verified; over doubles, if its "
          "errors are at most 1e-6.</p>\n") +
          FigurePlace("methods",
                      "Share of the problems that each method solved, of those that it was asked about, "
                      "by number of contacts; lines: exact intervals at 95 %.") +
          ToHtml(MethodsTable(content.total, content.discoveries)));
}

Html ExistenceSection(const Record& total) {
  const AgreementTally all = SumOf(total.agreement);
  const std::string verdict =
      fmt::format("{} of {} {} a disagreement between methods.", Grouped(all.disagreements),
                  Counted(all.compared, "compared problem"), all.disagreements == 1 ? "shows" : "show");
  const Table table = AgreementTable(total);
  return Section(
      "existence", "Existence and agreement",
      Html("<p>Every problem here, those with sliding contacts apart, has a symmetric positive semidefinite A "
           "and b in its range. So it has a solution, for every mu: a theorem, in the plane and in space. "
           "Complete driving looks for it where the published algorithm does not solve, once a group in a "
           "unit, and on problems that are audited or drawn; the solution is verified exactly:</p>\n") +
          FigurePlace("driving",
                      "Share of the paths of complete driving with folds, with descents, and with ties, by "
                      "number of contacts; lines: exact intervals at 95 %.") +
          ToHtml(Select(table, "contacts problems solved not_solved pieces with_folds with_descents with_ties",
                        "Complete driving on the problems that were given to it, by number of contacts")) +
          Html("<h3>Do the methods agree?</h3>\n") + Tag("p")(verdict) + Html("\n") +
          ToHtml(Select(table,
                        "contacts compared enumerated disagreements continua regular signs_not_one "
                        "safety_decided safe safe_gave_up safe_gave_up_no_ties",
                        "Methods held against each other, by number of contacts")) +
          Html("<h3>How many solutions</h3>\n<p>Regular problems by the number of their solutions (in rows: "
               "contacts), which is odd where A is definite:</p>\n") +
          HistogramTable(total, "solutions", "Regular problems by number of solutions") +
          Html("<p>All problems whose modes were all tried, by the number of mode words that have "
               "solutions:</p>\n") +
          HistogramTable(total, "words", "Problems by number of mode words with solutions"));
}

}  // namespace stiction
