// SPDX-License-Identifier: Apache-2.0
// How the published algorithm ends on a problem besides the run that is told: under all readings of its text;
// in space over intervals, which prove what they decide.

#pragma once

#include <map>
#include <optional>
#include <string>

#include "certify/claims/policy_ends.h"
#include "certify/exact/solve.h"
#include "corpus/json_text.h"

namespace stiction {

struct Wanted;  // request.h

// By the name of a policy its end as JSON, without the reason, which is a run's own. Policies that consult the
// same switches run once. InputError for another method than baraff, and for an arithmetic in the plane that is
// not exact.
std::map<std::string, Json> OutcomesOf(const Wanted& wanted, const ExactProblem& problem,
                                       const std::string& source);

// What intervals say of a run of the published algorithm in space that does not end solved over floating-point
// numbers; empty of any other.
std::optional<InexactAnswer> OverIntervals(const ExactProblem& problem, const Request& request,
                                           Outcome outcome);

// "over intervals, proved: cycle: ..."
std::string OverIntervalsText(const InexactAnswer& answer);

}  // namespace stiction
