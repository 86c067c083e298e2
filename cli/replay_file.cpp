// SPDX-License-Identifier: Apache-2.0
#include "cli/replay_file.h"

#include <fmt/format.h>

#include "reports/pictures/problem_picture.h"
#include "reports/pictures/rounded_scene.h"

namespace stiction {
namespace {

template <class Kind>
ReplayFile Assembled(const SceneFileIn<Kind>& scene, const std::string& source) {
  const auto contacts = FindContacts(scene.scene);
  const auto model = Assemble(scene.scene, contacts);
  if (model.islands.size() != 1) {
    throw InputError(
        fmt::format("{}: found {} independent problems, expected one (stiction assemble writes each)", source,
                    model.islands.size()));
  }
  ReplayFile replay;
  replay.file.name = scene.scene.name;
  replay.file.problem = model.Problem(0);
  replay.picture = PictureOfProblem(RoundedScene(scene, source), contacts, model, model.islands[0]);
  return replay;
}

ReplayFile AssembledFrom(const std::string& text, const std::string& source) {
  return std::visit([&source](const auto& scene) { return Assembled(scene, source); },
                    ParseAnyScene(text, source));
}

bool AreSame(const ExactProblem& left, const ExactProblem& right) {
  return ProblemToJson(left) == ProblemToJson(right);
}

// Of the scene that a problem brings along, unless the problem has changed since, or the scene is none.
Json PictureBeside(const ProblemFile& file, const std::string& source) {
  if (!file.scene) return nullptr;
  try {
    const ReplayFile assembled = AssembledFrom(JsonText(*file.scene), source + ": scene");
    return AreSame(assembled.file.problem, file.problem) ? assembled.picture : nullptr;
  } catch (const InputError&) {
    return nullptr;
  }
}

}  // namespace

ReplayFile ReadReplayFile(const std::string& file) {
  const std::string text = ReadText(file);
  const Json json = ParseJson(text, file);
  if (json.is_object() && json.value("format", Json()) == "stiction-scene") return AssembledFrom(text, file);
  ReplayFile replay;
  replay.file = ParseProblem(text, file);
  replay.picture = PictureBeside(replay.file, file);
  return replay;
}

}  // namespace stiction
