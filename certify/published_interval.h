// SPDX-License-Identifier: Apache-2.0
// The published algorithm in space over intervals: every sign that a step depends on is proved, or the run ends
// `undecided`. `solved` is then a statement about the algorithm in exact arithmetic, and so are `ray` and
// `singular`. An endless run cannot be proved: forces are irrational, and a state that stands again as far as
// rounding shows ends the run `undecided`.

#ifndef STICTION_CERTIFY_PUBLISHED_INTERVAL_H_
#define STICTION_CERTIFY_PUBLISHED_INTERVAL_H_

#include <vector>

#include "corpus/problem_file.h"
#include "solver/published_space.h"

namespace stiction {

struct Enclosure {
  double low = 0, high = 0;
};

struct IntervalRun {
  PublishedSpaceVerdict verdict;
  std::vector<Enclosure> f, a;  // by row, in the problem's own axes; as far as the run came
};

// Requires PublishedHandlesInSpace(problem), PublishedReadsInSpace(options.policy). Intervals with double ends
// around the problem's rational numbers; tolerances other than loop_grain are not read.
IntervalRun RunOverIntervals(const ExactProblem& problem, const PublishedOptions& options);

}  // namespace stiction

#endif  // STICTION_CERTIFY_PUBLISHED_INTERVAL_H_
