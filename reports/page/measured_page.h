// SPDX-License-Identifier: Apache-2.0
// The page of benchmarks alone: that of a report without a store.

#ifndef STICTION_REPORTS_PAGE_MEASURED_PAGE_H_
#define STICTION_REPORTS_PAGE_MEASURED_PAGE_H_

#include <filesystem>
#include <string>
#include <vector>

#include "reports/page/figures.h"
#include "reports/page/frontiers.h"
#include "reports/page/rungs.h"

namespace stiction {

// The name in a report of a file of bench: one that shells and links take as it is.
std::string BenchName(const std::filesystem::path& file);

// `files`: that the lines stand in, whose names are told; `figures`: those of lines and records.
std::string MeasuredPage(const std::vector<RungLine>& lines, const std::vector<FrontierLine>& frontiers,
                         const std::vector<std::filesystem::path>& files, const std::vector<Table>& figures);

}  // namespace stiction

#endif  // STICTION_REPORTS_PAGE_MEASURED_PAGE_H_
