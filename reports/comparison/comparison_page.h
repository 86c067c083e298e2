// SPDX-License-Identifier: Apache-2.0
// Two campaigns, or solvers under test, side by side, as one page that needs nothing else.
//
// The build joins the page (web/) and embeds it into the program; here it gets its sentences, its
// tables, and what its figures draw: the very cells of comparison.csv and comparison_steps.csv.

#ifndef STICTION_REPORTS_COMPARISON_COMPARISON_PAGE_H_
#define STICTION_REPORTS_COMPARISON_COMPARISON_PAGE_H_

#include <string>

#include "reports/comparison/comparison.h"
#include "reports/comparison/solvers.h"

namespace stiction {

// `file_a` and `file_b` are the names of the two. The same comparison gives the same bytes.
std::string ComparisonPage(const Comparison& comparison, const std::string& file_a, const std::string& file_b);

// Tables alone: no figures. `about` says what the rates are.
std::string SolversPage(const SolversCompared& compared, const std::string& about);

}  // namespace stiction

#endif  // STICTION_REPORTS_COMPARISON_COMPARISON_PAGE_H_
