// SPDX-License-Identifier: Apache-2.0
// Optimizers: ways to look for candidates that are worse for the solver. Each is a function of what it is
// given: the same seed, parents and number of evaluations give the same elites, as far as the machine's
// libraries compute the same: objectives and NLopt take logarithms, roots and eigenvalues from them, and
// `ipopt` is Ipopt's.

#ifndef STICTION_SEARCH_ADVERSARY_OPTIMIZER_H_
#define STICTION_SEARCH_ADVERSARY_OPTIMIZER_H_

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "search/adversary/elites.h"

namespace stiction {

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

class Attempt {
 public:
  explicit Attempt(const Optimization& optimization);

  const Optimization& optimization() const { return optimization_; }
  Choices& random() { return random_; }
  Assessor& assessor() { return assessor_; }
  Elites& elites() { return elites_; }

  std::int64_t Left() const { return optimization_.evaluations - assessor_.looks(); }
  bool Ended() const { return Left() <= 0 || optimization_.cancelled(); }

  Candidate Random();
  // Looks at a candidate and takes it in if it is wanted.
  bool Try(Candidate candidate);
  // Only if it has a value.
  bool TryValue(Candidate candidate);
  // The parents, then random candidates until a part of the evaluations is spent.
  void Begin();

  Optimized Take();

 private:
  Optimization optimization_;
  Choices random_;
  Assessor assessor_;
  std::vector<Assessed> loops_;
  Elites elites_;
};

// Mutants (evolution.cpp), and points of the ranges of wide choices (continuous.cpp, continuation.cpp).
Optimized Evolve(const Optimization& optimization);
Optimized OptimizeContinuously(const Optimization& optimization);
Optimized Continue(const Optimization& optimization);

// The choices of a candidate that are treated as continuous: ranges of at least kWide values.
inline constexpr std::int64_t kWide = 64;
std::vector<std::size_t> WideChoices(const std::vector<Choice>& made);

}  // namespace stiction

#endif  // STICTION_SEARCH_ADVERSARY_OPTIMIZER_H_
