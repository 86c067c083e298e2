// SPDX-License-Identifier: Apache-2.0
// The published algorithm in space over every arithmetic that it has there: floating point and intervals.
//
// Intervals   every sign that a step depends on is proved, or the run ends `undecided`. So `solved`, `ray` and
//             `singular` are statements about the algorithm in exact arithmetic. An endless run cannot be
//             proved: forces are irrational, and a state that stands again as far as rounding shows ends
//             `undecided`.
// Suspicions  what floating point does not solve is run again over long double, with finer tolerances and
//             states compared after finer rounding. `cycle` remains a suspicion.
// Kinds       bilateral and sliding contacts leave a problem exactly (solver/problem/reduction.h), before its
// numbers
//             are rounded or enclosed. Runs are told in the terms of the whole problem, as those of exact.h:
//             bilateral variables stand in C; where they cannot leave it, the run ends in `singular`.

#ifndef STICTION_CERTIFY_PUBLISHED_SPACE_H_
#define STICTION_CERTIFY_PUBLISHED_SPACE_H_

#include <vector>

#include "corpus/problem_file.h"
#include "solver/published/published_space.h"

namespace stiction {

struct RoundedSpaceRun {
  PublishedSpaceVerdict verdict;
  std::vector<double> f, a;  // by row, in the problem's own axes, where the run ended; a = A f + b anew
  std::vector<double> ray;   // the direction of a ray, otherwise empty
  double residual = 0;       // WeakResidual of f, a
  std::vector<double> initial_f, initial_a;  // before the first step: f is zero but for bilateral contacts
  SpaceTrace<double> trace;                  // where asked for
};

struct Enclosure {
  double low = 0, high = 0;
};

struct IntervalSpaceRun {
  PublishedSpaceVerdict verdict;
  std::vector<Enclosure> f, a;
  std::vector<Enclosure> ray;  // the direction of a ray, otherwise empty
};

// All require dimension 3 and PublishedReadsInSpace(options.policy).

// Each number of the problem rounded to the nearest double, and then to Scalar: float, double or long double.
enum class KeepTrace { kNo, kYes };
template <class Scalar>
RoundedSpaceRun RunRoundedInSpace(const ExactProblem& problem, const PublishedOptions& options,
                                  KeepTrace keep = KeepTrace::kNo);

// Over long double with the problem rounded to Scalar: loop_grain 1e-12, tolerances at least as fine as 1e-14.
template <class Scalar>
RoundedSpaceRun RunSuspicionInSpace(const ExactProblem& problem, const PublishedOptions& options);

// Double ends around the problem's numbers. Of the tolerances loop_grain alone is read.
IntervalSpaceRun RunIntervalsInSpace(const ExactProblem& problem, const PublishedOptions& options);

}  // namespace stiction

#endif  // STICTION_CERTIFY_PUBLISHED_SPACE_H_
