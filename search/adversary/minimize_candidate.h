// SPDX-License-Identifier: Apache-2.0
// Minimizing a candidate as what it is: a scene stays a scene that can be built, with fewer contacts and bodies
// and rounder numbers.
//
// What is changed are choices, so nothing has to be checked but that the finding is still there. Simpler, in
// this order: fewer contacts; fewer choices, which are fewer bodies and corners; fewer significant digits of
// all choices; a smaller sum of their sizes. Passes run until none makes progress. Deterministic; no clock.

#pragma once

#include <functional>

#include "search/adversary/candidate.h"

namespace stiction {

struct MinimizedCandidate {
  Candidate candidate;
  std::int64_t tried = 0, accepted = 0;
  bool cancelled = false;
};

// `keep` says whether a candidate still shows the finding. The given one does: it is not asked again, since a
// solver that answers by chance may not fail a second time.
MinimizedCandidate MinimizeCandidate(
    const Candidate& candidate, const std::function<bool(const Candidate&)>& keep,
    const std::function<bool()>& cancelled = [] { return false; });

}  // namespace stiction
