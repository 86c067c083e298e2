// SPDX-License-Identifier: Apache-2.0
// The page of a report: one HTML document that needs nothing else.

#ifndef STICTION_REPORTS_PAGE_H_
#define STICTION_REPORTS_PAGE_H_

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "corpus/store.h"
#include "reports/discovery.h"
#include "reports/html.h"
#include "reports/rungs.h"

namespace stiction {

// Findings that the page shows; findings.csv has them all.
inline constexpr std::size_t kFindingsShown = 300;

// What a store says, read once.
struct ReportContent {
  CampaignIdentity identity;
  std::int64_t units = 0;
  std::int64_t blocks = 0;
  Record total;
  Work work;
  std::vector<Discovery> discoveries;
  std::vector<RungLine> rungs;  // of a benchmark; empty: no such section
};

std::string Page(const ReportContent& content);

// ---- Sections of the page, in its order ----

Html FoundSection(const ReportContent& content);
Html CampaignSection(const ReportContent& content);
Html TimeTable(const ProcessorTime& time);
Html OutcomesSection(const Record& total);
Html FrequenciesSection(const Record& total);
Html DoublesSection(const Record& total);
Html PivotsSection(const Record& total);
Html StepsSection(const Record& total);
Html ExistenceSection(const Record& total);
Html FindingsSection(const std::vector<Discovery>& discoveries);

// What a finding is in full: its problem in numbers, what happens, commands and files.
Html FindingDetails(const Discovery& discovery);

// <section id=...><h2>...
Html Section(const std::string& id, const std::string& title, const Html& content);

}  // namespace stiction

#endif  // STICTION_REPORTS_PAGE_H_
