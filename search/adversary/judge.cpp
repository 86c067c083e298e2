// SPDX-License-Identifier: Apache-2.0
#include "search/adversary/judge.h"

#include <bit>

namespace stiction {
namespace {

std::int64_t Coarse(std::int64_t count) { return std::bit_width(static_cast<std::uint64_t>(count)); }

template <class Scalar>
Behaviour BehaviourOf(Trial<Scalar>& trial) {
  const Verdict& verdict = trial.Published().verdict;
  const Statistics& s = verdict.statistics;
  const bool loops = IsLoop(verdict.outcome);
  return {static_cast<std::int64_t>(verdict.outcome), loops ? verdict.period : s.drives,
          loops ? verdict.start : s.give_ups, Coarse(s.zero_steps), s.steps / 4};
}

// The value of an objective, or what stands for it; no number is no value.
template <class Scalar>
Score ScoreOf(const Objective& objective, Trial<Scalar>& trial, std::optional<double> (*value)(Trial<Scalar>&)) {
  Score score;
  score.value = value(trial);
  if (score.value && !(*score.value > -1e300 && *score.value < 1e300)) score.value.reset();
  if (!objective.of_loops) return score;
  if (const auto distance = DistanceToLoop(trial)) score.nearness = -*distance;
  return score;
}

}  // namespace

bool Score::operator<(const Score& other) const {
  if (value && other.value) return *value < *other.value;
  if (value.has_value() != other.value.has_value()) return other.value.has_value();
  return nearness < other.nearness;
}

Judged Judge::Look(Candidate candidate) {
  ++looks_;
  Judged judged;
  ContactProblem<double> problem = RoundedOf(candidate, &judged.made);
  judged.candidate = std::move(candidate);
  judged.candidate.choices.clear();
  for (const Choice& choice : judged.made) judged.candidate.choices.push_back(choice.value);
  InexactTrial trial(std::move(problem), policy_, limits_);
  judged.behaviour = BehaviourOf(trial);
  if (objective_.inexact != nullptr) {
    judged.score = ScoreOf(objective_, trial, objective_.inexact);
  } else if (!objective_.of_loops || trial.Loops()) {
    Confirm(judged);
  } else if (const auto distance = DistanceToLoop(trial)) {
    judged.score.nearness = -*distance;
  }
  return judged;
}

void Judge::Confirm(Judged& judged) {
  if (judged.confirmed) return;
  ++confirmations_;
  ExactTrial trial(ExactOf(judged.candidate), policy_, limits_);
  const bool had_value = judged.score.value.has_value();
  judged.score = ScoreOf(objective_, trial, objective_.exact);
  denied_ += had_value && !judged.score.value;
  judged.behaviour = BehaviourOf(trial);
  judged.confirmed = true;
}

}  // namespace stiction
