// SPDX-License-Identifier: Apache-2.0
// Counts: what came of runs, added up. Whoever tells a number of runs, or a rate, takes both of its counts from
// one of these, so that summary, text, page, comparison and papers agree.

#ifndef STICTION_CORPUS_COUNTS_H_
#define STICTION_CORPUS_COUNTS_H_

#include <cstdint>
#include <functional>
#include <map>

#include "corpus/statistics.h"

namespace stiction {

struct Counts {
  std::int64_t runs = 0;
  Tally::Outcomes exact = {};       // of suspicious runs, as they ended in exact arithmetic
  std::int64_t suspicious = 0;      // run again exactly, since doubles did not solve them well
  std::int64_t confirmed = 0;       // of these, with the outcome of doubles
  std::int64_t doubles_differ = 0;  // of these, with another outcome, and decided
  std::int64_t wrong = 0;           // called solved by doubles, with forces that are no solution
  std::int64_t audited = 0;         // run again exactly without a suspicion, as a sample
  std::int64_t misjudged = 0;       // of these, with another outcome

  void Add(const Tally& tally);
  // Of a stratum doubles are not counted.
  void Add(const Stratum& stratum);

  std::int64_t Of(Outcome outcome) const { return exact[static_cast<int>(outcome)]; }
  // A state stands again in exact arithmetic, in space by intervals. One definition: cycles and stalls.
  std::int64_t Loops() const { return Of(Outcome::kCycle) + Of(Outcome::kStall); }
};

Counts CountAll(const Record& record);

// By what `by` makes of a TallyKey, in order.
template <class By>
auto CountBy(const Record& record, By by) {
  std::map<decltype(by(TallyKey{})), Counts> counts;
  for (const auto& [key, tally] : record.tallies) counts[by(key)].Add(tally);
  return counts;
}

// The same of strata, by what `by` makes of a TallyKey and a StratumKey.
template <class By>
auto CountStrataBy(const Record& record, By by) {
  std::map<decltype(by(TallyKey{}, StratumKey{})), Counts> counts;
  for (const auto& [key, tally] : record.tallies) {
    for (const auto& [stratum_key, stratum] : tally.strata) counts[by(key, stratum_key)].Add(stratum);
  }
  return counts;
}

// Tallies themselves, merged.
template <class By>
auto MergeBy(const Record& record, By by) {
  std::map<decltype(by(TallyKey{})), Tally> merged;
  for (const auto& [key, tally] : record.tallies) merged[by(key)].Merge(tally);
  return merged;
}

// Every policy runs the same problems.
std::int64_t ProblemsOf(const Record& record);

}  // namespace stiction

#endif  // STICTION_CORPUS_COUNTS_H_
