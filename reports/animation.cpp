// SPDX-License-Identifier: Apache-2.0
#include "reports/animation.h"

#include <cmath>
#include <iterator>

#include "corpus/json.h"
#include "reports/animation_template.h"
#include "reports/html/template.h"
#include "reports/pictures/draw_bodies.h"
#include "scene/tables.h"

namespace stiction {
namespace {

constexpr std::array kKinds = {"bilateral", "frictionless", "static", "sliding"};

// A force of a contact by rows, exactly, and as draw.h shows it: pixels of a newton, before it is cut.
template <class Kind>
Json ForceJson(const SceneIn<Kind, double>& scene, const Screen& screen, const AppliedForceIn<Kind>& force,
               double newton) {
  const Vector2<double> at = Seen(force.point);
  const double side = ShownSide(scene, force.bodies) == 0 ? 1 : -1;
  const Vector2<double> along = side * newton * screen.scale * Seen(force.force);
  Json rows = Json::array();
  for (const double f : force.rows) rows.push_back(f);
  Json json = {{"at", InPicture(screen.X(at), screen.Y(at))},
               {"along", InPicture(along[0], -along[1])},
               {"bodies", {force.bodies[0], force.bodies[1]}},
               {"kind", kKinds[static_cast<std::size_t>(force.law.kind)]},
               {"f", std::move(rows)}};
  if (force.law.HasFrictionRows()) json["mu"] = force.law.mu;
  return json;
}

template <class Kind>
Json FrameJson(const SceneIn<Kind, double>& moved, const Screen& screen, const FrameIn<Kind>& frame,
               double newton) {
  Json points = Json::array(), forces = Json::array();
  for (const auto& contact : frame.marks.contacts) {
    const Vector2<double> at = Seen(contact);
    points.push_back(InPicture(screen.X(at), screen.Y(at)));
  }
  for (const auto& force : frame.marks.forces) {
    if (!force.from_joint) forces.push_back(ForceJson(moved, screen, force, newton));
  }
  return {{"time", frame.time},
          {"transforms", Transforms(moved, screen)},
          {"placed", Placed(moved, screen).markup()},
          {"points", std::move(points)},
          {"forces", std::move(forces)},
          {"problems", frame.problems},
          {"remark", frame.remark},
          {"energy", NumbersToJson(frame.energy)},
          {"drift", NumbersToJson(frame.drift)}};
}

}  // namespace

template <class Kind>
std::string AnimationPage(const SceneIn<Kind, double>& scene, const View& view,
                          const std::vector<FrameIn<Kind>>& frames, double newton, double rate) {
  const Screen screen(view);
  Json names = Json::array(), bodies = Json::array(), shown = Json::array();
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i) names.push_back(NameOfBody(scene, i));
  for (const Html& picture : BodyPictures(scene, screen)) bodies.push_back(picture.markup());
  SceneIn<Kind, double> moved = scene;
  for (const auto& frame : frames) {
    SetPoses(moved, frame);
    shown.push_back(FrameJson(moved, screen, frame, newton));
  }
  const Json data = {{"name", scene.name},
                     {"dimension", Kind::kDimension},
                     {"rate", rate},
                     {"size", {screen.width, screen.height}},
                     {"names", names},
                     {"bodies", bodies},
                     {"frames", std::move(shown)}};
  const std::string page(std::begin(kAnimationTemplate), std::end(kAnimationTemplate));
  return FilledTemplate(page, {{"title", Text(scene.name)}, {"data", ScriptData(JsonText(data))}});
}

template std::string AnimationPage(const SceneIn<Plane, double>&, const View&,
                                   const std::vector<FrameIn<Plane>>&, double, double);
template std::string AnimationPage(const SceneIn<Space, double>&, const View&,
                                   const std::vector<FrameIn<Space>>&, double, double);

}  // namespace stiction
