// SPDX-License-Identifier: Apache-2.0
// The pages of a report, each an HTML document that needs nothing else: what was found, in few screens; all
// that was counted; the findings, which are read when they are asked for. Sections, tables and sentences stand
// there as text; scripts draw the figures, play a loop and make the findings sortable (web/).

#ifndef STICTION_REPORTS_PAGE_PAGE_H_
#define STICTION_REPORTS_PAGE_PAGE_H_

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "corpus/json.h"
#include "corpus/store/store.h"
#include "reports/html/html.h"
#include "reports/page/figures.h"
#include "reports/page/frontiers.h"
#include "reports/page/rungs.h"
#include "reports/tables/discovery.h"
#include "reports/tables/since.h"

namespace stiction {

// Findings that stand in their page as text; the others are data, which its script shows.
inline constexpr std::size_t kFindingsShown = 50;
// Findings that the first page names.
inline constexpr std::size_t kFindingsNamed = 6;

// What a store says, read once.
struct ReportContent {
  // What an optimized search seeks; empty of problems at random.
  std::string Objective() const;

  CampaignIdentity identity;
  std::map<std::string, std::string> labels;  // of fields of a campaign, where they are not their names
  std::int64_t units = 0;
  std::int64_t blocks = 0;
  Record total;
  Work work;
  std::vector<Discovery> discoveries;
  std::vector<FrontierLine> frontiers;  // the records that are known
  OwnSearch own;                        // of an optimized search
  std::vector<RungLine> rungs;          // of a benchmark; empty: none was measured
  std::optional<Since> since;           // an earlier report
  Json player;                          // what the page plays of the simplest loop; null: nothing
};

// `figures`: those of the content.
std::string FrontPage(const ReportContent& content, const std::vector<Table>& figures);
std::string ResultsPage(const ReportContent& content, const std::vector<Table>& figures);
std::string FindingsPage(const ReportContent& content);

// ---- Sections of the first page, and the head of each ----

// A template filled, with what all pages have in common: `found` stands before the method, `more` behind the
// references.
struct PageParts {
  std::string title, heading;
  Html lead, navigation, found, how, more = {};
  Json findings = Json::array(), player = {};  // of the script
};
std::string FilledPage(const std::vector<Table>& figures, const PageParts& parts);

// How problems were drawn and judged.
Html MethodText(const ReportContent& content);
// What was searched, and the commands that search it again.
Html AgainSection(const ReportContent& content);
Html FilesSection();
bool HasFrontiers(const ReportContent& content);
// <a href=...>: "results.html#steps", "Steps".
Html LinksTo(const std::vector<std::pair<std::string, std::string>>& places);
// Where in the page of all results something stands.
std::vector<std::pair<std::string, std::string>> PlacesOfResults(const ReportContent& content);

// What was found, in sentences, each a paragraph or nothing.
struct Sentences {
  Html asked, loops, grid, stuck, complete, agreement, doubles;
};
Sentences SentencesOf(const ReportContent& content);

// The best of an optimized search.
Html BestSentence(const ReportContent& content);
// What the rates are worth.
Html RateBounds(const Record& total);

// ---- Sections of the page of all results, in its order ----

Html CountedSection(const ReportContent& content);
Html OutcomesSection(const Record& total);
Html FrequenciesSection(const Record& total);
Html DoublesSection(const Record& total);
Html StepsSection(const Record& total);
Html ExistenceSection(const Record& total);
Html MethodsSection(const ReportContent& content);
Html FindingsSection(const std::vector<Discovery>& discoveries, const std::optional<Since>& since = {});

// The first findings with a representative, in the order of interest, as the scripts of the pages read them
// (web/data.md).
Json FindingsToJson(const std::vector<Discovery>& discoveries, const std::optional<Since>& since,
                    std::size_t most = std::numeric_limits<std::size_t>::max());

// What a finding is in full: its problem in numbers, what happens, commands and files.
Html FindingDetails(const Discovery& discovery);

// <section id=...><h2>...
Html Section(const std::string& id, const std::string& title, const Html& content);

}  // namespace stiction

#endif  // STICTION_REPORTS_PAGE_PAGE_H_
