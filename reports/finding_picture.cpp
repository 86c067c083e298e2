// SPDX-License-Identifier: Apache-2.0
#include "reports/finding_picture.h"

#include <fmt/format.h>

#include "corpus/input_error.h"
#include "corpus/problem_file.h"
#include "corpus/scene_file.h"
#include "reports/draw.h"
#include "reports/rounded_scene.h"
#include "scene/contacts.h"
#include "scene/simulate.h"

namespace stiction {
namespace {

template <class Kind>
Html SceneFigure(const SceneFileIn<Kind>& file, const std::string& signature) {
  const SceneIn<Kind, double> scene = RoundedScene(file, signature);
  MarksIn<Kind> marks;
  for (const auto& contact : FindContacts(file.scene))
    marks.contacts.push_back(contact.point.unaryExpr(&ToDouble));
  View view;
  view.Include(scene);
  view.AddMargin();
  const auto bodies = static_cast<std::int64_t>(scene.bodies.size()),
             contacts = static_cast<std::int64_t>(marks.contacts.size());
  const std::string label =
      fmt::format("Scene of {}: {}, touching at {}", signature,
                  bodies == 1 ? "1 body" : Grouped(bodies) + " bodies", Counted(contacts, "point"));
  return Tag("figure",
             {{"class", "scene"}})(DrawInline<Kind>(scene, view, marks, label) +
                                   Html("<figcaption>The scene, as found. Green: contacts.</figcaption>\n")) +
         Html("\n");
}

}  // namespace

Html PictureOfFinding(const Finding& finding) {
  try {
    const ProblemFile file = ParseProblem(finding.problem, finding.signature);
    if (!file.scene) return Html();
    return std::visit([&](const auto& scene) { return SceneFigure(scene, finding.signature); },
                      ParseAnyScene(JsonText(*file.scene), finding.signature + ": scene"));
  } catch (const InputError&) {
    return Html();
  }
}

}  // namespace stiction
