// SPDX-License-Identifier: Apache-2.0
// What is known of a claim: it is proved, disproved or not decided, in these words in every medium.
//
// proved       The certificate says it. Of several policies: it holds under every one of them.
// disproved    Its negation is certified, or an exact run ends otherwise, which `reason` says. Where it holds
// under
//              some policies and under others not, the certificate is of those under which it does.
// not decided  `reason` says which budget was spent, or what could not be told.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "corpus/json_text.h"

namespace stiction {

enum class ClaimState : std::uint8_t { kProved, kDisproved, kNotDecided };
std::string_view Name(ClaimState state);

// How the policies end of which something is claimed.
struct PolicyCounts {
  std::int64_t asked = 0;
  std::int64_t so = 0;                            // under which the claim holds
  std::int64_t open = 0;                          // under which it is not decided
  std::int64_t certified = 0;                     // that the certificate names
  std::map<std::string, std::int64_t> otherwise;  // how the others end, by outcome
  std::string example;  // one of the others: of those that refute the claim, if any do

  ClaimState State() const;
};

struct ClaimAnswer {
  ClaimState state = ClaimState::kNotDecided;
  SharedJson certificate;                // null where there is none
  std::string reason;                    // in words; empty where the certificate says it all
  std::optional<PolicyCounts> policies;  // of a claim of runs
  std::string_view method = "none";      // of existence, what decided it: complete, fast, lemke, enumerate
};

// Of a maker that returns a certificate of the claim or of its negation, or, where it has none, null or a text
// that says why.
ClaimAnswer ByCertificate(SharedJson found, const std::string& why_none = "");

// "1,320 of 1,536 policies loop; 216 end in solved." `does`, `do`: "loops", "loop".
std::string PoliciesSentence(const PolicyCounts& counts, std::string_view does, std::string_view plural);

// {asked, state, certificate, reason?, policies?: {asked, so, certified, otherwise, example?}}
SharedJson ToJson(const ClaimAnswer& answer, std::string_view claim);

// Whether the certificate of an answer as JSON is of the claim or of its negation: not so where it is of some
// policies only.
bool IsWholeCertificate(const Json& answer);

// What is said of an answer as JSON: "disproved, unsafe: a reduced determinant is not positive".
std::string ClaimSentence(const Json& answer);

}  // namespace stiction
