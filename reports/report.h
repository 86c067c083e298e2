// SPDX-License-Identifier: Apache-2.0
// The report: what a store holds, as a page for people, tables for programs, and files to replay and check.
// files.md says what each file is.

#pragma once

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
