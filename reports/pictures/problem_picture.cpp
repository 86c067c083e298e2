// SPDX-License-Identifier: Apache-2.0
#include "reports/pictures/problem_picture.h"

#include "corpus/input_error.h"
#include "corpus/json.h"
#include "corpus/record/problem_file.h"
#include "reports/pictures/draw_bodies.h"
#include "reports/pictures/rounded_scene.h"
#include "scene/simulate.h"

namespace stiction {
namespace {

template <class Kind>
typename Kind::template Vector<double> PointOf(const SceneIn<Kind, double>& scene,
                                               const std::vector<TouchPointIn<Kind, Rational>>& contacts,
                                               const ConstraintIn<Kind, Rational>& constraint) {
  if (!constraint.from_joint) return contacts[constraint.source].point.unaryExpr(&ToDouble);
  const auto& joint = scene.joints[constraint.source];
  return scene.bodies[joint.a].At(joint.at_a);
}

// The way of a unit force of each row, on the body that draw.h shows it on.
template <class Kind>
Json WaysOf(const SceneIn<Kind, double>& scene, const ConstraintIn<Kind, Rational>& constraint) {
  const int side = ShownSide(scene, constraint.bodies);
  Json ways = Json::array();
  for (const auto& row : constraint.rows) {
    const typename Kind::template Vector<double> way =
        row.J[side].template head<Kind::kDimension>().unaryExpr(&ToDouble);
    const Vector2<double> seen = Seen(way);
    ways.push_back(InPicture(seen[0], -seen[1]));
  }
  return ways;
}

}  // namespace

template <class Kind>
Json PictureOfProblem(const SceneIn<Kind, double>& scene,
                      const std::vector<TouchPointIn<Kind, Rational>>& contacts,
                      const ModelIn<Kind, Rational>& model, const Island& island) {
  View view;
  view.Include(scene);
  view.AddMargin();
  const Screen screen(view);
  Json places = Json::array();
  for (const int number : island.constraints) {
    const auto& constraint = model.constraints[number];
    const Vector2<double> at = Seen(PointOf(scene, contacts, constraint));
    places.push_back({{"at", InPicture(screen.X(at), screen.Y(at))}, {"rows", WaysOf(scene, constraint)}});
  }
  const Vector2<double> gravity = Seen(scene.gravity);
  return {{"svg", DrawSvg(scene, view, MarksIn<Kind>(), 1)},
          {"contacts", std::move(places)},
          {"gravity", InPicture(gravity[0], -gravity[1])}};
}

namespace {

bool AreSame(const ExactProblem& left, const ExactProblem& right) {
  return *ProblemToJson(left) == *ProblemToJson(right);
}

// The picture of the scene, if this is its one problem.
template <class Kind>
Json PictureOf(const SceneFileIn<Kind>& scene, const ExactProblem& problem, const std::string& source) {
  const auto contacts = FindContacts(scene.scene);
  const auto model = Assemble(scene.scene, contacts);
  if (model.islands.size() != 1 || !AreSame(model.Problem(0), problem)) return {};
  return PictureOfProblem(RoundedScene(scene, source), contacts, model, model.islands[0]);
}

}  // namespace

SharedJson PictureBeside(const ProblemFile& file, const std::string& source) {
  if (!file.scene) return {};
  try {
    const auto scene = ParseAnyScene(JsonText(file.scene), source + ": scene");
    return std::visit([&](const auto& each) { return PictureOf(each, file.problem, source); }, scene);
  } catch (const InputError&) {
    return {};
  }
}

template Json PictureOfProblem(const SceneIn<Plane, double>&, const std::vector<TouchPointIn<Plane, Rational>>&,
                               const ModelIn<Plane, Rational>&, const Island&);
template Json PictureOfProblem(const SceneIn<Space, double>&, const std::vector<TouchPointIn<Space, Rational>>&,
                               const ModelIn<Space, Rational>&, const Island&);

}  // namespace stiction
