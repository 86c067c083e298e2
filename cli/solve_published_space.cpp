// SPDX-License-Identifier: Apache-2.0
#include "cli/solve_published_space.h"

#include <fmt/format.h>

#include "certify/published_space.h"
#include "cli/shared.h"
#include "corpus/input_error.h"

namespace stiction {
namespace {

Json OutcomeToJson(const PublishedSpaceVerdict& verdict) {
  Json json = {{"outcome", Name(verdict.outcome)}};
  if (!verdict.reason.empty()) json["reason"] = verdict.reason;
  if (verdict.outcome == Outcome::kCycle) {
    json["start"] = verdict.start;
    json["period"] = verdict.period;
    json["evidence"] = "a state stands again after rounding: forces are irrational, and this is no proof";
  }
  return json;
}

Json VectorToJson(const std::vector<double>& values) { return NumbersToJson(values); }

Json VectorToJson(const std::vector<Enclosure>& values) {
  Json json = Json::array();
  for (const Enclosure& x : values) json.push_back({NumberToJson(x.low), NumberToJson(x.high)});
  return json;
}

template <class Run>
PublishedSpaceAnswer Answer(const Run& run, const PublishedOptions& options) {
  Json json = OutcomeToJson(run.verdict);
  json["method"] = "baraff";
  json["policy"] = PolicyName(options.policy);
  json["f"] = VectorToJson(run.f);
  json["a"] = VectorToJson(run.a);
  if (!run.ray.empty()) json["ray"] = VectorToJson(run.ray);
  json["statistics"] = StatisticsToJson(run.verdict.statistics);
  json["statistics"]["redirects"] = run.verdict.redirects;
  json["statistics"]["breaks"] = run.verdict.breaks;
  return {run.verdict.outcome, json};
}

// What rounded numbers do not solve is run again before it is said.
template <class Scalar>
PublishedSpaceAnswer AnswerRounded(const ExactProblem& problem, const PublishedOptions& options) {
  RoundedSpaceRun run = RunRoundedInSpace<Scalar>(problem, options);
  const PublishedSpaceVerdict first = run.verdict;
  const bool suspicion = first.outcome != Outcome::kSolved;
  if (suspicion) run = RunSuspicionInSpace<Scalar>(problem, options);
  PublishedSpaceAnswer answer = Answer(run, options);
  if (suspicion) answer.result["suspected"] = OutcomeToJson(first);
  if (answer.outcome == Outcome::kSolved) answer.result["residual"] = NumberToJson(run.residual);
  return answer;
}

PublishedSpaceAnswer AnswerIn(const ExactProblem& problem, const std::string& arithmetic,
                              const PublishedOptions& options) {
  if (arithmetic == "float") return AnswerRounded<float>(problem, options);
  if (arithmetic == "double") return AnswerRounded<double>(problem, options);
  if (arithmetic == "long-double") return AnswerRounded<long double>(problem, options);
  if (arithmetic == "interval") return Answer(RunIntervalsInSpace(problem, options), options);
  throw InputError(
      fmt::format("--arithmetic {}: expected interval, float, double or long-double for the "
                  "published algorithm in space, which takes square roots",
                  arithmetic));
}

}  // namespace

PublishedSpaceAnswer SolvePublishedInSpace(const ExactProblem& problem, const std::string& arithmetic,
                                           const PublishedOptions& options) {
  if (!PublishedReadsInSpace(options.policy)) {
    throw InputError(
        fmt::format("--policy {}: in space expected file=no, apex=kept and slip=literal or slip=redirect, or "
                    "slip=polygon alone; no other reading of these is built",
                    PolicyName(options.policy)));
  }
  const std::string chosen = arithmetic.empty() ? "interval" : arithmetic;
  PublishedSpaceAnswer answer = AnswerIn(problem, chosen, options);
  answer.result["arithmetic"] = chosen;
  return answer;
}

}  // namespace stiction
