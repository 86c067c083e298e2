// SPDX-License-Identifier: Apache-2.0
// A store as JSON, for the end of a search; that of a search with an objective also in a few lines, and its
// best as problems. All others have theirs in reports/text/text_report.h.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corpus/store/store.h"

namespace stiction {

struct Campaign;
struct Elite;
struct ProblemFile;

// The best of an optimized search, of a generator and number of contacts, as it is told.
struct BestLine {
  std::string generator, mu, value;
  int contacts = 0;
};
// Empty for a search without an objective.
std::vector<BestLine> BestLines(const Store& store);

SharedJson SummaryToJson(const Store& store);
// Of what it gives (cli/schema.h): of random problems, of a search with an objective; and of processor times.
std::string ShapeOfSummary();
std::string ShapeOfOptimized();
std::string ShapeOfTimes();
// Requires a search with an objective. `file` is named in the commands that it proposes.
std::string OptimizedText(const Store& store, const std::string& file);

// Of a candidate that BestOf gives the value as the objective of the campaign tells it, where it has one; and
// the problem itself, with where it comes from.
std::optional<double> ValueOf(const Elite& elite, const Campaign& campaign);
ProblemFile BestFile(const Elite& elite, const Campaign& campaign);

}  // namespace stiction
