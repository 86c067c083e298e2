// SPDX-License-Identifier: Apache-2.0
// A run of the published algorithm in space, besides over intervals, which prove what they decide.

#ifndef STICTION_CLI_NARRATION_OVER_INTERVALS_H_
#define STICTION_CLI_NARRATION_OVER_INTERVALS_H_

#include <optional>
#include <string>

#include "certify/exact/solve.h"

namespace stiction {

// What intervals say of a run of the published algorithm in space that does not end solved over floating-point
// numbers; empty of any other.
std::optional<InexactAnswer> OverIntervals(const ExactProblem& problem, const Request& request,
                                           Outcome outcome);

// "over intervals, proved: cycle: ..."
std::string OverIntervalsText(const InexactAnswer& answer);

}  // namespace stiction

#endif  // STICTION_CLI_NARRATION_OVER_INTERVALS_H_
