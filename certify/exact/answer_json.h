// SPDX-License-Identifier: Apache-2.0
// An answer in JSON, over any arithmetic.

#pragma once

#include "certify/exact/solve.h"
#include "corpus/json.h"

namespace stiction {

// Shapes (cli/schema.h) of what stands below, each by its name in the one after it: exact numbers are strings,
// inexact ones numbers, enclosures pairs; what a method does not have is left out.
inline constexpr const char* kEndShape = "{outcome: outcome, start?: integer, period?: integer, reason?: text}";
inline constexpr const char* kErrorsShape = R"({
  residual?: rounded, acceleration_error?: rounded, force_error?: rounded, backward_error?: rounded,
  amplification?: rounded,
  worst_contact?: integer | null,  // the first is 1; null where nothing is missed
})";
inline constexpr const char* kSuspicionShape = "{...end, ...errors, arithmetic: arithmetic}";
inline constexpr const char* kSolutionShape = R"({
  ...end, ...errors, method: method, arithmetic: arithmetic, f: vector | null, a: vector | null,
  statistics: counters, ray?: vector, bound?: exact, law?: law, evidence?: text, suspected?: suspected,
  policy?: text,
  word?: text,  // the cells of the contacts at the end
  why?: text,  // why `auto` chose this method
  rung?: rung,
  unique_accelerations?: false  // another solution with other accelerations is known; this one moves less
})";

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
    "a state recurs after rounding: forces are irrational, and this is no proof";
// Why one over intervals is.
inline constexpr std::string_view kProofOfSets =
    "proved: the sets of a state that remembers nothing recur, and decide its forces";
inline constexpr std::string_view kProofOfBox =
    "proved: the steps from a state to the next of the same sets map a box of what it remembers into itself";

Json CountersToJson(const Counters& counters);

// The row of the table that made an answer: `method`, or what stands behind it, as its counters tell.
std::string_view AnsweredBy(std::string_view method, const Counters& counters);

}  // namespace stiction
