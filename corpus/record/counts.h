// SPDX-License-Identifier: Apache-2.0
// Counts: what came of runs, added up. Whoever tells a number of runs, or a rate, takes both of its counts from
// one of these, so that summary, text, page, comparison and papers agree.

#pragma once

#include <cstdint>
#include <string>

#include "corpus/record/statistics.h"

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
  std::int64_t with_zero_steps = 0;
  std::int64_t with_give_ups = 0;

  void Add(const Tally& tally);
  // Of a stratum doubles are not counted, nor what steps were like.
  void Add(const Stratum& stratum);

  std::int64_t Of(Outcome outcome) const { return exact[static_cast<int>(outcome)]; }
  // A state recurs in exact arithmetic, in space by intervals. One definition: cycles and stalls.
  std::int64_t Loops() const { return Of(Outcome::kCycle) + Of(Outcome::kStall); }
};

Counts CountAll(const Record& record);

// Every policy runs the same problems.
std::int64_t ProblemsOf(const Record& record);

// The policies of the runs: "the policy paper", "2 policies (paper, ties=contacts)", "1536 policies"; empty:
// no runs.
std::string PoliciesText(const Record& record);

// The counters of a record's tallies by contacts, added up.
template <class CountersByContacts>
auto SumOf(const CountersByContacts& by_contacts) {
  typename CountersByContacts::mapped_type sum;
  for (const auto& [contacts, counters] : by_contacts) AddCounters(sum, counters);
  return sum;
}

}  // namespace stiction
