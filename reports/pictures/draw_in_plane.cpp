// SPDX-License-Identifier: Apache-2.0
// Bodies in the plane.

#include <fmt/format.h>

#include <array>

#include "reports/pictures/draw_bodies.h"
#include "scene/simulate.h"

namespace stiction {
namespace {

constexpr std::array kLevelColours = {"#e89a3c", "#9a6fb0", "#6aa84f", "#4f81bd", "#c0504d"};

Html LineTo(const std::string& path) { return Tag("path", {{"d", path}})(""); }

Html Drawn(const BodyShape<double>& shape) {
  const auto number = [](double x) { return Significant(x); };
  if (!shape.IsRound()) {
    std::string points;
    for (const auto& corner : shape.corners)
      points += Significant(corner[0], 6) + "," + Significant(corner[1], 6) + " ";
    return Tag("polygon", {{"points", points}})("");
  }
  const std::string x = number(shape.center[0]), y = number(shape.center[1]), r = number(shape.radius);
  // The radius line shows the turning.
  return Tag("circle", {{"cx", x}, {"cy", y}, {"r", r}})("") + LineTo("M" + x + "," + y + " h" + r);
}

// The pieces of a body, y up; behind them a rod to each of its joints.
Html BodyPicture(const Scene<double>& scene, int index, double scale) {
  const RigidBody<double>& body = scene.bodies[index];
  Html pieces;
  for (const auto& joint : scene.joints) {
    if (body.fixed || (joint.a != index && joint.b != index)) continue;
    const Vector2<double>& at = joint.a == index ? joint.at_a : joint.at_b;
    pieces += LineTo("M0,0 L" + Significant(at[0]) + "," + Significant(at[1]));
  }
  for (const auto& shape : body.shapes) pieces += Drawn(shape);
  return Tag("g", {{"fill", body.fixed ? "#333333" : ColourOfLevel(kLevelColours, body.level)},
                   {"stroke", "black"},
                   {"stroke-width", Significant(1 / scale, 4)},
                   {"fill-opacity", "0.85"}})(pieces);
}

}  // namespace

std::vector<Html> BodyPictures(const Scene<double>& scene, const Screen& screen) {
  std::vector<Html> pictures;
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i)
    pictures.push_back(BodyPicture(scene, i, screen.scale));
  return pictures;
}

std::vector<std::string> Transforms(const Scene<double>& scene, const Screen& screen) {
  std::vector<std::string> transforms;
  for (const auto& body : scene.bodies) {
    const double c = screen.scale * body.rotation[0], s = screen.scale * body.rotation[1];
    transforms.push_back(fmt::format("matrix({:.5g} {:.5g} {:.5g} {:.5g} {:.5g} {:.5g})", c, -s, -s, -c,
                                     screen.X(body.position), screen.Y(body.position)));
  }
  return transforms;
}

Html Placed(const Scene<double>& scene, const Screen& screen) {
  Html joints;
  for (const auto& joint : scene.joints)
    joints += Dot(screen, scene.bodies[joint.a].At(joint.at_a), "white", 4);
  return joints;
}

}  // namespace stiction
