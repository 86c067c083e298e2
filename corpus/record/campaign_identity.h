// SPDX-License-Identifier: Apache-2.0
// What a campaign is, as its store says it, and what two campaigns differ in.

#ifndef STICTION_CORPUS_RECORD_CAMPAIGN_IDENTITY_H_
#define STICTION_CORPUS_RECORD_CAMPAIGN_IDENTITY_H_

#include <cstdint>
#include <string>
#include <vector>

namespace stiction {

// Two stores belong together if all of this is equal. Shards and builds are no part of it.
struct CampaignIdentity {
  std::string definition;  // canonical JSON: generators, sizes, palette, unit size, ...
  std::uint64_t seed = 0;
  std::string policies;  // JSON list of canonical names
  int algorithm = 1;     // version of what a search computes (search/algorithm_version.h)

  bool operator==(const CampaignIdentity&) const = default;
};

// What two campaigns differ in: "seed", "1", "2". Of a part that one has not its text is empty.
struct CampaignDifference {
  std::string part, of_a, of_b;
};
std::vector<CampaignDifference> DifferencesOf(const CampaignIdentity& a, const CampaignIdentity& b);

// In one line, "seed 7, not 8; contacts 2, 3, not 4": of campaigns that differ.
std::string Difference(const CampaignIdentity& stored, const CampaignIdentity& wanted);

}  // namespace stiction

#endif  // STICTION_CORPUS_RECORD_CAMPAIGN_IDENTITY_H_
