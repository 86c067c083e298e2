// SPDX-License-Identifier: Apache-2.0
#include "cli/narration/page_of_run.h"

#include <vector>

#include "certify/exact/exact.h"
#include "certify/request/facts.h"
#include "cli/narration/followed.h"
#include "cli/narration/published_ends.h"

namespace stiction {
namespace {

// Every policy of the grid is expected to end as this run does, and does.
bool EveryPolicyEndsSo(const ProblemFile& file, const Solution& solution, const Limits& limits) {
  const bool expected = file.expect.size() == 1 && file.expect.begin()->first == "*" &&
                        file.expect.begin()->second == Name(solution.outcome());
  return expected && file.problem.dimension() == 2 && file.problem.contacts().size() <= kExplainedContacts &&
         AllEndIn(solution.outcome(), file.problem, PlanarGrid(), limits);
}

}  // namespace

SharedJson PageOfRun(const Wanted& wanted, const ProblemFile& file, const std::string& source,
                     const SharedJson& picture, const Solution& solution,
                     const std::optional<InexactAnswer>& over_intervals) {
  std::vector<FollowedRun> runs = {Followed(PathRequestOf(wanted, file.problem, source), file, solution)};
  if (over_intervals) runs[0].end += "; " + OverIntervalsText(*over_intervals);
  Wanted beside = wanted;
  beside.method = "complete";
  beside.arithmetic = "";
  beside.policy = Wanted().policy;
  if (wanted.method != beside.method) {
    const Request request = PathRequestOf(beside, file.problem, source);
    runs.push_back(Followed(request, file, SolveAsked(file.problem, request, source)));
  }
  return ReplayPageData(file, picture, runs, EveryPolicyEndsSo(file, solution, wanted.request.limits));
}

}  // namespace stiction
