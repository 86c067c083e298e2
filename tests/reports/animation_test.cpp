// SPDX-License-Identifier: Apache-2.0
// The page of a run of a scene: what it holds of the forces of a frame.

#include "reports/animation.h"

#include <catch2/catch.hpp>
#include <string>

#include "corpus/json.h"
#include "reports/pictures/draw_bodies.h"
#include "scene/simulate.h"

namespace stiction {
namespace {

// A disc on a floor that is fixed, which is body 0.
Scene<double> DiscOnFloor() {
  Scene<double> scene;
  scene.bodies.resize(2);
  for (auto& body : scene.bodies) body.shapes.emplace_back().radius = 1;
  scene.bodies[0].fixed = true;
  scene.bodies[1].name = "disc";
  return scene;
}

AppliedForceIn<Plane> ForceOf(int on, int from) {
  AppliedForceIn<Plane> force;
  force.bodies = {on, from};
  force.point = {0, 0};
  force.force = {1, 3};
  force.rows = {3, -1};
  force.law.kind = ContactKind::kStatic;
  force.law.mu = 0.5;
  return force;
}

TEST_CASE(
    "animation: a force acts on the body that moves, has its rows and its friction, and those of joints are "
    "left out") {
  const Scene<double> scene = DiscOnFloor();
  View view;
  view.Include(scene);
  MarksIn<Plane> marks;
  marks.forces = {ForceOf(1, 0), ForceOf(0, 1), ForceOf(1, 0)};
  marks.forces[2].from_joint = true;
  const double pixels = Screen(view).scale / 10;  // of a newton
  const std::string page = AnimationPage<Plane>(scene, view, {RecordFrame(scene, 0, marks)}, 0.1, 30);
  const std::string begin = "id=\"data\">";
  const std::size_t from = page.find(begin) + begin.size();
  const Json data = ParseJson(page.substr(from, page.find("</script>", from) - from), "data");
  CHECK(data["names"] == Json({"body 1", "disc"}));
  const Json& forces = data["frames"][0]["forces"];
  REQUIRE(forces.size() == 2);
  CHECK(forces[0]["f"] == Json({3.0, -1.0}));
  CHECK(forces[0]["mu"] == 0.5);
  CHECK(forces[0]["kind"] == "static");
  for (const int side : {0, 1}) {
    INFO(side);
    const double sign = side == 0 ? 1 : -1;
    CHECK(forces[side]["along"][0].get<double>() == Approx(sign * pixels).margin(0.01));
    CHECK(forces[side]["along"][1].get<double>() == Approx(-3 * sign * pixels).margin(0.01));
  }
}

}  // namespace
}  // namespace stiction
