// SPDX-License-Identifier: Apache-2.0
// stiction solve --method baraff, in space.

#ifndef STICTION_CLI_SOLVE_PUBLISHED_SPACE_H_
#define STICTION_CLI_SOLVE_PUBLISHED_SPACE_H_

#include <string>

#include "corpus/problem_file.h"
#include "solver/problem/solution.h"

namespace stiction {

struct PublishedSpaceAnswer {
  Outcome outcome = Outcome::kUndecided;
  Json result;  // without the assumptions
};

// Requires dimension 3. An empty arithmetic is `interval`. InputError for an arithmetic or
// a policy that is not built for space.
PublishedSpaceAnswer SolvePublishedInSpace(const ExactProblem& problem, const std::string& arithmetic,
                                           const PublishedOptions& options);

}  // namespace stiction

#endif  // STICTION_CLI_SOLVE_PUBLISHED_SPACE_H_
