// SPDX-License-Identifier: Apache-2.0
// Suites of stiction-bench: what each is, in a table; each measures, prints, and returns an exit code.

#ifndef STICTION_BENCH_SUITE_H_
#define STICTION_BENCH_SUITE_H_

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/json_text.h"
#include "search/generators.h"

namespace stiction {

enum class SuiteId {
  kAdversary,
  kPatches,
  kSearch,
  kTrade,
  kExtremes,
  kSilent,
  kGate,
  kRatios,
  kMethods,
  kFrictionless,
  kPeers,
  kRandom,
  kStructure,
  kPeersExtremes,
  kGrowth,
  kLinearAlgebra,
  kSpace,
  kSliding,
  kSmallest,
  kScenes,
};

struct Suite {
  SuiteId id;
  std::string_view name, help;
  int most_contacts;  // that --contacts may ask for
};

inline constexpr int kMostOfMethods = 30;  // 4^n - 1 pieces are counted in 64 bits
inline constexpr int kMostOfAnySuite = 2000;

inline constexpr std::array kSuites = {
    Suite{SuiteId::kAdversary, "adversary", "the optimizers of a search beside random problems, by objective",
          kMaxContacts},
    Suite{SuiteId::kPatches, "patches",
          "ways to change the published algorithm, and how often each still fails", kMaxContacts},
    Suite{SuiteId::kSearch, "search",
          "problems a second of a search, the split of its time, threads, a roofline, Siconos's Lemke",
          kMaxContacts},
    Suite{SuiteId::kTrade, "trade",
          "speed against accuracy: every method over every arithmetic, on the generators", kMaxContacts},
    Suite{SuiteId::kExtremes, "extremes",
          "the same along dials: masses, levers, units, conditioning, friction, ...", kMaxContacts},
    Suite{SuiteId::kSilent, "silent", "wrong answers that say nothing of it, counted over generators and dials",
          kMaxContacts},
    Suite{SuiteId::kGate, "gate",
          "whether all that is called solved is, and what is left undecided, along dials", kMaxContacts},
    Suite{SuiteId::kRatios, "ratios", "certified outcomes beside doubles, staged searches beside exact ones",
          kMaxContacts},
    Suite{SuiteId::kMethods, "methods", "the methods side by side: counts, outcomes, times", kMostOfMethods},
    Suite{SuiteId::kFrictionless, "frictionless",
          "section 4 beside elimination and quadratic programs, to 150 contacts", kMostOfAnySuite},
    Suite{SuiteId::kPeers, "peers", "stiction beside other packages, by the program stiction-peers",
          kMostOfAnySuite},
    Suite{SuiteId::kRandom, "random", "of it, random problems by the number of contacts", kMostOfAnySuite},
    Suite{SuiteId::kStructure, "structure", "of it, stacks, walls, scenes, nearly dependent rows",
          kMostOfAnySuite},
    Suite{SuiteId::kPeersExtremes, "peers-extremes", "of it, the dials of extremes, judged over rationals",
          kMostOfAnySuite},
    Suite{SuiteId::kGrowth, "growth", "of it, time and memory at up to 2000 contacts", kMostOfAnySuite},
    Suite{SuiteId::kLinearAlgebra, "linear-algebra", "ways to solve a linear system exactly, side by side",
          kMaxContacts},
    Suite{SuiteId::kSpace, "space", "readings of section 5.6 in space: counts and outcomes", 12},
    Suite{SuiteId::kSliding, "sliding", "section 6, contacts that slide: counts and outcomes", kMaxContacts},
    Suite{SuiteId::kSmallest, "smallest", "loops of two contacts with small integers, A definite, mu = 1",
          kMaxContacts},
    Suite{SuiteId::kScenes, "scenes",
          "frames a second of the scenes of a folder, minimal and full models, or one thread and more",
          kMaxContacts},
};

struct BenchOptions {
  std::string suite = "search";
  std::vector<int> contacts;             // empty: the suite's own
  std::optional<std::int64_t> problems;  // empty: the suite's own
  int repeat = 5;
  std::uint64_t seed = 1;
  std::optional<GeneratorId> generator;  // empty: the suite's own
  std::string scenes = "corpus/scenes";  // folder
  std::vector<std::string> families;     // of problems with structure; empty: all
  int threads = 1;                       // of a simulation, of `silent`
  int entries = 2;                       // the largest integer of `smallest`
  bool exact = false;                    // `smallest`: every run over rationals
  std::string csv;                       // a file for the lines of trade and extremes
  bool json = false;
};

// The optimizers of a search side by side (adversary.cpp).
int BenchAdversary(const BenchOptions& options);

// Ways to change the published algorithm, and how often each still fails (patches.cpp).
int BenchPatches(const BenchOptions& options);

// The problems of two contacts with small integers, A definite, mu = 1 (smallest.cpp).
int BenchSmallest(const BenchOptions& options);

// Every method over every arithmetic: on generators; along dials; counting silent wrong answers alone
// (ladder.cpp). Exit 1 where one is silently wrong.
int BenchTrade(const BenchOptions& options);
int BenchExtremes(const BenchOptions& options);
int BenchSilent(const BenchOptions& options);
// Whether all that is called solved over inexact numbers is solved, along dials in the plane and in space
// (gate.cpp). Exit 1 where it is not.
int BenchGate(const BenchOptions& options);
// What certified outcomes cost beside doubles, and searches with staged suspicions beside those without
// (ratios.cpp).
int BenchRatios(const BenchOptions& options);

// Problems a second of a search, the split of its time, threads, a roofline, Siconos's Lemke (search_rate.cpp).
int BenchSearch(const BenchOptions& options);

// The methods side by side on the same problems (methods.cpp).
int BenchMethods(const BenchOptions& options);
// Section 4 beside elimination and quadratic programs, to 150 contacts (methods.cpp).
int BenchFrictionless(const BenchOptions& options);

// stiction beside the solvers of other packages (run_peers.cpp, peers.cpp). Does not return. InputError if the
// program stiction-peers is missing.
int BenchPeers(const BenchOptions& options);

// One of its tables, in a process of its own. InputError if it cannot be had.
Json AskPeers(const BenchOptions& options, const std::string& table);

// Of it, random problems by the number of contacts (peers_tables.cpp).
int BenchRandom(const BenchOptions& options);
// Of it, problems with structure (peers_structure.cpp).
int BenchStructure(const BenchOptions& options);
// Of it, the dials of `extremes` (peers_extremes.cpp).
int BenchPeersExtremes(const BenchOptions& options);
// Of it, the growth of time and memory with the number of contacts, direction systems updated and solved
// afresh.
int BenchGrowth(const BenchOptions& options);

// Ways to solve a linear system exactly, side by side on the same systems (linear_algebra.cpp).
int BenchLinearAlgebra(const BenchOptions& options);
// The readings of section 5.6 side by side, on problems in space (space.cpp).
int BenchSpace(const BenchOptions& options);
// The published algorithm where contacts slide (sliding.cpp).
int BenchSliding(const BenchOptions& options);

// The scenes of a folder, side by side the minimal and the full model, or one thread and more (scenes.cpp).
// InputError if there are none.
int BenchScenes(const BenchOptions& options);

}  // namespace stiction

#endif  // STICTION_BENCH_SUITE_H_
