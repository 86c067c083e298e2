// SPDX-License-Identifier: Apache-2.0
// The planar methods over intervals: every sign that a step depends on is proved, or the run ends `undecided`.
//
// So `solved`, `ray`, `singular` and `stall` are statements about the method in exact arithmetic, on the
// problem as it is: its numbers are enclosed by doubles, every pivot is the pivot over rationals, and the
// forces lie within their ends. A tie, a repeated state and a give-up whose zeros are not known from the sets
// (solver/problem/ enclosure.h) end `undecided`, where rationals go on.
//
// Kinds    bilateral and sliding contacts leave the problem exactly, before it is enclosed (reduction.h); a run
//          is told in the terms of the whole problem, as those of exact.h.

#ifndef STICTION_CERTIFY_INTERVALS_H_
#define STICTION_CERTIFY_INTERVALS_H_

#include <vector>

#include "certify/solve.h"
#include "corpus/problem_file.h"
#include "solver/problem/options.h"
#include "solver/problem/solution.h"

namespace stiction {

struct IntervalRun {
  Verdict verdict;
  std::vector<Enclosure> f, a;        // by row, where the run ended; empty where it could not begin
  std::vector<Enclosure> ray;         // the direction of a ray, otherwise empty
  std::vector<Pivot<double>> pivots;  // where asked for: numbers in the middle of their ends
  std::vector<Counter> more;          // than the verdict's own
};

// All require dimension 2.

IntervalRun RunPublishedOverIntervals(const ExactProblem& problem, const PublishedOptions& options,
                                      KeepTrace keep = KeepTrace::kNo);

// With a covering vector of ones. Where it ends undecided, f and a are not filled.
IntervalRun RunLemkeOverIntervals(const ExactProblem& problem, const Limits& limits,
                                  KeepTrace keep = KeepTrace::kNo);

}  // namespace stiction

#endif  // STICTION_CERTIFY_INTERVALS_H_
