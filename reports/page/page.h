// SPDX-License-Identifier: Apache-2.0
// The page of a report: one HTML document that needs nothing else. Its sections, tables and sentences stand in
// it as text; a script draws the figures and makes the findings sortable (web/, bundled ahead of time).

#ifndef STICTION_REPORTS_PAGE_PAGE_H_
#define STICTION_REPORTS_PAGE_PAGE_H_

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "corpus/store/store.h"
#include "reports/html/html.h"
#include "reports/page/figures.h"
#include "reports/page/frontiers.h"
#include "reports/page/rungs.h"
#include "reports/tables/discovery.h"
#include "reports/tables/since.h"

namespace stiction {

// Findings that stand in the page as text; the others are data, which its script shows.
inline constexpr std::size_t kFindingsShown = 300;

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
};

// `figures`: those of the content.
std::string Page(const ReportContent& content, const std::vector<Table>& figures);

// ---- Sections of the page, in its order ----

Html FoundSection(const ReportContent& content);
Html OutcomesSection(const Record& total);
Html FrequenciesSection(const Record& total);
Html DoublesSection(const Record& total);
Html StepsSection(const Record& total);
Html ExistenceSection(const Record& total);
Html MethodsSection(const ReportContent& content);
Html FindingsSection(const std::vector<Discovery>& discoveries, const std::optional<Since>& since = {});
Html AgainSection(const ReportContent& content);

// What was found, in sentences.
Html FoundSentences(const ReportContent& content);

// All findings with a representative, in the order of interest, as the script of the page reads them
// (web/data.md).
Json FindingsToJson(const std::vector<Discovery>& discoveries, const std::optional<Since>& since);

// What a finding is in full: its problem in numbers, what happens, commands and files.
Html FindingDetails(const Discovery& discovery);

// <section id=...><h2>...
Html Section(const std::string& id, const std::string& title, const Html& content);

}  // namespace stiction

#endif  // STICTION_REPORTS_PAGE_PAGE_H_
