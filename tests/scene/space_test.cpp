// SPDX-License-Identifier: Apache-2.0
// Scenes in space: contacts, rows, assembly; closed forms exactly, and minimal models against full ones.

#include "certify/exact/space.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <random>
#include <tuple>

#include "certify/exact/properties.h"
#include "certify/exact/solve.h"
#include "certify/exact/verify_solution.h"
#include "corpus/record/scene_file.h"
#include "scene/assemble.h"
#include "scene/polyhedron.h"
#include "scene/rows.h"
#include "tests/factored.h"

namespace stiction {
namespace {

using Vector = Vector3<double>;

SceneInSpace<Rational> SpatialScene(const std::string& name) {
  const auto path = std::filesystem::path(STICTION_SCENES) / "space" / (name + ".json");
  return std::get<SceneFileInSpace>(ReadAnyScene(path)).scene;
}

Rational Exactly(const std::string& text) { return *ParseRational(text); }

Vector3<Rational> Exact(double x, double y, double z) { return MakeVector3<Rational>(x, y, z); }

// ---- Polyhedra -------------------------------------------------------------------------------

std::vector<Vector3<Rational>> BoxCorners(double x, double y, double z) {
  std::vector<Vector3<Rational>> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(Exact((i & 1 ? x : -x) / 2, (i & 2 ? y : -y) / 2, (i & 4 ? z : -z) / 2));
  return corners;
}

TEST_CASE("polyhedron: a box has six faces of four corners, twelve edges, and its closed mass properties") {
  const Polyhedron box = MakePolyhedron(BoxCorners(2, 4, 6));
  REQUIRE(box.fault.empty());
  REQUIRE(box.shape.faces.size() == 6);
  REQUIRE(box.shape.edges.size() == 12);
  for (std::size_t f = 0; f < 6; ++f) {
    CHECK(box.shape.faces[f].size() == 4);
    const auto& face = box.shape.faces[f];
    const auto& c = box.shape.corners;
    const Vector3<Rational> turn = CrossProduct<Rational>(c[face[1]] - c[face[0]], c[face[2]] - c[face[1]]);
    CHECK(turn.dot(box.shape.normals[f]) > 0);
    CHECK(c[face[0]].dot(box.shape.normals[f]) > 0);
  }
  const auto mass = MassPropertiesOf({box.shape});
  CHECK(mass.mass == 48);
  CHECK(mass.inertia(0, 0) == 48 * (16 + 36) / 12);
  CHECK(mass.inertia(1, 1) == 48 * (4 + 36) / 12);
  CHECK(mass.inertia(2, 2) == 48 * (4 + 16) / 12);
  CHECK(mass.inertia(0, 1) == 0);
}

TEST_CASE("polyhedron: corners that are no polyhedron's are refused") {
  auto corners = BoxCorners(2, 2, 2);
  corners.push_back(Exact(0.5, 0.5, 1));  // in a face
  CHECK(MakePolyhedron(corners).fault == "corner 8 in the hull of the others");
  CHECK(MakePolyhedron({Exact(0, 0, 0), Exact(1, 0, 0), Exact(0, 1, 0), Exact(1, 1, 0)}).fault ==
        "corners that are all in one plane");
  CHECK(MakePolyhedron({Exact(0, 0, 0), Exact(1, 0, 0), Exact(0, 1, 0)}).fault == "fewer than four corners");
}

// ---- Contact finding -------------------------------------------------------------------------

BodyInSpace<double> Box(const Vector& size, const Vector& at, const Vector& axis = Vector(0, 0, 1),
                        double angle = 0) {
  SceneInSpace<Rational> scene;
  scene.bodies.emplace_back();
  scene.bodies[0].shapes.push_back(MakePolyhedron(BoxCorners(size[0], size[1], size[2])).shape);
  BodyInSpace<double> body = Round(scene).bodies[0];
  body.position = at;
  body.rotation = MakeQuaternion<double>(std::cos(angle / 2), std::sin(angle / 2) * axis.normalized());
  return body;
}

BodyInSpace<double> Ball(double radius, const Vector& at) {
  BodyInSpace<double> body;
  body.shapes.emplace_back();
  body.shapes[0].radius = radius;
  body.position = at;
  return body;
}

SceneInSpace<double> SceneOf(std::vector<BodyInSpace<double>> bodies, double gap = 1e-3) {
  SceneInSpace<double> scene;
  scene.bodies = std::move(bodies);
  scene.gap = gap;
  return scene;
}

TEST_CASE("contacts in space: a face on a face has the corners of what they share") {
  for (const bool swap : {false, true}) {
    std::vector bodies = {Box({10, 10, 2}, {0, 0, -1}), Box({2, 2, 1}, {4.5, 0, 0.5})};
    if (swap) std::swap(bodies[0], bodies[1]);
    const auto contacts = FindContacts(SceneOf(bodies));
    REQUIRE(contacts.size() == 4);
    Vector sum = Vector::Zero();
    for (const auto& c : contacts) {
      CHECK(c.gap == 0);
      const double up = c.a == (swap ? 0 : 1) ? 1 : -1;  // from b to a
      CHECK(c.normal[2] == up);
      sum += c.point;
    }
    CHECK(sum[0] == Approx(4 * 4.25));  // from 3.5 to the floor's end
  }
  CHECK(FindContacts(SceneOf({Box({10, 10, 2}, {0, 0, -1}), Box({2, 2, 1}, {0, 0, 0.502})})).empty());
  // A square across a square leaves an octagon.
  CHECK(
      FindContacts(SceneOf({Box({2, 2, 2}, {0, 0, -1}), Box({2, 2, 1}, {0, 0, 0.5}, {0, 0, 1}, 0.7)})).size() ==
      8);
}

TEST_CASE("contacts in space: an edge across an edge touches in one point") {
  const double up = std::sqrt(2.0);
  const auto contacts = FindContacts(SceneOf({Box({4, 1, 1}, {0, 0, 0}, {1, 0, 0}, M_PI / 4),
                                              Box({1, 4, 1}, {0.25, 0.125, up}, {0, 1, 0}, M_PI / 4)}));
  REQUIRE(contacts.size() == 1);
  CHECK(contacts[0].meeting == Meeting::kEdges);
  CHECK(contacts[0].gap == Approx(0).margin(1e-12));
  CHECK(contacts[0].point[0] == Approx(0.25));
  CHECK(contacts[0].point[1] == Approx(0).margin(1e-12));
  CHECK(contacts[0].point[2] == Approx(up / 2));
  CHECK(std::abs(contacts[0].normal[2]) == Approx(1));
}

TEST_CASE("contacts in space: balls against faces, edges, corners and balls") {
  const auto box = Box({2, 2, 2}, {0, 0, 0});
  const auto at = [&box](const Vector& center) { return FindContacts(SceneOf({box, Ball(1, center)})); };
  REQUIRE(at({0.5, 0.2, 2}).size() == 1);
  CHECK(at({0.5, 0.2, 2})[0].meeting == Meeting::kFace);
  CHECK(at({1.6, 0.3, 1.8})[0].meeting == Meeting::kEdge);
  CHECK(at({1.6, 0.3, 1.8})[0].normal[0] == Approx(0.6));
  const auto corner = at({1 + 2.0 / 3, 1 + 2.0 / 3, 1 + 1.0 / 3});
  REQUIRE(corner.size() == 1);
  CHECK(corner[0].meeting == Meeting::kPoint);
  CHECK(corner[0].gap == Approx(0).margin(1e-12));
  CHECK(at({1.6, 0.3, 1.81}).empty());
  const auto two = FindContacts(SceneOf({Ball(1, {0, 0, 0}), Ball(2, {1.8, 0, 2.4})}));
  REQUIRE(two.size() == 1);
  CHECK(two[0].point[0] == Approx(0.6));
  CHECK(two[0].normal[2] == Approx(-0.8));
}

// ---- Rows ------------------------------------------------------------------------------------

SceneInSpace<double> Coasted(SceneInSpace<double> scene, double t) {
  for (auto& body : scene.bodies) {
    body.position += t * body.velocity;
    const double angle = t * body.spin.norm();
    if (angle == 0) continue;
    const Vector axis = std::sin(angle / 2) / angle * t * body.spin;
    body.rotation = Product<double>(MakeQuaternion<double>(std::cos(angle / 2), axis), body.rotation);
  }
  return scene;
}

template <class Measure>
std::pair<double, double> Derivatives(const SceneInSpace<double>& scene, const Measure& measure) {
  const double h = 1e-4;
  const double minus = measure(Coasted(scene, -h)), zero = measure(scene), plus = measure(Coasted(scene, h));
  return {(plus - minus) / (2 * h), (plus - 2 * zero + minus) / (h * h)};
}

Vector RandomVector(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  const double x = number(random), y = number(random), z = number(random);
  return {x, y, z};
}

struct Touching {
  const char* name;
  Meeting meeting;
  std::vector<BodyInSpace<double>> bodies;
};

std::vector<Touching> AllMeetings() {
  return {
      {"corner on face",
       Meeting::kFace,
       {Box({6, 6, 2}, {0, 0, -1}), Box({1, 1, 1}, {0, 0, 0.9}, {1, 2, 0.3}, 0.8)}},
      {"ball on face", Meeting::kFace, {Box({6, 6, 2}, {0, 0, -1}, {1, 1, 0}, 0.1), Ball(1, {0.1, 0.2, 1})}},
      {"ball on edge", Meeting::kEdge, {Box({2, 2, 2}, {0, 0, 0}), Ball(1, {1.6, 0.3, 1.9})}},
      {"ball on corner", Meeting::kPoint, {Box({2, 2, 2}, {0, 0, 0}), Ball(1, {1.7, 1.6, 1.4})}},
      {"ball on ball", Meeting::kPoint, {Ball(2, {0, 0, 0}), Ball(1, {1.8, 0.3, 2.4})}},
      {"edges",
       Meeting::kEdges,
       {Box({4, 1, 1}, {0, 0, 0}, {1, 0, 0}, 0.7), Box({1, 4, 1}, {0.2, 0.1, 1.5}, {0.2, 1, 0.1}, 0.8)}}};
}

TEST_CASE("rows in space: velocity and bias of a contact are the derivatives of its gap") {
  std::mt19937 random(1);
  for (const auto& [name, meeting, bodies] : AllMeetings()) {
    for (int repeat = 0; repeat < 5; ++repeat) {
      INFO(name);
      SceneInSpace<double> scene = SceneOf(bodies, 0.5);
      for (auto& body : scene.bodies) body.velocity = RandomVector(random), body.spin = RandomVector(random);
      const auto contacts = FindContacts(scene);
      REQUIRE(!contacts.empty());
      std::size_t nearest = 0;  // of a manifold: a corner, no clipped end
      for (std::size_t i = 0; i < contacts.size(); ++i) {
        if (contacts[i].gap < contacts[nearest].gap) nearest = i;
      }
      REQUIRE(contacts[nearest].meeting == meeting);
      const auto gap = [nearest](const SceneInSpace<double>& at) { return FindContacts(at).at(nearest).gap; };
      const auto [first, second] = Derivatives(scene, gap);
      const auto constraint = ContactConstraint(scene, contacts[nearest]);
      CHECK(Velocity(constraint, 0, DynamicsOf(scene)) == Approx(first).margin(1e-6));
      CHECK(constraint.rows[0].bias == Approx(second).margin(1e-5));
    }
  }
}

TEST_CASE(
    "rows in space: where nothing slips the tangential bias is the derivative of the tangential velocity") {
  std::mt19937 random(2);
  for (const auto& [name, meeting, bodies] : AllMeetings()) {
    for (int repeat = 0; repeat < 5; ++repeat) {
      INFO(name);
      SceneInSpace<double> scene = SceneOf(bodies, 0.5);
      for (auto& body : scene.bodies) body.velocity = RandomVector(random), body.spin = RandomVector(random);
      std::size_t nearest = 0;
      const auto find = [&nearest](const SceneInSpace<double>& at) { return FindContacts(at).at(nearest); };
      for (std::size_t i = 0; i < FindContacts(scene).size(); ++i) {
        if (FindContacts(scene)[i].gap < find(scene).gap) nearest = i;
      }
      // Together, and at rest relative to each other.
      const auto apart = find(scene);
      scene.bodies[apart.a].position -= apart.gap * apart.normal;
      const auto contact = find(scene);
      const auto slip = [&find](const SceneInSpace<double>& at) -> Vector {
        const auto c = find(at);
        return at.bodies[c.a].VelocityAt(c.point) - at.bodies[c.b].VelocityAt(c.point);
      };
      scene.bodies[contact.a].velocity -= slip(scene);
      const auto constraint = ContactConstraint(scene, contact);
      for (int row = 1; row < 3; ++row) {
        const Vector t = constraint.rows[row].J[0].head<3>();
        const auto along = [&](const SceneInSpace<double>& at) { return t.dot(slip(at)); };
        CHECK(constraint.rows[row].bias == Approx(Derivatives(scene, along).first).margin(1e-6));
      }
    }
  }
}

Quaternion<double> RandomRotation(std::mt19937& random) {
  return MakeQuaternion<double>(0.3, RandomVector(random)).normalized();
}

TEST_CASE("rows in space: velocity and bias of joints are the derivatives of what they measure") {
  std::mt19937 random(3);
  const std::array<std::size_t, 4> rows = {3, 5, 2, 5};  // of ball, hinge, rail, slider
  for (int repeat = 0; repeat < 40; ++repeat) {
    SceneInSpace<double> scene;
    scene.bodies.resize(2);
    for (auto& body : scene.bodies) {
      body.position = RandomVector(random), body.velocity = RandomVector(random);
      body.rotation = RandomRotation(random), body.spin = RandomVector(random);
    }
    const auto kind = static_cast<JointKindInSpace>(repeat % 4);
    scene.joints.push_back({kind, 0, 1, RandomVector(random), RandomVector(random),
                            RandomVector(random).normalized(), RandomRotation(random)});
    const auto constraints = JointConstraints(scene);
    INFO("kind " << repeat % 4);
    REQUIRE(constraints.size() == rows[repeat % 4]);
    for (std::size_t i = 0; i < constraints.size(); ++i) {
      const auto error = [i](const SceneInSpace<double>& at) { return JointConstraints(at)[i].rows[0].error; };
      const auto [first, second] = Derivatives(scene, error);
      CHECK(Velocity(constraints[i], 0, DynamicsOf(scene)) == Approx(first).margin(1e-6));
      CHECK(constraints[i].rows[0].bias == Approx(second).margin(1e-5));
    }
  }
}

TEST_CASE(
    "rows in space: what a joint allows has no velocity and no error in its rows, which are independent") {
  std::mt19937 random(5);
  using Kind = JointKindInSpace;
  for (const auto& [kind, slide, turn] : std::vector<std::tuple<Kind, double, double>>{
           {Kind::kBall, 0, 1}, {Kind::kHinge, 0, 1}, {Kind::kRail, 0.7, 1}, {Kind::kSlider, 0.7, 0}}) {
    INFO("kind " << static_cast<int>(kind));
    SceneInSpace<double> scene;
    scene.bodies.resize(2);
    for (auto& body : scene.bodies)
      body.position = RandomVector(random), body.rotation = RandomRotation(random);
    auto &a = scene.bodies[0], &b = scene.bodies[1];
    const Vector at_b = RandomVector(random), p = b.At(at_b), direction = Vector(2, -1, 2) / 3;
    scene.joints.push_back(
        {kind, 0, 1, a.Local(p), at_b, direction, Product<double>(Conjugate<double>(b.rotation), a.rotation)});
    const Vector along = RotationMatrix<double>(b.rotation) * direction;
    const Vector axis = kind == Kind::kHinge ? along : RandomVector(random).normalized();
    b.velocity = RandomVector(random), b.spin = RandomVector(random);
    a.spin = b.spin + turn * axis;
    a.velocity = b.VelocityAt(p) + slide * along - CrossProduct<double>(a.spin, p - a.position);
    const auto rows = JointConstraints(scene);
    Eigen::MatrixXd J(rows.size(), 6);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      CHECK(Velocity(rows[i], 0, DynamicsOf(scene)) == Approx(0).margin(1e-14));
      J.row(static_cast<int>(i)) = rows[i].rows[0].J[0];
    }
    CHECK(J.fullPivLu().rank() == J.rows());
    const Quaternion<double> turned = MakeQuaternion<double>(std::cos(turn), std::sin(turn) * axis);
    a.rotation = Product<double>(turned, a.rotation);
    a.position = p + slide * along + RotationMatrix<double>(turned) * (a.position - p);
    for (const auto& row : JointConstraints(scene)) CHECK(row.rows[0].error == Approx(0).margin(1e-14));
  }
}

TEST_CASE("rows in space: velocity and bias of given contacts are the derivatives of their gap") {
  std::mt19937 random(3);
  SceneInSpace<double> scene = SceneOf({Box({1, 1, 1}, {0, 0, 0}, {1, 2, 3}, 0.5), Box({1, 1, 1}, {2, 1, 1})});
  for (auto& body : scene.bodies) body.velocity = RandomVector(random), body.spin = RandomVector(random);
  scene.contacts.push_back({0, 1, {0.5, 0.2, 0.1}, {-1, 0.3, 0.2}, {0.6, 0, 0.8}});
  const auto gap = [](const SceneInSpace<double>& at) { return FindContacts(at).at(0).gap; };
  const auto [first, second] = Derivatives(scene, gap);
  const auto given = ContactConstraint(scene, FindContacts(scene).at(0));
  CHECK(Velocity(given, 0, DynamicsOf(scene)) == Approx(first).margin(1e-6));
  CHECK(given.rows[0].bias == Approx(second).margin(1e-5));
}

// ---- Closed forms ----------------------------------------------------------------------------

struct SolvedInSpace {
  SceneModel<Rational, 6> model;
  std::vector<ExactVector> f;
  std::vector<Eigen::Matrix<Rational, 6, 1>> accelerations;
  Rational bound = 1;  // of Coulomb's law, the least of all problems
};

SolvedInSpace SolveScene(const SceneInSpace<Rational>& scene) {
  SolvedInSpace solved;
  solved.model = Assemble(scene, FindContacts(scene));
  for (std::size_t i = 0; i < solved.model.islands.size(); ++i) {
    const ExactAnswer solution = SolveInSpace(solved.model.Problem(i), {});
    REQUIRE(solution.outcome == Outcome::kSolved);
    solved.f.push_back(solution.f);
    solved.bound = std::min(solved.bound, *solution.bound);
  }
  solved.accelerations = BodyAccelerations(solved.model, solved.f);
  return solved;
}

TEST_CASE("scene in space: a box on a slope rests above mu = tan and slides below") {
  const auto rests = SolveScene(SpatialScene("box-on-slope-rests"));
  REQUIRE(rests.model.constraints.size() == 4);
  for (int i = 0; i < 6; ++i) CHECK(rests.accelerations[1][i] == 0);
  const auto slides = SolveScene(SpatialScene("box-on-slope-slides"));
  const double down = 10 * (0.6 - 2999.0 / 4000 * 0.8);
  CHECK(slides.accelerations[1][0].get_d() == Approx(-0.8 * down).epsilon(1e-12));
  CHECK(slides.accelerations[1][2].get_d() == Approx(-0.6 * down).epsilon(1e-12));
  for (const int i : {1, 3, 4, 5}) CHECK(slides.accelerations[1][i].get_d() == Approx(0).margin(1e-12));
}

TEST_CASE("scene in space: a thrown ball slides at mu g and gains spin") {
  const auto ball = SolveScene(SpatialScene("ball-slides-then-rolls"));
  REQUIRE(ball.model.constraints.size() == 1);
  CHECK(ball.model.constraints[0].law.kind == ContactKind::kSliding);
  CHECK(ball.accelerations[1][0] == -2);
  CHECK(ball.accelerations[1][2] == 0);
  CHECK(ball.accelerations[1][4] == 10);  // mu m g r / (2/5 m r^2)
}

TEST_CASE("scene in space: three legs bear what statics asks, four stand too") {
  const auto tripod = SolveScene(SpatialScene("tripod"));
  REQUIRE(tripod.f.size() == 1);
  REQUIRE(tripod.f[0].size() == 3);
  CHECK(tripod.f[0][0] == 20);
  CHECK(tripod.f[0][1] == Exactly("20/3"));
  CHECK(tripod.f[0][2] == Exactly("40/3"));
  const auto table = SolveScene(SpatialScene("table"));
  REQUIRE(table.f[0].size() == 4);
  CHECK(Rational(table.f[0].sum()) == 40);
  for (int i = 0; i < 6; ++i) CHECK(table.accelerations[1][i] == 0);
}

TEST_CASE("scene in space: the joint of a conical pendulum bears weight and centripetal force") {
  const auto pendulum = SolveScene(SpatialScene("conical-pendulum"));
  REQUIRE(pendulum.f[0].size() == 3);
  CHECK(pendulum.f[0][0] == Exactly("-15/2"));
  CHECK(pendulum.f[0][1] == 0);
  CHECK(pendulum.f[0][2] == 10);
}

// The force of a joint on its first body.
Vector3<Rational> JointForce(const SolvedInSpace& solved, int joint) {
  Vector3<Rational> force = Zero<Vector3<Rational>>();
  for (std::size_t i = 0; i < solved.f.size(); ++i) {
    int at = 0;
    for (const int k : solved.model.islands[i].constraints) {
      const auto& constraint = solved.model.constraints[k];
      for (const auto& row : constraint.rows) {
        const Rational f = solved.f[i][at++];
        if (constraint.from_joint && constraint.source == joint) force += row.J[0].head<3>() * f;
      }
    }
  }
  return force;
}

TEST_CASE("scene in space: a car hung from a slanted rail slides with g sin and does not swing") {
  const auto car = SolveScene(SpatialScene("cable-car"));
  REQUIRE(car.f.at(0).size() == 2);
  CHECK(car.accelerations[1].head<3>() == Exact(-6 * 4, 0, -6 * 3) / Rational(5));
  CHECK(car.accelerations[1].tail<3>() == Exact(0, 0, 0));
  CHECK(JointForce(car, 0) == Exact(-3 * 16, 0, 4 * 16) / Rational(5));
}

TEST_CASE(
    "scene in space: a gate on a leaning hinge is a pendulum of g sin, exactly, and on two hinges the same") {
  const auto gate = SolveScene(SpatialScene("leaning-gate"));
  REQUIRE(gate.f.at(0).size() == 5);
  const Rational spin = Exactly("1800/401");
  CHECK(gate.accelerations[1].tail<3>() == spin * Exact(0, 3, 4) / Rational(5));
  const Vector3<Rational> fall = spin * Exact(0, 4, -3) / Rational(5);
  CHECK(gate.accelerations[1].head<3>() == fall);
  CHECK(JointForce(gate, 0) == 3 * (fall + Exact(0, 0, 10)));
  auto scene = SpatialScene("leaning-gate");
  scene.joints.push_back(scene.joints[0]);
  for (auto* z : {&scene.joints[1].at_a[2], &scene.joints[1].at_b[2]}) *z -= Exactly("2/5");
  const auto twice = SolveScene(scene);
  CHECK(twice.f.at(0).size() == 10);
  CHECK(twice.accelerations == gate.accelerations);
}

// Virtual work. With phi the angle of the crank above the slider's direction and primes d/dphi at the start:
// crank pin (-4/5, 0, 3/5), piston (-7/5, 0, 0), the rod's centre their mean, its spin their difference over
// its length 6/5.
TEST_CASE("scene in space: a slider-crank starts as its reduced inertia asks, exactly") {
  const auto linkage = SolveScene(SpatialScene("slider-crank"));
  REQUIRE(linkage.f.size() == 1);
  CHECK(linkage.f[0].size() == 16);
  const Rational crank = Exactly("1/12") * Exactly("26/25") + Exactly("1/4");
  const Rational rod = Exactly("121/100") + Exactly("9/100") +
                       Exactly("1/12") * Exactly("29/20") * Exactly("1/2"),
                 piston = Exactly("49/25");
  const Rational moment = 10 * (Exactly("1/2") * Exactly("3/5") + Exactly("3/10"));
  const Rational angular = -moment / (crank + rod + piston);
  CHECK(linkage.accelerations[1].tail<3>() == Vector3<Rational>(0, -angular, 0));
  CHECK(linkage.accelerations[3].head<3>() == Vector3<Rational>(-Exactly("7/5") * angular, 0, 0));
  CHECK(linkage.accelerations[3].tail<3>() == Exact(0, 0, 0));
}

TEST_CASE("scene in space: a sledge on a slider pushes a box that would rest alone, both with 2 m/s^2") {
  const auto scene = SpatialScene("sledge-pushes-box");
  const auto pushed = SolveScene(scene);
  for (const int body : {1, 2}) {
    CHECK(pushed.accelerations[body][0].get_d() == Approx(-2 * 0.8).epsilon(1e-9));
    CHECK(pushed.accelerations[body][2].get_d() == Approx(-2 * 0.6).epsilon(1e-9));
    for (const int i : {1, 3, 4, 5}) CHECK(pushed.accelerations[body][i].get_d() == Approx(0).margin(1e-9));
  }
  // The slider bears the weight across the slope, and none along it.
  CHECK(JointForce(pushed, 0)[0].get_d() == Approx(-0.6 * 8).epsilon(1e-9));
  CHECK(JointForce(pushed, 0)[2].get_d() == Approx(0.8 * 8).epsilon(1e-9));
  auto alone = scene;
  alone.joints.clear();
  alone.bodies.pop_back();
  alone.pairs.clear();
  const auto rests = SolveScene(alone);
  for (int i = 0; i < 6; ++i) CHECK(rests.accelerations[1][i] == 0);
}

TEST_CASE("scene in space: a trapdoor leans on a box with 15 N, the floor holds it above mu = 3/8 only") {
  const auto rests = SolveScene(SpatialScene("trapdoor-rests"));
  for (int body = 0; body < 4; ++body) {
    for (int i = 0; i < 6; ++i) CHECK(rests.accelerations[body][i] == 0);
  }
  CHECK(JointForce(rests, 0) == Exact(9, 0, 13));
  auto below = SpatialScene("trapdoor-rests");
  below.mu = Exactly("37/100");
  const auto opens = SolveScene(below);
  CHECK(opens.accelerations[3][0] > 0);
  CHECK(opens.accelerations[2][4] > 0);
}

TEST_CASE("scene in space: a truck that accelerates leaves its crate behind with mu g, or takes it along") {
  auto scene = SpatialScene("crate-on-a-truck");
  const auto left = SolveScene(scene);
  CHECK(left.accelerations[0][0] == 6);
  CHECK(left.accelerations[2][0].get_d() == Approx(5).epsilon(1e-9));
  scene.mu = Exactly("3/5");
  const auto taken = SolveScene(scene);
  CHECK(taken.accelerations[2][0].get_d() == Approx(6).epsilon(1e-9));
}

TEST_CASE("scene in space: the gyroscopic moment is -w x (I w)") {
  SceneInSpace<Rational> scene;
  scene.bodies.emplace_back();
  scene.bodies[0].inertia = Vector3<Rational>(1, 2, 3).asDiagonal();
  scene.bodies[0].spin = Exact(1, 1, 1);
  const auto model = Assemble(scene, FindContacts(scene));
  const auto accelerations = BodyAccelerations(model, {});
  // Euler's equations: I1 w1' = (I2 - I3) w2 w3, ...
  CHECK(accelerations[0][3] == -1);
  CHECK(accelerations[0][4] == 1);
  CHECK(accelerations[0][5] == Exactly("-1/3"));
}

// ---- Minimal models --------------------------------------------------------------------------

TEST_CASE(
    "assemble in space: A is symmetric and semidefinite with b in its range, and minimal forces solve the full "
    "problem") {
  for (const char* name : {"box-on-slope-rests", "box-on-slope-slides", "ball-slides-then-rolls", "tripod",
                           "table", "conical-pendulum", "cable-car", "leaning-gate", "slider-crank",
                           "trapdoor-rests", "trapdoor-opens", "sledge-pushes-box"}) {
    INFO(name);
    const auto scene = SpatialScene(name);
    const auto solved = SolveScene(scene);
    for (std::size_t i = 0; i < solved.model.islands.size(); ++i) {
      const ExactProblem problem = solved.model.Problem(i);
      CHECK(IsSymmetric(problem));
      CHECK(IsPositiveSemidefinite(problem));
      CHECK(IsInRange(problem));
      CHECK(DenseOf(solved.model.InFactors(i)).A == problem.A);
    }
    const auto full = Assemble(scene, FindContacts(scene), Level::kForces, /*minimal=*/false);
    REQUIRE(full.islands.size() == 1);
    const ExactVector all = ExtendForces(solved.model, solved.f, full);
    CHECK(FindViolation(full.Problem(0), all, FrictionLaw::kCoulomb, solved.bound).value_or("") == "");
    CHECK(BodyAccelerations(full, {all}) == solved.accelerations);
  }
}

TEST_CASE(
    "assemble in space: a smooth inner contact of a face is dropped, exactly, a rough one and an outer one are "
    "not") {
  SceneInSpace<Rational> scene;
  scene.bodies.resize(2);
  scene.bodies[0].name = "plate", scene.bodies[1].name = "ground";
  scene.bodies[1].fixed = true;
  scene.bodies[0].position = Exact(0, 0, 1);
  scene.gravity = Exact(1, 2, -10);
  scene.bodies[0].torque = Exact(3, -2, 1);
  const std::vector<std::pair<double, double>> feet = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}, {0.5, 0.25}};
  for (const auto& [x, y] : feet)
    scene.contacts.push_back({0, 1, Exact(x, y, -1), Exact(0, 0, 0), Exact(0, 0, 1)});
  const auto smooth = Assemble(scene, FindContacts(scene));
  CHECK(smooth.redundant == std::vector{4});
  const auto solved = SolveScene(scene);
  const auto full = Assemble(scene, FindContacts(scene), Level::kForces, /*minimal=*/false);
  const ExactVector all = ExtendForces(solved.model, solved.f, full);
  CHECK(FindViolation(full.Problem(0), all, FrictionLaw::kCoulomb, 1).value_or("") == "");
  scene.mu = 1;
  CHECK(Assemble(scene, FindContacts(scene)).redundant.empty());
  scene.mu = 0;
  scene.contacts[4].at_a = Exact(1.5, 0, -1);
  CHECK(Assemble(scene, FindContacts(scene)).redundant.empty());
}

TEST_CASE("assemble in space: the direction of slip is a unit vector exactly") {
  SceneInSpace<Rational> scene = SpatialScene("ball-slides-then-rolls");
  scene.bodies[1].velocity = Exact(0.3, -0.7, 0);
  const auto model = Assemble(scene, FindContacts(scene));
  const auto& slip = model.constraints.at(0).law.slip;
  CHECK(Rational(slip[0] * slip[0] + slip[1] * slip[1]) == 1);
  const auto& rows = model.constraints[0].rows;
  const double x = Rational(slip[0] * rows[1].J[0][0] + slip[1] * rows[2].J[0][0]).get_d();
  const double y = Rational(slip[0] * rows[1].J[0][1] + slip[1] * rows[2].J[0][1]).get_d();
  CHECK(x == Approx(0.3 / std::hypot(0.3, 0.7)));
  CHECK(y == Approx(-0.7 / std::hypot(0.3, 0.7)));
}

}  // namespace
}  // namespace stiction
