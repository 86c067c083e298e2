// SPDX-License-Identifier: Apache-2.0
#include "search/adversary/optimizer.h"

#include <algorithm>
#include <bit>

#include "corpus/named_rows.h"
#include "corpus/rounded.h"
#include "search/adversary/trial.h"
#include "solver/problem/check.h"
#include "solver/problem/solution.h"

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

const OptimizerRow* FindOptimizer(std::string_view name) { return RowNamed(Optimizers(), name); }

// ---- What a candidate is worth -------------------------------------------------------------------

namespace {

std::int64_t Coarse(std::int64_t count) { return std::bit_width(static_cast<std::uint64_t>(count)); }

template <class Scalar>
Behaviour BehaviourOf(Trial<Scalar>& trial) {
  const Verdict& verdict = trial.Published();
  const Statistics& s = verdict.statistics;
  const bool loops = IsLoop(verdict.outcome);
  return {static_cast<std::int64_t>(verdict.outcome), loops ? verdict.period : s.drives,
          loops ? verdict.start : s.give_ups, Coarse(s.zero_steps), s.steps / 4};
}

bool IsDefinite(const ContactProblem<double>& problem) { return Condition(problem).has_value(); }
bool IsDefinite(const ExactProblem& problem) { return IsDefinite(Rounded<double>(problem)); }

// The value of an objective, or what stands for it; no number is no value.
template <class Scalar>
Worth WorthOf(const Objective& objective, Trial<Scalar>& trial,
              std::optional<double> (*value)(Trial<Scalar>&)) {
  Worth worth;
  worth.value = value(trial);
  if (worth.value && !(*worth.value > -1e300 && *worth.value < 1e300)) worth.value.reset();
  if (!objective.of_loops) return worth;
  if (objective.of_definite && !IsDefinite(trial.problem())) return worth;
  if (const auto distance = DistanceToLoop(trial)) worth.nearness = -*distance;
  return worth;
}

}  // namespace

bool Worth::operator<(const Worth& other) const {
  if (value && other.value) return *value < *other.value;
  if (value.has_value() != other.value.has_value()) return other.value.has_value();
  return nearness < other.nearness;
}

Assessed Attempt::Look(Candidate candidate) {
  ++found_.evaluations;
  Assessed assessed;
  ContactProblem<double> problem = RoundedOf(candidate, &assessed.made);
  assessed.candidate = std::move(candidate);
  assessed.candidate.choices = ValuesOf(assessed.made);
  if (optimization_.tries) {
    optimization_.tries(assessed, problem);
    assessed.confirmed = true;
    return assessed;
  }
  const Objective& objective = *optimization_.objective;
  InexactTrial trial(std::move(problem), optimization_.policy, optimization_.limits);
  assessed.behaviour = BehaviourOf(trial);
  if (objective.inexact != nullptr) {
    assessed.worth = WorthOf(objective, trial, objective.inexact);
  } else if (!objective.of_loops || trial.Loops()) {
    Confirm(assessed);
  } else if (const auto distance = DistanceToLoop(trial)) {
    assessed.worth.nearness = -*distance;
  }
  return assessed;
}

void Attempt::Confirm(Assessed& assessed) {
  if (assessed.confirmed) return;
  ++found_.confirmations;
  ExactTrial trial(ExactOf(assessed.candidate), optimization_.policy, optimization_.limits);
  const bool had_value = assessed.worth.value.has_value();
  assessed.worth = WorthOf(*optimization_.objective, trial, optimization_.objective->exact);
  found_.denied += had_value && !assessed.worth.value;
  assessed.behaviour = BehaviourOf(trial);
  assessed.confirmed = true;
}

// ---- Elites --------------------------------------------------------------------------------------

std::optional<std::size_t> Attempt::PlaceFor(const Assessed& assessed) const {
  const std::vector<Assessed>& all = found_.elites;
  const auto same = std::ranges::find(all, assessed.behaviour, &Assessed::behaviour);
  if (same != all.end()) {
    if (IsBetter(*same, assessed)) return std::nullopt;  // equal ones replace it, so that all drifts
    return static_cast<std::size_t>(same - all.begin());
  }
  if (all.size() < kMostElites) return all.size();
  const auto worst = std::ranges::max_element(all, IsBetter);
  if (!IsBetter(assessed, *worst)) return std::nullopt;
  return static_cast<std::size_t>(worst - all.begin());
}

bool Attempt::Admit(Assessed assessed) {
  if (!PlaceFor(assessed)) return false;
  if (assessed.worth.value) Confirm(assessed);
  const auto place = PlaceFor(assessed);
  if (!place) return false;
  if (assessed.confirmed && IsLoop(static_cast<Outcome>(assessed.behaviour[0])))
    found_.loops.push_back(assessed);
  if (*place == found_.elites.size()) found_.elites.emplace_back();
  found_.elites[*place] = std::move(assessed);
  return true;
}

bool Attempt::TryValue(Candidate candidate) {
  Assessed assessed = Look(std::move(candidate));
  return assessed.worth.value.has_value() && Admit(std::move(assessed));
}

const Assessed& Attempt::Best() const {
  STICTION_CHECK(!found_.elites.empty(), "there is a best one");
  return *std::ranges::min_element(found_.elites, IsBetter);
}

const Assessed& Attempt::Draw() {
  STICTION_CHECK(!found_.elites.empty(), "there is somebody to draw");
  const auto last = static_cast<std::int64_t>(found_.elites.size()) - 1;
  const auto rounds = random_.Integer(0, 1) == 0 ? random_.Integer(1, 4) : 16;
  const Assessed* drawn = nullptr;
  for (std::int64_t k = 0; k < rounds; ++k) {
    const Assessed& next = found_.elites[static_cast<std::size_t>(random_.Integer(0, last))];
    if (drawn == nullptr || IsBetter(next, *drawn)) drawn = &next;
  }
  return *drawn;
}

// ---- An attempt ----------------------------------------------------------------------------------

Candidate Attempt::Random() {
  const auto pick = random_.Integer(0, static_cast<std::int64_t>(optimization_.palette.size()) - 1);
  Candidate like = optimization_.like;
  like.mu = optimization_.palette[static_cast<std::size_t>(pick)];
  return RandomCandidate(like, static_cast<std::uint64_t>(random_.Integer(0, std::int64_t{1} << 62)));
}

void Attempt::Begin() {
  for (const Candidate& parent : optimization_.parents) {
    if (Ended()) return;
    Try(parent);
  }
  const std::int64_t draws = optimization_.evaluations / (optimization_.parents.empty() ? 4 : 16);
  for (std::int64_t k = 0; k < draws && !Ended(); ++k) Try(Random());
  while (found_.elites.empty() && !Ended()) Try(Random());
}

Optimized Attempt::Take() {
  std::ranges::stable_sort(found_.elites, IsBetter);
  return std::move(found_);
}

std::vector<std::size_t> WideChoices(const std::vector<Choice>& made) {
  constexpr std::int64_t kWide = 64;
  std::vector<std::size_t> wide;
  for (std::size_t i = 0; i < made.size(); ++i) {
    if (made[i].high - made[i].low + 1 >= kWide) wide.push_back(i);
  }
  return wide;
}

}  // namespace stiction
