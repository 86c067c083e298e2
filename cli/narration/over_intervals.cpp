// SPDX-License-Identifier: Apache-2.0
#include "cli/narration/over_intervals.h"

#include <fmt/format.h>

#include "certify/exact/published_space.h"
#include "cli/narration/outcome_text.h"

namespace stiction {

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
