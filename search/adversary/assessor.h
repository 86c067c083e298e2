// SPDX-License-Identifier: Apache-2.0
// Assessor: what a candidate is worth, over doubles first, over rationals before it counts.

#ifndef STICTION_SEARCH_ADVERSARY_ASSESSOR_H_
#define STICTION_SEARCH_ADVERSARY_ASSESSOR_H_

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "search/adversary/candidate.h"
#include "search/adversary/objective.h"
#include "solver/problem/options.h"

namespace stiction {

// Any value is better than none; without one what is nearer to a loop is better.
struct Worth {
  std::optional<double> value;
  double nearness = -1e9;  // minus the distance to a loop; of objectives of loops

  bool operator<(const Worth& other) const;
};

// What a run does, coarsely: candidates of different behaviour are kept beside each other.
using Behaviour = std::array<std::int64_t, 5>;

struct Assessed {
  Candidate candidate;       // its choices clamped, without what no choice asked for
  std::vector<Choice> made;  // the same choices with their ranges
  Worth worth;
  Behaviour behaviour = {};
  bool confirmed = false;  // the worth is of the exact problem
};

// What a solver under test makes of a candidate, over the doubles that it is given; nothing else is to be
// confirmed.
struct Tried {
  std::optional<double> value;
  Behaviour behaviour = {};
};
using TrySolver = std::function<Tried(const Candidate&, const ContactProblem<double>&)>;

class Assessor {
 public:
  // The objective, one of the table, must outlive this. `tries`: of an objective of a solver under test.
  Assessor(const Objective& objective, const Policy& policy, const Limits& limits, TrySolver tries = {})
      : objective_(objective), policy_(policy), limits_(limits), tries_(std::move(tries)) {}

  const Objective& objective() const { return objective_; }

  // One evaluation: over doubles, or, where the objective has no shortcut, over rationals.
  Assessed Look(Candidate candidate);
  // Over rationals. A candidate whose double run was mistaken loses its value here.
  void Confirm(Assessed& assessed);

  std::int64_t looks() const { return looks_; }
  std::int64_t confirmations() const { return confirmations_; }  // exact runs
  // Values over doubles that rationals denied.
  std::int64_t denied() const { return denied_; }

 private:
  Objective objective_;
  Policy policy_;
  Limits limits_;
  TrySolver tries_;
  std::int64_t looks_ = 0, confirmations_ = 0, denied_ = 0;
};

}  // namespace stiction

#endif  // STICTION_SEARCH_ADVERSARY_ASSESSOR_H_
