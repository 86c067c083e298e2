// SPDX-License-Identifier: Apache-2.0
// Measurements of rungs (bench --suite trade or extremes, --csv) in a report: a figure and a table.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/told/told.h"

namespace stiction {

// A line of the file, of one family and setting; or of all settings together.
struct RungLine {
  std::string family, method, arithmetic;
  Numbers counts;  // problems, solved, undecided, other, refused, wrong, silent; asked: not refused
  std::vector<double> microseconds;  // medians, where something was solved
  double worst_residual = 0;
};

// InputError that names the line and the column of what is not as bench writes it.
std::vector<RungLine> ReadRungs(const std::filesystem::path& file);

// Time and lost answers of each method over each arithmetic.
Table RungsFigure(const std::vector<RungLine>& lines);
// The table `rungs`, and what is told of all of them.
void AddRungs(Facts& facts, const std::vector<RungLine>& lines);
// "bench/trade.csv": where a report has a file of bench.
std::string BenchName(const std::filesystem::path& file);

}  // namespace stiction
