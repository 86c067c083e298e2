// SPDX-License-Identifier: Apache-2.0
// Minimizing: a simpler problem with the same certified finding.
//
// A candidate is kept if it is simpler and still interesting: A symmetric, positive semidefinite, b in
// range(A), all exactly, and every policy asked for ends in the same outcome on it, exactly; in space, as
// intervals prove (certify/exact/published_space.h). Simpler, in this order (SimplicityOf):
//   fewer contacts; fewer rows; fewer entries of A and b that are not zero; fewer bits in A (each entry
//   once), b and mu; smaller sum of absolute numerators and denominators.
// Passes run until none makes progress, so minimizing a minimized problem changes nothing:
//   take bilateral contacts out (solver/problem/reduction.h); drop contacts; drop friction; stretch tangents to
//   mu = 1 (with f = S f', A' = S A S, b' = S b and mu' = mu s_N / s_F it is the same problem in other units);
//   round A and b to small integers; round the factors of A = L D L' and b = L c; divide A and b by common
//   factors; move entries to zero and toward small numbers one by one. Where nothing of this helps, and there
//   are at most three contacts: entries rounded up or down by lot, and two entries changed at once.
// Deterministic; no clock. Cost: one exact run per candidate, one run of the policies per accepted one.

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "corpus/exact_problem.h"
#include "solver/problem/solution.h"

namespace stiction {

// "scene" of a minimized problem's origin, where its parent had one.
inline constexpr const char* kSceneOfParent = "that of the parent; these A and b may belong to none";

struct Simplicity {
  std::int64_t contacts = 0;
  std::int64_t rows = 0;
  std::int64_t nonzeros = 0;
  std::int64_t bits = 0;
  Rational magnitude = 0;

  bool operator<(const Simplicity& other) const;
};
Simplicity SimplicityOf(const ExactProblem& problem);

struct MinimizeOptions {
  Outcome keep = Outcome::kCycle;
  std::vector<Policy> policies = {Policy{}};  // all must end in `keep`
  // If given, the signature under the first policy is kept too, so that the kind of loop stays; in space the
  // period.
  std::optional<std::string> signature;
  std::optional<std::int64_t> period;
  // Further than one change at a time goes: seconds to minutes more, so not for every finding of a search.
  bool further = false;
  // In place of all that: whether a candidate is as interesting. Not asked of the problem itself, of which it
  // holds: what is minimized of a solver that answers by chance may not hold a second time.
  std::function<bool(const ExactProblem&)> keeps = {};
  Limits limits;
  std::function<bool()> cancelled = [] { return false; };
};

struct Minimized {
  ExactProblem problem;
  std::int64_t candidates = 0;
  std::int64_t accepted = 0;
  bool cancelled = false;
};

// Requires: the problem is interesting itself; otherwise, but for `keeps`, InputError that says what it lacks.
// In space policies that the published algorithm reads there (PublishedReadsInSpace).
Minimized Minimize(const ExactProblem& problem, const MinimizeOptions& options);

}  // namespace stiction
