// SPDX-License-Identifier: Apache-2.0
#include "search/adversary/assessor.h"

#include <bit>

#include "corpus/rounded.h"
#include "search/adversary/trial.h"

namespace stiction {
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

Assessed Assessor::Look(Candidate candidate) {
  ++looks_;
  Assessed assessed;
  ContactProblem<double> problem = RoundedOf(candidate, &assessed.made);
  assessed.candidate = std::move(candidate);
  assessed.candidate.choices.clear();
  for (const Choice& choice : assessed.made) assessed.candidate.choices.push_back(choice.value);
  if (tries_) {
    const Tried tried = tries_(assessed.candidate, problem);
    assessed.worth.value = tried.value;
    assessed.behaviour = tried.behaviour;
    assessed.confirmed = true;
    return assessed;
  }
  InexactTrial trial(std::move(problem), policy_, limits_);
  assessed.behaviour = BehaviourOf(trial);
  if (objective_.inexact != nullptr) {
    assessed.worth = WorthOf(objective_, trial, objective_.inexact);
  } else if (!objective_.of_loops || trial.Loops()) {
    Confirm(assessed);
  } else if (const auto distance = DistanceToLoop(trial)) {
    assessed.worth.nearness = -*distance;
  }
  return assessed;
}

void Assessor::Confirm(Assessed& assessed) {
  if (assessed.confirmed) return;
  ++confirmations_;
  ExactTrial trial(ExactOf(assessed.candidate), policy_, limits_);
  const bool had_value = assessed.worth.value.has_value();
  assessed.worth = WorthOf(objective_, trial, objective_.exact);
  denied_ += had_value && !assessed.worth.value;
  assessed.behaviour = BehaviourOf(trial);
  assessed.confirmed = true;
}

}  // namespace stiction
