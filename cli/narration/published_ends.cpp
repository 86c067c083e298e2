// SPDX-License-Identifier: Apache-2.0
#include "cli/narration/published_ends.h"

#include <fmt/format.h>

#include "certify/exact/answer_json.h"
#include "certify/exact/exact.h"
#include "certify/exact/published_space.h"
#include "certify/request/request.h"
#include "cli/narration/outcome_text.h"
#include "corpus/json.h"

namespace stiction {
namespace {

using Outcomes = std::map<std::string, Json>;

template <class End>
Json OutcomeToJson(const End& end) {
  Json entry = EndToJson(end);
  entry.erase("reason");
  return entry;
}

Outcomes InPlane(const Limits& limits, const ExactProblem& problem) {
  Outcomes outcomes;
  for (const PolicyClass& equal : RunPolicies(problem, GridOf(2), limits)) {
    for (const Policy& policy : equal.policies) outcomes[PolicyName(policy)] = OutcomeToJson(equal.verdict);
  }
  return outcomes;
}

Outcomes InSpace(Request request, const ExactProblem& problem, const std::string& source) {
  request.trace = false;
  Outcomes outcomes;
  for (const Policy& policy : GridOf(3)) {
    request.policy = policy;
    outcomes[PolicyName(policy)] = std::visit([](const auto& answer) { return OutcomeToJson(answer); },
                                              SolveAsked(problem, request, source).answer);
  }
  return outcomes;
}

}  // namespace

std::map<std::string, Json> OutcomesOf(const Wanted& wanted, const ExactProblem& problem,
                                       const std::string& source) {
  if (wanted.method != "baraff")
    throw InputError(fmt::format("all policies: found {0}method {1}, expected {0}method baraff", wanted.dashes,
                                 wanted.method));
  const Request request = PathRequestOf(wanted, problem, source);
  if (problem.dimension == 2 && request.arithmetic != Arithmetic::kExact)
    throw InputError(fmt::format("{}arithmetic: found {}, expected exact for all policies in the plane",
                                 wanted.dashes, wanted.arithmetic));
  return problem.dimension == 2 ? InPlane(wanted.request.limits, problem) : InSpace(request, problem, source);
}

std::optional<InexactAnswer> OverIntervals(const ExactProblem& problem, const Request& request,
                                           Outcome outcome) {
  const bool in_space = problem.dimension == 3 && request.method == "baraff";
  if (!in_space || !PublishedReadsInSpace(request.policy) || outcome == Outcome::kSolved) return std::nullopt;
  return RunIntervalsInSpace(problem, {.policy = request.policy, .limits = request.limits});
}

std::string OverIntervalsText(const InexactAnswer& answer) {
  const bool open = answer.outcome == Outcome::kUndecided || answer.outcome == Outcome::kLimit;
  return fmt::format("over intervals, {}: {}", open ? "which do not decide it" : "proved", Describe(answer));
}

}  // namespace stiction
