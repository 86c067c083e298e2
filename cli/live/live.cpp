// SPDX-License-Identifier: Apache-2.0
#include "cli/live/live.h"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <vector>

#include "answers/followed.h"
#include "answers/replay_page.h"
#include "corpus/problem_file.h"

namespace stiction {
namespace {

const std::string kRequest = "request";  // named in errors

Json SwitchesToJson() {
  Json switches = Json::array();
  for (const PolicySwitchRow& row : PolicySwitches()) {
    if (!row.planar) continue;
    Json values = Json::array();
    for (const PolicyValue& value : row.values)
      values.push_back({{"name", value.name}, {"meaning", value.meaning}});
    switches.push_back({{"name", row.name}, {"question", row.question}, {"values", std::move(values)}});
  }
  return switches;
}

Json LimitsToJson() {
  Json json = Json::object();
  Limits limits = kLiveLimits;
  ForEachField(limits, [&json](const NumberRow& row, std::int64_t value) { json[row.name] = value; });
  return json;
}

void RequirePlane(const ProblemFile& file) {
  const int rows = file.problem.rows();
  if (file.problem.dimension != 2)
    throw InputError("problem", "dimension", std::to_string(file.problem.dimension),
                     "2: in space forces are irrational, and nothing here runs there");
  if (rows > kMostLiveRows)
    throw InputError("problem", "contacts", fmt::format("{} rows", rows),
                     fmt::format("at most {}; the program takes more", kMostLiveRows));
}

FollowedRun Run(const PathOptions& path, const ProblemFile& file) {
  SolveRequest request{.method = path.method, .trace = KeepTrace::kYes};
  request.options.policy = ParsePolicy(path.policy);
  request.options.limits = path.limits;
  return Followed(path, file, {.answer = SolveExactly(file.problem, request)});
}

Json RunToJson(const JsonPlace& place) {
  const ProblemFile file = ParseProblem(place.Required("problem", "text").Text("text"), "problem");
  RequirePlane(file);
  PathOptions path{.method = place.Required("method", "text").Text("text"),
                   .policy = place.Required("policy", "text").Text("text"),
                   .limits = kLiveLimits};
  std::vector<FollowedRun> runs = {Run(path, file)};
  path.method = "complete";
  if (runs[0].replay["method"] != path.method) runs.push_back(Run(path, file));
  return {{"data", ReplayPageData(file, nullptr, runs)}};
}

Json AnswerToJson(const std::string& request) {
  const Json json = ParseJson(request, kRequest);
  const JsonPlace place(json, kRequest, "");
  const JsonPlace ask = place.Required("ask", "run or switches");
  const std::string& asked = ask.Text("run or switches");
  if (asked == "switches") return {{"switches", SwitchesToJson()}, {"limits", LimitsToJson()}};
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
    return Json{{"error", error.what()}}.dump();
  }
}

}  // namespace stiction
