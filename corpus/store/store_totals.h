// SPDX-License-Identifier: Apache-2.0
// What a store holds, summed up once for all who speak of it: summaries, texts, pages.

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "corpus/record/counts.h"
#include "corpus/store/store.h"

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
  Counts counts;         // of all runs: each problem under every policy
  CountsByLabel groups;  // signatures, by label
  ExistenceTally existence;
  AgreementTally agreement;
  // Of exact methods: met by units, and shown only when a finding was finished.
  std::int64_t disagreements = 0;
  LoopTally loops;             // by_zero_steps stays empty
  std::vector<Finding> grave;  // representatives
  std::int64_t finished = 0, pending = 0;
  std::int64_t finished_loops = 0, whole_grid = 0;  // minimized loops, and of these those under every policy
  std::vector<Finding> simplest;  // finished and minimized: the gravest, loops, the shortest problem first

  // Groups whose kind is a loop.
  std::int64_t LoopGroups() const;
};

StoreTotals TotalsOf(const Store& store);

// What the facts of a finished finding say of its minimized problem: with a grid, contacts, start and period.
// InputError where they do not.
SharedJson MinimizedFacts(const Finding& finding);

// "processor time: 41.2 s: generation 10 %, ..."; what took nothing is left out, all of it if nothing took any.
std::string TimeText(const ProcessorTime& time);

// What finishes the findings of a store that are not yet certified and minimized.
std::string FinishCommand(const std::string& file);

}  // namespace stiction
