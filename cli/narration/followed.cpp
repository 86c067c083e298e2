// SPDX-License-Identifier: Apache-2.0
#include "cli/narration/followed.h"

#include <algorithm>
#include <optional>

#include "certify/exact/answer_json.h"
#include "certify/exact/exact.h"
#include "cli/narration/narrate_text.h"
#include "corpus/grouped.h"
#include "corpus/json.h"
#include "corpus/record/problem_file.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

// How a run ended, as PrintEnd says it.
std::string EndOf(const Solution& solution) {
  return std::visit(
      [](const auto& answer) {
        const bool proved = answer.arithmetic == Arithmetic::kExact;
        std::string text = EndText(answer, proved);
        if (!proved && answer.outcome == Outcome::kCycle) text += fmt::format(" ({})", kNoProof);
        if (answer.ray.size() > 0)
          text += fmt::format("; no limit to the step along df = {}", ListText(answer.ray));
        return text;
      },
      solution.answer);
}

std::string TitleOf(const Request& asked) {
  const std::string heading(FindMethod<Rational>(asked.method)->heading);
  return asked.method == "baraff" ? heading + ", policy " + PolicyName(asked.policy) : heading;
}

// ---- Partings ----------------------------------------------------------------------------------

using Steps = std::vector<Pivot<Rational>>;

bool AreSame(const Pivot<Rational>& left, const Pivot<Rational>& right) {
  return left.driven == right.driven && left.goal == right.goal && left.limiting == right.limiting &&
         left.s == right.s && left.f == right.f && left.sets == right.sets;
}

// The first step in which both runs do something, and not the same.
std::optional<std::size_t> FirstDifference(const Steps& left, const Steps& right) {
  const std::size_t both = std::min(left.size(), right.size());
  const auto [at, other] =
      std::mismatch(left.begin(), left.begin() + static_cast<std::ptrdiff_t>(both), right.begin(), &AreSame);
  const auto step = static_cast<std::size_t>(at - left.begin());
  return step < both ? std::optional(step) : std::nullopt;
}

// Enough for a run that ends, or comes round, somewhat later.
Limits EnoughFor(const Steps& steps, const Limits& limits) {
  Limits enough = limits;
  enough.pivots = std::min(limits.pivots, static_cast<std::int64_t>(1000 + 10 * steps.size()));
  return enough;
}

// The policy with another value of a switch leaves the path at a step, and ends so.
Json PartingToJson(std::size_t step, const PolicySwitchRow& row, int here, int there, Outcome outcome) {
  const PolicyValue &mine = row.values[static_cast<std::size_t>(here)],
                    &other = row.values[static_cast<std::size_t>(there)];
  return {{"step", step},        {"switch", row.name},     {"question", row.question},
          {"reads", row.reads},  {"here", mine.name},      {"meaning", mine.meaning},
          {"there", other.name}, {"other", other.meaning}, {"outcome", Name(outcome)}};
}

// Runs of the other policies end in `limit` after some multiple of the steps of this one.
Json PartingsOf(const ExactProblem& problem, const Request& asked, const Steps& pivots) {
  const Limits enough = EnoughFor(pivots, asked.limits);
  Json partings = Json::array();
  for (const PolicySwitchRow& row : PolicySwitches()) {
    const int here = row.get(asked.policy);
    for (int there = 0; row.planar && there < static_cast<int>(row.values.size()); ++there) {
      if (there == here) continue;
      Policy other = asked.policy;
      row.set(other, there);
      const ExactRun run = RunExact(problem, {.policy = other, .limits = enough});
      const auto step = FirstDifference(pivots, run.trace.pivots);
      if (step) partings.push_back(PartingToJson(*step, row, here, there, run.verdict.outcome));
    }
  }
  return partings;
}

// A page of more takes a browser long to open.
constexpr std::size_t kMostStepsOfPage = 3000;

}  // namespace

Narration Narrate(std::string_view method, const ProblemFile& file, const Solution& solution,
                  const Telling& how) {
  const auto narrate = [&](const auto& answer) {
    switch (FindMethod<Rational>(method)->path) {
      case Path::kDrives:
        return NarrateBaraff(file, answer, how);
      case Path::kPieces:
        return NarrateComplete(file, answer, how);
      case Path::kPivots:
        return NarrateLemke(file, answer, how);
      case Path::kNone:
        break;
    }
    STICTION_CHECK(false, "a method with a path");
    return Narration();
  };
  return std::visit(narrate, solution.answer);
}

Json ReplayToJson(const Request& asked, const ProblemFile& file, const Solution& solution, Narration narration,
                  bool initial) {
  Json json = SolutionToJson(solution, file.problem.dimension());
  if (!json.contains("start")) json["start"] = json["period"] = 0;
  json["method"] = asked.method;
  if (asked.method == "baraff") json["policy"] = PolicyName(asked.policy);
  const auto first = [&file](const auto& answer) {
    return Json{{"f", ListJson(answer.first_f)}, {"a", ListJson(FirstAccelerations(file.problem, answer))}};
  };
  if (initial) json["initial"] = std::visit(first, solution.answer);
  json["pivots"] = ListJson(narration.pivots);
  return json;
}

FollowedRun Followed(const Request& asked, const ProblemFile& file, const Solution& solution) {
  FollowedRun run;
  run.title = TitleOf(asked);
  run.narration = Narrate(asked.method, file, solution, {.vectors = true});
  run.end = EndOf(solution);
  run.replay = ReplayToJson(asked, file, solution, run.narration, true);
  if (const std::size_t steps = run.narration.pivots.size(); steps > kMostStepsOfPage)
    throw InputError(
        fmt::format("--html: found a run of {} steps, expected at most {}: --max-drives ends it earlier",
                    Grouped(static_cast<std::int64_t>(steps)), Grouped(kMostStepsOfPage)));
  const auto* exact = std::get_if<ExactAnswer>(&solution.answer);
  const bool parts = asked.method == "baraff" && exact != nullptr;
  run.partings = parts ? PartingsOf(file.problem, asked, exact->pivots) : Json::array();
  return run;
}

// ---- As the viewer wants them ------------------------------------------------------------------

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
  Json told = ListJson(run.narration.told);
  if (run.replay->contains("policy")) {
    const Policy policy = ParsePolicy(run.replay->at("policy").get<std::string>());
    for (Json& step : told) {
      if (step["mark"] == "given up") step["readings"] = ReadingsOf(step, policy);
    }
  }
  return {{"title", run.title},  {"before", run.narration.before}, {"told", std::move(told)},
          {"end", run.end},      {"loop", LoopToJson(run.replay)}, {"partings", run.partings},
          {"replay", run.replay}};
}

Json RowNames(const ExactProblem& problem) {
  const VariableTexts names(problem);
  Json rows = Json::array();
  for (int row = 0; row < problem.rows(); ++row) rows.push_back(names.Component(row));
  return rows;
}

}  // namespace

SharedJson ReplayPageData(const ProblemFile& file, const SharedJson& picture,
                          const std::vector<FollowedRun>& runs, bool every_policy) {
  Json data = {{"name", file.name},
               {"problem", ProblemToJson(file.problem)},
               {"rows", RowNames(file.problem)},
               {"picture", picture},
               {"runs", Json::array()}};
  for (const FollowedRun& run : runs) data["runs"].push_back(RunToJson(run));
  if (every_policy) data["every_policy"] = true;
  return data;
}

}  // namespace stiction
