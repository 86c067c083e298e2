// SPDX-License-Identifier: Apache-2.0
// Counters: what a method counts, by names that are said once.

#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace stiction {

// In the order in which they are told.
enum class Counter : std::uint8_t {
  kDrives,
  kSteps,
  kPivots,
  kZeroSteps,
  kLongestZeroRun,
  kBounces,
  kGiveUps,
  kSingularDirections,
  kOuterScans,
  kRedirects,
  kBreaks,
  kPrefixes,
  kPrograms,
  kSweeps,
  kExchanges,
  kPoints,
  kNewtonSteps,
  kStarts,
  kIterations,
  kFactorizations,
  kUpdates,
  kWords,
  kPublished,
  kFallbacks,
  kPolygons,
  kPieces,
  kFolds,
  kDescents,
  kTies,
  kStages,
  kRefinements,
  kLoose,
  kSparse,
  kWarm,
};

struct CounterName {
  std::string_view name, help;
};

inline constexpr std::array kCounterNames = {
    CounterName{"drives", "calls of drive-to-zero"},
    CounterName{"steps", "turns of its loop"},
    CounterName{"pivots", "steps after which a variable changed its set"},
    CounterName{"zero_steps", "steps of length zero"},
    CounterName{"longest_zero_run", "most zero steps in a row within a drive"},
    CounterName{"bounces", "zero steps after which the variable wants back"},
    CounterName{"give_ups", "variables removed from their set"},
    CounterName{"singular_directions", "direction systems with a singular matrix"},
    CounterName{"outer_scans", "scans for a violated condition"},
    CounterName{"redirects", "contacts given up because their recorded direction opposes aF no more"},
    CounterName{"breaks", "scans at which every contact is established by its set, yet (21) fails at one"},
    CounterName{"prefixes", "beginnings of mode words that were looked at"},
    CounterName{"programs", "linear programs solved"},
    CounterName{"sweeps", "Gauss-Seidel sweeps over all contacts"},
    CounterName{"exchanges", "guesses of all cells"},
    CounterName{"points", "proximal problems tried"},
    CounterName{"newton_steps", "steps of Newton's method"},
    CounterName{"starts", "points from which it started"},
    CounterName{"iterations", "iterations of an optimizer"},
    CounterName{"factorizations", "matrices factored"},
    CounterName{"updates", "contacts that entered or left a factored matrix"},
    CounterName{"words", "mode words solved exactly"},
    CounterName{"published", "1 if the published algorithm was called"},
    CounterName{"fallbacks", "runs of complete driving behind another method"},
    CounterName{"polygons", "runs of complete driving on polygons"},
    CounterName{"pieces", "linear pieces of the path"},
    CounterName{"folds", "points of a stage where the driven force turns"},
    CounterName{"descents", "returns of a driven force to zero"},
    CounterName{"ties", "times the perturbation of b was consulted"},
    CounterName{"stages", "stages entered"},
    CounterName{"refinements", "times polygons got more corners"},
    CounterName{"loose", "problems solved to kLooseResidual only"},
    CounterName{"sparse", "problems solved in the space of bodies, without A"},
    CounterName{"warm", "problems solved from given forces"},
};
inline constexpr int kCounterCount = static_cast<int>(kCounterNames.size());
static_assert(static_cast<int>(Counter::kWarm) + 1 == kCounterCount);

class Counters {
 public:
  Counters() = default;
  // Those that a method tells, at zero or with their values.
  Counters(std::initializer_list<Counter> told) {
    for (const Counter c : told) told_[Index(c)] = true;
  }
  Counters(std::initializer_list<std::pair<Counter, std::int64_t>> told) {
    for (const auto& [c, value] : told) Tell(c) = value;
  }

  std::int64_t operator[](Counter c) const { return values_[Index(c)]; }
  std::int64_t& operator[](Counter c) { return values_[Index(c)]; }
  // The same, told from now on.
  std::int64_t& Tell(Counter c) {
    told_[Index(c)] = true;
    return values_[Index(c)];
  }
  Counters& operator+=(const Counters& more) {
    more.ForEach([this](Counter c, std::int64_t value) { Tell(c) += value; });
    return *this;
  }

  // visit(counter, value) of those that are told.
  template <class Visit>
  void ForEach(Visit visit) const {
    for (int i = 0; i < kCounterCount; ++i)
      if (told_[i]) visit(static_cast<Counter>(i), values_[i]);
  }

  bool operator==(const Counters&) const = default;

 private:
  static int Index(Counter c) { return static_cast<int>(c); }

  std::array<std::int64_t, kCounterCount> values_ = {};
  std::array<bool, kCounterCount> told_ = {};
};

inline constexpr std::string_view Name(Counter c) { return kCounterNames[static_cast<int>(c)].name; }

}  // namespace stiction
