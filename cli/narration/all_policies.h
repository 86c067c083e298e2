// SPDX-License-Identifier: Apache-2.0
// How the published algorithm ends on a problem under all readings of its text.

#ifndef STICTION_CLI_NARRATION_ALL_POLICIES_H_
#define STICTION_CLI_NARRATION_ALL_POLICIES_H_

#include <map>
#include <string>
#include <vector>

#include "certify/claims/policy_ends.h"
#include "corpus/exact_problem.h"
#include "corpus/json_text.h"
#include "solver/problem/options.h"

namespace stiction {

struct Wanted;  // request.h

// By the name of a policy its end as JSON, without the reason, which is a run's own. Policies that consult the
// same switches run once. InputError for another method than baraff, and for an arithmetic in the plane that is
// not exact.
std::map<std::string, Json> OutcomesOf(const Wanted& wanted, const ExactProblem& problem,
                                       const std::string& source);

}  // namespace stiction

#endif  // STICTION_CLI_NARRATION_ALL_POLICIES_H_
