// SPDX-License-Identifier: Apache-2.0
// The report: what a store holds, as a page for people, tables for programs, and files to replay and check.
//
//   index.html                    what was found: a page that needs nothing else, as the others
//   results.html                  all that was counted
//   findings.html                 all findings, each in numbers
//   replay.html                   the simplest loop, step by step, if there is a finding that plays
//   statistics.csv verdicts.csv   what was counted (tables/campaign_tables.h)
//   steps.csv findings.csv agreement.csv solutions.csv
//   figures/NAME.csv              what the figures of the page draw (figures.h)
//   campaign.json                 what was searched, for another search
//   frontiers.csv                 the worst problems that are known, if records were given (frontiers.h)
//   bench/NAME                    the files of bench, as they were given
//   since.csv                     what changed since an earlier report, if one was given (since.h)
//   citation.bib                  how to cite it (latex.h)
//   SHA256SUMS                    of every file but itself
//   findings/NAME.json            the minimized problem; as found while there is none
//   findings/NAME.svg             the scene of the problem as found, if it has one
//   findings/NAME.original.json   the problem as found
//   findings/NAME.certificate.json  of the minimized problem, otherwise of the problem as found
//   findings/NAME.existence.certificate.json            that NAME.json has a solution
//   findings/NAME.original.existence.certificate.json   likewise, of NAME.original.json if that is another
//   problem

#ifndef STICTION_REPORTS_REPORT_H_
#define STICTION_REPORTS_REPORT_H_

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "corpus/record/problem_file.h"
#include "corpus/store/store.h"
#include "corpus/whole_folder.h"
#include "reports/page/frontiers.h"
#include "reports/report_files.h"
#include "reports/viewer.h"

namespace stiction {

// What a report has besides the content of its store.
struct ReportExtras {
  std::vector<std::filesystem::path> benches = {};  // of bench --csv, drawn on the page
  std::filesystem::path since = {};                 // an earlier report, beside which the page says what is new
  bool latex = false;                               // tables and figures for papers, too (latex.h)
  // Only so many findings have files, those of most interest (discovery.h); tables and page have all.
  std::int64_t files = std::numeric_limits<std::int64_t>::max();
  std::vector<FrontierLine> frontiers = {};        // records, told on the page
  OwnSearch own = {};                              // of an optimized search, told beside them
  std::map<std::string, std::string> labels = {};  // of fields of a campaign, where they are not their names
  ShowWriting show = {};                           // told how far it is
  // Runs a problem under a policy, for the player; nothing for what is too long for a page. `file` is what its
  // command names.
  std::function<std::optional<Playable>(const ProblemFile&, const std::string& policy, const std::string& file)>
      play = {};
};

// Writes the directory as a whole (corpus/whole_folder.h), so that nothing of an older report stays. The same
// content of a store gives the same bytes. Returns where a directory with files of others was moved to, if so.
std::filesystem::path WriteReport(const Store& store, const std::filesystem::path& directory,
                                  Occupied occupied = Occupied::kRefused, const ReportExtras& extras = {});

// Likewise, of benchmarks and records alone: index.html, figures/, bench/, frontiers.csv, SHA256SUMS. Of the
// extras benches, of which there is one at least, and frontiers count.
std::filesystem::path WriteMeasured(const std::filesystem::path& directory, Occupied occupied,
                                    const ReportExtras& extras);

}  // namespace stiction

#endif  // STICTION_REPORTS_REPORT_H_
