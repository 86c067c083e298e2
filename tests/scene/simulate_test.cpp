// SPDX-License-Identifier: Apache-2.0
// Stepping through time: closed forms, rest, energy, which of several solutions.

#include "scene/simulate.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <functional>
#include <random>

#include "corpus/record/scene_file.h"
#include "solver/problem/errors.h"
#include "tests/factored.h"
#include "tests/support.h"

namespace stiction {
namespace {

Scene<double> SceneInDoubles(const std::string& name) {
  return Round(ReadScene(std::filesystem::path(STICTION_SCENES) / (name + ".json")).scene);
}

Simulation Run(const std::string& name, int steps, double step = 1.0 / 60,
               const std::function<void(Simulation&)>& prepare = {}) {
  Simulation simulation(SceneInDoubles(name), step);
  if (prepare) prepare(simulation);
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

TEST_CASE("simulate: a stack of five does not creep over 10,000 steps", "[slow]") {
  CHECK(LargestMove(SceneInDoubles("stack"), Run("stack", 10000).scene()) < 1e-10);
}

TEST_CASE("simulate: on a slope a block rests above mu = tan, and slides below as it must") {
  CHECK(LargestMove(SceneInDoubles("incline-rests"), Run("incline-rests", 1000).scene()) < 1e-10);
  const int steps = 120;
  const double h = 1.0 / 60, down = 10 * (0.6 - 0.8 * 0.74975);
  const Simulation slides = Run("incline-slides", steps);
  const double way = LargestMove(SceneInDoubles("incline-slides"), slides.scene());
  CHECK(way == Approx(down * steps * h * steps * h / 2).epsilon(1e-9));
}

TEST_CASE("simulate: a ladder stands above its mu and slides below") {
  CHECK(LargestMove(SceneInDoubles("ladder-stands"), Run("ladder-stands", 300).scene()) < 1e-9);
  CHECK(LargestMove(SceneInDoubles("ladder-slides"), Run("ladder-slides", 300).scene()) > 1e-3);
}

TEST_CASE("simulate: joints hold, and a pendulum keeps its energy but for the step") {
  for (const char* name : {"double-pendulum", "pendulum-at-the-bottom"}) {
    INFO(name);
    const double energy = EnergyOf(SceneInDoubles(name)).total();
    Simulation simulation(SceneInDoubles(name), 1.0 / 480);
    double worst = 0, joints = 0;
    for (int i = 0; i < 960; ++i) {
      simulation.Step();
      worst = std::max(worst, std::abs(EnergyOf(simulation.scene()).total() - energy));
      joints = std::max(joints, DriftOf(simulation.scene()).joints);
    }
    CHECK(worst < 0.2);  // of 40 J that change hands; first order in the step, and it does not grow
    CHECK(joints < 3e-6);
  }
}

TEST_CASE("simulate: energy errors fall with the step") {
  const auto error = [](int steps_a_second) {
    const double before = EnergyOf(SceneInDoubles("double-pendulum")).total();
    return std::abs(EnergyOf(Run("double-pendulum", steps_a_second, 1.0 / steps_a_second).scene()).total() -
                    before);
  };
  CHECK(error(1920) < 0.6 * error(240));
}

TEST_CASE("simulate: falling bodies lose energy, overlap by no more than the gap, and come to rest") {
  Simulation simulation(SceneInDoubles("falling-boxes"), 1.0 / 120);
  double energy = EnergyOf(simulation.scene()).total(), gained = 0, overlap = 0;
  for (int i = 0; i < 1200; ++i) {
    simulation.Step();
    const double now = EnergyOf(simulation.scene()).total();
    gained = std::max(gained, now - energy);
    energy = now;
    overlap = std::max(overlap, DriftOf(simulation.scene()).overlap);
  }
  CHECK(gained < 0.1);
  CHECK(overlap <= 1e-3);
  CHECK(simulation.statistics().collisions > 0);
  CHECK(simulation.scene().bodies[4].velocity.norm() < 1e-6);  // the slab lies
}

TEST_CASE("simulate: a step that ends deep is taken back, and done in halves that do not") {
  for (const int halvings : {0, 10}) {
    Simulation simulation(SceneInDoubles("falling-boxes"), 1.0 / 15);
    simulation.halvings = halvings;
    double overlap = 0;
    for (int i = 0; i < 30; ++i) {
      simulation.Step();
      overlap = std::max(overlap, DriftOf(simulation.scene()).overlap);
    }
    CHECK((halvings > 0 ? overlap <= 1e-3 : overlap > 1e-3));
    CHECK((simulation.statistics().halved > 0) == (halvings > 0));
    CHECK((simulation.statistics().deep > 0) == (halvings == 0));
    CHECK(simulation.time() == Approx(2));
  }
}

TEST_CASE("simulate: a collision is inelastic") {
  Scene<double> scene = SceneInDoubles("incline-rests");
  scene.gravity = {0, 0};
  scene.bodies[1].velocity = {0.6, -0.8};  // into the slope
  Simulation simulation(scene);
  simulation.Step();
  CHECK(simulation.statistics().collisions == 1);
  CHECK(simulation.scene().bodies[1].velocity.norm() < 1e-12);
}

TEST_CASE("simulate: where nothing collides a collision elsewhere changes nothing") {
  Scene<double> scene = SceneInDoubles("stack");
  scene.bodies.push_back(scene.bodies[1]);
  scene.bodies.back().position = {6, 0.7};  // falls, lands beside the stack
  int collisions = 0;
  const auto observe = [&collisions](const FrameProblem& met) {
    if (met.level != Level::kImpulses) return;
    ++collisions;
    const auto problem = met.model.Problem(met.island);
    CHECK(problem.contacts.size() == 2);
    // Its forces are given: both corners stop.
    REQUIRE(met.f.size() == problem.rows());
    CHECK((problem.A * met.f + problem.b).cwiseAbs().maxCoeff() < 1e-12);
  };
  Simulation both(scene, 1.0 / 60, 0, observe);
  for (int i = 0; i < 100; ++i) both.Step();
  CHECK(collisions > 0);
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
  CHECK(std::abs(foot[1]) < 0.05);
}

TEST_CASE("simulate: f = 0 is taken where it is a solution") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  SceneSolver solver;
  for (int repeat = 0; repeat < 200; ++repeat) {
    ContactProblem<double> problem;
    problem.contacts.assign(3, {ContactKind::kStatic, 1.0, {0, 0}});
    const Eigen::MatrixXd J = Eigen::MatrixXd::NullaryExpr(6, 4, [&] { return number(random); });
    problem.A = J * J.transpose();
    problem.b = Eigen::VectorXd::NullaryExpr(6, [&] { return number(random); });
    for (const int normal : {0, 2, 4}) problem.b[normal] = std::abs(problem.b[normal]);
    if (repeat % 2 == 0) problem.b[2] = 0;
    const SceneAnswer answer = solver.Solve(problem);
    REQUIRE(answer.Solved());
    CHECK(answer.f.isZero(0));
  }
}

TEST_CASE("simulate: without friction a problem has one answer, in the plane, in space and in factors") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1, 1);
  SceneSolver solver;
  for (int repeat = 0; repeat < 20; ++repeat) {
    ContactProblem<double> problem;
    problem.contacts.assign(4, {ContactKind::kFrictionless, 0.0, {0, 0}});
    const Eigen::MatrixXd J = Eigen::MatrixXd::NullaryExpr(4, 6, [&] { return number(random); });
    problem.A = J * J.transpose();
    const Eigen::VectorXd w = Eigen::VectorXd::NullaryExpr(6, [&] { return number(random); });
    problem.b = J * w;
    const SceneAnswer planar = solver.Solve(problem);
    problem.dimension = 3;
    const SceneAnswer spatial = solver.Solve(problem);
    const SceneAnswer sparse =
        solver.Solve(testing::InFactors(3, problem.contacts, J, w, Eigen::VectorXd::Zero(4)));
    REQUIRE((planar.Solved() && spatial.Solved() && sparse.Solved()));
    CHECK(planar.f == spatial.f);
    CHECK((planar.f - sparse.f).norm() < 1e-6 * (1 + planar.f.norm()));
    CHECK(planar.counters[Counter::kSparse] + spatial.counters[Counter::kSparse] == 0);
    CHECK(sparse.counters[Counter::kSparse] == 1);
  }
}

TEST_CASE(
    "simulate: the wedge that jams has no answer, neither near nor far, and the step is taken all the same") {
  Simulation simulation(SceneInDoubles("scripted-wedge-jams"));
  simulation.Step();
  REQUIRE(!simulation.undecided().empty());
  CHECK(simulation.undecided().front().error > kLooseResidual);
  CHECK(simulation.statistics().undecided == static_cast<std::int64_t>(simulation.undecided().size()));
  for (int k = 0; k < 20; ++k) simulation.Step();
  CHECK(simulation.statistics().frames == 21);
  for (const auto& body : simulation.scene().bodies) CHECK(body.position.allFinite());
}

TEST_CASE("simulate: what a stopped body stops in the same step does not sink into it") {
  // Both fall at 6 m/s; the lower one reaches the floor within the step, the upper one is 2 mm above it.
  Scene<double> scene = SceneInDoubles("stack");
  scene.bodies.erase(scene.bodies.begin() + 3, scene.bodies.end());
  scene.bodies[1].position[1] += 0.05;
  scene.bodies[2].position[1] += 0.052;
  for (const int block : {1, 2}) scene.bodies[block].velocity[1] = -6;
  Simulation simulation(scene);
  for (int i = 0; i < 5; ++i) {
    simulation.Step();
    CHECK(DriftOf(simulation.scene()).overlap < 1e-9);
  }
  CHECK(simulation.scene().bodies[2].velocity.norm() < 1e-9);
}

// A semicircular arch of `count` voussoirs, mean radius 1, on a floor.
Scene<double> Arch(double thickness, int count) {
  Scene<double> scene;
  scene.gravity = {0, -10};
  scene.mu = 1;
  scene.gap = 1e-3;
  RigidBody<double> floor;
  floor.fixed = true;
  floor.shapes.push_back({{}, {{-3, -1}, {3, -1}, {3, 0}, {-3, 0}}, {0, 0}, 0});
  scene.bodies.push_back(floor);
  const double angle = std::acos(-1.0) / count, inner = 1 - thickness / 2, outer = 1 + thickness / 2;
  for (int i = 0; i < count; ++i) {
    const Vector2<double> from(std::cos(i * angle), std::sin(i * angle));
    const Vector2<double> to(std::cos((i + 1) * angle), std::sin((i + 1) * angle));
    // Of a trapezoid between two radii: two triangles with the corner at the centre, one less the other.
    const double thirds =
        2 * (outer * outer * outer - inner * inner * inner) / (3 * (outer * outer - inner * inner));
    RigidBody<double> stone;
    stone.mass = (outer * outer - inner * inner) * std::sin(angle) / 2;
    stone.inertia = stone.mass * (thickness * thickness + angle * angle) / 12;
    stone.position = thirds * (from + to) / 2;
    BodyShape<double> shape;
    for (const Vector2<double>& corner : {Vector2<double>(inner * from), Vector2<double>(outer * from),
                                          Vector2<double>(outer * to), Vector2<double>(inner * to)})
      shape.corners.push_back(corner - stone.position);
    stone.shapes.push_back(shape);
    scene.bodies.push_back(stone);
  }
  return scene;
}

TEST_CASE("simulate: an arch stands above thickness / radius = 0.1075, and falls below", "[slow]") {
  for (const double thickness : {0.1065, 0.1085}) {
    const Scene<double> scene = Arch(thickness, 30);
    Simulation simulation(scene);
    for (int i = 0; i < 20; ++i) simulation.Step();
    const double move = LargestMove(scene, simulation.scene());
    INFO(move);
    CHECK((thickness > 0.1075 ? move < 1e-10 : move > 1e-5));
  }
  CHECK(LargestMove(SceneInDoubles("arch-stands"), Run("arch-stands", 600).scene()) < 1e-10);
  const Simulation falls = Run("arch-falls", 120, 1.0 / 120);
  CHECK(falls.scene().bodies[7].position[1] < 0.2);  // the crown
}

TEST_CASE("simulate: a house of cards stands") {
  CHECK(LargestMove(SceneInDoubles("card-house"), Run("card-house", 600).scene()) < 1e-9);
}

TEST_CASE("simulate: gears keep the ratio of their teeth, but for play") {
  constexpr double kStep = 1.0 / 240;
  Simulation simulation(SceneInDoubles("gears"), kStep);
  double turned = 0;
  for (int i = 0; i < 1440; ++i) {
    simulation.Step();
    turned += kStep * simulation.scene().bodies[2].spin;
  }
  CHECK(turned == Approx(-2 * 6.0 * 12 / 18).margin(0.05));
  CHECK(DriftOf(simulation.scene()).overlap < 1e-4);
}

TEST_CASE("simulate: a sliding block stops and stays") {
  Scene<double> scene = SceneInDoubles("incline-rests");
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
    const Simulation full = Run(name, 60, 1.0 / 60, [](Simulation& simulation) { simulation.minimal = false; });
    CHECK(LargestMove(Run(name, 60).scene(), full.scene()) < 1e-6);
  }
}

TEST_CASE(
    "simulate: a vice that closes on a block leaves no answer: frame and problem are told, nothing ends") {
  Scene<double> scene;
  scene.gap = 1e-3;
  for (const double x : {-1.0, 0.0, 1.0}) {
    RigidBody<double> body;
    body.fixed = x != 0;
    body.position = {x, 0};
    body.velocity = {-x, 0};
    body.shapes.push_back({{}, {{-0.45, -0.45}, {0.45, -0.45}, {0.45, 0.45}, {-0.45, 0.45}}, {0, 0}, 0});
    scene.bodies.push_back(body);
  }
  Simulation simulation(scene);
  for (int i = 0; i < 5; ++i) {
    simulation.Step();
    CHECK(simulation.undecided().empty());
  }
  simulation.Step();  // closed by 1/10 m at 1 m/s
  REQUIRE(!simulation.undecided().empty());
  const UndecidedProblem& first = simulation.undecided().front();
  const std::string text = TextOf(first);
  INFO(text);
  CHECK(first.frame == 5);
  CHECK(text.starts_with("frame 5, "));
  CHECK(text.find("is undecided") != text.npos);
  CHECK(first.problem.rows() > 0);
  for (int i = 6; i < 20; ++i) simulation.Step();
  CHECK(simulation.statistics().frames == 20);
  CHECK(simulation.scene().bodies[1].position.norm() < 1);  // it is not thrown out
}

// A wall of bricks, each of a mass of 1, and a block of `mass` thrown at it at 20 m/s.
template <class Kind>
SceneIn<Kind, double> HitWall(int courses, int length, double mass) {
  const auto point = [](double x, double depth, double z) {
    return Kind::kDimension == 2 ? fmt::format("[{}, {}]", x, z) : fmt::format("[{}, {}, {}]", x, depth, z);
  };
  std::string bodies =
      fmt::format(R"({{"name": "0", "fixed": true, "position": {}, "shapes": [{{"box": {}}}]}})",
                  point(0, 0, -1), point(100, 10, 2));
  int count = 0;
  const auto add = [&](double x, double z, double m, const std::string& size, const std::string& velocity) {
    bodies += fmt::format(
        R"(, {{"name": "{}", "mass": {}, "position": {}, "velocity": {}, "shapes": [{{"box": {}}}]}})", ++count,
        m, point(x, 0, z), velocity, size);
  };
  for (int course = 0; course < courses; ++course) {
    for (int k = 0; k < length - course % 2; ++k)
      add(k + course % 2 * 0.5, 0.25 + 0.5 * course, 1, point(0.96875, 0.5, 0.5), point(0, 0, 0));
  }
  add(-2, 0.25 * courses, mass, point(1, 1, 1), point(20, 0, 0));
  const std::string text = fmt::format(
      R"({{"format": "stiction-scene", "version": 1, "name": "wall", "dimension": {}, "gravity": {}, "mu": "1/2",
           "bodies": [{}]}})",
      Kind::kDimension, point(0, 0, -10), bodies);
  return Round(ParseScene<Kind>(text, "wall").scene);
}

TEMPLATE_TEST_CASE("simulate: ten boxes of masses of 1 and 10,000 stand on each other", "", Plane, Space) {
  const bool is_flat = TestType::kDimension == 2;
  std::string bodies =
      fmt::format(R"({{"name": "floor", "fixed": true, "position": {}, "shapes": [{{"box": {}}}]}})",
                  is_flat ? "[0, -1]" : "[0, 0, -1]", is_flat ? "[200, 2]" : "[200, 200, 2]");
  for (int k = 0; k < 10; ++k)
    bodies +=
        fmt::format(R"(, {{"name": "{}", "mass": {}, "position": [{}{}.5], "shapes": [{{"box": {}}}]}})", k,
                    k % 2 == 0 ? 1 : 10000, is_flat ? "0, " : "0, 0, ", k, is_flat ? "[1, 1]" : "[1, 1, 1]");
  const auto scene = Round(
      ParseScene<TestType>(fmt::format(R"({{"format": "stiction-scene", "version": 1, "name": "stack",
      "dimension": {}, "gravity": {}, "mu": "1/2", "bodies": [{}]}})",
                                       TestType::kDimension, is_flat ? "[0, -10]" : "[0, 0, -10]", bodies),
                           "stack")
          .scene);
  SimulationIn<TestType> simulation(scene, 1.0 / 240);
  constexpr int kSteps = 60;
  for (int k = 0; k < kSteps; ++k) simulation.Step();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    CHECK((simulation.scene().bodies[i].position - scene.bodies[i].position).norm() < 1e-10);
  CHECK(simulation.statistics().warm >= kSteps - 3);
}

TEMPLATE_TEST_CASE("simulate: a block thrown at a wall breaks it, and every problem is solved", "", Plane,
                   Space) {
  for (const double mass : {0.5, 10.0, 300.0}) {
    SimulationIn<TestType> simulation(HitWall<TestType>(4, 4, mass), 1.0 / 240);
    const double before = EnergyOf(simulation.scene()).total();
    for (int k = 0; k < 40; ++k) simulation.Step();
    const SimulationStatistics& statistics = simulation.statistics();
    CAPTURE(mass, statistics.problems, statistics.loose);
    CHECK(statistics.collisions > 0);
    CHECK(statistics.undecided == 0);
    CHECK(20 * statistics.loose <= statistics.problems);
    CHECK(EnergyOf(simulation.scene()).total() < before);
    CHECK(DriftOf(simulation.scene()).overlap < 1e-3);
  }
}

TEST_CASE("simulate: the block feeder feeds, and the jack lifts on both strokes", "[slow]") {
  Simulation feeder(SceneInDoubles("block-feeder"), 1.0 / 120);
  double overlap = 0;
  for (int i = 0; i < 1200; ++i) {
    feeder.Step();
    overlap = std::max(overlap, DriftOf(feeder.scene()).overlap);
  }
  CHECK(overlap < 1e-4);
  CHECK(100 * feeder.statistics().fallbacks < feeder.statistics().problems);
  int out = 0;
  for (const auto& body : feeder.scene().bodies)
    out += body.name.starts_with("block") && body.position[0] > 0.9;
  CHECK(out >= 2);
  Simulation jack(SceneInDoubles("double-action-jack"), 1.0 / 240);
  std::vector<double> heights;  // of the load, after every half turn of the crank
  for (int i = 0; i < 2000; ++i) {
    if (i % 250 == 0) heights.push_back(jack.scene().bodies[7].position[1]);
    jack.Step();
    CHECK(DriftOf(jack.scene()).joints < 1e-3);
  }
  for (std::size_t i = 1; i < heights.size(); ++i) CHECK(heights[i] > heights[i - 1] + 0.1);
}

// `count` copies of the stack, side by side on floors of their own, the k-th pushed by k centimetres a second.
Scene<double> Towers(int count) {
  const Scene<double> stack = SceneInDoubles("stack");
  Scene<double> towers = stack;
  towers.bodies.clear();
  for (int k = 0; k < count; ++k) {
    for (RigidBody<double> body : stack.bodies) {
      body.position[0] += 30.0 * k;
      if (!body.fixed) body.velocity[0] += 0.01 * k;
      towers.bodies.push_back(body);
    }
  }
  return towers;
}

TEST_CASE("simulate: islands have the same answers on any number of threads") {
  const auto run = [](int threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    Simulation simulation(Towers(30));
    for (int i = 0; i < 20; ++i) simulation.Step();
    return simulation;
  };
  const Simulation one = run(1), four = run(4);
  CHECK(one.statistics().problems > 20 * 25);
  CHECK(one.statistics() == four.statistics());
  CHECK(LargestMove(one.scene(), four.scene()) == 0);
  CHECK(LargestMove(Towers(30), one.scene()) > 1e-3);
}

TEST_CASE("simulate: a block that leaves, but is pressed back within the step, does not sink") {
  for (const bool minimal : {true, false}) {
    Scene<double> scene = SceneInDoubles("incline-rests");
    scene.bodies[1].velocity = {-0.6, 0.8};  // off the slope, faster than `rest`
    scene.bodies[1].force = {600, -800};     // and back
    Simulation simulation(scene);
    simulation.minimal = minimal;
    simulation.halvings = 0;
    simulation.Step();
    CHECK(DriftOf(simulation.scene()).overlap < 1e-9);
    CHECK(simulation.forces().size() == 2);
  }
}

// Bricks in running bond, `courses` of them and as many in the lower one.
Scene<double> Wall(int courses) {
  Scene<double> scene;
  scene.gravity = {0, -10};
  scene.mu = 0.5;
  scene.gap = 1e-3;
  RigidBody<double> floor;
  floor.fixed = true;
  floor.position = {0, -1};
  floor.shapes.push_back({{}, {{-100, -1}, {100, -1}, {100, 1}, {-100, 1}}, {0, 0}, 0});
  scene.bodies.push_back(floor);
  for (int course = 0; course < courses; ++course) {
    for (int k = 0; k < courses - course % 2; ++k) {
      RigidBody<double> brick;
      brick.inertia = (0.95 * 0.95 + 0.5 * 0.5) / 12;
      brick.position = {k + 0.5 * (course % 2), 0.25 + 0.5 * course};
      brick.shapes.push_back({{}, {{-0.475, -0.25}, {0.475, -0.25}, {0.475, 0.25}, {-0.475, 0.25}}, {0, 0}, 0});
      scene.bodies.push_back(brick);
    }
  }
  return scene;
}

TEST_CASE("simulate: a block on the wall of a turning drum presses with m w^2 r, from the first frame on") {
  Scene<double> scene;
  scene.mu = 0.5;
  scene.gap = 1e-3;
  scene.bodies.resize(2);
  auto &drum = scene.bodies[0], &block = scene.bodies[1];
  drum.fixed = true;
  block.position = {1, 0};
  block.velocity = {0, 5};
  block.spin = drum.spin = 5;
  block.inertia = 1.0 / 6;
  drum.shapes.push_back({{}, {{1.5, -2}, {2, -2}, {2, 2}, {1.5, 2}}, {0, 0}, 0});
  block.shapes.push_back({{}, {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}, {0, 0}, 0});
  Simulation simulation(scene, 1.0 / 240);
  for (int i = 0; i < 240; ++i) {
    simulation.Step();
    double pressed = 0;
    for (const auto& force : simulation.forces()) pressed += force.force.norm();
    CHECK(pressed == Approx(25).epsilon(1e-3));
  }
  CHECK(simulation.statistics().collisions == 0);
  CHECK(simulation.scene().bodies[1].position.norm() == Approx(1).epsilon(1e-6));
  const auto& body = simulation.scene().bodies[1];  // where the drum has turned
  const double angle = std::remainder(std::atan2(body.position[1], body.position[0]) - 5, 2 * M_PI);
  CHECK(std::abs(angle) < 1e-3);  // of second order in the step
}

TEST_CASE("simulate: a pendulum at the bottom pulls with m (g + w^2 l) in the first frame") {
  Simulation simulation(SceneInDoubles("pendulum-at-the-bottom"), 1.0 / 240);
  for (int i = 0; i < 2; ++i) {
    simulation.Step();
    Eigen::Vector2d pull(0, 0);
    for (const auto& force : simulation.forces()) pull += force.force;
    CHECK(pull.norm() == Approx(14).epsilon(1e-3));
  }
}

// The largest row of accelerations in which two answers differ.
double LargestDifference(const SceneModel<double>& model, const ContactProblem<double>::Vector& f,
                         const ContactProblem<double>::Vector& g) {
  const auto p = BodyAccelerations(model, {f}), q = BodyAccelerations(model, {g});
  double difference = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    difference = std::max(difference, (p[i] - q[i]).cwiseAbs().maxCoeff());
  return difference;
}

TEST_CASE("simulate: factors give the answers of a dense A, with friction, without it, and with joints") {
  for (const double mu : {0.5, 0.0}) {
    Scene<double> scene = Wall(5);
    scene.mu = mu;
    scene.bodies.back().force = {6, 0};  // mu m g = 5 N
    Joint<double> tie;                   // from the first brick to the floor
    tie.b = 1;
    tie.at_a = {-0.475, 1};
    tie.at_b = {-0.475, -0.25};
    tie.direction = {1, 0}, tie.relative_rotation = {1, 0};
    scene.joints.push_back(tie);
    const auto model = Assemble(scene, FindContacts(scene), Level::kForces, /*minimal=*/true, 1.0 / 60);
    REQUIRE(model.islands.size() == 1);
    SceneSolver solver;
    const SceneAnswer dense = solver.Solve(model.Problem(0)), sparse = solver.Solve(model.InFactors(0));
    REQUIRE(dense.Solved());
    REQUIRE(sparse.Solved());
    CHECK(LargestDifference(model, dense.f, sparse.f) < 1e-5);
    CHECK(LargestDifference(model, dense.f, 0 * dense.f) > 1);
  }
}

// In doubles, too, where impulses have w = 0; and b of a wall at rest is not lost beside gravity.
TEST_CASE("assemble: in factors b = J w + c at every level") {
  auto scene = Wall(8);
  scene.bodies.back().velocity = {1e-9, -1e-9};
  for (const Level level : {Level::kForces, Level::kImpulses, Level::kPositions}) {
    const auto model = Assemble(scene, FindContacts(scene), level, /*minimal=*/true, 1.0 / 60);
    for (std::size_t i = 0; i < model.islands.size(); ++i) {
      const auto factored = model.InFactors(i);
      const Eigen::VectorXd b = model.Problem(i).b;
      INFO(kLevelNames[static_cast<int>(level)]);
      CHECK(factored.b == b);
      const double size = std::max(b.cwiseAbs().maxCoeff(), factored.w.cwiseAbs().maxCoeff());
      CHECK((factored.A.J() * factored.w + factored.c - b).cwiseAbs().maxCoeff() <= 1e-14 * size);
      CHECK((level == Level::kForces) == (factored.w.cwiseAbs().maxCoeff() > 1));
    }
  }
}

// The same verdict, bodies where they are but for so much after so many steps, and every answer a solution of
// its problem: the gate judges both.
TEST_CASE("simulate: from the forces of the step before as from f = 0", "[slow]") {
  const std::vector<std::pair<const char*, int>> scenes = {{"large/brick-wall", 10},
                                                           {"large/wrecking-ball", 60}};
  for (const auto& [name, steps] : scenes) {
    INFO(name);
    const Simulation one = Run(name, steps);
    const Simulation other = Run(name, steps, 1.0 / 60, [](Simulation& cold) { cold.warm = false; });
    CHECK(one.statistics().warm > 0);
    CHECK(other.statistics().warm == 0);
    CHECK(one.statistics().loose == other.statistics().loose);
    CHECK(LargestMove(one.scene(), other.scene()) < 1e-6);
  }
}

TEST_CASE("simulate: at rest the forces of the step before are the solution") {
  Simulation simulation(Wall(8));
  simulation.Step();
  std::vector<Eigen::VectorXd> before;
  for (int i = 0; i < 20; ++i) {
    before.clear();
    for (const auto& force : simulation.forces()) before.push_back(force.force);
    simulation.Step();
  }
  CHECK(simulation.statistics().warm == 20);
  for (std::size_t i = 0; i < before.size(); ++i)
    CHECK((before[i] - simulation.forces()[i].force).norm() < 1e-6);
}

TEST_CASE("simulate: a wall of many bricks stands, without A") {
  Simulation simulation(Wall(8));
  for (int i = 0; i < 5; ++i) simulation.Step();
  CHECK(simulation.statistics().sparse == simulation.statistics().problems);
  CHECK(LargestMove(Wall(8), simulation.scene()) < 1e-8);
}

TEST_CASE("simulate: no scene of the plane overlaps by more than its gap", "[slow]") {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(STICTION_SCENES)) {
    const auto& path = entry.path();
    if (path.extension() != ".json" || path.stem() == "scripted-wedge-jams") continue;  // which has no answer
    INFO(path.stem().string());
    const SceneFile file = ReadScene(path);
    Simulation simulation(Round(file.scene), ToDouble(file.step));
    const double gap = simulation.scene().gap > 0 ? simulation.scene().gap : 1e-3;
    double overlap = 0;
    const double seconds = ToDouble(file.seconds) / (testing::Short() ? 4 : 1);
    while (simulation.time() < seconds) {
      simulation.Step();
      overlap = std::max(overlap, DriftOf(simulation.scene()).overlap);
    }
    CHECK(overlap <= gap);
    CHECK(simulation.statistics().deep == 0);
    ++scenes;
  }
  CHECK(scenes >= 29);
}

TEST_CASE("simulate: discs of one centre part") {
  Scene<double> scene;
  scene.bodies.resize(2);
  for (auto& body : scene.bodies) {
    body.shapes.resize(1);
    body.shapes[0].radius = 0.5;
  }
  CHECK(DriftOf(scene).overlap == 1);
  Simulation simulation(scene);
  for (int i = 0; i < 3; ++i) simulation.Step();
  CHECK(DriftOf(simulation.scene()).overlap < 1e-9);
}

TEST_CASE("simulate: joined and given pairs of fixed bodies are in no problem, full or minimal") {
  for (const bool minimal : {true, false}) {
    Scene<double> scene = SceneInDoubles("stack");
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies.back().level = 7;
    Joint<double> pin;
    pin.b = static_cast<int>(scene.bodies.size()) - 1;
    pin.at_a = pin.at_b = {0, 0};
    pin.direction = pin.relative_rotation = {1, 0};
    scene.joints.push_back(pin);
    const auto model = Assemble(scene, FindContacts(scene), Level::kForces, minimal);
    REQUIRE(model.islands.size() == 1);
    CHECK(model.islands[0].rows == 20);
  }
}

TEST_CASE("simulate: every problem is shown, and the same run twice is the same") {
  std::int64_t seen = 0;
  Simulation simulation(SceneInDoubles("falling-boxes"), 1.0 / 60, 0, [&seen](const FrameProblem& met) {
    CHECK(met.f.size() == met.model.islands[met.island].rows);
    CHECK(met.f.size() > 0);
    ++seen;
  });
  for (int i = 0; i < 100; ++i) simulation.Step();
  CHECK(seen == simulation.statistics().problems);
  CHECK(LargestMove(simulation.scene(), Run("falling-boxes", 100).scene()) == 0);
}

// The scene in another unit of length: of masses and times nothing changes.
Scene<double> InUnit(Scene<double> scene, double metres) {
  scene.gravity *= metres;
  scene.gap *= metres;
  for (auto& body : scene.bodies) {
    body.inertia *= metres * metres;
    body.torque *= metres * metres;
    for (auto* v : {&body.position, &body.velocity, &body.acceleration, &body.force}) *v *= metres;
    for (auto& shape : body.shapes) {
      shape.center *= metres;
      shape.radius *= metres;
      for (auto& corner : shape.corners) corner *= metres;
    }
  }
  for (auto& joint : scene.joints) {
    joint.at_a *= metres;
    joint.at_b *= metres;
  }
  for (auto& contact : scene.contacts) {
    contact.at_a *= metres;
    contact.at_b *= metres;
  }
  return scene;
}

TEST_CASE("simulate: a scene of kilometres and one of micrometres move as one of metres does") {
  for (const char* name : {"stack", "falling-boxes", "double-pendulum", "card-pair-slides"}) {
    for (const double gap : {1.0, 0.0}) {
      Scene<double> scene = SceneInDoubles(name);
      scene.gap *= gap;
      Simulation one(scene);
      for (int i = 0; i < 60; ++i) one.Step();
      for (const double metres : {0x1p10, 0x1p-20}) {  // that doubles scale by without rounding
        CAPTURE(name, gap, metres);
        Simulation other(InUnit(scene, metres));
        for (int i = 0; i < 60; ++i) other.Step();
        CHECK(LargestMove(InUnit(other.scene(), 1 / metres), one.scene()) < 1e-9);
        CHECK(other.statistics() == one.statistics());
      }
    }
  }
}

TEST_CASE("simulate: the size of a scene is that of what moves in it") {
  Scene<double> scene = SceneInDoubles("stack");
  const double size = SizeOf(scene);
  CHECK(size > 0.1);
  CHECK(size < 10);
  for (auto& body : scene.bodies) {
    if (body.fixed) body.shapes.clear();
  }
  CHECK(SizeOf(scene) == size);
  CHECK(SizeOf(InUnit(scene, 1024)) == 1024 * size);
  CHECK(SizeOf(Scene<double>{}) == 1);
}

}  // namespace
}  // namespace stiction
