// SPDX-License-Identifier: Apache-2.0
#include "cli/replay_file.h"

#include "corpus/formats/read_problem.h"
#include "corpus/json.h"
#include "reports/pictures/problem_picture.h"
#include "reports/pictures/rounded_scene.h"

namespace stiction {
namespace {

bool AreSame(const ExactProblem& left, const ExactProblem& right) {
  return ProblemToJson(left) == ProblemToJson(right);
}

// The picture of the scene, if this is its one problem.
template <class Kind>
Json PictureOf(const SceneFileIn<Kind>& scene, const ExactProblem& problem, const std::string& source) {
  const auto contacts = FindContacts(scene.scene);
  const auto model = Assemble(scene.scene, contacts);
  if (model.islands.size() != 1 || !AreSame(model.Problem(0), problem)) return nullptr;
  return PictureOfProblem(RoundedScene(scene, source), contacts, model, model.islands[0]);
}

// The picture of the scene that a problem brings along, unless the problem has changed since, or the scene is
// none.
Json PictureBeside(const ProblemFile& file, const std::string& source) {
  if (!file.scene) return nullptr;
  try {
    const auto scene = ParseAnyScene(JsonText(*file.scene), source + ": scene");
    return std::visit([&](const auto& each) { return PictureOf(each, file.problem, source); }, scene);
  } catch (const InputError&) {
    return nullptr;
  }
}

}  // namespace

ReplayFile ReadReplayFile(const std::string& file) {
  ReplayFile replay;
  replay.file = ReadProblem(file);
  replay.picture = PictureBeside(replay.file, file);
  return replay;
}

}  // namespace stiction
