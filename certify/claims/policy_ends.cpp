// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/policy_ends.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "certify/exact/exact.h"
#include "certify/exact/published_space.h"
#include "corpus/grouped.h"
#include "solver/problem/answer.h"

namespace stiction {
namespace {

std::vector<PolicyEnds> EndsInPlane(const std::vector<Policy>& policies, const ExactProblem& problem,
                                    const Limits& limits) {
  std::vector<PolicyEnds> ends;
  for (PolicyClass& equal : RunPolicies(problem, policies, limits, [&limits] { return limits.Stopped(); })) {
    const Verdict& verdict = equal.verdict;
    ends.push_back(PolicyEnds{std::move(equal.policies), verdict.outcome, std::string(verdict.reason),
                              verdict.statistics.drives, verdict.statistics.steps});
  }
  return ends;
}

std::vector<PolicyEnds> EndsInSpace(const std::vector<Policy>& policies, const ExactProblem& problem,
                                    const Limits& limits) {
  std::vector<PolicyEnds> ends;
  for (const Policy& policy : policies) {
    if (!PublishedReadsInSpace(policy)) {
      ends.push_back(PolicyEnds{{policy}, Outcome::kUndecided, "this policy is not built in space"});
      continue;
    }
    const InexactAnswer answer = RunIntervalsInSpace(problem, {.policy = policy, .limits = limits});
    ends.push_back(PolicyEnds{{policy},
                              answer.outcome,
                              std::string(answer.reason),
                              answer.counters[Counter::kDrives],
                              answer.counters[Counter::kSteps]});
  }
  return ends;
}

std::string NameOf(const PolicyEnds& ends) {
  const auto paper = std::ranges::find(ends.policies, Policy{});
  return PolicyName(paper == ends.policies.end() ? ends.policies.front() : *paper);
}

// Of one policy.
std::string EndSentence(const PolicyEnds& end, ClaimState state, const ClaimedVerb& verb) {
  const std::string under = "under " + NameOf(end);
  if (state == ClaimState::kProved) return fmt::format("{} the published algorithm {}", under, verb.one);
  if (end.outcome == Outcome::kLimit) return fmt::format("{} the run is out of {}", under, end.reason);
  if (state == ClaimState::kNotDecided)
    return fmt::format("{} it is {}", under, end.reason.empty() ? "undecided" : "undecided: " + end.reason);
  if (IsLoop(end.outcome)) return fmt::format("{} the published algorithm never ends", under);
  return fmt::format("{} the published algorithm ends in {} after {}, {}", under, Name(end.outcome),
                     Counted(end.drives, "drive"), Counted(end.steps, "step"));
}

}  // namespace

std::vector<Policy> GridOf(int dimension) {
  if (dimension == 2) return PlanarGrid();
  std::vector<Policy> grid;
  for (const Slip slip : {Slip::kLiteral, Slip::kRedirect}) {
    for (Policy policy : PlanarGrid()) {
      policy.slip = slip;
      if (PublishedReadsInSpace(policy)) grid.push_back(policy);
    }
  }
  return grid;
}

std::vector<Policy> PoliciesAsked(std::string_view text, int dimension) {
  return text == "*" ? GridOf(dimension) : ParsePolicies(text);
}

std::vector<PolicyEnds> EndsUnder(const std::vector<Policy>& policies, const ExactProblem& problem,
                                  const Limits& limits) {
  return problem.dimension == 3 ? EndsInSpace(policies, problem, limits)
                                : EndsInPlane(policies, problem, limits);
}

EndState EndsIn(Outcome outcome) {
  return [outcome](const PolicyEnds& end) {
    if (end.outcome == outcome) return ClaimState::kProved;
    const bool open = end.outcome == Outcome::kLimit || end.outcome == Outcome::kUndecided;
    return open ? ClaimState::kNotDecided : ClaimState::kDisproved;
  };
}

ClaimAnswer AnswerOfEnds(const std::vector<PolicyEnds>& ends, const ClaimedVerb& verb, const EndState& state) {
  PolicyCounts counts;
  const PolicyEnds *otherwise = nullptr, *unsure = nullptr;
  for (const PolicyEnds& end : ends) {
    const auto count = static_cast<std::int64_t>(end.policies.size());
    const ClaimState known = state(end);
    counts.asked += count;
    if (known == ClaimState::kProved) {
      counts.so += count;
      continue;
    }
    counts.open += known == ClaimState::kNotDecided ? count : 0;
    counts.otherwise[std::string(Name(end.outcome))] += count;
    const PolicyEnds*& first = known == ClaimState::kDisproved ? otherwise : unsure;
    if (first == nullptr || NameOf(end) == "paper") first = &end;
  }
  ClaimAnswer answer;
  answer.state = counts.State();
  if (counts.asked == 1) {
    answer.reason = EndSentence(ends.front(), answer.state, verb);
  } else {
    answer.reason = PoliciesSentence(counts, verb.one, verb.more);
    const PolicyEnds* shown = otherwise != nullptr ? otherwise : unsure;
    if (shown != nullptr) answer.reason += fmt::format("; {}", EndSentence(*shown, state(*shown), verb));
  }
  if (const PolicyEnds* example = otherwise != nullptr ? otherwise : unsure) counts.example = NameOf(*example);
  answer.policies = std::move(counts);
  return answer;
}

}  // namespace stiction
