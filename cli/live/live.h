// SPDX-License-Identifier: Apache-2.0
// What a page of `replay` asks of the solver that it brings along (reports/web/README.md): run an edited
// problem.
//
// The same sources as the program's, over numbers that are headers alone:
// no file, no clock, no thread. Rationals are Boost's (corpus/rational_boost.h). In space, where forces are
// irrational, the published algorithm runs over doubles alone, and says so. Built for browsers by build.py.

#pragma once

#include <string>

#include "solver/problem/options.h"

namespace stiction {

// Of a run on a page, whose reader waits. One that spends them ends in `limit`, and says so. kMostStepsOfPage
// is no less.
inline constexpr Limits kLiveLimits = {.drives = 300, .pivots = 1000, .bits = 2000};
inline constexpr int kMostLiveRows = 64;

// Of {"ask": "switches"}: {"switches": the table of the policy in the plane, "in_space": what of it is built
// there, "limits": {"max-drives", "max-pivots", "max-bits"}}. Of {"ask": "run", "problem": the text of a
// problem file, "method", "policy"}: {"data": as the page has it}, without a picture, of that method and of
// complete driving beside it. Of whatever is wrong
// {"error": one line}. Never throws.
std::string AnswerLive(const std::string& request);

}  // namespace stiction
