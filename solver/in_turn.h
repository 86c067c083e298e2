// SPDX-License-Identifier: Apache-2.0
// Runs in turn, of one method that consists of several.

#ifndef STICTION_SOLVER_IN_TURN_H_
#define STICTION_SOLVER_IN_TURN_H_

#include <utility>

#include "solver/problem/answer.h"
#include "solver/problem/options.h"

namespace stiction {

// The first answer that is solved, or a better one than the first: one that is not undecided, where that is.
// Each run is a function without arguments; none is begun once the limits stop them. The counters of the first
// are added to those of what takes its place.
template <class First, class... Others>
auto InTurn(const Limits& limits, First first, Others... others) {
  auto best = first();
  const auto attempt = [&](auto& run) {
    if (best.Solved() || limits.Stopped()) return;
    auto other = run();
    const bool decides = best.outcome == Outcome::kUndecided && other.outcome != Outcome::kUndecided;
    if (!other.Solved() && !decides) return;
    other.counters += best.counters;
    best = std::move(other);
  };
  (attempt(others), ...);
  return best;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_IN_TURN_H_
