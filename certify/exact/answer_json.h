// SPDX-License-Identifier: Apache-2.0
// An answer in JSON, over any arithmetic.

#ifndef STICTION_CERTIFY_EXACT_ANSWER_JSON_H_
#define STICTION_CERTIFY_EXACT_ANSWER_JSON_H_

#include "certify/exact/solve.h"
#include "corpus/json.h"

namespace stiction {

// {"outcome", "method", "arithmetic", "word", "f", "a", "ray", "residual", "statistics", "suspected", ...}:
// exact numbers are strings, inexact ones numbers, enclosures pairs. What a method does not have is left out,
// and `unique_accelerations` is told where it is known to be false.
Json SolutionToJson(const Solution& solution, int dimension);

// {"outcome", "reason", "start", "period"} of an answer or a suspicion.
template <class End>
Json EndToJson(const End& end) {
  Json json = {{"outcome", Name(end.outcome)}};
  if (!end.reason.empty()) json["reason"] = end.reason;
  if (IsLoop(end.outcome)) {
    json["start"] = end.start;
    json["period"] = end.period;
  }
  return json;
}

// Why a cycle over rounded numbers in space is no proof.
inline constexpr std::string_view kNoProof =
    "a state stands again after rounding: forces are irrational, and this is no proof";
// Why one over intervals is.
inline constexpr std::string_view kProofOfSets =
    "proved: the sets of a state that remembers nothing stand again, and decide its forces";

Json CountersToJson(const std::vector<Counter>& counters);

}  // namespace stiction

#endif  // STICTION_CERTIFY_EXACT_ANSWER_JSON_H_
