// SPDX-License-Identifier: Apache-2.0
// Problem number `index` of a unit, from the seed alone.

#pragma once

#include <cstdint>

#include "corpus/exact_problem.h"
#include "search/campaign.h"
#include "search/generators/generators.h"

namespace stiction {

struct ProblemFile;  // corpus/record/problem_file.h

struct Regenerated {
  ExactProblem problem;
  Drawn drawn;
};

Regenerated Regenerate(const Campaign& campaign, std::int64_t unit, std::int64_t index);
// The same where the task of the unit is known.
Regenerated Regenerate(const Campaign& campaign, const Task& task, std::int64_t unit, std::int64_t index);

// A problem that was regenerated as a file, with its scene where it has one.
ProblemFile FileOf(const Campaign& campaign, std::int64_t unit, std::int64_t index,
                   const ExactProblem& problem);

// A finding at that problem, under a policy of the campaign: what it is has to be filled in.
Finding FindingAt(const Campaign& campaign, const Task& task, std::int64_t unit, std::int64_t index,
                  std::size_t policy = 0);

}  // namespace stiction
