// SPDX-License-Identifier: Apache-2.0
#include "search/units/regenerate.h"

#include <fmt/format.h>

#include <algorithm>

#include "corpus/record/problem_file.h"
#include "corpus/record/scene_file.h"
#include "corpus/rounded.h"
#include "search/generators/scenes.h"

namespace stiction {
namespace {

Choices ChoicesOf(const Campaign& campaign, std::int64_t unit, std::int64_t index) {
  return Choices(
      ProblemSeed(campaign.seed, static_cast<std::uint64_t>(unit), static_cast<std::uint64_t>(index)));
}

}  // namespace

Regenerated Regenerate(const Campaign& campaign, std::int64_t unit, std::int64_t index) {
  return Regenerate(campaign, TaskOf(Schedule(campaign), unit), unit, index);
}

Regenerated Regenerate(const Campaign& campaign, const Task& task, std::int64_t unit, std::int64_t index) {
  Choices choices = ChoicesOf(campaign, unit, index);
  Regenerated made;
  const auto generate = [&](auto& problem) {
    made.drawn = Generate(task.generator, task.contacts, SurroundingsOf(campaign), choices, problem);
  };
  const bool is_dyadic = std::ranges::all_of(
      campaign.palette, [](const MuChoice& mu) { return (mu.denominator & (mu.denominator - 1)) == 0; });
  if (!Row(task.generator).exact_in_double || !is_dyadic) {
    generate(made.problem);
    return made;
  }
  thread_local ContactProblem<double> doubles;  // the same numbers, much sooner
  generate(doubles);
  made.problem = Unrounded(doubles);
  return made;
}

ProblemFile FileOf(const Campaign& campaign, std::int64_t unit, std::int64_t index,
                   const ExactProblem& problem) {
  const Task task = TaskOf(Schedule(campaign), unit);
  const std::string generator(Row(task.generator).name);
  ProblemFile file;
  file.name = fmt::format("{}-{}-{}", generator, unit, index);
  file.problem = problem;
  file.origin.Add({{"generator", generator},
                   {"campaign_seed", std::to_string(campaign.seed)},
                   {"unit", unit},
                   {"index", index}});
  Choices choices = ChoicesOf(campaign, unit, index);
  if (auto scene = GenerateScene(task.generator, task.contacts, SurroundingsOf(campaign), choices)) {
    scene->name = file.name;
    SceneFile scene_file;
    scene_file.scene = *std::move(scene);
    file.scene = ToJson(scene_file);
  }
  return file;
}

Finding FindingAt(const Campaign& campaign, const Task& task, std::int64_t unit, std::int64_t index,
                  std::size_t policy) {
  Finding finding;
  finding.unit = unit;
  finding.index = index;
  finding.generator = Row(task.generator).name;
  finding.contacts = task.contacts;
  finding.policy = PolicyName(campaign.policies[policy]);
  return finding;
}

}  // namespace stiction
