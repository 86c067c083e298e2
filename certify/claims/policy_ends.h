// SPDX-License-Identifier: Apache-2.0
// How the published algorithm ends under each of the policies of which something is claimed: exactly in the
// plane, in space as intervals prove.

#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "certify/claims/claim_answer.h"
#include "certify/exact/properties.h"
#include "solver/problem/options.h"
#include "solver/problem/solution.h"

namespace stiction {

// Policies that take the same steps.
struct PolicyEnds {
  std::vector<Policy> policies;
  Outcome outcome = Outcome::kUndecided;
  std::string reason = {};  // of a run that is out of a budget, or undecided
  std::int64_t drives = 0, steps = 0;
};

// All policies: in the plane the whole grid; in space what of it is built there, for each reading of `slip`.
std::vector<Policy> GridOf(int dimension);
// ParsePolicies, whose "*" is GridOf.
std::vector<Policy> PoliciesAsked(std::string_view text, int dimension);

std::vector<PolicyEnds> EndsUnder(const std::vector<Policy>& policies, const ExactProblem& problem,
                                  const Limits& limits);

// Whether what is claimed is so of a run that ended in this way; not decided where its outcome is none.
using EndState = std::function<ClaimState(const PolicyEnds&)>;

// What is claimed, in words: "loops", "loop".
struct ClaimedVerb {
  std::string_view one, more;
};

// Without a certificate.
ClaimAnswer AnswerOfEnds(const std::vector<PolicyEnds>& ends, const ClaimedVerb& verb, const EndState& state);

// Proved of this outcome, not decided of a run that did not end, disproved of any other.
EndState EndsIn(Outcome outcome);

}  // namespace stiction
