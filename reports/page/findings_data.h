// SPDX-License-Identifier: Apache-2.0
// What the page says of one finding, as text and as data.

#ifndef STICTION_REPORTS_PAGE_FINDINGS_DATA_H_
#define STICTION_REPORTS_PAGE_FINDINGS_DATA_H_

#include <cstdint>
#include <string>
#include <vector>

#include "corpus/exact_problem.h"
#include "reports/tables/discovery.h"

namespace stiction {

// Of the JSON text of a problem; longer ones nobody reads off a page.
inline constexpr std::size_t kLongestProblem = 6000;

// "N1", "F1", "N2", ...; in space a contact has two friction rows, "F1x" and "F1y".
std::vector<std::string> RowNames(const ExactProblem& problem);
// What stands in the column of mu: the coefficient beside the normal of its contact.
std::vector<std::string> MuColumn(const ExactProblem& problem);

struct ProblemSize {
  int nonzeros = 0;       // of A and b
  std::int64_t bits = 0;  // of the longest numerator or denominator
};
ProblemSize SizeOf(const ExactProblem& problem);

// The minimized problem; as found while there is none.
const std::string& SimplestText(const Finding& finding);
// "solved 36, cycle 1,500"
std::string GridText(const GridOutcomes& grid);
// What happens, and to which problem.
std::string StoryOf(const Discovery& discovery);
// Of a shell in the folder of the report.
std::string CommandsOf(const Discovery& discovery);

}  // namespace stiction

#endif  // STICTION_REPORTS_PAGE_FINDINGS_DATA_H_
