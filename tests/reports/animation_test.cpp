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

// The data of a page, its frames and forces unpacked.
Json AnimationDataOf(const std::string& page) {
  const std::string begin = "id=\"data\">";
  const std::size_t from = page.find(begin) + begin.size();
  Json data = ParseJson(page.substr(from, page.find("</script>", from) - from), "data");
  data["frames"] = ParseJson(Unpacked(data["frames"].get<std::string>()), "frames");
  return data;
}

std::vector<std::uint8_t> ForceBytesOf(const Json& data) {
  const std::string bytes = Unpacked(data["forces"].get<std::string>());
  return {bytes.begin(), bytes.end()};
}

std::array<float, 2> ForceRowsAt(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  std::array<float, 2> rows = {};
  std::memcpy(rows.data(), &bytes.at(at), sizeof rows);
  return rows;
}

constexpr std::size_t kFrameHead =
    6;  // of a frame: its forces, how many stand in the frame before, and how many not
constexpr std::size_t kForceBytes = 18;  // of a force in the plane
constexpr std::size_t kRowsBegin = 10;   // where its rows begin

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
  const Json data = AnimationDataOf(AnimationPage<Plane>(scene, view, {RecordFrame(scene, 0, marks)}, 0.1, 30));
  CHECK(data["names"] == Json({"body 1", "disc"}));
  REQUIRE(data["contacts"].size() == 2);
  CHECK(data["contacts"][0] == Json({{"bodies", {1, 0}}, {"kind", "static"}, {"rows", 2}, {"mu", 0.5}}));
  const std::vector<std::uint8_t> bytes = ForceBytesOf(data);
  REQUIRE(bytes.size() == kFrameHead + 2 * kForceBytes);
  const auto word = [&bytes](std::size_t at) {
    return static_cast<std::int16_t>(bytes[at] | bytes[at + 1] << 8);
  };
  for (const int side : {0, 1}) {
    INFO(side);
    const std::size_t begin_of = kFrameHead + side * kForceBytes;
    const double sign = side == 0 ? 1 : -1;
    CHECK(word(begin_of) == side);
    CHECK(word(begin_of + 6) / 10.0 == Approx(sign * pixels).margin(0.06));
    CHECK(word(begin_of + 8) / 10.0 == Approx(-3 * sign * pixels).margin(0.06));
    CHECK(ForceRowsAt(bytes, begin_of + kRowsBegin) == std::array<float, 2>{3, -1});
  }
}

TEST_CASE("animation: a frame says of what stands in the one before how much of it does") {
  const Scene<double> scene = DiscOnFloor();
  View view;
  view.Include(scene);
  MarksIn<Plane> two, one;
  two.forces = {ForceOf(1, 0), ForceOf(0, 1)};
  one.forces = {two.forces[0], two.forces[0]};
  const std::vector<std::uint8_t> bytes = ForceBytesOf(AnimationDataOf(AnimationPage<Plane>(
      scene, view, {RecordFrame(scene, 0, two), RecordFrame(scene, 0.1, two), RecordFrame(scene, 0.2, one)},
      0.1, 30)));
  REQUIRE(bytes.size() == 3 * kFrameHead + 3 * kForceBytes);
  const auto head = [&bytes](std::size_t at) { return std::vector(&bytes[at], &bytes[at] + kFrameHead); };
  CHECK(head(0) == std::vector<std::uint8_t>{2, 0, 0, 0, 2, 0});
  CHECK(head(kFrameHead + 2 * kForceBytes) == std::vector<std::uint8_t>{2, 0, 2, 0, 0, 0});
  CHECK(head(2 * kFrameHead + 2 * kForceBytes) == std::vector<std::uint8_t>{2, 0, 1, 0, 1, 0});
}

TEST_CASE("animation: what is less than a billionth of the largest force of all frames is 0") {
  const Scene<double> scene = DiscOnFloor();
  View view;
  view.Include(scene);
  MarksIn<Plane> strong, weak;
  strong.forces = {ForceOf(1, 0)};
  weak.forces = {ForceOf(1, 0)};
  weak.forces[0].rows = {2e-9, 4e-9};  // of 3
  const std::vector<std::uint8_t> bytes = ForceBytesOf(AnimationDataOf(AnimationPage<Plane>(
      scene, view, {RecordFrame(scene, 0, weak), RecordFrame(scene, 0.1, strong)}, 0.1, 30)));
  CHECK(ForceRowsAt(bytes, kFrameHead + kRowsBegin) == std::array<float, 2>{0, 4e-9F});
}

}  // namespace
}  // namespace stiction
