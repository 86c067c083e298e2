// SPDX-License-Identifier: Apache-2.0
#include "cli/narration/partings.h"

#include <algorithm>
#include <optional>

#include "certify/exact/exact.h"

namespace stiction {
namespace {

using Steps = std::vector<Pivot<Rational>>;

bool AreSame(const Pivot<Rational>& left, const Pivot<Rational>& right) {
  return left.driven == right.driven && left.goal == right.goal && left.limiting == right.limiting &&
         left.s == right.s && left.f == right.f && left.sets == right.sets;
}

// The first step in which both runs do something, and not the same.
std::optional<std::size_t> FirstDifference(const Steps& left, const Steps& right) {
  const std::size_t both = std::min(left.size(), right.size());
  const auto [at, other] =
      std::mismatch(left.begin(), left.begin() + static_cast<std::ptrdiff_t>(both), right.begin(), &AreSame);
  const auto step = static_cast<std::size_t>(at - left.begin());
  return step < both ? std::optional(step) : std::nullopt;
}

// Enough for a run that ends, or comes round, somewhat later.
Limits EnoughFor(const Steps& steps, const Limits& limits) {
  Limits enough = limits;
  enough.pivots = std::min(limits.pivots, static_cast<std::int64_t>(1000 + 10 * steps.size()));
  return enough;
}

}  // namespace

std::vector<Parting> PartingsOf(const ExactProblem& problem, const Policy& policy, const Limits& limits,
                                const Steps& pivots) {
  const Limits enough = EnoughFor(pivots, limits);
  std::vector<Parting> partings;
  for (const PolicySwitchRow& row : PolicySwitches()) {
    for (int value = 0; row.planar && value < static_cast<int>(row.values.size()); ++value) {
      if (value == row.get(policy)) continue;
      Policy other = policy;
      row.set(other, value);
      const ExactRun run = RunExact(problem, {.policy = other, .limits = enough});
      const auto step = FirstDifference(pivots, run.trace.pivots);
      if (step) partings.push_back({*step, &row, value, run.verdict.outcome});
    }
  }
  return partings;
}

}  // namespace stiction
