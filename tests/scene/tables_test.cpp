// SPDX-License-Identifier: Apache-2.0
// What comes out of a simulation: words for how bodies moved, and the rows of its tables.

#include "scene/tables.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>

#include "corpus/record/scene_file.h"

namespace stiction {
namespace {

template <class Kind = Plane>
SceneIn<Kind, double> SceneToRun(const std::string& name) {
  const auto path = std::filesystem::path(STICTION_SCENES) / (name + ".json");
  return Round(std::get<SceneFileIn<Kind>>(ReadAnyScene(path)).scene);
}

// How the bodies of a run of so many steps moved.
template <class Kind>
std::vector<BodyMotion> MotionsOf(const SceneIn<Kind, double>& scene, int steps) {
  SimulationIn<Kind> simulation(scene);
  MotionTrack<Kind> track;
  track.Add(0, scene, {});
  for (int k = 0; k < steps; ++k) {
    simulation.Step();
    track.Add(simulation.time(), simulation.scene(), SupportsOf(simulation));
  }
  return track.Motions();
}

// A block on a slope of 3/4.
Scene<double> BlockOnSlope(double mu) {
  Scene<double> scene = SceneToRun("incline-rests");
  scene.mu = mu;
  return scene;
}

TEST_CASE("creep: a block one percent inside its cone rests, and one percent outside slides") {
  for (const int steps : {12, 120, 1200}) {
    INFO(steps);
    const auto inside = MotionsOf(BlockOnSlope(0.75 * 1.01), steps).at(0);
    CHECK(inside.word == "rests");
    CHECK(inside.moved < 1e-10);
    if (steps > 120) continue;  // it would slide off
    const auto outside = MotionsOf(BlockOnSlope(0.75 / 1.01), steps).at(0);
    CHECK(outside.word == "slides");
    const double down = 10 * (0.6 - 0.8 * 0.75 / 1.01), end = steps / 60.0;
    CHECK(outside.moved == Approx(down * (end * end - end * end / 4) / 2).epsilon(0.05));
  }
}

TEST_CASE("creep: in space a box rests or slides likewise, and without friction slides") {
  CHECK(MotionsOf(SceneToRun<Space>("space/box-on-slope-rests"), 60).at(0).word == "rests");
  CHECK(MotionsOf(SceneToRun<Space>("space/box-on-slope-slides"), 60).at(0).word == "slides");
  CHECK(MotionsOf(BlockOnSlope(0), 60).at(0).word == "slides");
}

TEST_CASE("creep: what nothing bears on flies, and what swings from a joint moves") {
  Scene<double> scene = BlockOnSlope(1);
  scene.bodies[1].position = {0, 100};
  const auto falls = MotionsOf(scene, 60).at(0);
  CHECK(falls.word == "flies");
  CHECK(falls.moved == Approx(10 * 0.75 / 2).epsilon(0.02));
  CHECK(MotionsOf(SceneToRun("double-pendulum"), 60).at(0).word == "moves");
}

// A block that is moved along by so much in the time t, and touched all the while.
BodyMotion MotionAlong(const std::function<double(double)>& way, int steps, double step = 1.0 / 60,
                       const std::function<bool(double)>& slides = {}) {
  Scene<double> scene = BlockOnSlope(1);
  const Vector2<double> at = scene.bodies[1].position;
  MotionTrack<Plane> track;
  for (int k = 0; k <= steps; ++k) {
    const double t = k * step;
    scene.bodies[1].position = at + way(t) * Vector2<double>(-0.8, -0.6);
    track.Add(t, scene, {{true, false}, {true, slides && slides(t)}});
  }
  return track.Motions().at(0);
}

TEST_CASE("creep: a trajectory as engines leave it creeps, however long it is, at its speed") {
  for (const int steps : {10, 127, 128, 129, 1000, 100'000}) {
    INFO(steps);
    const double end = steps / 60.0;
    const BodyMotion motion = MotionAlong([](double t) { return 1e-4 * t; }, steps);
    CHECK(motion.word == "creeps");
    CHECK(motion.speed == Approx(1e-4));
    CHECK(motion.seconds == Approx(end / 2).margin(end / 64 + 1.0 / 60));
    CHECK(motion.moved == Approx(1e-4 * motion.seconds));
  }
  CHECK(MotionAlong([](double t) { return 0.9e-6 * t; }, 600).word == "rests");
  CHECK(MotionAlong([](double t) { return 1.1e-6 * t; }, 600).word == "creeps");
  CHECK(MotionAlong([](double t) { return 1.1e-3 * t; }, 600).word == "moves");
}

TEST_CASE("creep: the word is that of the last part, and what moved before it shows in the way") {
  const auto lands = [](double t) { return t < 6 ? 0.1 * t : 0.6; };
  const BodyMotion motion = MotionAlong(lands, 600);
  CHECK(motion.word == "rests");
  CHECK(motion.moved == Approx(0.1).epsilon(0.1));
  const auto slides = [](double t) { return t > 9.801 && t < 9.8025; };  // between states that are kept
  CHECK(MotionAlong([](double t) { return 0.1 * t; }, 60'000, 1.0 / 6000, slides).word == "slides");
  const auto slid = [](double t) { return t < 7; };
  CHECK(MotionAlong([](double t) { return 0.1 * t; }, 60'000, 1.0 / 6000, slid).word == "moves");
}

TEST_CASE("creep: of a disc that turns half round, the rim has moved by its diameter") {
  Scene<double> scene = BlockOnSlope(1);
  scene.bodies[1].shapes.resize(1);
  scene.bodies[1].shapes[0] = {};
  scene.bodies[1].shapes[0].radius = 0.5;
  MotionTrack<Plane> track;
  track.Add(0, scene, {});
  track.Add(1, scene, {});
  scene.bodies[1].rotation = -scene.bodies[1].rotation;
  track.Add(2, scene, {});
  CHECK(track.Motions().at(0).moved == Approx(1));
  MotionTrack<Plane> none;
  none.Add(0, scene, {});
  CHECK(none.Motions().empty());
}

// The number of a row's column, by its name.
template <class Row>
double NumberOf(const OutputTable<Row>& table, const std::string& column, const Row& row) {
  for (const auto& found : table.columns) {
    if (found.name == column) return std::get<double>(found.Of(row));
  }
  FAIL("no column " << column);
  return 0;
}

template <class Kind>
void CheckBalance(const std::string& name, int up) {
  INFO(name);
  SimulationIn<Kind> simulation(SceneToRun<Kind>(name));
  for (int k = 0; k < 30; ++k) simulation.Step();
  const auto& scene = simulation.scene();
  const std::string axes = "xyz";
  std::map<int, std::array<double, 3>> sums;
  int borne = 0;
  ForEachContactRow(simulation, simulation.time(), [&](const ContactRow<Kind>& row) {
    double along = 0, squares = 0;
    for (int axis = 0; axis < Kind::kDimension; ++axis) {
      const double f = NumberOf(ContactTable<Kind>(), std::string("f") + axes[axis] + "_N", row);
      sums[row.contact.a][axis] += f;
      sums[row.contact.b][axis] -= f;
      along += f * NumberOf(ContactTable<Kind>(), std::string("n") + axes[axis], row);
      squares += f * f;
    }
    const double normal = NumberOf(ContactTable<Kind>(), "normal_N", row);
    const double tangential = NumberOf(ContactTable<Kind>(), "tangential_N", row);
    CHECK(normal == Approx(along).margin(1e-9));
    CHECK(std::hypot(normal, tangential) == Approx(std::sqrt(squares)).margin(1e-9));
    CHECK(DoesOf<Kind>(row.force) == (squares == 0 ? "free" : "sticks"));
    borne += squares > 0;
  });
  CHECK(borne > 0);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].fixed) continue;
    for (int axis = 0; axis < Kind::kDimension; ++axis) {
      const double weight = axis == up ? scene.bodies[i].mass * scene.gravity.norm() : 0;
      CHECK(sums[static_cast<int>(i)][axis] == Approx(weight).margin(1e-5 * scene.bodies[i].mass * 10));
    }
  }
}

TEST_CASE("tables: forces of contacts balance the weight of every body that rests, and all of them stick") {
  CheckBalance<Plane>("stack", 1);
  CheckBalance<Space>("space/stack", 2);
}

TEST_CASE("tables: a contact that slides is said to, with and without friction") {
  for (const double mu : {0.0, 0.7}) {
    Simulation simulation(BlockOnSlope(mu));
    for (int k = 0; k < 10; ++k) simulation.Step();
    int sliding = 0;
    for (const auto& force : simulation.forces()) sliding += DoesOf<Plane>(&force) == "slides";
    CHECK(sliding == static_cast<int>(simulation.forces().size()));
    CHECK(sliding > 0);
  }
}

}  // namespace
}  // namespace stiction
