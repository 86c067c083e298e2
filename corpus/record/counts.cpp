// SPDX-License-Identifier: Apache-2.0
#include "corpus/record/counts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace stiction {

void Counts::Add(const Tally& tally) {
  runs += tally.problems;
  for (int inexact = 0; inexact < kOutcomeCount; ++inexact) {
    for (int outcome = 0; outcome < kOutcomeCount; ++outcome) {
      const std::int64_t count = tally.verdicts[inexact][outcome];
      exact[outcome] += count;
      suspicious += count;
      if (outcome == static_cast<int>(Outcome::kUndecided)) continue;
      (inexact == outcome ? confirmed : doubles_differ) += count;
    }
  }
  wrong += tally.wrong;
  audited += tally.audited;
  misjudged += tally.misjudged;
  with_zero_steps += tally.with_zero_steps;
  with_give_ups += tally.with_give_ups;
}

void Counts::Add(const Stratum& stratum) {
  runs += stratum.problems;
  for (int outcome = 0; outcome < kOutcomeCount; ++outcome) {
    exact[outcome] += stratum.exact[outcome];
    suspicious += stratum.exact[outcome];
  }
  audited += stratum.audited;
  misjudged += stratum.misjudged;
}

Counts CountAll(const Record& record) {
  Counts all;
  for (const auto& [key, tally] : record.tallies) all.Add(tally);
  return all;
}

std::int64_t ProblemsOf(const Record& record) {
  std::map<std::pair<std::string, int>, std::int64_t> problems;
  for (const auto& [key, tally] : record.tallies) {
    std::int64_t& most = problems[{key.generator, key.contacts}];
    most = std::max(most, tally.problems);
  }
  std::int64_t sum = 0;
  for (const auto& [key, count] : problems) sum += count;
  return sum;
}

std::string PoliciesText(const Record& record) {
  constexpr std::size_t kMostNamed = 3;
  std::set<std::string> policies;
  for (const auto& [key, tally] : record.tallies) policies.insert(key.policy);
  if (policies.empty()) return "";
  if (policies.size() == 1) return "the policy " + *policies.begin();
  const std::string all = fmt::format("{} policies", policies.size());
  return policies.size() <= kMostNamed ? fmt::format("{} ({})", all, fmt::join(policies, ", ")) : all;
}

}  // namespace stiction
