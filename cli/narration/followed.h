// SPDX-License-Identifier: Apache-2.0
// A run of a path method, told: for `replay`, for its page, and for the page that runs again in a browser.

#ifndef STICTION_CLI_NARRATION_FOLLOWED_H_
#define STICTION_CLI_NARRATION_FOLLOWED_H_

#include <fmt/format.h>

#include <string>

#include "certify/exact/answer_json.h"
#include "certify/exact/solve.h"
#include "cli/narration/outcome_text.h"
#include "cli/narration/replay_page.h"
#include "corpus/record/loop_sentence.h"

namespace stiction {

struct PathOptions {
  std::string method = "baraff";
  std::string policy = "paper";  // of the published algorithm
  Limits limits;
};

// Requires a path method.
Narration Narrate(const std::string& method, const ProblemFile& file, const Solution& solution,
                  const Telling& how);

// "cycle: the state after 3 drives recurs 4 drives later, for ever"
template <class End>
std::string EndText(const End& end, bool proved) {
  if (proved || end.outcome != Outcome::kCycle) return Describe(end);
  return "cycle: after rounding, " + LoopClause({ProofKind::kStates, end.start, end.period});
}

// What `replay --json` prints; `initial`: with --step, which tells forces and accelerations before the first
// step.
Json ReplayToJson(const PathOptions& o, const ProblemFile& file, const Solution& solution, Narration narration,
                  bool initial);

// A run for the viewer. InputError for one of more steps than a page has room for.
FollowedRun Followed(const PathOptions& o, const ProblemFile& file, const Solution& solution);

}  // namespace stiction

#endif  // STICTION_CLI_NARRATION_FOLLOWED_H_
