// SPDX-License-Identifier: Apache-2.0
// The page of a run of a scene: what it holds of the forces of a frame.

#include "reports/animation.h"

#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "corpus/json.h"
#include "reports/pictures/draw_bodies.h"
#include "scene/simulate.h"
#include "tests/reports/packed.h"

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
  REQUIRE(data["contacts"].size() == 2);
  CHECK(data["contacts"][0] == Json({{"bodies", {1, 0}}, {"kind", "static"}, {"rows", 2}, {"mu", 0.5}}));
  const std::vector<std::uint8_t> bytes = FromBase64(data["frames"][0]["forces"].get<std::string>());
  constexpr std::size_t kBytes = 18;  // of a force in the plane
  constexpr std::size_t kHead = 4;    // how many stand in the frame before, and how many not
  REQUIRE(bytes.size() == kHead + 2 * kBytes);
  const auto word = [&bytes](std::size_t at) {
    return static_cast<std::int16_t>(bytes[at] | bytes[at + 1] << 8);
  };
  for (const int side : {0, 1}) {
    INFO(side);
    const std::size_t begin_of = kHead + side * kBytes;
    const double sign = side == 0 ? 1 : -1;
    CHECK(word(begin_of) == side);
    CHECK(word(begin_of + 6) / 10.0 == Approx(sign * pixels).margin(0.06));
    CHECK(word(begin_of + 8) / 10.0 == Approx(-3 * sign * pixels).margin(0.06));
    std::array<float, 2> rows = {};
    std::memcpy(rows.data(), &bytes[begin_of + 10], sizeof rows);
    CHECK(rows == std::array<float, 2>{3, -1});
  }
}

TEST_CASE("animation: a frame says of what stands in the one before how much of it does") {
  const Scene<double> scene = DiscOnFloor();
  View view;
  view.Include(scene);
  MarksIn<Plane> two, one;
  two.forces = {ForceOf(1, 0), ForceOf(0, 1)};
  one.forces = {two.forces[0], two.forces[0]};
  const std::string page = AnimationPage<Plane>(
      scene, view, {RecordFrame(scene, 0, two), RecordFrame(scene, 0.1, two), RecordFrame(scene, 0.2, one)},
      0.1, 30);
  const std::string begin = "id=\"data\">";
  const std::size_t from = page.find(begin) + begin.size();
  const Json data = ParseJson(page.substr(from, page.find("</script>", from) - from), "data");
  const auto bytes = [&data](int frame) {
    return FromBase64(data["frames"][frame]["forces"].get<std::string>());
  };
  CHECK(bytes(1) == std::vector<std::uint8_t>{2, 0, 0, 0});
  const std::vector<std::uint8_t> last = bytes(2);
  REQUIRE(last.size() == 4 + 18);
  CHECK(std::vector(last.begin(), last.begin() + 4) == std::vector<std::uint8_t>{1, 0, 1, 0});
}

}  // namespace
}  // namespace stiction
