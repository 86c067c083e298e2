// SPDX-License-Identifier: Apache-2.0
// The published algorithm in space over intervals.
//
// Intervals   every sign that a step depends on is proved, or the run ends `undecided`. So `solved`, `ray` and
//             `singular` are statements about the algorithm in exact arithmetic. An endless run cannot be
//             proved: forces are irrational, and a state that stands again as far as rounding shows ends
//             `undecided`.
// Kinds       bilateral and sliding contacts leave a problem exactly (solver/problem/reduction.h), before its
//             numbers are rounded or enclosed. Runs are told in the terms of the whole problem, as those of
//             exact.h: bilateral variables stand in C; where they cannot leave it, the run ends in `singular`.

#ifndef STICTION_CERTIFY_PUBLISHED_SPACE_H_
#define STICTION_CERTIFY_PUBLISHED_SPACE_H_

#include <vector>

#include "certify/solve.h"
#include "solver/published/published_space.h"

namespace stiction {

struct IntervalSpaceRun {
  PublishedSpaceVerdict verdict;
  std::vector<Enclosure> f, a;
  std::vector<Enclosure> ray;  // the direction of a ray, otherwise empty
};

// Requires dimension 3 and PublishedReadsInSpace(options.policy).
//
// Double ends around the problem's numbers. Of the tolerances loop_grain alone is read.
IntervalSpaceRun RunIntervalsInSpace(const ExactProblem& problem, const PublishedOptions& options);

}  // namespace stiction

#endif  // STICTION_CERTIFY_PUBLISHED_SPACE_H_
