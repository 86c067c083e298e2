// SPDX-License-Identifier: Apache-2.0
// Campaign: what a search tries, in units that are the same on every machine.

#ifndef STICTION_SEARCH_CAMPAIGN_H_
#define STICTION_SEARCH_CAMPAIGN_H_

#include <cstdint>
#include <string>
#include <vector>

#include "corpus/store.h"
#include "search/generators.h"
#include "solver/options.h"

namespace stiction {

// Files: {"format": "stiction-campaign", "version": 1, ...} with any of the keys below.
struct Campaign {
  std::uint64_t seed = 1;
  std::vector<GeneratorId> generators;  // default: all
  std::vector<int> contacts = {1, 2, 3, 4, 5, 6, 7, 8};
  std::vector<MuChoice> palette = {kDefaultPalette.begin(), kDefaultPalette.end()};
  std::vector<Policy> policies = {Policy{}};
  std::int64_t unit_problems = 10000;       // problems of a unit
  std::int64_t audit_every = 5000;          // of which one in so many is also run exactly, suspicious or not
  std::int64_t representatives_per_unit = 4;  // new signatures of a unit whose problem is kept
  Limits limits = {1000, 10000, 100000};

  Campaign();
  bool operator==(const Campaign&) const = default;
};

Campaign ReadCampaign(const std::filesystem::path& file);
// Everything but the seed and the policies, canonical.
Json DefinitionToJson(const Campaign& campaign);
CampaignIdentity IdentityOf(const Campaign& campaign, const std::string& build);

// A unit tries one generator at one size.
struct Task {
  GeneratorId generator;
  int contacts;
};
// Units go round the generators and sizes; two, three and four contacts come more often (8, 4 and 2 times).
std::vector<Task> Schedule(const Campaign& campaign);

// "1/2" or "0.5" -> MuChoice; InputError otherwise.
MuChoice ParseMu(const std::string& text);

}  // namespace stiction

#endif  // STICTION_SEARCH_CAMPAIGN_H_
