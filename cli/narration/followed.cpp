// SPDX-License-Identifier: Apache-2.0
#include "cli/narration/followed.h"

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

std::string TitleOf(const PathOptions& o) {
  const std::string heading(FindMethod<Rational>(o.method)->heading);
  return o.method == "baraff" ? heading + ", policy " + PolicyName(ParsePolicy(o.policy)) : heading;
}

// A page of more takes a browser long to open.
constexpr std::size_t kMostStepsOfPage = 3000;

}  // namespace

Narration Narrate(const std::string& method, const ProblemFile& file, const Solution& solution,
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

Json ReplayToJson(const PathOptions& o, const ProblemFile& file, const Solution& solution, Narration narration,
                  bool initial) {
  Json json = SolutionToJson(solution, file.problem.dimension());
  if (!json.contains("start")) json["start"] = json["period"] = 0;
  json["method"] = o.method;
  if (o.method == "baraff") json["policy"] = PolicyName(ParsePolicy(o.policy));
  const auto first = [&file](const auto& answer) {
    return Json{{"f", ListJson(answer.first_f)}, {"a", ListJson(FirstAccelerations(file.problem, answer))}};
  };
  if (initial) json["initial"] = std::visit(first, solution.answer);
  json["pivots"] = std::move(narration.pivots);
  return json;
}

FollowedRun Followed(const PathOptions& o, const ProblemFile& file, const Solution& solution) {
  FollowedRun run;
  run.title = TitleOf(o);
  run.narration = Narrate(o.method, file, solution, {.vectors = true});
  run.end = EndOf(solution);
  run.replay = ReplayToJson(o, file, solution, run.narration, true);
  if (const std::size_t steps = run.replay["pivots"].size(); steps > kMostStepsOfPage)
    throw InputError(
        fmt::format("--html: found a run of {} steps, expected at most {}: --max-drives ends it earlier",
                    Grouped(static_cast<std::int64_t>(steps)), Grouped(kMostStepsOfPage)));
  const auto* exact = std::get_if<ExactAnswer>(&solution.answer);
  if (o.method == "baraff" && exact != nullptr)
    run.partings = PartingsOf(file.problem, ParsePolicy(o.policy), o.limits, exact->pivots);
  return run;
}

}  // namespace stiction
