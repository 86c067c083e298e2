// SPDX-License-Identifier: Apache-2.0
// stiction replay, in space: section 5.6 over rounded numbers, complete driving on polygons exactly.

#ifndef STICTION_CLI_REPLAY_SPACE_H_
#define STICTION_CLI_REPLAY_SPACE_H_

#include <string>
#include <vector>

#include "corpus/problem_file.h"
#include "solver/problem/solution.h"

namespace stiction {

// A run, for programs and for people.
struct SpaceReplay {
  Outcome outcome = Outcome::kUndecided;
  Json json;
  std::string table;  // a line for each step
  std::string steps;  // directions, forces, accelerations and sets as well
};

// Requires dimension 3; arithmetic float, double or long-double. `vectors`: whether the JSON has them too. A
// run that does not end in `solved` is run again as RunSuspicionInSpace says, and the outcome is that of this
// run. InputError for a policy that is not built for space.
SpaceReplay ReplayPublishedInSpace(const ProblemFile& file, const PublishedOptions& options,
                                   const std::string& arithmetic, bool vectors);

// Complete driving over rationals, on polygons of so many sides. Requires dimension 3.
SpaceReplay ReplayComplete(const ProblemFile& file, int sides, const Limits& limits);

// The policies that are built for space: the planar grid with file=no and apex=kept, for each reading of
// `slip`.
std::vector<Policy> GridInSpace();

// The outcome of ReplayPublishedInSpace.
Verdict DecideRounded(const ExactProblem& problem, const PublishedOptions& options,
                      const std::string& arithmetic);

}  // namespace stiction

#endif  // STICTION_CLI_REPLAY_SPACE_H_
