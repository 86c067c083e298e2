// SPDX-License-Identifier: Apache-2.0
// Scenes in space, stepped through time.

#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "corpus/record/scene_file.h"
#include "scene/simulate.h"
#include "tests/support.h"

namespace stiction {
namespace {

using Vector = Vector3<double>;

SceneFileInSpace NamedFile(const std::string& name) {
  const auto path = std::filesystem::path(STICTION_SCENES) / "space" / (name + ".json");
  return std::get<SceneFileInSpace>(ReadAnyScene(path));
}

SimulationInSpace Started(const std::string& name) {
  const SceneFileInSpace file = NamedFile(name);
  return SimulationInSpace(Round(file.scene), ToDouble(file.step));
}

// The deepest overlap at the end of a frame, until t = seconds.
double WorstOverlap(SimulationInSpace& simulation, double seconds) {
  double overlap = 0;
  while (simulation.time() < seconds) {
    simulation.Step();
    overlap = std::max(overlap, DriftOf(simulation.scene()).overlap);
  }
  return overlap;
}

TEST_CASE(
    "simulate in space: a box on a slope does not creep above mu = tan, and slides by the closed form below") {
  SimulationInSpace rests = Started("box-on-slope-rests");
  const Vector start = rests.scene().bodies[1].position;
  for (int i = 0; i < 1000; ++i) rests.Step();
  CHECK((rests.scene().bodies[1].position - start).norm() < 1e-9);
  SimulationInSpace slides = Started("box-on-slope-slides");
  for (int i = 0; i < 60; ++i) slides.Step();
  // v = a (t - h/2) once it slides; the first steps, slower than `rest`, count as at rest and end the same way.
  const double a = 10 * (0.6 - 2999.0 / 4000 * 0.8);
  CHECK(slides.scene().bodies[1].velocity.norm() == Approx(a * (1 - 1.0 / 120)).epsilon(1e-6));
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
  std::vector<double> fell(testing::Short() ? 5 : simulation.scene().bodies.size(), 0);  // of the first of them
  while (simulation.time() < 3 && fell.back() == 0) {
    simulation.Step();
    for (std::size_t i = 1; i < fell.size(); ++i) {
      const double up = RotationMatrix<double>(simulation.scene().bodies[i].rotation)(2, 2);
      if (fell[i] == 0 && up < 0.9) fell[i] = simulation.time();
    }
  }
  for (std::size_t i = 1; i < fell.size(); ++i) CHECK(fell[i] > fell[i - 1]);
}

TEST_CASE("simulate in space: no scene overlaps by more than its gap, or has problems that are solved loosely",
          "[slow]") {
  const double part = testing::Short() ? 4 : 1;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(STICTION_SCENES) / "space")) {
    if (entry.path().extension() != ".json") continue;
    const std::string name = entry.path().stem();
    INFO(name);
    SimulationInSpace simulation = Started(name);
    CHECK(WorstOverlap(simulation, ToDouble(NamedFile(name).seconds) / part) <= 1e-3);
    CHECK(simulation.statistics().loose == 0);
    CHECK(simulation.statistics().deep == 0);
  }
  // More contacts at rest than bodies can tell apart, b a little out of range(A).
  SimulationInSpace dominoes(Round(NamedFile("dominoes").scene));
  WorstOverlap(dominoes, 3 / part);
  CHECK(dominoes.statistics().loose == 0);
}

TEST_CASE("simulate in space: a step that ends deep is taken back, and done in halves that do not") {
  const SceneInSpace<double> scene = Round(NamedFile("falling-bodies").scene);
  SimulationInSpace whole(scene), once(scene), halved(scene);
  whole.halvings = 0;
  once.halvings = 1;
  CHECK(WorstOverlap(whole, 2) > 0.01);
  CHECK(whole.statistics().halved == 0);
  CHECK(whole.statistics().deep > 3);
  CHECK(WorstOverlap(halved, 2) <= 1e-3);
  CHECK(halved.statistics().halved > 5);
  CHECK(halved.statistics().deep == 0);
  CHECK(halved.statistics().frames == whole.statistics().frames);
  CHECK(halved.time() == whole.time());
  double before = 0;
  for (std::int64_t deep = 0; once.time() < 2; deep = once.statistics().deep) {
    once.Step();
    const double overlap = DriftOf(once.scene()).overlap;
    CHECK((once.statistics().deep > deep || overlap <= std::max(1e-3, before)));
    before = overlap;
  }
  CHECK(once.statistics().deep > 0);
}

// Two rods, one turning end over end, meet at 20 m/s, far from anything else.
SceneInSpace<double> FastImpact() {
  SceneInSpace<double> scene = Round(NamedFile("falling-bodies").scene);
  scene.gravity.setZero();
  scene.bodies.assign(2, scene.bodies[5]);
  auto &rod = scene.bodies[0], &other = scene.bodies[1];
  rod.position = {0, 0, 0};
  rod.spin = {3, 20, 5};
  other.position = {2, 0.1, 0.3};
  other.velocity = {-20, 0, -1};
  other.spin = {0, 0, 10};
  return scene;
}

TEST_CASE("simulate in space: halves keep momenta, and a fast impact from overlap") {
  const auto momentum = [](const SceneInSpace<double>& at) {
    return Vector(at.bodies[0].mass * at.bodies[0].velocity + at.bodies[1].mass * at.bodies[1].velocity);
  };
  const SceneInSpace<double> scene = FastImpact();
  SimulationInSpace whole(scene), halved(scene);
  whole.halvings = 0;
  CHECK(WorstOverlap(whole, 0.5) > 0.01);
  CHECK(WorstOverlap(halved, 0.5) <= 1e-3);
  CHECK(halved.statistics().halved > 0);
  CHECK(halved.statistics().collisions > 0);
  CHECK((momentum(halved.scene()) - momentum(scene)).norm() < 1e-12);
  CHECK(EnergyOf(halved.scene()).kinetic < EnergyOf(scene).kinetic);
}

TEST_CASE("simulate in space: halves have the same answers on any number of threads") {
  const SceneInSpace<double> one = Round(NamedFile("falling-bodies").scene);
  SceneInSpace<double> scene = one;
  for (const double x : {30.0, 60.0}) {
    for (BodyInSpace<double> body : one.bodies) {
      body.position[0] += x;
      if (!body.fixed) body.velocity[0] += x / 100;
      scene.bodies.push_back(body);
    }
  }
  const auto run = [&scene](int threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    SimulationInSpace simulation(scene);
    WorstOverlap(simulation, 1);
    return simulation;
  };
  const SimulationInSpace first = run(1), second = run(4);
  CHECK(first.statistics() == second.statistics());
  CHECK(first.statistics().halved > 0);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    CHECK(first.scene().bodies[i].position == second.scene().bodies[i].position);
}

TEST_CASE("simulate in space: falling bodies lose energy, overlap by no more than the gap, and come to rest") {
  SimulationInSpace simulation = Started("falling-bodies");
  const double start = EnergyOf(simulation.scene()).total();
  while (simulation.time() < 4) {
    simulation.Step();
    CHECK(DriftOf(simulation.scene()).overlap <= 1e-3);
    CHECK(EnergyOf(simulation.scene()).total() < 1.001 * start);
  }
  CHECK(EnergyOf(simulation.scene()).kinetic < 0.01 * start);
  CHECK(simulation.statistics().collisions > 0);
}

// Momentum, and angular momentum about the origin.
Eigen::Matrix<double, 6, 1> MomentaOf(const SceneInSpace<double>& at) {
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (const auto& body : at.bodies) {
    const Vector p = body.mass * body.velocity, L = WorldInertia(body) * body.spin;
    sum.head<3>() += p;
    sum.tail<3>() += CrossProduct<double>(body.position, p) + L;
  }
  return sum;
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
  SimulationInSpace simulation(scene);
  const auto before = MomentaOf(simulation.scene());
  const double energy = EnergyOf(simulation.scene()).kinetic;
  for (int i = 0; i < 120; ++i) simulation.Step();
  CHECK(simulation.statistics().collisions > 0);
  CHECK((MomentaOf(simulation.scene()) - before).norm() < 1e-3 * before.norm());
  CHECK((MomentaOf(simulation.scene()) - before).head<3>().norm() < 1e-12);
  CHECK(EnergyOf(simulation.scene()).kinetic < energy);
  SceneInSpace<double> alone = scene;
  alone.bodies.resize(1);
  SimulationInSpace flight(alone);
  const auto start = MomentaOf(alone);
  for (int i = 0; i < 1000; ++i) flight.Step();
  CHECK((MomentaOf(flight.scene()) - start).norm() < 1e-10);
}

TEST_CASE("simulate in space: a conical pendulum keeps its height, a joint its bodies together") {
  SimulationInSpace simulation = Started("conical-pendulum");
  for (int i = 0; i < 960; ++i) simulation.Step();
  CHECK(simulation.scene().bodies[1].position[2] == Approx(-2.5).margin(0.05));
  CHECK(DriftOf(simulation.scene()).joints < 1e-3);
}

TEST_CASE("simulate in space: a wall pushed at the top moves without A as with it, and stands", "[slow]") {
  const auto wall = std::get<SceneFileInSpace>(
      ReadAnyScene(std::filesystem::path(STICTION_SCENES) / "large" / "brick-wall-in-space.json"));
  SceneInSpace<double> scene = Round(wall.scene);
  SimulationInSpace stands(scene);
  for (int i = 0; i < 3; ++i) stands.Step();
  CHECK(stands.statistics().sparse == stands.statistics().problems);
  for (const auto& body : stands.scene().bodies) CHECK(body.velocity.norm() < 1e-6);

  if (testing::Short()) return;           // a thousand rows, dense
  scene.bodies.back().force = {6, 1, 0};  // mu m g = 5 N
  const auto model = Assemble(scene, FindContacts(scene), Level::kForces, /*minimal=*/true, 1.0 / 60);
  REQUIRE(model.islands.size() == 1);
  SceneSolver solver;
  const SceneAnswer dense = solver.Solve(model.Problem(0)), sparse = solver.Solve(model.InFactors(0));
  REQUIRE(dense.Solved());
  REQUIRE(sparse.Solved());
  CHECK(std::pair(dense.counters[Counter::kSparse], sparse.counters[Counter::kSparse]) ==
        std::pair<std::int64_t, std::int64_t>(0, 1));
  const auto p = BodyAccelerations(model, {dense.f}), q = BodyAccelerations(model, {sparse.f});
  for (std::size_t i = 0; i < p.size(); ++i) CHECK((p[i] - q[i]).norm() < 1e-4);
  CHECK(p.back().norm() > 1);
}

TEST_CASE("simulate in space: from the forces of the step before as from f = 0") {
  for (const char* name :
       {"stack", "box-on-slope-slides", "crate-on-a-truck", "trapdoor-opens", "slider-crank"}) {
    INFO(name);
    SimulationInSpace one(Round(NamedFile(name).scene)), other(Round(NamedFile(name).scene));
    other.warm = false;
    for (int i = 0; i < 60; ++i) {
      one.Step();
      other.Step();
    }
    CHECK(one.statistics().warm > 0);
    CHECK(other.statistics().warm == 0);
    CHECK(one.statistics().loose == other.statistics().loose);
    for (std::size_t i = 0; i < one.scene().bodies.size(); ++i)
      CHECK((one.scene().bodies[i].position - other.scene().bodies[i].position).norm() < 1e-6);
  }
}

TEST_CASE("simulate in space: what slides goes on from the forces of the step before") {
  for (const char* name : {"sledge-pushes-box", "trapdoor-opens"}) {
    INFO(name);
    SimulationInSpace simulation(Round(NamedFile(name).scene));
    for (int i = 0; i < 60; ++i) simulation.Step();
    CHECK(simulation.statistics().warm > 55);
  }
}

// ---- Joints ----------------------------------------------------------------------------------

struct Worst {
  double drift = 0, energy = 0;  // m or sine; J away from the start
};

Worst Run(SimulationInSpace& simulation, int steps) {
  Worst worst;
  const double start = EnergyOf(simulation.scene()).total();
  for (int i = 0; i < steps; ++i) {
    simulation.Step();
    worst.drift = std::max(worst.drift, DriftOf(simulation.scene()).joints);
    worst.energy = std::max(worst.energy, std::abs(EnergyOf(simulation.scene()).total() - start));
  }
  return worst;
}

TEST_CASE(
    "simulate in space: along straight rails and sliders nothing drifts, and speeds are those of closed "
    "forms") {
  SimulationInSpace car = Started("cable-car"), sledge = Started("sledge-pushes-box");
  CHECK(Run(car, 240).drift < 1e-12);  // 1 s
  const double half = 1.0 / 480;       // velocities are those of the middle of the last step
  CHECK((car.scene().bodies[1].velocity - 6 * (1 - half) * Vector(-0.8, 0, -0.6)).norm() < 1e-9);
  CHECK(car.scene().bodies[1].spin.norm() < 1e-9);
  CHECK(Run(sledge, 120).drift < 1e-12);
  for (const int body : {1, 2})
    CHECK((sledge.scene().bodies[body].velocity - (1 - 2 * half) * Vector(-0.8, 0, -0.6)).norm() < 1e-6);
}

// Steps of h and of h / 2 through the same time: drift, which a step makes and the next one mends, is of third
// order in h, down to what is not corrected; energy of first.
void CheckFinerIsBetter(const Worst& coarse, const Worst& fine) {
  CHECK(fine.drift < std::max(0.15 * coarse.drift, 2 * kDrift));
  CHECK(fine.energy < 0.6 * coarse.energy);
}

Worst RunFor(const SceneInSpace<double>& scene, double seconds, int steps_a_second) {
  SimulationInSpace simulation(scene, 1.0 / steps_a_second);
  return Run(simulation, static_cast<int>(seconds * steps_a_second));
}

TEST_CASE("simulate in space: a gate keeps to its hinge, and its energy but for the step") {
  const auto gate = Started("leaning-gate").scene();
  const Worst coarse = RunFor(gate, 4, 240), fine = RunFor(gate, 4, 480);
  CHECK(coarse.drift < 1e-6);
  CHECK(coarse.energy < 0.1);  // of 18 J that change hands
  CheckFinerIsBetter(coarse, fine);
}

TEST_CASE("simulate in space: the piston of a slider-crank is where its crank says", "[slow]") {
  SimulationInSpace simulation = Started("slider-crank");
  double least = 2, greatest = 0;
  for (int i = 0; i < 1920; ++i) {
    simulation.Step();
    const auto& bodies = simulation.scene().bodies;
    const Vector pin = bodies[1].At({0.5, 0, 0}), piston = bodies[3].position;
    CHECK(piston[0] == Approx(pin[0] + std::sqrt(1.44 - 0.16 - pin[2] * pin[2])).margin(1e-3));
    CHECK((piston - Vector(piston[0], 0.4, 0)).norm() < 1e-12);
    least = std::min(least, piston[0]), greatest = std::max(greatest, piston[0]);
  }
  CHECK(least == Approx(std::sqrt(1.28) - 1).margin(1e-3));  // the dead centres, met and passed
  CHECK(greatest == Approx(std::sqrt(1.28) + 1).margin(1e-3));
  if (testing::Short()) return;
  const Worst coarse = RunFor(Started("slider-crank").scene(), 4, 480);
  CHECK(coarse.drift < 1e-6);
  CheckFinerIsBetter(coarse, RunFor(Started("slider-crank").scene(), 4, 960));
}

// Two bodies and a joint between them, both turning; a hinge turns and a slider slides besides.
SceneInSpace<double> JoinedInFlight(JointKindInSpace kind) {
  SceneInSpace<double> scene;
  scene.bodies.resize(2);
  auto &a = scene.bodies[0], &b = scene.bodies[1];
  a.mass = 2, b.mass = 3;
  a.inertia = Vector(0.5, 0.6, 0.9).asDiagonal();
  b.inertia = Vector(1.1, 0.8, 0.7).asDiagonal();
  b.position = {0.6, 0.5, 0.4};
  b.spin = a.spin = {0.7, -0.5, 0.9};
  const Vector direction = Vector(2, -1, 2) / 3, p(0.3, 0.4, 0.1);
  const bool slides = kind == JointKindInSpace::kRail || kind == JointKindInSpace::kSlider;
  if (kind == JointKindInSpace::kHinge) a.spin += 1.5 * direction;
  if (kind == JointKindInSpace::kBall || kind == JointKindInSpace::kRail) a.spin += Vector(0.3, 1, -0.4);
  a.velocity = b.VelocityAt(p) - CrossProduct<double>(a.spin, p);
  if (slides) a.velocity += 0.5 * direction;
  scene.joints.push_back({kind, 0, 1, p, b.Local(p), direction});
  return scene;
}

TEST_CASE("simulate in space: joined bodies in flight keep their momenta, and their energy but for the step") {
  for (const auto kind : {JointKindInSpace::kBall, JointKindInSpace::kHinge, JointKindInSpace::kRail,
                          JointKindInSpace::kSlider}) {
    INFO("kind " << static_cast<int>(kind));
    const auto scene = JoinedInFlight(kind);
    std::array<Worst, 2> worst;
    std::array<double, 2> turned;  // change of the angular momentum
    for (int i = 0; i < 2; ++i) {
      SimulationInSpace simulation(scene, 1.0 / (480 << i));
      worst[i] = Run(simulation, 960 << i);
      const Eigen::Matrix<double, 6, 1> change = MomentaOf(simulation.scene()) - MomentaOf(scene);
      CHECK(change.head<3>().norm() < 1e-12);
      turned[i] = change.tail<3>().norm();
    }
    CHECK(worst[0].drift < 1e-5);
    CHECK(worst[0].energy < 0.01 * EnergyOf(scene).total());
    CHECK(turned[0] < 0.01);
    CHECK(turned[1] < 0.6 * turned[0]);
    CheckFinerIsBetter(worst[0], worst[1]);
  }
}

TEST_CASE("simulate in space: on two hinges of one axis bodies move as on one", "[slow]") {
  for (SceneInSpace<double> scene :
       {Started("leaning-gate").scene(), JoinedInFlight(JointKindInSpace::kHinge)}) {
    SimulationInSpace one(scene, 1.0 / 240);
    scene.joints.push_back(scene.joints[0]);
    auto& second = scene.joints[1];
    second.at_b += 0.4 * second.direction;
    second.at_a += 0.4 * (RotationMatrix<double>(second.relative_rotation).transpose() * second.direction);
    SimulationInSpace two(scene, 1.0 / 240);
    for (int i = 0; i < 480; ++i) one.Step(), two.Step();
    for (const int body : {0, 1}) {
      const auto &x = one.scene().bodies[body], &y = two.scene().bodies[body];
      CHECK((x.position - y.position).norm() < 1e-4);
      CHECK((x.rotation - y.rotation).norm() < 1e-4);
    }
  }
}

TEST_CASE("simulate in space: a trapdoor rests on a box above mu = 3/8, and falls to the floor below") {
  SimulationInSpace rests = Started("trapdoor-rests"), opens = Started("trapdoor-opens");
  const auto start = rests.scene().bodies;
  Run(rests, 480);
  for (const int body : {2, 3})
    CHECK((rests.scene().bodies[body].position - start[body].position).norm() < 1e-6);
  const Worst worst = Run(opens, 480);
  CHECK(worst.drift < 1e-3);
  CHECK(opens.scene().bodies[2].position[2] == Approx(1.0 / 6).margin(1e-3));
  CHECK(opens.scene().bodies[3].position[0] > 4);
}

TEST_CASE("simulate in space: a fixed body moves with its acceleration") {
  SimulationInSpace simulation = Started("crate-on-a-truck");
  for (int i = 0; i < 120; ++i) simulation.Step();
  const auto& bodies = simulation.scene().bodies;
  CHECK(bodies[0].velocity[0] == Approx(3 - 6.0 / 480).epsilon(1e-12));
  CHECK(bodies[0].position[0] == Approx(0.75).epsilon(1e-9));
  CHECK(bodies[2].velocity[0] == Approx(2.5 - 5.0 / 480).epsilon(1e-6));
  CHECK(bodies[2].position[2] == Approx(0.5).margin(1e-6));
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
