// SPDX-License-Identifier: Apache-2.0
// What a campaign is, as its store says it; what is told of it; and what two campaigns differ in.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "corpus/json_text.h"

namespace stiction {

// Two stores belong together if all of this but the remarks is equal. Shards and builds are no part of it.
struct CampaignIdentity {
  std::string definition;  // canonical JSON: generators, sizes, palette, unit size, ...
  std::uint64_t seed = 0;
  std::string policies;      // JSON list of canonical names
  int algorithm = 1;         // version of what a search computes (search/algorithm_version.h)
  std::string remarks = {};  // JSON object; empty where there are none

  bool operator==(const CampaignIdentity& other) const {
    return definition == other.definition && seed == other.seed && policies == other.policies &&
           algorithm == other.algorithm;
  }
};

// What JSON a text stands for; the text itself where it is none.
SharedJson JsonOrText(const std::string& text);
// The remarks of a campaign, by name; and its definition with them, which is no object if it was damaged.
SharedJson RemarksOf(const CampaignIdentity& identity);
SharedJson ToldDefinition(const CampaignIdentity& identity);
// What was searched, as stiction search reads it; the definition as it stands if that is no JSON object.
std::string CampaignText(const CampaignIdentity& identity);

// What two campaigns differ in: "seed", "1", "2". Of a part that one has not its text is empty.
struct CampaignDifference {
  std::string part, of_a, of_b;
};
std::vector<CampaignDifference> DifferencesOf(const CampaignIdentity& a, const CampaignIdentity& b);

// In one line, "seed 7, not 8; contacts 2, 3, not 4": of campaigns that differ.
std::string Difference(const CampaignIdentity& stored, const CampaignIdentity& wanted);

}  // namespace stiction
