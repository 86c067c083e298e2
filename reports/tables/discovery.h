// SPDX-License-Identifier: Apache-2.0
// Discovery: one signature of a campaign, as a report speaks of it. A finding of the store with how often its
// signature was met, and what its facts say in numbers.

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "corpus/store/store.h"
#include "solver/problem/solution.h"

namespace stiction {

// Outcomes of one problem over the policy grid.
struct GridOutcomes {
  std::array<std::int64_t, kOutcomeCount> counts = {};

  std::int64_t Total() const;
  bool IsAll(std::string_view outcome) const;  // every policy ends in it; false for an empty grid
  std::int64_t Loops() const;                  // in a cycle or a stall
  bool AllLoop() const;
};

// One of the two runs that a finished finding's facts describe: of the problem as found, of the minimized one.
struct RunFacts {
  std::int64_t contacts = 0;
  std::int64_t start = 0;   // in drives for a cycle, in steps for a stall
  std::int64_t period = 0;  // likewise
  std::int64_t steps = 0;   // from f = 0 to the end of the first repetition
  GridOutcomes grid;
  std::optional<bool> safe;  // where it was decided
};

// What Ipopt made of the problem as found.
struct FeasibilityFacts {
  std::string outcome;
  std::int64_t starts = 0;
};

struct LoopLength {
  std::int64_t drives = 0;
  std::int64_t steps = 0;
};

// Relative to the report's directory; empty: there is no such file.
struct FindingFiles {
  std::string problem;
  std::string original;
  std::string certificate;
  std::string existence;           // of the problem
  std::string original_existence;  // of the problem as found, if that is another one
  std::string picture = {};        // of the scene of the problem as found, if it has one
};

struct Discovery {
  std::string signature;
  std::string kind;
  std::int64_t met = 0;
  const Finding* representative = nullptr;  // none was kept: a unit keeps a bounded number of them
  std::optional<LoopLength> loop;
  std::optional<RunFacts> found;          // finished only
  std::optional<RunFacts> minimized;      // finished and minimized only
  std::optional<FeasibilityFacts> ipopt;  // finished, in the plane
  std::optional<WordSketch> words;        // of its loops, where the signature is counts alone
  FindingFiles files;

  bool HasFiles() const { return !files.problem.empty(); }
  bool Finished() const { return representative != nullptr && representative->done; }
  bool IsLoop() const;     // of the published algorithm
  bool WholeGrid() const;  // every policy ends in the outcome of the finding, and that is not `solved`
  // Different words of its loops: counted, or estimated and then no more than there were loops. Requires
  // `words`.
  std::int64_t Words() const;
  // Whether the policies of the planar grid were run on it as it was found: of loops in the plane.
  bool SawPolicies() const { return found && found->grid.Total() > 0; }
  bool EveryPolicyLoops() const { return found && found->grid.AllLoop(); }
  int SmallestContacts() const;  // of the minimized problem, or as found
};

// In the order of signature. The findings must outlive what is returned.
std::vector<Discovery> Discoveries(const Record& record, const std::vector<Finding>& findings);

// The loop with the shortest minimized problem, the gravest first, as StoreTotals has it
// (corpus/store/store_totals.h); null if none is minimized.
const Discovery* SimplestLoop(const std::vector<Discovery>& discoveries);

// The order of interest: grave kinds (kinds.h), loops, finished ones, fewest contacts, then those that the
// whole grid shows, then the most frequent, then by signature. Only those with a representative.
std::vector<const Discovery*> ByInterest(const std::vector<Discovery>& discoveries);

// A signature as a file name without extension: letters, digits and -_=,@ stay; a name that had to be changed
// gets a hash of the signature, so that two signatures never share a file.
std::string FileName(const std::string& signature);

}  // namespace stiction
