// SPDX-License-Identifier: Apache-2.0
// What a store holds, summed up once for all who speak of it: summaries, texts, pages.

#ifndef STICTION_CORPUS_STORE_TOTALS_H_
#define STICTION_CORPUS_STORE_TOTALS_H_

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "corpus/store.h"

namespace stiction {

// A signature up to the first "-<number>c". That is a kind, sometimes with its outcomes:
// "disagreement-ray-solved".
std::string LabelOf(const std::string& signature);

// Labels: the gravest kinds first, then loops.
struct LabelsByGravity {
  bool operator()(const std::string& left, const std::string& right) const;
};

struct StoreTotals {
  using CountsByLabel = std::map<std::string, std::int64_t, LabelsByGravity>;

  Record record;  // of all units
  Work work;
  std::int64_t units = 0, problems = 0;
  std::int64_t runs = 0;        // each problem under every policy
  std::int64_t suspicions = 0;  // runs repeated exactly since doubles did not solve them well
  std::int64_t confirmed = 0;   // of these, with the same outcome
  std::int64_t audited = 0;     // runs repeated exactly without a suspicion
  std::int64_t misjudged = 0;   // of these, with another outcome
  std::int64_t wrong = 0;       // called solved with forces that are none
  CountsByLabel findings;       // runs
  CountsByLabel groups;         // signatures
  ExistenceTally existence;
  AgreementTally agreement;
  LoopTally loops;             // by_zero_steps stays empty
  std::vector<Finding> grave;  // representatives
  std::int64_t finished = 0, pending = 0;
  std::int64_t whole_grid = 0;    // minimized loops under every policy
  std::vector<Finding> simplest;  // finished and minimized: the gravest, loops, the shortest problem first

  // Runs and groups whose kind is a loop.
  std::int64_t LoopsMet() const;
  std::int64_t LoopGroups() const;
};

StoreTotals TotalsOf(const Store& store);

// What the facts of a finished finding say of its minimized problem: with a grid, contacts, start and period.
// InputError where they do not.
Json MinimizedFacts(const Finding& finding);

// "processor time: 41.2 s: generation 10 %, ..."; what took nothing is left out, all of it if nothing took any.
std::string TimeText(const ProcessorTime& time);

// What finishes the findings of a store that are not yet certified and minimized.
std::string FinishCommand(const std::string& file);

}  // namespace stiction

#endif  // STICTION_CORPUS_STORE_TOTALS_H_
