// SPDX-License-Identifier: Apache-2.0
// The published algorithm in space over intervals.
//
// Intervals   every sign that a step depends on is proved, or the run ends `undecided`. So `solved`, `ray`,
//             `singular` and `cycle` are statements about the algorithm in exact arithmetic. Forces are
//             irrational, but not those of a state that remembers nothing: no contact in NCF, no resting force,
//             the matrix of C and CF regular. There they are a rational function of the sets, so the sets of
//             such a state that recur prove the loop, if all systems in between are regular. Where that
//             shows nothing, loops_in_space.h looks with more bits, and for a box that the run never leaves;
//             what it does not decide either ends `undecided`.
// Kinds       bilateral and sliding contacts leave a problem exactly (solver/problem/reduction.h), before its
//             numbers are rounded or enclosed. Runs are told in the terms of the whole problem, as those of
//             exact.h: bilateral variables stand in C; where they cannot leave it, the run ends in `singular`.

#pragma once

#include <string_view>

#include "certify/exact/solve.h"
#include "solver/published/published_space.h"

namespace stiction {

inline constexpr std::string_view kStaysInBox = "it never leaves a box";

// Requires dimension 3 and PublishedReadsInSpace(request.policy).
//
// Double ends around the problem's numbers; f, a and ray are the midpoints, which nobody has judged. Of the
// tolerances loop_grain alone is read.
//
// `cycle` with kStaysInBox for its reason: the run never ends, though no state need ever repeat.
InexactAnswer RunIntervalsInSpace(const ExactProblem& problem, const Request& request);

}  // namespace stiction
