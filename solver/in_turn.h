// SPDX-License-Identifier: Apache-2.0
// Runs in turn: what a method, a claim or a scene tries one after the other until something is decided.

#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "solver/problem/solution.h"

namespace stiction {

template <class Told>
using Runs = std::vector<std::function<Told()>>;

// The first that decides(told) takes; otherwise the best by replaces(told, best), of several the first. At
// least one run. decides() is asked of each once.
template <class Told, class Decides, class Replaces>
Told InTurn(const Runs<Told>& runs, Decides decides, Replaces replaces) {
  Told best = runs.front()();
  bool done = decides(best);
  for (std::size_t k = 1; k < runs.size() && !done; ++k) {
    Told told = runs[k]();
    done = decides(told);
    if (done || replaces(told, best)) best = std::move(told);
  }
  return best;
}

// Of answers: the first that is solved, otherwise the first that is not undecided, if one is.
template <class Answer>
Answer InTurn(const Runs<Answer>& runs) {
  return InTurn(
      runs, [](const Answer& answer) { return answer.Solved(); },
      [](const Answer& answer, const Answer& best) {
        return best.outcome == Outcome::kUndecided && answer.outcome != Outcome::kUndecided;
      });
}

}  // namespace stiction
