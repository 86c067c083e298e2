// SPDX-License-Identifier: Apache-2.0
// Units of a campaign with an objective: an optimizer's candidates in the place of random problems.
//
// A unit starts from the best that units of earlier epochs of its shard found, of its task and, side by side,
// of smaller sizes of its generator (parents.h). So all units of an epoch can run at once, and nothing but the
// campaign and the shard decides what comes out.

#pragma once

#include <map>
#include <string>
#include <vector>

#include "search/adversary/optimizer.h"
#include "search/units/unit.h"

namespace stiction {

// As a store keeps those of a unit, with what they cost.
struct UnitElites {
  std::vector<Elite> elites;  // the best first; their worth is of the exact problem
  std::int64_t evaluations = 0, confirmations = 0, denied = 0;
};
std::string ToText(const UnitElites& elites);
UnitElites ElitesFromText(const std::string& text, const std::string& source);  // InputError

// What earlier epochs found.
class Heritage {
 public:
  static constexpr std::int64_t kUnitsPerEpoch = 8;  // of a shard

  Heritage(const Campaign& campaign, const Shard& shard) : schedule_(Schedule(campaign)), shard_(shard) {}

  static std::int64_t EpochOf(std::int64_t unit, const Shard& shard) {
    return unit / shard.count / kUnitsPerEpoch;
  }

  // In any order; units of other shards are passed over.
  void Add(std::int64_t unit, const UnitElites& elites);
  // The best of its task, then the best of each smaller size, the largest first. Requires all units of this
  // shard of earlier epochs.
  std::vector<Candidate> ParentsOf(std::int64_t unit) const;

 private:
  std::vector<Task> schedule_;
  Shard shard_;
  std::map<std::int64_t, std::vector<Elite>> units_;
};

UnitResult RunOptimizedUnit(
    const Campaign& campaign, std::int64_t unit, const std::vector<Candidate>& parents,
    const std::function<bool()>& cancelled = [] { return false; }, const TrySolver& tries = {});

// The best candidates of a store, over all its units: the best first, at most `most` of each generator and
// number of contacts.
std::vector<Elite> BestOf(const Store& store, std::size_t most);

}  // namespace stiction
