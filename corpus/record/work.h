// SPDX-License-Identifier: Apache-2.0
// Work: the processor time that a part of a campaign took, the builds that did it, and the machines. Outcomes
// are the same wherever a unit runs, work is not: nothing of it is ever compared.

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <type_traits>

namespace stiction {

// In microseconds, by what it was spent on.
struct ProcessorTime {
  std::int64_t generation = 0;
  std::int64_t doubles = 0;
  std::int64_t filtered = 0;
  std::int64_t exact = 0;
  std::int64_t compared = 0;
  std::int64_t finishing = 0;

  std::int64_t Total() const { return generation + doubles + filtered + exact + compared + finishing; }
  bool operator==(const ProcessorTime&) const = default;
};

// visit(name, meaning, microseconds)
template <class Time, class Visit>
requires std::is_same_v<std::remove_cvref_t<Time>, ProcessorTime>
void ForEachPart(Time&& time, Visit visit) {
  visit("generation", "problems drawn, over doubles and over rationals", time.generation);
  visit("doubles", "runs over doubles, and all that is not named here", time.doubles);
  visit("filtered", "runs with certified signs", time.filtered);
  visit("exact", "runs over rationals, in space over intervals", time.exact);
  visit("compared", "complete driving, Lemke's method, all modes, safety", time.compared);
  visit("finishing", "findings certified and minimized", time.finishing);
}

inline constexpr int kProcessorTimeParts = 6;
using ProcessorTimeParts = std::array<std::int64_t, kProcessorTimeParts>;

inline ProcessorTimeParts PartsOf(const ProcessorTime& time) {
  ProcessorTimeParts parts = {};
  std::size_t n = 0;
  ForEachPart(time, [&](const char*, const char*, std::int64_t value) { parts[n++] = value; });
  return parts;
}

struct Work {
  std::set<std::string> builds;
  ProcessorTime time;
  std::set<std::string> machines = {};  // machine.h; empty where none was recorded

  // Of two parts of a campaign.
  void Add(const Work& other) {
    Combine(other, [](std::int64_t mine, std::int64_t theirs) { return mine + theirs; });
  }
  // Of two copies of the same part, which two machines may have made: the longer time counts.
  void Unite(const Work& copy) {
    Combine(copy, [](std::int64_t mine, std::int64_t theirs) { return std::max(mine, theirs); });
  }
  bool operator==(const Work&) const = default;

 private:
  template <class Operation>
  void Combine(const Work& other, Operation operation) {
    builds.insert(other.builds.begin(), other.builds.end());
    machines.insert(other.machines.begin(), other.machines.end());
    const ProcessorTimeParts theirs = PartsOf(other.time);
    auto next = theirs.begin();
    ForEachPart(time, [&](const char*, const char*, std::int64_t& mine) { mine = operation(mine, *next++); });
  }
};

}  // namespace stiction
