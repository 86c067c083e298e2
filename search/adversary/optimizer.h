// SPDX-License-Identifier: Apache-2.0
// Optimizers: ways to look for candidates that are worse for the solver. Each is a function of what it is
// given: the same seed, parents and number of evaluations give the same elites, as far as the machine's
// libraries compute the same: objectives and NLopt take logarithms, roots and eigenvalues from them, and
// `ipopt` is Ipopt's.

#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
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

// A candidate that is kept.
struct Elite {
  Candidate candidate;
  Worth worth;
};
inline bool IsBetter(const Elite& left, const Elite& right) { return right.worth < left.worth; }

// What a run does, coarsely: candidates of different behaviour are kept beside each other.
using Behaviour = std::array<std::int64_t, 5>;

struct Assessed : Elite {    // the choices of the candidate are clamped, without what no choice asked for
  std::vector<Choice> made;  // the same choices with their ranges
  Behaviour behaviour = {};
  bool confirmed = false;  // the worth is of the exact problem
};

// Sets what a solver under test makes of a candidate, its value and behaviour, over the doubles that it is
// given; nothing else is to be confirmed.
using TrySolver = std::function<void(Assessed&, const ContactProblem<double>&)>;

struct Optimization {
  const Objective* objective = nullptr;
  Candidate like;                  // all but its choices
  std::vector<MuChoice> palette;   // to draw mu from
  std::vector<Candidate> parents;  // what was found before, the best first
  std::uint64_t seed = 1;
  std::int64_t evaluations = 10000;  // over doubles, or, without a shortcut, over rationals
  Policy policy;
  Limits limits;
  std::function<bool()> cancelled = [] { return false; };
  TrySolver tries = {};  // of an objective of a solver under test
};

struct Optimized {
  std::vector<Assessed> elites;  // confirmed, the best first
  std::vector<Assessed> loops;   // confirmed, in the order in which they came
  // Looks at candidates, exact runs, and values over doubles that rationals denied.
  std::int64_t evaluations = 0, confirmations = 0, denied = 0;
};

struct OptimizerRow {
  std::string_view name;  // on the command line
  std::string_view help;
  Optimized (*run)(const Optimization&);
};
// random, evolution, nlopt, continuation.
std::span<const OptimizerRow> Optimizers();
// Null if none has this name.
const OptimizerRow* FindOptimizer(std::string_view name);

// ---- What optimizers share -----------------------------------------------------------------------

// Elites are the best candidates of every behaviour. Every value is one over rationals; how near a candidate
// without one is to a loop may be one over doubles.
class Attempt {
 public:
  static constexpr std::size_t kMostElites = 48;

  explicit Attempt(const Optimization& optimization)
      : optimization_(optimization), random_(optimization.seed) {}

  const Optimization& optimization() const { return optimization_; }
  Choices& random() { return random_; }
  // So far; elites in the order in which behaviours came.
  const Optimized& found() const { return found_; }
  std::int64_t Left() const { return optimization_.evaluations - found_.evaluations; }
  bool Ended() const { return Left() <= 0 || optimization_.cancelled(); }

  // One evaluation: over doubles, or, where the objective has no shortcut, over rationals.
  Assessed Look(Candidate candidate);
  // Over rationals. A candidate whose double run was mistaken loses its value here.
  void Confirm(Assessed& assessed);
  // Whether it was taken in: it is no worse than the one of its behaviour, or has a new one and is not the
  // worst of a full house. What would be taken in with a value is confirmed first, and then asked again.
  bool Admit(Assessed assessed);
  // Looks at a candidate and takes it in if it is wanted.
  bool Try(Candidate candidate) { return Admit(Look(std::move(candidate))); }
  // Only if it has a value.
  bool TryValue(Candidate candidate);

  Candidate Random();
  // Require an elite: the best, and the best of a few drawn at random.
  const Assessed& Best() const;
  const Assessed& Draw();
  // The parents, then random candidates until a part of the evaluations is spent.
  void Begin();
  Optimized Take();

 private:
  // Where it would stand; the end for a new place, none if it is not wanted.
  std::optional<std::size_t> PlaceFor(const Assessed& assessed) const;

  Optimization optimization_;
  Choices random_;
  Optimized found_;
};

// Mutants (evolution.cpp), and points of the ranges of wide choices (continuous.cpp, continuation.cpp).
Optimized Evolve(const Optimization& optimization);
Optimized OptimizeContinuously(const Optimization& optimization);
Optimized Continue(const Optimization& optimization);

// The choices of a candidate that are treated as continuous: ranges of at least 64 values.
std::vector<std::size_t> WideChoices(const std::vector<Choice>& made);

}  // namespace stiction
