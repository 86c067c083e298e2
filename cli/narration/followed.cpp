// SPDX-License-Identifier: Apache-2.0
#include "cli/narration/followed.h"

#include <algorithm>
#include <array>

#include "cli/narration/narrate_text.h"
#include "corpus/grouped.h"
#include "corpus/json.h"
#include "corpus/record/problem_file.h"

namespace stiction {
namespace {

// A row for each path method.
struct Narrator {
  std::string_view method;
  Narration (*exact)(const ProblemFile&, const ExactAnswer&, const Telling&);
  Narration (*inexact)(const ProblemFile&, const InexactAnswer&, const Telling&);

  Narration operator()(const ProblemFile& file, const ExactAnswer& a, const Telling& how) const {
    return exact(file, a, how);
  }
  Narration operator()(const ProblemFile& file, const InexactAnswer& a, const Telling& how) const {
    return inexact(file, a, how);
  }
};

constexpr std::array kNarrators = {
    Narrator{"baraff", &NarrateBaraff<Rational>, &NarrateBaraff<double>},
    Narrator{"complete", &NarrateComplete<Rational>, &NarrateComplete<double>},
    Narrator{"lemke", &NarrateLemke<Rational>, &NarrateLemke<double>},
};

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
  if (o.method == "baraff") return "The published algorithm, policy " + PolicyName(ParsePolicy(o.policy));
  return o.method == "complete" ? "Complete driving" : "Lemke's method";
}

// A page of more takes a browser long to open.
constexpr std::size_t kMostStepsOfPage = 3000;

}  // namespace

Narration Narrate(const std::string& method, const ProblemFile& file, const Solution& solution,
                  const Telling& how) {
  const auto narrator =
      std::find_if(kNarrators.begin(), kNarrators.end(), [&method](auto& n) { return n.method == method; });
  return std::visit([&](const auto& answer) { return (*narrator)(file, answer, how); }, solution.answer);
}

Json ReplayToJson(const PathOptions& o, const ProblemFile& file, const Solution& solution, Narration narration,
                  bool initial) {
  Json json = SolutionToJson(solution, file.problem.dimension);
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
