// SPDX-License-Identifier: Apache-2.0
#include "search/adversary/optimizer.h"

#include <algorithm>
#include <array>

namespace stiction {
namespace {

Optimized TryRandomly(const Optimization& optimization) {
  Attempt attempt(optimization);
  while (!attempt.Ended()) attempt.Try(attempt.Random());
  return attempt.Take();
}

}  // namespace

std::span<const OptimizerRow> Optimizers() {
  static constexpr std::array<OptimizerRow, 4> kRows = {{
      {"evolution", "mutates and crosses the choices of what was found, and keeps the best of every behaviour",
       Evolve},
      {"nlopt", "NLopt's CRS2, ESCH, Subplex and Nelder and Mead on the choices of a wide range",
       OptimizeContinuously},
      {"continuation", "walks from a loop, or the best so far, as far as a direction improves it", Continue},
      {"random", "draws each candidate anew, to compare with", TryRandomly},
  }};
  return kRows;
}

const OptimizerRow* FindOptimizer(std::string_view name) {
  const auto rows = Optimizers();
  const auto row =
      std::find_if(rows.begin(), rows.end(), [name](const OptimizerRow& o) { return o.name == name; });
  return row == rows.end() ? nullptr : &*row;
}

Attempt::Attempt(const Optimization& optimization)
    : optimization_(optimization),
      random_(optimization.seed),
      assessor_(*optimization.objective, optimization.policy, optimization.limits, optimization.tries),
      elites_(assessor_, [this](const Assessed& loop) { loops_.push_back(loop); }) {}

Candidate Attempt::Random() {
  const auto pick = random_.Integer(0, static_cast<std::int64_t>(optimization_.palette.size()) - 1);
  Candidate like = optimization_.like;
  like.mu = optimization_.palette[static_cast<std::size_t>(pick)];
  return RandomCandidate(like, static_cast<std::uint64_t>(random_.Integer(0, std::int64_t{1} << 62)));
}

bool Attempt::Try(Candidate candidate) { return elites_.Admit(assessor_.Look(std::move(candidate))); }

bool Attempt::TryValue(Candidate candidate) {
  Assessed assessed = assessor_.Look(std::move(candidate));
  return assessed.worth.value.has_value() && elites_.Admit(std::move(assessed));
}

void Attempt::Begin() {
  for (const Candidate& parent : optimization_.parents) {
    if (Ended()) return;
    Try(parent);
  }
  const std::int64_t draws = optimization_.evaluations / (optimization_.parents.empty() ? 4 : 16);
  for (std::int64_t k = 0; k < draws && !Ended(); ++k) Try(Random());
  while (elites_.empty() && !Ended()) Try(Random());
}

Optimized Attempt::Take() {
  Optimized result{elites_.all(), std::move(loops_), assessor_.looks(), assessor_.confirmations(),
                   assessor_.denied()};
  std::stable_sort(result.elites.begin(), result.elites.end(),
                   [](const Assessed& left, const Assessed& right) { return right.worth < left.worth; });
  return result;
}

std::vector<std::size_t> WideChoices(const std::vector<Choice>& made) {
  std::vector<std::size_t> wide;
  for (std::size_t i = 0; i < made.size(); ++i) {
    if (made[i].high - made[i].low + 1 >= kWide) wide.push_back(i);
  }
  return wide;
}

}  // namespace stiction
