// SPDX-License-Identifier: Apache-2.0
// A run of a path method, told: for `replay`, for its page, and for the page that runs again in a browser.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "certify/exact/solve.h"
#include "cli/narration/narrate.h"
#include "corpus/json_text.h"
#include "corpus/record/loop_sentence.h"

namespace stiction {

// Requires a path method.
Narration Narrate(std::string_view method, const ProblemFile& file, const Solution& solution,
                  const Telling& how);

// "cycle: the state after 3 drives recurs 4 drives later, for ever"
template <class End>
std::string EndText(const End& end, bool proved) {
  if (proved || end.outcome != Outcome::kCycle) return Describe(end);
  return "cycle: after rounding, " + LoopClause({ProofKind::kStates, end.start, end.period});
}

// What `replay --json` prints of the run that was asked for; `initial`: with --step, which tells forces and
// accelerations before the first step.
Json ReplayToJson(const Request& asked, const ProblemFile& file, const Solution& solution, Narration narration,
                  bool initial);

struct FollowedRun {
  std::string title;
  SharedJson replay;    // as --step --json prints it
  Narration narration;  // with vectors
  std::string end;      // how it ended, in words
  // Of the published algorithm over rationals in the plane: where the other readings of a switch leave its
  // path. One switch at a time, in table order: the first step at which the runs part, and how the other one
  // ends; values that leave the path nowhere are left out.
  SharedJson partings;
};

// A run for the viewer. InputError for one of more steps than a page has room for.
FollowedRun Followed(const Request& asked, const ProblemFile& file, const Solution& solution);

// Runs on one problem, as the viewer wants them: reports/web/data.md has the keys. `picture`:
// reports/pictures/problem_picture.h, or null; `every_policy`: that every one of the grid ends as the first
// run.
SharedJson ReplayPageData(const ProblemFile& file, const SharedJson& picture,
                          const std::vector<FollowedRun>& runs, bool every_policy = false);

}  // namespace stiction
