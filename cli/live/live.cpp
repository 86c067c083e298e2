// SPDX-License-Identifier: Apache-2.0
#include "cli/live/live.h"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <vector>

#include "certify/exact/inexact.h"
#include "cli/narration/followed.h"
#include "corpus/json_text.h"
#include "corpus/record/problem_file.h"
#include "solver/published/published_space.h"

namespace stiction {
namespace {

const std::string kRequest = "request";  // named in errors

// Whether a value of a switch is built for that dimension.
bool IsBuilt(const PolicySwitchRow& row, int value, int dimension) {
  Policy policy;
  row.set(policy, value);
  return dimension == 2 ? row.planar : PublishedReadsInSpace(policy);
}

// Those that leave something to choose.
SharedJson SwitchesToJson(int dimension) {
  std::vector<SharedJson> switches;
  for (const PolicySwitchRow& row : PolicySwitches()) {
    std::vector<SharedJson> values;
    for (int i = 0; i < static_cast<int>(row.values.size()); ++i) {
      if (IsBuilt(row, i, dimension))
        values.push_back({{"name", row.values[i].name}, {"meaning", row.values[i].meaning}});
    }
    if (values.size() > 1)
      switches.push_back({{"name", row.name}, {"question", row.question}, {"values", std::move(values)}});
  }
  return SharedJson(switches);
}

SharedJson LimitsToJson() {
  SharedJson json;
  Limits limits = kLiveLimits;
  ForEachField(limits, [&json](const NumberRow& row, std::int64_t value) { json.Add({{row.name, value}}); });
  return json;
}

void RequireFew(const ProblemFile& file) {
  const int rows = file.problem.rows();
  if (rows > kMostLiveRows)
    throw InputError("problem", "contacts", fmt::format("{} rows", rows),
                     fmt::format("at most {}; the program takes more", kMostLiveRows));
}

// Over doubles alone.
Solution SolvePublishedInSpace(const ExactProblem& problem, const Request& request) {
  try {
    RequireReading(problem.dimension, request);
    return {.answer = Solve(Rounded<double>(problem), request)};
  } catch (const InputError& error) {
    throw InputError(std::string("problem: ") + error.what());
  }
}

FollowedRun Run(const Request& request, const ProblemFile& file) {
  if (file.problem.dimension() == 2 || request.method != "baraff")
    return Followed(request, file, {.answer = SolveExactly(file.problem, request)});
  FollowedRun run = Followed(request, file, SolvePublishedInSpace(file.problem, request));
  run.end += "; over doubles alone: stiction replay says what is proved";
  return run;
}

SharedJson RunToJson(const JsonPlace& place) {
  const ProblemFile file = ParseProblem(place.Required("problem", "text").Text("text"), "problem");
  RequireFew(file);
  const std::string method = place.Required("method", "text").Text("text");
  Request request{.method = method,
                  .law = FrictionLaw::kBaraff,  // as `replay` where none is asked for
                  .policy = ParsePolicy(place.Required("policy", "text").Text("text")),
                  .limits = kLiveLimits,
                  .trace = true};
  std::vector<FollowedRun> runs = {Run(request, file)};
  request.method = "complete";
  if (method != request.method) runs.push_back(Run(request, file));
  return {{"data", ReplayPageData(file, {}, runs)}};
}

SharedJson AnswerToJson(const std::string& request) {
  const JsonPlace place(request, kRequest);
  const JsonPlace ask = place.Required("ask", "run or switches");
  const std::string& asked = ask.Text("run or switches");
  if (asked == "switches")
    return {{"switches", SwitchesToJson(2)}, {"in_space", SwitchesToJson(3)}, {"limits", LimitsToJson()}};
  if (asked == "run") return RunToJson(place);
  ask.Refuse("run or switches");
}

}  // namespace

std::string AnswerLive(const std::string& request) {
  try {
    return JsonText(AnswerToJson(request));
  } catch (const std::bad_alloc&) {
    return R"({"error":"out of memory"})";
  } catch (const std::exception& error) {
    return JsonText(SharedJson{{"error", error.what()}});
  }
}

}  // namespace stiction
