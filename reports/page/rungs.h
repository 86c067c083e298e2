// SPDX-License-Identifier: Apache-2.0
// Measurements of rungs (bench --suite trade or extremes, --csv) in a report: a figure, and a table for each
// family.

#ifndef STICTION_REPORTS_PAGE_RUNGS_H_
#define STICTION_REPORTS_PAGE_RUNGS_H_

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reports/html/html.h"
#include "reports/page/figures.h"

namespace stiction {

// A line of the file, of one family and setting.
struct RungLine {
  std::string family, method, arithmetic;
  std::int64_t problems = 0, solved = 0, undecided = 0, other = 0, refused = 0, wrong = 0, silent = 0;
  std::optional<double> microseconds, worst_residual;  // the first: the median
};

// InputError that names the line and the column of what is not as bench writes it.
std::vector<RungLine> ReadRungs(const std::filesystem::path& file);

// Time and lost answers of each method over each arithmetic (figures.h).
Table RungsFigure(const std::vector<RungLine>& lines);
// Without lines it says what measures them.
Html RungsSection(const std::vector<RungLine>& lines);

}  // namespace stiction

#endif  // STICTION_REPORTS_PAGE_RUNGS_H_
