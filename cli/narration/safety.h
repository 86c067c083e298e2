// SPDX-License-Identifier: Apache-2.0
// Whether A is safe (certify/claims/safe.h), weakly safe, safe in the limit, and for which friction: what
// `certify --safe` and `explain` say, found once.

#pragma once

#include <string>

#include "corpus/exact_problem.h"
#include "corpus/json_text.h"

namespace stiction {

// What `certify --safe --json` prints. Requires a planar problem of frictionless and static contacts.
Json SafetyOf(const ExactProblem& problem);

// Its first sentence: what the determinants say, and what follows for a run.
std::string SafetySentence(const Json& safety);

// All of it, in lines.
std::string SafetyText(const Json& safety);

// ["slip-", "stick"] -> "slip- stick".
std::string WordText(const Json& word);

}  // namespace stiction
