// SPDX-License-Identifier: Apache-2.0
#include "cli/narration/replay_page.h"

#include "cli/narration/narrate_text.h"
#include "corpus/json.h"
#include "corpus/record/problem_file.h"

namespace stiction {
namespace {

// The states, counted in steps, that are the same, exactly or but for rounding: where the loop begins, and
// where the run was ended. Null for a run that is no loop.
Json LoopToJson(const Json& replay) {
  if (replay["outcome"] != "cycle") return nullptr;
  const Json& pivots = replay["pivots"];
  std::size_t from = 0;
  while (from < pivots.size() && pivots[from]["drive"] <= replay["start"]) ++from;
  const bool exact = pivots.empty() || pivots.back()["f"].empty() || pivots.back()["f"][0].is_string();
  return {{"from", from}, {"to", pivots.size()}, {"exact", exact}};
}

Json PartingToJson(const Parting& parting, const Policy& policy) {
  const PolicySwitchRow& row = *parting.row;
  const PolicyValue &here = row.values[static_cast<std::size_t>(row.get(policy))],
                    &there = row.values[static_cast<std::size_t>(parting.value)];
  return {{"step", parting.step}, {"switch", row.name},     {"question", row.question},
          {"reads", row.reads},   {"here", here.name},      {"meaning", here.meaning},
          {"there", there.name},  {"other", there.meaning}, {"outcome", Name(parting.outcome)}};
}

// The readings by which a step gives a variable up: when it is, and what a normal takes along.
Json ReadingsOf(const Json& told, const Policy& policy) {
  Json readings = Json::array();
  for (const PolicySwitchRow& row : PolicySwitches()) {
    const bool on_normal = told["moved"].get<std::string>().front() == 'N';
    if (row.id != PolicySwitch::kGiveUp && (row.id != PolicySwitch::kDrop || !on_normal)) continue;
    const PolicyValue& value = row.values[static_cast<std::size_t>(row.get(policy))];
    readings.push_back(
        {{"switch", row.name}, {"question", row.question}, {"here", value.name}, {"meaning", value.meaning}});
  }
  return readings;
}

Json RunToJson(const FollowedRun& run) {
  Json partings = Json::array(), told = run.narration.told;
  if (run.replay.contains("policy")) {
    const Policy policy = ParsePolicy(run.replay["policy"].get<std::string>());
    for (const Parting& parting : run.partings) partings.push_back(PartingToJson(parting, policy));
    for (Json& step : told) {
      if (step["mark"] == "given up") step["readings"] = ReadingsOf(step, policy);
    }
  }
  return {{"title", run.title},  {"before", run.narration.before}, {"told", std::move(told)},
          {"end", run.end},      {"loop", LoopToJson(run.replay)}, {"partings", std::move(partings)},
          {"replay", run.replay}};
}

Json RowNames(const ExactProblem& problem) {
  const VariableTexts names(problem);
  Json rows = Json::array();
  for (int row = 0; row < problem.rows(); ++row) rows.push_back(names.Component(row));
  return rows;
}

}  // namespace

Json ReplayPageData(const ProblemFile& file, const Json& picture, const std::vector<FollowedRun>& runs) {
  Json data = {{"name", file.name},
               {"problem", ProblemToJson(file.problem)},
               {"rows", RowNames(file.problem)},
               {"picture", picture},
               {"runs", Json::array()}};
  for (const FollowedRun& run : runs) data["runs"].push_back(RunToJson(run));
  return data;
}

}  // namespace stiction
