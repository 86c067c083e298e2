// SPDX-License-Identifier: Apache-2.0
// Contacts, rows, assembly: closed forms exactly, and minimal models against full ones.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <random>

#include "certify/claims/existence.h"
#include "certify/exact/exact.h"
#include "certify/exact/properties.h"
#include "certify/exact/verify_solution.h"
#include "corpus/json.h"
#include "corpus/record/scene_file.h"
#include "scene/assemble.h"
#include "scene/rows.h"
#include "solver/problem/reduction.h"
#include "tests/factored.h"
#include "tests/methods.h"

namespace stiction {
namespace {

using Forces = std::vector<ExactVector>;

SceneFile NamedScene(const std::string& name) {
  return ReadScene(std::filesystem::path(STICTION_SCENES) / (name + ".json"));
}

std::vector<std::string> SceneNames() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(STICTION_SCENES)) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// Forces of one problem by complete driving, verified; empty if it ends in a ray.
std::optional<ExactVector> SolveExactly(const ExactProblem& problem) {
  const Reduction<Rational> reduction(problem);
  REQUIRE(reduction.end() == ReductionEnd::kReduced);
  ExactVector x(0);
  if (reduction.problem().rows() > 0) {
    const ExactAnswer run = testing::RunComplete(reduction.problem(), Limits());
    if (!run.Solved()) return std::nullopt;
    x = run.f;
  }
  const ExactVector f = reduction.Forces(x);
  CHECK(FindViolation(problem, f).value_or("") == "");
  return f;
}

std::optional<Forces> SolveExactly(const SceneModel<Rational>& model) {
  Forces forces;
  for (std::size_t i = 0; i < model.islands.size(); ++i) {
    const auto f = SolveExactly(model.Problem(i));
    if (!f) return std::nullopt;
    forces.push_back(*f);
  }
  return forces;
}

struct Solved {
  SceneModel<Rational> model;
  Forces f;
  std::vector<Eigen::Matrix<Rational, 3, 1>> accelerations;
};

Solved SolveScene(const Scene<Rational>& scene) {
  Solved solved;
  solved.model = Assemble(scene, FindContacts(scene));
  const auto f = SolveExactly(solved.model);
  REQUIRE(f.has_value());
  solved.f = *f;
  solved.accelerations = BodyAccelerations(solved.model, solved.f);
  return solved;
}

Rational Q(const std::string& text) { return *ParseRational(text); }

// ---- Contact finding -------------------------------------------------------------------------

RigidBody<double> Polygon(const std::string& name, std::vector<Vector2<double>> corners, double x, double y,
                          double angle = 0) {
  RigidBody<double> body;
  body.name = name;
  body.shapes.push_back({{}, std::move(corners), {0, 0}, 0});
  body.position = {x, y};
  body.rotation = {std::cos(angle), std::sin(angle)};
  return body;
}

RigidBody<double> Box(double w, double h, double x, double y, double angle = 0) {
  return Polygon("box", {{-w / 2, -h / 2}, {w / 2, -h / 2}, {w / 2, h / 2}, {-w / 2, h / 2}}, x, y, angle);
}

RigidBody<double> Disc(double r, double x, double y) {
  RigidBody<double> body;
  body.shapes.push_back({{}, {}, {0, 0}, r});
  body.position = {x, y};
  return body;
}

Scene<double> SceneOf(std::vector<RigidBody<double>> bodies, double gap = 1e-3) {
  Scene<double> scene;
  scene.bodies = std::move(bodies);
  scene.gap = gap;
  return scene;
}

TEST_CASE("contacts: an edge on an edge has its two ends, clipped to both") {
  for (const bool swap : {false, true}) {
    std::vector bodies = {Box(20, 2, 0, -1), Box(2, 1, 9.5, 0.5)};
    if (swap) std::swap(bodies[0], bodies[1]);
    const auto contacts = FindContacts(SceneOf(bodies));
    REQUIRE(contacts.size() == 2);
    const double low = std::min(contacts[0].point[0], contacts[1].point[0]);
    const double high = std::max(contacts[0].point[0], contacts[1].point[0]);
    CHECK(low == 8.5);
    CHECK(high == 10.0);  // the floor ends there
    for (const auto& c : contacts) {
      CHECK(c.gap == 0);
      const double up = c.a == (swap ? 0 : 1) ? 1 : -1;  // from b to a
      CHECK(c.normal[1] == up);
    }
  }
}

TEST_CASE("contacts: none beyond the gap, one for a corner, none twice") {
  CHECK(FindContacts(SceneOf({Box(20, 2, 0, -1), Box(2, 1, 0, 0.502)})).empty());
  CHECK(FindContacts(SceneOf({Box(20, 2, 0, -1), Box(2, 1, 0, 0.5009)})).size() == 2);
  const double angle = 0.3, height = std::sin(angle) + 0.5 * std::cos(angle);
  const auto corner = FindContacts(SceneOf({Box(20, 2, 0, -1), Box(2, 1, 0, height, angle)}));
  REQUIRE(corner.size() == 1);
  CHECK(corner[0].gap == Approx(0).margin(1e-12));
  CHECK(corner[0].point[0] == Approx(-std::cos(angle) + 0.5 * std::sin(angle)));
}

TEST_CASE("contacts: discs against discs, edges and corners") {
  const auto two = FindContacts(SceneOf({Disc(1, 0, 0), Disc(2, 1.8, 2.4)}));
  REQUIRE(two.size() == 1);
  CHECK(two[0].point[0] == Approx(0.6));
  CHECK(two[0].normal[0] == Approx(-0.6));
  CHECK(two[0].meeting == Meeting::kPoint);
  const auto edge = FindContacts(SceneOf({Disc(1, 0, 1), Box(2, 2, 0, -1)}));
  REQUIRE(edge.size() == 1);
  CHECK(edge[0].a == 0);
  CHECK(edge[0].meeting == Meeting::kFace);
  CHECK(edge[0].point[1] == 0.0);
  const auto corner = FindContacts(SceneOf({Box(2, 2, 0, -1), Disc(1, 1.6, 0.8)}));
  REQUIRE(corner.size() == 1);
  CHECK(corner[0].a == 1);
  CHECK(corner[0].meeting == Meeting::kPoint);
  CHECK(corner[0].point[0] == 1.0);
  CHECK(corner[0].normal[0] == Approx(0.6));
  CHECK(FindContacts(SceneOf({Box(2, 2, 0, -1), Disc(1, 1.6, 0.81)})).empty());
}

TEST_CASE("contacts: levels, joints, rules and fixed bodies keep pairs apart") {
  Scene<double> scene = SceneOf({Box(20, 2, 0, -1), Box(2, 1, 0, 0.5)});
  scene.bodies[1].level = 1;
  CHECK(FindContacts(scene).empty());
  scene.bodies[1].level = 0;
  scene.pairs.push_back({1, 0, 0.25, {}});
  CHECK(FindContacts(scene).at(0).mu == 0.25);
  scene.pairs[0].collide = false;
  CHECK(FindContacts(scene).empty());
  scene.pairs.clear();
  scene.bodies[0].fixed = scene.bodies[1].fixed = true;
  CHECK(FindContacts(scene).empty());
}

// ---- Rows ------------------------------------------------------------------------------------

// Where all bodies are after t without accelerations.
Scene<double> Coasted(Scene<double> scene, double t) {
  for (auto& body : scene.bodies) {
    body.position += t * body.velocity;
    const double angle = t * body.spin;
    body.rotation = Rotate<double>({std::cos(angle), std::sin(angle)}, body.rotation);
  }
  return scene;
}

// First and second derivative of measure(scene at t) at t = 0.
template <class Measure>
std::pair<double, double> Derivatives(const Scene<double>& scene, const Measure& measure) {
  const double h = 1e-4;
  const double minus = measure(Coasted(scene, -h)), zero = measure(scene), plus = measure(Coasted(scene, h));
  return {(plus - minus) / (2 * h), (plus - 2 * zero + minus) / (h * h)};
}

void SetMotions(Scene<double>& scene, std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  for (auto& body : scene.bodies) {
    body.velocity = {number(random), number(random)};
    body.spin = number(random);
  }
}

TEST_CASE("rows: velocity and bias of a contact are the derivatives of its gap") {
  std::mt19937 random(1);
  const std::vector<std::pair<const char*, std::vector<RigidBody<double>>>> scenes = {
      {"corner on edge", {Box(4, 2, 0, -1, 0.1), Box(2, 1, 0.3, 1.1, 0.7)}},
      {"disc on edge", {Box(4, 2, 0, -1, 0.1), Disc(1, 0.2, 1.1)}},
      {"disc on corner", {Box(2, 2, 0, -1, 0.1), Disc(1, 1.7, 0.9)}},
      {"disc on disc", {Disc(1, 0, 0), Disc(2, 1.8, 2.4)}},
  };
  for (const auto& [name, bodies] : scenes) {
    for (int repeat = 0; repeat < 5; ++repeat) {
      INFO(name);
      Scene<double> scene = SceneOf(bodies, 0.5);
      SetMotions(scene, random);
      const auto contacts = FindContacts(scene);
      REQUIRE(contacts.size() >= 1);
      for (std::size_t i = 0; i < contacts.size(); ++i) {
        if (contacts.size() == 2 && contacts[i].gap > contacts[1 - i].gap)
          continue;  // a clipped end, no corner
        const auto gap = [i](const Scene<double>& at) { return FindContacts(at).at(i).gap; };
        const auto [first, second] = Derivatives(scene, gap);
        const auto constraint = ContactConstraint(scene, contacts[i]);
        CHECK(Velocity(constraint, 0, DynamicsOf(scene)) == Approx(first).margin(1e-6));
        CHECK(constraint.rows[0].bias == Approx(second).margin(1e-5));
      }
    }
  }
}

TEST_CASE("rows: velocity and bias of joints and given contacts are the derivatives of what they measure") {
  std::mt19937 random(2);
  for (int repeat = 0; repeat < 10; ++repeat) {
    Scene<double> scene = SceneOf({Box(1, 1, 0, 0, 0.3), Box(1, 1, 2, 1, -0.4)});
    SetMotions(scene, random);
    const Vector2<double> direction(0.6, 0.8), turn(1, 0);
    scene.joints.push_back({JointKind::kPin, 0, 1, {0.5, 0.2}, {-1, 0.3}, direction, turn});
    scene.joints.push_back({JointKind::kRail, 0, 1, {0.5, 0.2}, {-1, 0.3}, direction, turn});
    scene.contacts.push_back({0, 1, {0.5, 0.2}, {-1, 0.3}, direction});
    const auto constraints = JointConstraints(scene);
    REQUIRE(constraints.size() == 3);
    for (std::size_t i = 0; i < constraints.size(); ++i) {
      const auto error = [i](const Scene<double>& at) { return JointConstraints(at)[i].rows[0].error; };
      const auto [first, second] = Derivatives(scene, error);
      CHECK(Velocity(constraints[i], 0, DynamicsOf(scene)) == Approx(first).margin(1e-6));
      CHECK(constraints[i].rows[0].bias == Approx(second).margin(1e-5));
    }
    const auto gap = [](const Scene<double>& at) { return FindContacts(at).at(0).gap; };
    const auto [first, second] = Derivatives(scene, gap);
    const auto given = ContactConstraint(scene, FindContacts(scene).at(0));
    CHECK(Velocity(given, 0, DynamicsOf(scene)) == Approx(first).margin(1e-6));
    CHECK(given.rows[0].bias == Approx(second).margin(1e-5));
  }
}

// ---- Closed forms ----------------------------------------------------------------------------

TEST_CASE("scene: a block on a slope rests above mu = tan and slides below, exactly") {
  const auto rests = SolveScene(NamedScene("incline-rests").scene);
  for (int i = 0; i < 3; ++i) CHECK(rests.accelerations[1][i] == 0);
  const auto slides = SolveScene(NamedScene("incline-slides").scene);
  const Rational down = 10 * (Q("3/5") - Q("2999/4000") * Q("4/5"));
  CHECK(slides.accelerations[1][0] == Rational(-down * Q("4/5")));
  CHECK(slides.accelerations[1][1] == Rational(-down * Q("3/5")));
  CHECK(slides.accelerations[1][2] == 0);
}

TEST_CASE("scene: a beam on two supports, a disc in a wedge") {
  const auto beam = SolveScene(NamedScene("beam-on-two-supports").scene);
  REQUIRE(beam.f.size() == 1);
  REQUIRE(beam.f[0].size() == 2);
  CHECK(beam.f[0][0] == 30);
  CHECK(beam.f[0][1] == 10);
  const auto disc = SolveScene(NamedScene("disc-in-a-wedge").scene);
  REQUIRE(disc.f[0].size() == 2);
  CHECK(disc.f[0][0] == 8);
  CHECK(disc.f[0][1] == 6);
}

TEST_CASE("scene: a ladder stands above mu = 1 / (2 tan) and slides below") {
  const auto stands = SolveScene(NamedScene("ladder-stands").scene);
  for (int i = 0; i < 3; ++i) CHECK(stands.accelerations[2][i] == 0);
  REQUIRE(stands.f[0].size() == 3);  // floor: two rows; smooth wall: one
  CHECK(stands.f[0][0] == 120);
  CHECK(abs(stands.f[0][1]) == 45);
  CHECK(stands.f[0][2] == 45);
  const auto slides = SolveScene(NamedScene("ladder-slides").scene);
  CHECK(slides.accelerations[2][0] > 0);
  CHECK(slides.accelerations[2][1] < 0);
}

TEST_CASE("scene: the rod of tangent 2, at rest, sliding, and with three solutions") {
  ExactMatrix A(2, 2);
  A << Q("8/5"), Q("6/5"), Q("6/5"), Q("17/5");
  const auto problem = [](const std::string& name) {
    const auto scene = NamedScene(name).scene;
    const auto model = Assemble(scene, FindContacts(scene));
    REQUIRE(model.islands.size() == 1);
    return model.Problem(0);
  };
  for (const char* name : {"rod-at-rest", "rod-without-solution", "rod-with-two-solutions", "three-solutions"})
    CHECK(problem(name).A == A);
  CHECK(problem("three-solutions").b[0] == 1);
  CHECK(problem("three-solutions").b[1] == 8);
  for (const auto& [normal, friction] : {std::pair("0", "0"), {"31/20", "-29/10"}, {"5/4", "-5/2"}}) {
    ExactVector f(2);
    f << Q(normal), Q(friction);
    CHECK_FALSE(FindViolation(problem("three-solutions"), f));
  }
  const auto rest = SolveScene(NamedScene("rod-at-rest").scene);
  CHECK(rest.f[0][0] == Q("17/2"));
  CHECK(rest.f[0][1] == -3);
  const ExactProblem none = problem("rod-without-solution"), two = problem("rod-with-two-solutions");
  CHECK(none.contacts[0].kind == ContactKind::kSliding);
  CHECK(none.contacts[0].slip[0] == 1);
  CHECK(none.b[0] == -10);
  CHECK_FALSE(SolveExactly(none).has_value());
  CHECK(two.b[0] == 10);
  ExactVector f(2);
  f << 0, 0;
  CHECK_FALSE(FindViolation(two, f));
  f << Q("25/2"), -25;
  CHECK_FALSE(FindViolation(two, f));
}

TEST_CASE("scene: the tension of a pendulum at the bottom is m (g + w^2 l)") {
  const auto pendulum = SolveScene(NamedScene("pendulum-at-the-bottom").scene);
  REQUIRE(pendulum.f[0].size() == 2);
  CHECK(pendulum.f[0][0] == 0);
  CHECK(pendulum.f[0][1] == 14);
  CHECK(pendulum.accelerations[1][1] == 4);
}

TEST_CASE("scene: a contact counts as sliding from the stated speed on, by the sign of its speed") {
  Scene<Rational> scene = NamedScene("incline-rests").scene;
  scene.bodies[1].velocity = MakeVector2<Rational>(Q("-4/500"), Q("-3/500"));  // 1/100 down the slope
  const auto kind = [&scene] { return Assemble(scene, FindContacts(scene)).Problem(0).contacts.at(0); };
  CHECK(kind().kind == ContactKind::kSliding);
  const Rational slip = kind().slip[0];
  scene.bodies[1].velocity *= Rational(-1);
  CHECK(kind().slip[0] == -slip);
  scene.rest = Q("1/100");
  CHECK(kind().kind == ContactKind::kStatic);
}

TEST_CASE("scene: a smooth keystone bears weight / (2 sin) on each face") {
  const auto stone = SolveScene(NamedScene("keystone").scene);
  REQUIRE(stone.f.size() == 1);
  REQUIRE(stone.f[0].size() == 4);  // two contacts a face, left first
  CHECK(Rational(stone.f[0][0] + stone.f[0][1]) == Q("25/3"));
  CHECK(Rational(stone.f[0][2] + stone.f[0][3]) == Q("25/3"));
  for (int i = 0; i < 3; ++i) CHECK(stone.accelerations[2][i] == 0);
}

TEST_CASE("scene: a jammed wedge can fall, and it can stay") {
  const auto scene = NamedScene("jammed-wedge").scene;
  const auto model = Assemble(scene, FindContacts(scene));
  REQUIRE(model.islands.size() == 1);
  ExactVector f = ExactVector::Constant(8, Rational(0));
  CHECK_FALSE(FindViolation(model.Problem(0), f));
  CHECK(BodyAccelerations(model, {f})[2][1] == -10);
  f[2] = f[3] = f[4] = 25;
  f[5] = -25;
  CHECK_FALSE(FindViolation(model.Problem(0), f));
  for (int i = 0; i < 3; ++i) CHECK(BodyAccelerations(model, {f})[2][i] == 0);
}

TEST_CASE(
    "scene: below mu = 4/3 the scripted wedge gives way, above there is no solution, and b is out of range") {
  const auto slides = SolveScene(NamedScene("scripted-wedge-slides").scene);
  CHECK(slides.accelerations[1][1] == 1);  // the floor's
  CHECK(slides.accelerations[2][0] == Q("-3/4"));
  CHECK(slides.accelerations[2][1] == 1);
  const auto scene = NamedScene("scripted-wedge-jams").scene;
  const ExactProblem problem = Assemble(scene, FindContacts(scene)).Problem(0);
  CHECK_FALSE(IsInRange(problem));
  const Reduction<Rational> reduction(problem);
  ExactMatrix A(2, 2);
  A << 16, 12, 12, 9;
  CHECK(reduction.problem().A.topLeftCorner(2, 2) == A);
  CHECK(reduction.problem().b[0] == -1);
  CHECK(reduction.problem().b[1] == 0);
  CHECK_FALSE(SolveExactly(problem).has_value());
  CHECK(DecideExistence(problem, {}).certificate->at("claim") == "no-solution");
}

TEST_CASE("scene: two cards lean on each other above mu = (centre - foot) / height, and slide apart below") {
  const auto stands = SolveScene(NamedScene("card-pair-stands").scene);
  for (const int card : {1, 2}) {
    for (int i = 0; i < 3; ++i) CHECK(stands.accelerations[card][i] == 0);
  }
  const auto slides = SolveScene(NamedScene("card-pair-slides").scene);
  CHECK(slides.accelerations[1][1] < 0);
  CHECK(slides.accelerations[2][1] < 0);
  const auto house = SolveScene(NamedScene("card-house").scene);
  for (const auto& acceleration : house.accelerations) {
    for (int i = 0; i < 3; ++i) CHECK(acceleration[i] == 0);
  }
}

// ---- Minimal models --------------------------------------------------------------------------

// A fixed body that turns, or accelerates, pushes with whatever force it takes: its motion need not be in
// range(A).
bool IsDriven(const Scene<Rational>& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const auto& body) {
    return body.fixed && (body.spin != 0 || body.acceleration != Vector2<Rational>(0, 0));
  });
}

TEST_CASE(
    "assemble: every scene has an A that is symmetric and semidefinite, with b in its range unless driven") {
  for (const std::string& name : SceneNames()) {
    INFO(name);
    const auto scene = NamedScene(name).scene;
    const auto model = Assemble(scene, FindContacts(scene));
    for (std::size_t i = 0; i < model.islands.size(); ++i) {
      const ExactProblem problem = model.Problem(i);
      CHECK(IsSymmetric(problem));
      CHECK(IsPositiveSemidefinite(problem));
      if (!IsDriven(scene)) CHECK(IsInRange(problem));
      CHECK(DenseOf(model.InFactors(i)).A == problem.A);
    }
  }
}

TEST_CASE("assemble: minimal forces, extended by zeros, solve the full problem of every scene", "[slow]") {
  int extended = 0;
  for (const std::string& name : SceneNames()) {
    INFO(name);
    if (name.starts_with("arch-")) continue;  // nothing to leave out, and 60 rows take a while over rationals
    const auto scene = NamedScene(name).scene;
    const auto contacts = FindContacts(scene);
    const auto full = Assemble(scene, contacts, Level::kForces, /*minimal=*/false);
    const auto minimal = Assemble(scene, contacts);
    if (full.islands.empty()) continue;
    REQUIRE(full.islands.size() == 1);
    const auto f = SolveExactly(minimal);
    if (!f) continue;  // the sliding rod, the scripted wedge
    const ExactVector all = ExtendForces(minimal, *f, full);
    CHECK(FindViolation(full.Problem(0), all).value_or("") == "");
    CHECK(BodyAccelerations(full, {all}) == BodyAccelerations(minimal, *f));
    ++extended;
  }
  CHECK(extended >= 8);
}

TEST_CASE("assemble: islands, smooth pairs, what parts and inner contacts of a face are told apart") {
  const auto scene = NamedScene("two-towers").scene;
  const auto contacts = FindContacts(scene);
  const auto model = Assemble(scene, contacts);
  CHECK(model.islands.size() == 2);
  CHECK(model.parting.size() == 2);
  CHECK(model.redundant.size() == 2);  // the ground's two pieces meet under the middle block
  CHECK(model.islands[0].rows == 8);
  CHECK(model.islands[1].rows == 2);
  const auto full = Assemble(scene, contacts, Level::kForces, /*minimal=*/false);
  CHECK(full.islands.at(0).rows == 16);
  CHECK_FALSE(Explain(scene, contacts, model, Level::kForces).empty());
}

TEST_CASE("assemble: of six contacts between two hollow blocks two are kept, and every tower is a problem") {
  const auto scene = NamedScene("hollow-blocks").scene;
  const auto model = Assemble(scene, FindContacts(scene));
  REQUIRE(model.islands.size() == 4);
  CHECK(model.redundant.size() == 48);
  for (const auto& island : model.islands) CHECK(island.rows == 12);
}

// Three given contacts on one face, the inner one last.
Scene<Rational> FaceOfThree() {
  Scene<Rational> scene;
  scene.gravity = MakeVector2<Rational>(Rational(0), Rational(-10));
  scene.mu = Rational(1, 2);
  RigidBody<Rational> floor, block;
  floor.fixed = true;
  block.position = MakeVector2<Rational>(Rational(0), Rational(1));
  scene.bodies = {floor, block};
  for (const char* x : {"-1", "1", "1/3"}) {
    const auto at = MakeVector2<Rational>(Q(x), Rational(0));
    scene.contacts.push_back({1, 0, block.Local(at), at, MakeVector2<Rational>(Rational(0), Rational(1))});
  }
  return scene;
}

TEST_CASE("assemble: an inner contact is dropped only between two of the same law, on one line, not nearer") {
  const auto dropped = [](const Scene<Rational>& scene) {
    return Assemble(scene, FindContacts(scene)).redundant.size();
  };
  CHECK(dropped(FaceOfThree()) == 1);
  auto lower = FaceOfThree();
  lower.contacts[2].at_a[1] -= Rational(1, 10);  // off the line: other moments of friction
  lower.contacts[2].at_b[1] -= Rational(1, 10);
  CHECK(dropped(lower) == 0);
  auto tilted = FaceOfThree();
  tilted.contacts[2].normal = MakeVector2<Rational>(Q("3/5"), Q("4/5"));
  CHECK(dropped(tilted) == 0);
  // mu is a matter of pairs; one of its own is set in the rows.
  const auto scene = FaceOfThree();
  auto constraints = Assemble(scene, FindContacts(scene), Level::kForces, /*minimal=*/false).constraints;
  CHECK(FindRedundant(constraints) == std::vector{2});
  constraints[2].law.mu = Rational(2);
  CHECK(FindRedundant(constraints).empty());
  constraints[2].law.mu = Rational(1, 2);
  constraints[2].rows[0].b -= Rational(1, 1000);  // closes sooner than the others
  CHECK(FindRedundant(constraints).empty());
}

TEST_CASE("assemble: at the level of impulses b is the velocity, and b of gaps is not below it") {
  Scene<Rational> scene = NamedScene("beam-on-two-supports").scene;
  scene.bodies[2].velocity = MakeVector2<Rational>(Rational(0), Rational(-3));
  const auto model = Assemble(scene, FindContacts(scene), Level::kImpulses);
  CHECK(model.colliding.size() == 2);
  CHECK(model.Problem(0).b[0] == -3);
  const auto p = SolveExactly(model);
  REQUIRE(p.has_value());
  CHECK(Rational((*p)[0][0] + (*p)[0][1]) == 12);  // m v
}

}  // namespace
}  // namespace stiction
