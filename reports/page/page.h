// SPDX-License-Identifier: Apache-2.0
// The pages of a report, each an HTML document that needs nothing else: what was found, in few screens; all
// that was counted; the findings, which are read when they are asked for. They render what told/report.txt
// says, as text; scripts draw the figures, play a loop and make the findings sortable (web/).

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "corpus/json_text.h"
#include "corpus/store/store_totals.h"
#include "reports/html/html.h"
#include "reports/page/frontiers.h"
#include "reports/page/rungs.h"
#include "reports/tables/discovery.h"
#include "reports/tables/since.h"
#include "reports/told/told.h"

namespace stiction {

// Findings that stand in their page as text; the others are data, which its script shows.
inline constexpr std::size_t kFindingsShown = 50;
// Findings that the first page names.
inline constexpr std::size_t kFindingsNamed = 6;

// What a store says, read once; of benchmarks alone all but rungs, their files and records is empty.
struct ReportContent {
  // What an optimized search seeks; empty of problems at random.
  std::string Objective() const;

  CampaignIdentity identity;
  std::map<std::string, std::string> labels;  // of fields of a campaign, where they are not their names
  std::int64_t blocks = 0;
  StoreTotals totals;
  std::vector<Discovery> discoveries;
  std::vector<FrontierLine> frontiers;         // the records that are known
  OwnSearch own;                               // of an optimized search
  std::vector<RungLine> rungs;                 // of a benchmark; empty: none was measured
  std::vector<std::filesystem::path> benches;  // its files
  std::optional<Since> since;                  // an earlier report
  SharedJson player;                           // what the page plays of the simplest loop; null: nothing
};

// All that pages say of it: `index`, `results` and `findings`, or `measured`. It must outlive what is returned.
Told Tell(const ReportContent& content, const std::vector<std::string>& pages);

// Figures of the pages: tables that their script draws, those that have something to draw. Each stands in a
// page and, the same, in figures/NAME.csv. Rates are in a million runs, shares of 1; `low` and `high` are the
// ends of their exact intervals at 95 % (corpus/intervals.h).
std::vector<Table> Figures(const ReportContent& content);

// index.html, results.html or measured.html, by its name in report.txt; `figures`: those of the content.
std::string Page(const std::string& name, const ReportContent& content, const Told& told,
                 const std::vector<Table>& figures);
std::string FindingsPage(const ReportContent& content, const Told& told);

// ---- Findings ----

// The first findings with a representative, in the order of interest, as the scripts of the pages read them
// (web/data.md).
Json FindingsToJson(const std::vector<Discovery>& discoveries, const std::optional<Since>& since,
                    std::size_t most = std::numeric_limits<std::size_t>::max());
// A row for each of the first ones.
Html FindingsRows(const std::vector<Discovery>& discoveries, const std::optional<Since>& since);
// What a finding is in full: its problem in numbers, what happens, commands and files.
Html FindingDetails(const Discovery& discovery);

}  // namespace stiction
