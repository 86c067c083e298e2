// SPDX-License-Identifier: Apache-2.0
#include "search/units/regenerate.h"

#include <fmt/format.h>

#include "corpus/record/problem_file.h"
#include "corpus/record/scene_file.h"
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
  made.drawn = Generate<Rational, Eigen::Dynamic>(task.generator, task.contacts, SurroundingsOf(campaign),
                                                  choices, made.problem);
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
