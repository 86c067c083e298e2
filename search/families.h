// SPDX-License-Identifier: Apache-2.0
// Families of problems, a generator at one number of contacts each: which of those of a campaign a store has
// tried.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "corpus/json_text.h"
#include "search/campaign.h"

namespace stiction {

struct Families {
  std::int64_t of = 0, tried = 0;
  // Numbers of contacts by generator, in the order of the campaign.
  std::vector<std::pair<std::string, std::vector<int>>> were_tried, were_not;
};
Families FamiliesOf(const Store& store, const Campaign& campaign);

// "2 of 12 families tried: integers 2, bodies 2; not reached: ..."; empty where all were. `file` is the
// store's.
std::string FamiliesText(const Store& store, const std::string& file);

// {tried, of, not_reached: ["bodies 2", ...]}
SharedJson FamiliesToJson(const Store& store);

}  // namespace stiction
