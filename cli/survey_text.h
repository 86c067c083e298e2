// SPDX-License-Identifier: Apache-2.0
// What `stiction survey` says to people, of the entries that --json prints.

#ifndef STICTION_CLI_SURVEY_TEXT_H_
#define STICTION_CLI_SURVEY_TEXT_H_

#include "corpus/json_text.h"

namespace stiction {

inline constexpr double kMostRounding = 1e-2;  // A - A' up to this part of A may be rounding, and is mended

// The facts once, then a line for every run; the same of (A + A')/2, if that was judged.
void PrintSurveyed(const Json& entry);
// Of one problem: what it meets, and what became of it.
void PrintSurveySentences(const Json& entry);
// Of many: how many meet the paper's assumptions, and how often each method ended how.
void PrintSurveyCounts(const Json& entries, bool suspicions);

}  // namespace stiction

#endif  // STICTION_CLI_SURVEY_TEXT_H_
