// SPDX-License-Identifier: Apache-2.0
#include "corpus/record/scene_file.h"

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

void CheckRefused(const std::string& text, const std::string& where, const std::string& expected,
                  bool in_space = false) {
  INFO(text);
  try {
    in_space ? void(ParseScene<Space>(text, "file")) : void(ParseScene(text, "file"));
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

TEST_CASE("scene file: of dimension 3, read exactly and written so that it reads back the same") {
  const SceneFileInSpace file = ParseScene<Space>(R"({"format": "stiction-scene", "version": 1, "name": "s",
    "dimension": 3, "note": "n", "gravity": ["0", "0", "-981/100"], "mu": 0.5, "bodies": [
      {"name": "slope", "fixed": true, "rotation": [3, 0, -1, 0], "shapes": [{"box": [2, 4, 6], "center": [0, 0, -1]}]},
      {"name": "tip", "mass": "2", "inertia": [[2, "1/3", 0], ["1/3", 2, 0], [0, 0, 1]], "angle": 0.1, "axis": [0, 3, 4],
       "shapes": [{"polyhedron": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, "1/7"]]}]},
      {"name": "ball", "mass": "3", "position": ["1", "0", "1"], "spin": [1, 2, 3], "shapes": [{"ball": "1/2"}]}],
    "joints": [{"kind": "ball", "bodies": ["ball", "slope"], "at": ["1", "0", "0"]}],
    "contacts": [{"bodies": ["tip", "slope"], "anchors": [[0, 0, 0], [0, 0, 0]], "normal": ["-3", "0", "4"]}],
    "pairs": [{"bodies": ["tip", "ball"], "collide": false}]})",
                                                  "file");
  const auto& scene = file.scene;
  CHECK(scene.bodies[0].shapes[0].faces.size() == 6);
  CHECK(scene.bodies[2].inertia(1, 1) == Rational(3, 10));  // 2/5 m r^2
  CHECK(scene.bodies[2].inertia(0, 1) == 0);
  CHECK(scene.joints[0].at_a[2] == -1);
  CHECK(scene.joints[0].at_b[0] == Rational(4, 5));
  CHECK(scene.joints[0].at_b[2] == Rational(-3, 5));
  CHECK(scene.contacts[0].normal[0] == 0);  // the slope's own axis
  CHECK(scene.contacts[0].normal[2] == 1);
  const std::string text = Print(file);
  CHECK(Print(ParseScene<Space>(text, "again")) == text);
}

// A fixed door frame, turned so that its x axis is (4/5, 0, 3/5) in the world, and a door.
std::string SpaceText(const std::string& more, const std::string& of_frame = "",
                      const std::string& of_door = "") {
  return R"({"format": "stiction-scene", "version": 1, "name": "s", "dimension": 3, "bodies": [
    {"name": "frame", "fixed": true, "rotation": [3, 0, -1, 0])" +
         of_frame + R"(}, {"name": "door", "mass": "1", "position": ["0", "1", "0"], "rotation": [1, 1, 0, 0],
     "shapes": [{"box": [1, 1, 1]}])" +
         of_door + "}]" + more + "}";
}

std::string JointText(const std::string& members) {
  return SpaceText(R"(, "joints": [{"bodies": ["door", "frame"], "at": [0, 2, 0], )" + members + "}]");
}

TEST_CASE(
    "scene file: joints of dimension 3 have their direction and turn in the coordinates of their second body") {
  const auto joint = [](const std::string& members) {
    return ParseScene<Space>(JointText(members), "file").scene.joints.at(0);
  };
  const auto hinge = joint(R"("kind": "hinge", "direction": ["8", "0", "6"])");
  CHECK(hinge.kind == JointKindInSpace::kHinge);
  CHECK(hinge.at_a == MakeVector3<Rational>(0, 0, -1));
  CHECK(hinge.direction == MakeVector3<Rational>(1, 0, 0));
  // b's rotation back after a's: z of the door is -y of the world, and of the frame.
  const Vector3<Rational> z =
      RotationMatrix<Rational>(hinge.relative_rotation) * MakeVector3<Rational>(0, 0, 1);
  CHECK(z == MakeVector3<Rational>(0, -1, 0));
  CHECK(joint(R"("kind": "rail", "axis": ["0", "3", "4"])").direction ==
        MakeVector3<Rational>(0, Rational(3, 5), Rational(4, 5)));
  const auto slider = joint(R"("kind": "slider", "axis": [0, 0, 1], "turn": ["1", "2", "3", "4"])");
  CHECK(slider.relative_rotation[3] == 4);
  CHECK(joint(R"("kind": "ball")").at_b == MakeVector3<Rational>(0, 2, 0));
}

TEST_CASE("scene file: joints and accelerations of dimension 3 are written so that they read back the same") {
  for (const char* members : {R"("kind": "ball")", R"("kind": "hinge", "direction": ["1", "1", "0"])",
                              R"("kind": "rail", "direction": ["1", "2", "3"])",
                              R"("kind": "slider", "axis": ["0", "0", "1"], "turn": ["1", "2", "3", "1/4"])"}) {
    const std::string text = Print(ParseScene<Space>(JointText(members), "file"));
    CHECK(Print(ParseScene<Space>(text, "again")) == text);
  }
  const auto file = ParseScene<Space>(SpaceText("", R"(, "acceleration": ["0", "1/3", "0"])"), "file");
  CHECK(file.scene.bodies[0].acceleration[1] == Rational(1, 3));
  CHECK(ParseScene<Space>(Print(file), "again").scene.bodies[0].acceleration ==
        file.scene.bodies[0].acceleration);
}

TEST_CASE("scene file: joints and accelerations of dimension 3 are rounded to doubles") {
  const auto text = JointText(R"("kind": "slider", "axis": ["0", "3", "4"], "turn": ["1", "2", "2", "4"])");
  const auto scene = Round(ParseScene<Space>(text, "file").scene);
  const auto& joint = scene.joints.at(0);
  CHECK(joint.kind == JointKindInSpace::kSlider);
  CHECK(std::pair(joint.a, joint.b) == std::pair(1, 0));
  CHECK(joint.at_b[1] == 2);
  CHECK((joint.direction - Vector3<double>(0, 0.6, 0.8)).norm() < 1e-15);
  CHECK((joint.relative_rotation - Quaternion<double>(0.2, 0.4, 0.4, 0.8)).norm() < 1e-15);
  const auto file = ParseScene<Space>(SpaceText("", R"(, "acceleration": ["0", "1/3", "0"])"), "file");
  CHECK(Round(file.scene).bodies[0].acceleration[1] == 1.0 / 3);
}

TEST_CASE("scene file: errors of dimension 3 name the place, what was found and what was expected") {
  const auto refused = [](const std::string& text, const std::string& where, const std::string& expected) {
    CheckRefused(text, where, expected, true);
  };
  refused(JointText(R"("kind": "pin")"), "joints[0].kind", "ball, hinge, rail or slider");
  refused(JointText(R"("kind": 3)"), "joints[0].kind", "ball, hinge, rail or slider");
  refused(JointText(R"("kind": "ball", "direction": [1, 0, 0])"), "joints[0].direction",
          "no direction of a ball");
  refused(JointText(R"("kind": "ball", "axis": [1, 0, 0])"), "joints[0].axis", "no axis of a ball");
  refused(JointText(R"("kind": "ball", "turn": [1, 0, 0, 0])"), "joints[0].turn", "no turn of a ball");
  refused(JointText(R"("kind": "rail", "axis": [1, 0, 0], "turn": [1, 0, 0, 0])"), "joints[0].turn",
          "no turn of a rail");
  refused(JointText(R"("kind": "hinge")"), "joints[0].direction", "a direction [x, y, z]");
  refused(JointText(R"("kind": "slider", "direction": [1, 0])"), "joints[0].direction",
          "three numbers [x, y, z]");
  refused(JointText(R"("kind": "slider", "direction": [0, 0, 0])"), "joints[0].direction", "not zero");
  refused(JointText(R"("kind": "hinge", "direction": [1, 0, 0], "axis": [1, 0, 0])"), "joints[0].axis",
          R"("direction" or "axis", not both)");
  refused(JointText(R"("kind": "hinge", "direction": [1, 0, 0], "turn": [1, 0, 0])"), "joints[0].turn",
          "a quaternion [w, x, y, z], not zero");
  refused(JointText(R"("kind": "hinge", "direction": [1, 0, 0], "turn": [0, 0, 0, 0])"), "joints[0].turn",
          "a quaternion [w, x, y, z], not zero");
  refused(JointText(R"("kind": "hinge", "direction": [1, 0, 0], "anchors": [[0, 0, 0], [0, 0, 0]])"),
          "joints[0].anchors", R"("at" or "anchors", not both)");
  refused(JointText(R"("kind": "ball", "normal": [1, 0, 0])"), "joints[0].normal", "");
  refused(SpaceText(R"(, "contacts": [{"bodies": ["door", "frame"], "at": [0, 0, 0], "normal": [0, 0, 1],
                             "axis": [0, 0, 1]}])"),
          "contacts[0].axis", R"("normal" or "axis", not both)");
  refused(SpaceText("", "", R"(, "acceleration": [0, 0, 1])"), "bodies[1].acceleration", "fixed");
  refused(SpaceText("", R"(, "acceleration": [0, 1])"), "bodies[0].acceleration", "three numbers [x, y, z]");
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

TEST_CASE("scene file: what is wrong at all levels is told at once") {
  const std::string text =
      R"({"format": "stiction-scene", "version": 1, "name": "s", "dimension": 2, "colour": 1, "mu": -1, "bodies": [
          {"name": "floor", "fixed": true, "mass": 1, "size": 2},
          {"name": "block", "mass": 0, "rotation": [1, 1], "shapes": [{"disc": -1}, {"disc": 1, "weight": 3}]},
          {"mass": 1, "inertia": 1, "position": [0]}],
        "joints": [{"kind": "pin", "bodies": ["floor", "block"], "at": [0, 0], "glue": 1}],
        "contacts": [{"bodies": ["floor", "door"], "at": [0, 0], "normal": [0, 1], "friction": 1}],
        "pairs": [{"bodies": ["floor", "block"], "mu": "x", "colour": 2}]})";
  std::string message;
  try {
    ParseScene(text, "file");
  } catch (const InputError& error) {
    message = error.what();
  }
  // At most ten are shown, and how many more there are.
  for (const char* told :
       {"file: colour: found an unknown key", "; mu: found -1", "; bodies[0].size: found an unknown",
        "; bodies[0].mass: found 1, expected no mass", "; bodies[1].mass: found 0",
        "; bodies[1].shapes[0].disc: found -1", "; bodies[1].shapes[1].weight: found an unknown key",
        "; bodies[1].rotation: found [1,1]", "; bodies[2].name: found nothing",
        "; bodies[2].position: found [0]", "; and 5 more"}) {
    CAPTURE(message, told);
    CHECK(message.find(told) != std::string::npos);
  }
}

}  // namespace
}  // namespace stiction
