// SPDX-License-Identifier: Apache-2.0
#include "reports/pictures/finding_picture.h"

#include <fmt/format.h>

#include "corpus/input_error.h"
#include "corpus/record/problem_file.h"
#include "corpus/record/scene_file.h"
#include "reports/pictures/draw.h"
#include "reports/pictures/rounded_scene.h"
#include "scene/contacts.h"
#include "scene/simulate.h"

namespace stiction {
namespace {

// A scene with its contacts, and as much of the plane as shows it.
template <class Kind>
struct ShownScene {
  SceneIn<Kind, double> scene;
  MarksIn<Kind> marks;
  View view;
};

template <class Kind>
ShownScene<Kind> Show(const SceneFileIn<Kind>& file, const std::string& signature) {
  ShownScene<Kind> shown{RoundedScene(file, signature), {}, {}};
  for (const auto& contact : FindContacts(file.scene))
    shown.marks.contacts.push_back(contact.point.unaryExpr(&ToDouble));
  shown.view.Include(shown.scene);
  shown.view.AddMargin();
  return shown;
}

template <class Kind>
Html SceneFigure(const ShownScene<Kind>& shown, const std::string& signature) {
  const auto bodies = static_cast<std::int64_t>(shown.scene.bodies.size()),
             contacts = static_cast<std::int64_t>(shown.marks.contacts.size());
  const std::string label =
      fmt::format("Scene of {}: {}, touching at {}", signature,
                  bodies == 1 ? "1 body" : Grouped(bodies) + " bodies", Counted(contacts, "point"));
  return Tag("figure",
             {{"class", "scene"}})(DrawInline<Kind>(shown.scene, shown.view, shown.marks, label) +
                                   Html("<figcaption>The scene, as found. Green: contacts.</figcaption>\n")) +
         Html("\n");
}

// draw(shown) of the scene as found; what it makes of nothing where there is none that can be drawn.
template <class Result, class Draw>
Result Drawn(const Finding& finding, Draw draw) {
  try {
    const ProblemFile file = ParseProblem(finding.problem, finding.signature);
    if (!file.scene) return Result();
    return std::visit([&](const auto& scene) -> Result { return draw(Show(scene, finding.signature)); },
                      ParseAnyScene(JsonText(file.scene), finding.signature + ": scene"));
  } catch (const InputError&) {
    return Result();
  }
}

}  // namespace

Html PictureOfFinding(const Finding& finding) {
  return Drawn<Html>(finding, [&](const auto& shown) { return SceneFigure(shown, finding.signature); });
}

std::string SvgOfFinding(const Finding& finding) {
  return Drawn<std::string>(finding,
                            [](const auto& shown) { return DrawSvg(shown.scene, shown.view, shown.marks, 1); });
}

}  // namespace stiction
