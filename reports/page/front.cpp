// SPDX-License-Identifier: Apache-2.0
// The first page of a report: the claim, the simplest loop, three figures, one table, and where all else is.

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "corpus/record/counts.h"
#include "corpus/record/kinds.h"
#include "reports/page/page.h"
#include "reports/tables/campaign_tables.h"

namespace stiction {
namespace {

constexpr char kLead[] =
    "<p>A search of random friction problems for inputs on which the pivoting algorithm of D. Baraff,\n"
    "<cite>Fast Contact Force Computation for Nonpenetrating Rigid Bodies</cite> (SIGGRAPH 1994), run as "
    "published, repeats a\nstate and so never ends. Every finding was run again in exact rational arithmetic, "
    "in space over intervals, which prove\nwhat they decide; a finished loop comes with a problem made as "
    "small as it gets and, in the plane, with a certificate that\nan independent checker verifies.</p>";

constexpr char kOptimizedLead[] =
    "<p>An optimized search: problems are not drawn, but made worse step by step, as an objective counts what "
    "is worse for the pivoting algorithm of D. Baraff, <cite>Fast Contact Force Computation for Nonpenetrating "
    "Rigid Bodies</cite> (SIGGRAPH 1994). Of such problems there are no frequencies. A value counts that exact "
    "rational arithmetic confirms.</p>";

// ---- Findings ----

// Named by their signatures; the script of the page says what happens, and links what plays.
Html NamedFindings(const std::vector<Discovery>& discoveries) {
  std::vector<const Discovery*> named = ByInterest(discoveries);
  if (named.size() > kFindingsNamed) named.resize(kFindingsNamed);
  Html list;
  for (const Discovery* discovery : named) {
    list +=
        Tag("li")(Tag("span", {{"class", "name"}, {"data-signature", discovery->signature}})(
                      Tag("code")(discovery->signature)) +
                  Html(" ") +
                  Tag("small")(fmt::format("{}, met {}", discovery->kind, Counted(discovery->met, "time")))) +
        Html("\n");
  }
  const auto groups = Counted(static_cast<std::int64_t>(discoveries.size()), "group");
  return Html("<h3>Of most interest</h3>\n") + Tag("ol", {{"class", "named"}})(Html("\n") + list) +
         Tag("p")(Html("<a href=\"findings.html\">All findings</a>") + Text(fmt::format(", {}.", groups))) +
         Html("\n");
}

Html Featured(const std::vector<Discovery>& discoveries) {
  const Discovery* simplest = SimplestLoop(discoveries);
  if (simplest == nullptr) return {};
  const Html title = Tag("h3", {{"class", "name"}, {"data-signature", simplest->signature}})(
      Html("<code>") + Text(simplest->signature) + Html("</code>"));
  return Tag("div", {{"class", "featured"}})(
             title +
             Html("\n<div id=\"play\"></div>\n<details class=\"folded\"><summary>A, b, mu, commands and "
                  "files</summary>\n") +
             FindingDetails(*simplest) + Html("</details>\n")) +
         Html("\n");
}

Html NothingFound(const ReportContent& content) {
  if (content.units == 0) return Html("<p>The store holds no units: nothing has been searched yet.</p>\n");
  if (!content.Objective().empty()) return Html("<p>No loop was kept.</p>\n");
  return Html("<p>No findings: every run ended in a solution, or exact arithmetic said that it does.</p>\n");
}

Html FoundSection(const ReportContent& content) {
  Html found = BestSentence(content);
  if (content.since) found += SinceText(*content.since, content.discoveries);
  if (content.discoveries.empty()) return Section("found", "What was found", found + NothingFound(content));
  const bool loop = SimplestLoop(content.discoveries) != nullptr;
  return Section("found", loop ? "The simplest loop" : "What was found",
                 found + Featured(content.discoveries) + NamedFindings(content.discoveries));
}

// ---- Figures, and the table ----

// A figure with its words beside it.
Html Beside(const Html& words, const Html& figure) {
  return Tag("div", {{"class", "beside"}})(Tag("div", {{"class", "words"}})(words) + Html("\n") + figure) +
         Html("\n");
}

Html Answers(const ReportContent& content, const Sentences& told) {
  const Record& total = content.total;
  const Html intervals = Html(
      "<p class=\"note\">In brackets: exact intervals at 95 %, of counts by Garwood, of shares by Clopper and "
      "Pearson.</p>\n");
  Table table = FailuresTable(total, {"generator"});
  table.caption = "Failures confirmed exactly, by generator";
  return Section(
             "often", "How often it loops",
             Beside(told.grid + told.stuck + Tag("p", {{"class", "note"}})(RateBounds(total)) + intervals,
                    FigurePlace("often",
                                "Loops confirmed exactly in a million runs, of all generators together; lines: "
                                "exact intervals at 95 %. An open triangle: none was seen, and the rate is "
                                "below its tip."))) +
         Section(
             "cost", "What it costs",
             Beside(told.complete,
                    FigurePlace("cost",
                                "Steps of a run in doubles: at most so many in half of the runs, in 99 of 100, "
                                "and in all; and the share of runs with a step of length zero, and of those in "
                                "which a variable is given up, with intervals."))) +
         Section("wrong", "What doubles get wrong",
                 Beside(told.doubles,
                        FigurePlace("doubles",
                                    "Suspicious runs by what doubles said, and what exact arithmetic says of "
                                    "them."))) +
         Section("table", "By generator",
                 told.agreement + ToHtml(table) +
                     Html("<p class=\"note\">Below each count: in a million runs, with its interval. <a "
                          "href=\"results.html#frequencies\">By contacts, friction and rank</a>.</p>\n"));
}

// ---- Where all else is ----

Html Elsewhere(const ReportContent& content) {
  auto places = PlacesOfResults(content);
  for (auto& [place, title] : places) place = "results.html" + place;
  const auto card = [](const char* file, const char* title, const Html& what) {
    return Tag("li")(Tag("a", {{"href", file}})(title) + Html("\n") + what) + Html("\n");
  };
  Html cards = card("results.html", "All results", Tag("p", {{"class", "places"}})(LinksTo(places)));
  if (!content.discoveries.empty())
    cards += card("findings.html", "Findings",
                  Html("<p>Loops first: each in numbers, with its files, and a link "
                       "that plays it. To sort, filter and search.</p>"));
  if (!content.player.is_null())
    cards += card("replay.html", "The player",
                  Html("<p>The simplest loop step by step, beside complete driving; "
                       "edit it, and run it again.</p>"));
  return Section("elsewhere", "All else", Tag("ul", {{"class", "cards"}})(Html("\n") + cards));
}

Html FrontLinks(const ReportContent& content) {
  std::vector<std::pair<std::string, std::string>> places = {{"#found", "Found"}};
  if (content.units > 0 && content.Objective().empty())
    places.insert(places.end(),
                  {{"#often", "How often"}, {"#cost", "Cost"}, {"#wrong", "Doubles"}, {"#table", "Table"}});
  places.insert(places.end(), {{"#again", "Reproducing it"}, {"#method", "Method and definitions"}});
  if (!content.discoveries.empty()) places.emplace_back("findings.html", "Findings");
  places.emplace_back("results.html", "All results");
  return LinksTo(places);
}

}  // namespace

std::string FrontPage(const ReportContent& content, const std::vector<Table>& figures) {
  const bool random = content.Objective().empty();
  const Sentences told = SentencesOf(content);
  const Html counts = content.units > 0 && random ? Answers(content, told) : Html();
  return FilledPage(figures, {.title = "stiction: does Baraff's contact force algorithm always end?",
                              .heading = "Does Baraff’s contact force algorithm always end?",
                              .lead = told.loops + told.asked + (random ? Html(kLead) : Html(kOptimizedLead)),
                              .navigation = FrontLinks(content),
                              .found = FoundSection(content) + counts + AgainSection(content),
                              .how = MethodText(content),
                              .more = Elsewhere(content),
                              .findings = FindingsToJson(content.discoveries, content.since, kFindingsNamed),
                              .player = content.player});
}

}  // namespace stiction
