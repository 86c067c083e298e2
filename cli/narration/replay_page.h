// SPDX-License-Identifier: Apache-2.0
// Runs of path methods on one problem, as the viewer wants them.

#ifndef STICTION_CLI_NARRATION_REPLAY_PAGE_H_
#define STICTION_CLI_NARRATION_REPLAY_PAGE_H_

#include <string>
#include <vector>

#include "cli/narration/narrate.h"
#include "cli/narration/partings.h"
#include "corpus/json.h"

namespace stiction {

struct FollowedRun {
  std::string title;
  Json replay;          // as --step --json prints it
  Narration narration;  // with vectors
  std::string end;      // how it ended, in words
  std::vector<Parting> partings;
};

// reports/web/data.md has the keys. `picture`: reports/pictures/problem_picture.h, or null.
Json ReplayPageData(const ProblemFile& file, const Json& picture, const std::vector<FollowedRun>& runs);

}  // namespace stiction

#endif  // STICTION_CLI_NARRATION_REPLAY_PAGE_H_
