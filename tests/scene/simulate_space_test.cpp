// SPDX-License-Identifier: Apache-2.0
// Scenes in space, stepped through time.

#include "solver/scene/simulate_space.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "corpus/scene_file.h"

namespace stiction {
namespace {

using Vector = Vector3<double>;

SimulationInSpace Started(const std::string& name) {
  const auto path = std::filesystem::path(STICTION_SCENES) / "space" / (name + ".json");
  const auto file = std::get<SceneFileInSpace>(ReadAnyScene(path));
  SimulationOptions options;
  options.step = ToDouble(file.step);
  return SimulationInSpace(Round(file.scene), options);
}

TEST_CASE(
    "simulate in space: a box on a slope does not creep above mu = tan, and slides by the closed form below") {
  SimulationInSpace rests = Started("box-on-slope-rests");
  const Vector start = rests.scene().bodies[1].position;
  for (int i = 0; i < 1000; ++i) rests.Step();
  CHECK((rests.scene().bodies[1].position - start).norm() < 1e-9);
  SimulationInSpace slides = Started("box-on-slope-slides");
  for (int i = 0; i < 60; ++i) slides.Step();
  // v = a t once it slides; the first steps, slower than `rest`, count as at rest and end the same way.
  const double a = 10 * (0.6 - 2999.0 / 4000 * 0.8);
  CHECK(slides.scene().bodies[1].velocity.norm() == Approx(a).epsilon(1e-6));
}

TEST_CASE("simulate in space: a thrown ball ends up rolling with 5/7 of its speed") {
  SimulationInSpace simulation = Started("ball-slides-then-rolls");
  for (int i = 0; i < 60; ++i) simulation.Step();
  const auto& ball = simulation.scene().bodies[1];
  CHECK(ball.velocity[0] == Approx(1).epsilon(1e-9));
  CHECK(ball.spin[1] == Approx(2).epsilon(1e-9));  // v / r
  CHECK(ball.velocity[1] == Approx(0).margin(1e-12));
  CHECK(ball.position[2] == Approx(0.5).margin(1e-9));
}

TEST_CASE("simulate in space: a rolling ball that spins about the normal too rolls straight on") {
  SimulationInSpace started = Started("ball-slides-then-rolls");
  SceneInSpace<double> scene = started.scene();
  scene.bodies[1].velocity = {1, 0, 0};
  scene.bodies[1].spin = {0, 2, 5};
  SimulationInSpace simulation(scene);
  for (int i = 0; i < 60; ++i) simulation.Step();
  CHECK(simulation.scene().bodies[1].velocity[1] == Approx(0).margin(1e-9));
  CHECK(simulation.scene().bodies[1].position[1] == Approx(0).margin(1e-9));
}

TEST_CASE("simulate in space: a stack of five boxes does not creep over 1,000 steps") {
  SimulationInSpace simulation = Started("stack");
  const auto start = simulation.scene().bodies;
  for (int i = 0; i < 1000; ++i) simulation.Step();
  for (std::size_t i = 1; i < start.size(); ++i)
    CHECK((simulation.scene().bodies[i].position - start[i].position).norm() < 1e-6);
}

TEST_CASE("simulate in space: dominoes fall one after the other") {
  SimulationInSpace simulation = Started("dominoes");
  std::vector<double> fell(simulation.scene().bodies.size(), 0);
  while (simulation.time() < 3) {
    simulation.Step();
    for (std::size_t i = 1; i < fell.size(); ++i) {
      const double up = RotationMatrix<double>(simulation.scene().bodies[i].rotation)(2, 2);
      if (fell[i] == 0 && up < 0.9) fell[i] = simulation.time();
    }
  }
  for (std::size_t i = 1; i < fell.size(); ++i) CHECK(fell[i] > fell[i - 1]);
  CHECK(DriftOf(simulation.scene()).overlap < 0.01);
}

TEST_CASE("simulate in space: momentum and angular momentum are kept in a collision and in free flight") {
  SceneInSpace<Rational> exact =
      std::get<SceneFileInSpace>(
          ReadAnyScene(std::filesystem::path(STICTION_SCENES) / "space" / "dominoes.json"))
          .scene;
  exact.bodies.resize(3);
  SceneInSpace<double> scene = Round(exact);
  scene.gravity.setZero();
  scene.bodies.erase(scene.bodies.begin());
  scene.bodies[0].velocity = {2, 0.3, -0.1};
  scene.bodies[0].spin = {0.4, 1, -0.7};
  const auto momenta = [](const SceneInSpace<double>& at) {
    Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
    for (const auto& body : at.bodies) {
      const Vector p = body.mass * body.velocity, L = body.WorldInertia() * body.spin;
      sum.head<3>() += p;
      sum.tail<3>() += CrossProduct<double>(body.position, p) + L;
    }
    return sum;
  };
  SimulationInSpace simulation(scene);
  const auto before = momenta(simulation.scene());
  const double energy = EnergyOf(simulation.scene()).kinetic;
  for (int i = 0; i < 120; ++i) simulation.Step();
  CHECK(simulation.statistics().collisions > 0);
  CHECK((momenta(simulation.scene()) - before).norm() < 1e-3 * before.norm());
  CHECK((momenta(simulation.scene()) - before).head<3>().norm() < 1e-12);
  CHECK(EnergyOf(simulation.scene()).kinetic < energy);
  SceneInSpace<double> alone = scene;
  alone.bodies.resize(1);
  SimulationInSpace flight(alone);
  const auto start = momenta(alone);
  for (int i = 0; i < 1000; ++i) flight.Step();
  CHECK((momenta(flight.scene()) - start).norm() < 1e-10);
}

TEST_CASE("simulate in space: a conical pendulum keeps its height, a joint its bodies together") {
  SimulationInSpace simulation = Started("conical-pendulum");
  for (int i = 0; i < 960; ++i) simulation.Step();
  CHECK(simulation.scene().bodies[1].position[2] == Approx(-2.5).margin(0.05));
  CHECK(DriftOf(simulation.scene()).joints < 1e-3);
}

TEST_CASE("simulate in space: the same scene gives the same states, bit by bit") {
  SimulationInSpace first = Started("dominoes"), second = Started("dominoes");
  for (int i = 0; i < 200; ++i) first.Step(), second.Step();
  for (std::size_t i = 0; i < first.scene().bodies.size(); ++i) {
    CHECK(first.scene().bodies[i].position == second.scene().bodies[i].position);
    CHECK(first.scene().bodies[i].rotation == second.scene().bodies[i].rotation);
  }
}

}  // namespace
}  // namespace stiction
