// SPDX-License-Identifier: Apache-2.0
// Stepping through time: closed forms, rest, energy, which of several solutions.

#include "solver/scene/simulate.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "corpus/scene_file.h"
#include "solver/residual.h"

namespace stiction {
namespace {

Scene<double> NamedScene(const std::string& name) {
  return Round(ReadScene(std::filesystem::path(STICTION_SCENES) / (name + ".json")).scene);
}

Simulation Run(const std::string& name, int steps, const SimulationOptions& options = {}) {
  Simulation simulation(NamedScene(name), options);
  for (int i = 0; i < steps; ++i) simulation.Step();
  return simulation;
}

double LargestMove(const Scene<double>& before, const Scene<double>& after) {
  double move = 0;
  for (std::size_t i = 0; i < before.bodies.size(); ++i) {
    const auto &p = before.bodies[i], &q = after.bodies[i];
    move = std::max({move, (q.position - p.position).norm(), (q.rotation - p.rotation).norm()});
  }
  return move;
}

TEST_CASE("simulate: a stack of five does not creep over 10,000 steps") {
  CHECK(LargestMove(NamedScene("stack"), Run("stack", 10000).scene()) < 1e-10);
}

TEST_CASE("simulate: on a slope a block rests above mu = tan, and slides below as it must") {
  CHECK(LargestMove(NamedScene("incline-rests"), Run("incline-rests", 1000).scene()) < 1e-10);
  const int steps = 120;
  const double h = 1.0 / 60, down = 10 * (0.6 - 0.8 * 0.74975);
  const Simulation slides = Run("incline-slides", steps);
  const double way = LargestMove(NamedScene("incline-slides"), slides.scene());
  CHECK(way == Approx(down * h * h * steps * (steps + 1) / 2).epsilon(1e-6));  // of this integrator
}

TEST_CASE("simulate: a ladder stands above its mu and slides below") {
  CHECK(LargestMove(NamedScene("ladder-stands"), Run("ladder-stands", 300).scene()) < 1e-9);
  CHECK(LargestMove(NamedScene("ladder-slides"), Run("ladder-slides", 300).scene()) > 1e-3);
}

TEST_CASE("simulate: joints hold, and a pendulum keeps its energy but for the step") {
  for (const char* name : {"double-pendulum", "pendulum-at-the-bottom"}) {
    INFO(name);
    SimulationOptions options;
    options.step = 1.0 / 480;
    const double energy = EnergyOf(NamedScene(name)).total();
    Simulation simulation(NamedScene(name), options);
    double worst = 0, joints = 0;
    for (int i = 0; i < 960; ++i) {
      simulation.Step();
      worst = std::max(worst, std::abs(EnergyOf(simulation.scene()).total() - energy));
      joints = std::max(joints, DriftOf(simulation.scene()).joints);
    }
    CHECK(worst < 1);  // of 40 J that change hands; first order in the step
    CHECK(joints < 1e-3);
  }
}

TEST_CASE("simulate: energy errors fall with the step") {
  const auto error = [](int steps_a_second) {
    SimulationOptions options;
    options.step = 1.0 / steps_a_second;
    const double before = EnergyOf(NamedScene("double-pendulum")).total();
    return std::abs(EnergyOf(Run("double-pendulum", steps_a_second, options).scene()).total() - before);
  };
  CHECK(error(1920) < 0.6 * error(240));
}

TEST_CASE("simulate: falling bodies lose energy, never overlap for long, and come to rest") {
  SimulationOptions options;
  options.step = 1.0 / 120;
  Simulation simulation(NamedScene("falling-boxes"), options);
  double energy = EnergyOf(simulation.scene()).total(), gained = 0, overlap = 0;
  for (int i = 0; i < 1200; ++i) {
    simulation.Step();
    const double now = EnergyOf(simulation.scene()).total();
    gained = std::max(gained, now - energy);
    energy = now;
    overlap = std::max(overlap, DriftOf(simulation.scene()).overlap);
  }
  CHECK(gained < 0.1);
  CHECK(overlap < 0.02);
  CHECK(simulation.statistics().collisions > 0);
  CHECK(simulation.scene().bodies[4].velocity.norm() < 1e-6);  // the slab lies
}

TEST_CASE("simulate: a collision is inelastic") {
  Scene<double> scene = NamedScene("incline-rests");
  scene.gravity = {0, 0};
  scene.bodies[1].velocity = {0.6, -0.8};  // into the slope
  Simulation simulation(scene);
  simulation.Step();
  CHECK(simulation.statistics().collisions == 1);
  CHECK(simulation.scene().bodies[1].velocity.norm() < 1e-12);
}

TEST_CASE("simulate: of three solutions the contact that can leave leaves") {
  Simulation simulation = Run("three-solutions", 1);
  REQUIRE(simulation.forces().size() == 1);
  CHECK(simulation.forces()[0].force.norm() == 0);
}

TEST_CASE(
    "simulate: where sliding leaves no solution, one inelastic step at the level of velocities is taken") {
  Simulation simulation = Run("rod-without-solution", 1);
  CHECK(simulation.statistics().impulsive == 1);
  const auto& rod = simulation.scene().bodies[1];
  const Vector2<double> foot = rod.VelocityAt(rod.At({-1, -2}));
  CHECK(foot[1] > -0.05);
}

TEST_CASE("simulate: a sliding block stops and stays") {
  Scene<double> scene = NamedScene("incline-rests");
  scene.mu = 1;
  scene.bodies[1].velocity = {-0.8, -0.6};  // down the slope at 1 m/s; friction 8, weight 6: stops after 1/2 s
  Simulation simulation(scene);
  for (int i = 0; i < 60; ++i) simulation.Step();
  const Scene<double> stopped = simulation.scene();
  CHECK((stopped.bodies[1].position - scene.bodies[1].position).norm() == Approx(0.25).epsilon(0.1));
  for (int i = 0; i < 600; ++i) simulation.Step();
  CHECK(LargestMove(stopped, simulation.scene()) < 1e-10);
}

TEST_CASE("simulate: minimal and full models move alike where accelerations are unique") {
  for (const char* name : {"two-towers", "incline-slides", "ladder-slides", "double-pendulum"}) {
    INFO(name);
    SimulationOptions full;
    full.minimal = false;
    CHECK(LargestMove(Run(name, 60).scene(), Run(name, 60, full).scene()) < 1e-6);
  }
}

TEST_CASE("simulate: a vice that closes on a block leaves no answer: the error names frame and problem") {
  Scene<double> scene;
  scene.gap = 1e-3;
  for (const double x : {-1.0, 0.0, 1.0}) {
    RigidBody<double> body;
    body.fixed = x != 0;
    body.position = {x, 0};
    body.velocity = {-x, 0};
    body.shapes.push_back({{{-0.45, -0.45}, {0.45, -0.45}, {0.45, 0.45}, {-0.45, 0.45}}, {0, 0}, 0});
    scene.bodies.push_back(body);
  }
  Simulation simulation(scene);
  try {
    for (int i = 0; i < 60; ++i) simulation.Step();
    FAIL("the vice closed");
  } catch (const SimulationError& error) {
    const std::string message = error.what();
    INFO(message);
    CHECK(simulation.statistics().frames == 5);  // closed by 1/10 m at 1 m/s
    CHECK(message.find("frame 5, ") != message.npos);
    CHECK(message.find("is undecided") != message.npos);
    CHECK(error.problem.rows() > 0);
  }
}

TEST_CASE("simulate: the block feeder feeds, and the jack lifts on both strokes") {
  SimulationOptions options;
  options.step = 1.0 / 120;
  const Simulation feeder = Run("block-feeder", 1200, options);
  int out = 0;
  for (const auto& body : feeder.scene().bodies)
    out += body.name.starts_with("block") && body.position[0] > 0.9;
  CHECK(out >= 2);
  options.step = 1.0 / 240;
  Simulation jack(NamedScene("double-action-jack"), options);
  std::vector<double> heights;  // of the load, after every half turn of the crank
  for (int i = 0; i < 2000; ++i) {
    if (i % 250 == 0) heights.push_back(jack.scene().bodies[7].position[1]);
    jack.Step();
    CHECK(DriftOf(jack.scene()).joints < 1e-3);
  }
  for (std::size_t i = 1; i < heights.size(); ++i) CHECK(heights[i] > heights[i - 1] + 0.1);
}

TEST_CASE("simulate: every problem is shown, and the same run twice is the same") {
  std::int64_t seen = 0;
  Simulation simulation(NamedScene("falling-boxes"), {}, [&seen](const FrameProblem& met) {
    CHECK(met.problem.rows() > 0);
    ++seen;
  });
  for (int i = 0; i < 100; ++i) simulation.Step();
  CHECK(seen == simulation.statistics().problems);
  CHECK(LargestMove(simulation.scene(), Run("falling-boxes", 100).scene()) == 0);
}

}  // namespace
}  // namespace stiction
