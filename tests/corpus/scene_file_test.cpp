// SPDX-License-Identifier: Apache-2.0
#include "corpus/scene_file.h"

#include <catch2/catch.hpp>

namespace stiction {
namespace {

const std::string kBodies =
    R"([{"name": "floor", "fixed": true, "acceleration": ["0", "1/3"], "shapes": [{"box": ["4", "1"]}]},
        {"name": "block", "mass": "2", "position": ["0", "1"], "shapes": [{"box": ["1", "1"]}]}])";

std::string Text(const std::string& bodies = kBodies, const std::string& more = "") {
  return R"({"format": "stiction-scene", "version": 1, "name": "s", "dimension": 2, "bodies": )" + bodies +
         more + "}";
}

std::string Body(const std::string& members) {
  return Text(R"([{"name": "a", )" + members + R"(}, {"name": "b", "fixed": true}])");
}

void CheckRefused(const std::string& text, const std::string& where, const std::string& expected) {
  INFO(text);
  try {
    ParseScene(text, "file");
    FAIL("accepted");
  } catch (const InputError& error) {
    const std::string message = error.what();
    INFO(message);
    CHECK(message.find("file: " + where + ": found ") != message.npos);
    CHECK(message.find(expected) != message.npos);
  }
}

TEST_CASE("scene file: mass properties of shapes, exact numbers and world points are read") {
  const SceneFile file = ParseScene(Text(kBodies, R"(, "gravity": ["0", "-981/100"], "mu": 0.5, "step": "1/240",
        "joints": [{"kind": "rail", "bodies": ["block", "floor"], "at": ["1", "1"], "direction": ["3", "4"]}],
        "pairs": [{"bodies": ["floor", "block"], "mu": "1/3", "collide": true}])"),
                                    "file");
  const auto& scene = file.scene;
  CHECK(scene.bodies[1].inertia == Rational(1, 3));  // m (w^2 + h^2) / 12
  CHECK(scene.bodies[0].acceleration[1] == Rational(1, 3));
  CHECK(scene.gravity[1] == Rational(-981, 100));
  CHECK(scene.mu == Rational(1, 2));
  CHECK(file.step == Rational(1, 240));
  CHECK(scene.joints[0].at_a[1] == 0);
  CHECK(scene.joints[0].at_b[1] == 1);
  CHECK(scene.joints[0].direction[0] == Rational(3, 5));
  CHECK(*scene.pairs[0].mu == Rational(1, 3));
}

TEST_CASE("scene file: what is written reads back the same") {
  const SceneFile file = ParseScene(
      Text(kBodies, R"(, "joints": [{"kind": "slider", "bodies": ["block", "floor"], "at": ["1/7", 0.1],
        "direction": ["1", "1"]}, {"kind": "pin", "bodies": ["floor", "block"], "at": [0, 1]}],
        "contacts": [{"bodies": ["block", "floor"], "at": ["0", "1/2"], "normal": ["0", "1"]}],
        "pairs": [{"bodies": ["floor", "block"], "mu": "1/3"}], "note": "n")"),
      "file");
  const std::string text = Print(file);
  CHECK(Print(ParseScene(text, "again")) == text);
}

TEST_CASE("scene file: errors name the place, what was found and what was expected") {
  CheckRefused(Text("{}"), "bodies", "an array of bodies");
  CheckRefused(Body(R"("mass": "0", "inertia": "1")"), "bodies[0].mass", "a number > 0");
  CheckRefused(Body(R"("mass": "1")"), "bodies[0].inertia", "no shapes to compute it from");
  CheckRefused(Body(R"("mass": "1", "shapes": [{"disc": "1", "center": ["1", "0"]}])"), "bodies[0]",
               "centre of mass");
  CheckRefused(Body(R"("mass": "1", "shapes": [{"disc": "-1"}])"), "bodies[0].shapes[0].disc", "a number > 0");
  CheckRefused(Body(R"("mass": "1", "shapes": [{"polygon": [[0,0],[0,1],[1,0]]}])"),
               "bodies[0].shapes[0].polygon", "anticlockwise");
  CheckRefused(Body(R"("mass": "1", "shapes": [{"polygon": [[0,0],[2,0],[1,1],[2,2],[0,2]]}])"),
               "bodies[0].shapes[0].polygon", "strictly convex");
  CheckRefused(Body(R"("mass": "1", "shapes": [{"polygon": [[0,2],[-1,-1],[2,1],[-2,1],[1,-1]]}])"),
               "bodies[0].shapes[0].polygon", "strictly convex");
  CheckRefused(Body(R"("mass": "1", "inertia": "1", "rotation": ["1", "1"])"), "bodies[0].rotation", "cos");
  CheckRefused(Body(R"("fixed": true, "mass": "1")"), "bodies[0].mass", "no mass of a fixed body");
  CheckRefused(Body(R"("mass": "1", "inertia": "1", "acceleration": [0, 1])"), "bodies[0].acceleration",
               "fixed");
  CheckRefused(Body(R"("mass": "1", "inertia": "1", "colour": "red")"), "bodies[0].colour", "");
  CheckRefused(Text(R"([{"name": "a", "fixed": true}, {"name": "a", "fixed": true}])"), "bodies[1].name",
               "a name of its own");
  CheckRefused(Text(kBodies, R"(, "mu": "-1")"), "mu", "a number >= 0");
  CheckRefused(Text(kBodies, R"(, "joints": [{"kind": "glue", "bodies": ["floor", "block"], "at": [0, 0]}])"),
               "joints[0].kind", "pin, rail or slider");
  CheckRefused(Text(kBodies, R"(, "joints": [{"kind": "pin", "bodies": ["floor", "door"], "at": [0, 0]}])"),
               "joints[0].bodies[1]", "the name of a body of the scene");
  CheckRefused(Text(kBodies, R"(, "joints": [{"kind": "pin", "bodies": ["floor", "floor"], "at": [0, 0]}])"),
               "joints[0].bodies", "two different bodies");
  CheckRefused(Text(kBodies, R"(, "joints": [{"kind": "rail", "bodies": ["floor", "block"], "at": [0, 0],
    "direction": [0, 0]}])"),
               "joints[0].direction", "not zero");
  CheckRefused(R"({"format": "stiction-scene", "version": 2, "name": "s"})", "version", "1");
  CheckRefused(R"({"format": "stiction-scene", "version": 1, "name": "s", "dimension": 3, "bodies": []})",
               "dimension", "2");
}

}  // namespace
}  // namespace stiction
