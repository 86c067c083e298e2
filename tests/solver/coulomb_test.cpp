// SPDX-License-Identifier: Apache-2.0
// Coulomb's law in space: the residual that measures it, and the solver that is judged by it.

#include "solver/numeric/coulomb.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <limits>

#include "solver/numeric/one_contact.h"
#include "solver/numeric/smooth_law.h"
#include "solver/problem/errors.h"
#include "solver/solve.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;
using Problem = ContactProblem<double>;

// n contacts, A = J J', b = J y with entries in [-1, 1]; + identity and any b where definite.
Problem RandomRound(int n, int columns, bool definite, Choices& choices) {
  static const std::vector<double> palette = {0.25, 0.5, 0.75, 1, 2};
  const auto draw = [&] { return static_cast<double>(choices.Integer(-1000, 1000)) / 1000; };
  Problem problem;
  problem.dimension = 3;
  for (int i = 0; i < n; ++i)
    problem.contacts.push_back({ContactKind::kStatic, palette[choices.Integer(0, 4)], {}});
  Problem::Matrix J(3 * n, columns);
  for (double& x : J.reshaped()) x = draw();
  Problem::Vector y(columns);
  for (double& x : y) x = draw();
  problem.A = J * J.transpose();
  problem.b = J * y;
  if (definite) {
    problem.A += Problem::Matrix::Identity(3 * n, 3 * n);
    for (double& x : problem.b) x += draw() - 0.5;
  }
  return problem;
}

Problem OneContact(double mu, std::vector<double> b) {
  Problem problem;
  problem.dimension = 3;
  problem.contacts = {{ContactKind::kStatic, mu, {}}};
  problem.A = Problem::Matrix::Identity(3, 3);
  problem.b = Eigen::Map<Problem::Vector>(b.data(), 3);
  return problem;
}

// ---- The residual ------------------------------------------------------------------------------

double ResidualOf(const Problem& problem, std::vector<double> f) {
  const Problem::Vector forces = Eigen::Map<Problem::Vector>(f.data(), static_cast<int>(f.size()));
  return ErrorOf(problem, forces, Problem::Vector(problem.A * forces + problem.b));
}

TEST_CASE("coulomb residual: zero at solutions, and only there") {
  // Slip: fN = 1, friction 1/2 against (3, 4) / 5.
  const Problem slips = OneContact(0.5, {-1, 3, 4});
  CHECK(ResidualOf(slips, {1, -0.3, -0.4}) <= 1e-15);
  CHECK(ResidualOf(slips, {1, -0.4, -0.3}) > 0.01);  // allowed by (21), (22), not by Coulomb
  CHECK(ResidualOf(slips, {1, -0.15, -0.2}) > 0.01);
  CHECK(ResidualOf(slips, {1, 0.3, 0.4}) > 0.01);
  CHECK(ResidualOf(slips, {1.1, -0.33, -0.44}) > 0.01);
  const Problem sticks = OneContact(0.5, {-1, 0.3, -0.1});
  CHECK(ResidualOf(sticks, {1, -0.3, 0.1}) <= 1e-15);
  CHECK(ResidualOf(sticks, {1, -0.3, 0}) > 0.01);
  const Problem parts = OneContact(0.5, {1, 3, 4});
  CHECK(ResidualOf(parts, {0, 0, 0}) == 0);
  CHECK(ResidualOf(parts, {0.5, 0, 0}) > 0.01);
  CHECK(std::isinf(ResidualOf(parts, {std::numeric_limits<double>::quiet_NaN(), 0, 0})));
}

TEST_CASE("coulomb residual: bilateral and sliding contacts") {
  Problem held;
  held.dimension = 3;
  held.contacts = {{ContactKind::kBilateral, 0, {}}};
  held.A = Problem::Matrix::Identity(1, 1);
  held.b = Problem::Vector::Ones(1);
  CHECK(ResidualOf(held, {-1}) == 0);
  CHECK(ResidualOf(held, {0}) > 0.1);
  Problem slides = OneContact(0.5, {-1, 3, 4});
  slides.contacts[0].kind = ContactKind::kSliding;
  slides.contacts[0].slip = {0, 1};
  CHECK(ResidualOf(slides, {1, 0, -0.5}) == 0);
  CHECK(ResidualOf(slides, {1, 0, 0.5}) > 0.1);
}

// ---- One contact -------------------------------------------------------------------------------

TEST_CASE("one contact: its force obeys the law, also where W is not symmetric") {
  Choices choices(11);
  const auto draw = [&] { return static_cast<double>(choices.Integer(-100, 100)) / 50; };
  std::array<int, 3> counts = {0, 0, 0};  // parts, sticks, slips
  for (int index = 0; index < 2000; ++index) {
    CAPTURE(index);
    Problem problem = OneContact(index % 10 == 0 ? 0 : std::abs(draw()), {draw(), draw(), draw()});
    Problem::Matrix J(3, 3);
    for (double& x : J.reshaped()) x = draw();
    problem.A = J * J.transpose() + 0.1 * Problem::Matrix::Identity(3, 3);
    if (index % 2 == 0) problem.A(1, 0) += 0.01;
    const auto f = SolveOneContact<double>(problem.A, problem.b, problem.contacts[0].mu);
    CHECK(ResidualOf(problem, {f[0], f[1], f[2]}) < 1e-11);
    const double slack = problem.contacts[0].mu * f[0] - std::hypot(f[1], f[2]);
    ++counts[f[0] == 0 ? 0 : slack > 1e-9 ? 1 : 2];
  }
  for (const int count : counts) CHECK(count > 200);
  const auto immovable = SolveOneContact<double>(Eigen::Vector3d(1, 0, 0).asDiagonal(), {-1, 3, 4}, 0.5);
  CHECK(std::hypot(immovable[1] + 0.3, immovable[2] + 0.4) < 1e-14);
}

// ---- The smoothed law --------------------------------------------------------------------------

TEST_CASE("smoothed law: its derivatives are those of its values") {
  Choices choices(17);
  const auto draw = [&] { return static_cast<double>(choices.Integer(-100, 100)) / 50; };
  for (int index = 0; index < 500; ++index) {
    CAPTURE(index);
    const Eigen::Vector3d f(draw(), draw(), draw()), a(draw(), draw(), draw());
    const double mu = 0.1 + std::abs(draw()), r = 0.1 + std::abs(draw()), m = index % 3 == 0 ? 0.01 : 1;
    const auto law = [&](const Eigen::Vector3d& at, const Eigen::Vector3d& response) {
      return SmoothStatic<double>(at, response, mu, r, m, 0.1);
    };
    const auto here = law(f, a);
    const double step = 1e-6;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d d = step * Eigen::Vector3d::Unit(k);
      CHECK(((law(f + d, a).h - law(f - d, a).h) / (2 * step) - here.by_f.col(k)).norm() < 1e-4);
      CHECK(((law(f, a + d).h - law(f, a - d).h) / (2 * step) - here.by_a.col(k)).norm() < 1e-4);
    }
  }
}

TEST_CASE("smoothed law: with m = 0 it is Coulomb's law") {
  const auto law = [](const std::vector<double>& f, const std::vector<double>& a) {
    return SmoothStatic<double>(Eigen::Vector3d(f[0], f[1], f[2]), Eigen::Vector3d(a[0], a[1], a[2]), 0.5, 1,
                                1e-9, 1e-9)
        .h.norm();
  };
  CHECK(law({1, -0.3, -0.4}, {0, 3, 4}) < 1e-8);    // slips
  CHECK(law({1, -0.4, -0.3}, {0, 3, 4}) > 0.01);    // not against its motion
  CHECK(law({1, -0.2, -0.1}, {0, 3, 4}) > 0.01);    // too little
  CHECK(law({1, -0.2, -0.1}, {0, 0, 0}) < 1e-8);    // sticks
  CHECK(law({1, -0.2, -0.1}, {0.1, 0, 0}) > 0.01);  // parts, with a force
  CHECK(law({0, 0, 0}, {0.1, 3, 4}) < 1e-8);        // parts
  CHECK(law({0, 0, 0}, {-0.1, 3, 4}) > 0.01);       // sinks
}

// ---- The solver --------------------------------------------------------------------------------

TEST_CASE("coulomb: one contact slips, sticks, parts") {
  for (const CoulombStart start : {CoulombStart::kSweeps, CoulombStart::kComplete}) {
    CoulombSolver<double> solver({}, start);
    const auto solve = [&solver](const Problem& problem) {
      REQUIRE(solver.Run(problem).outcome == Outcome::kSolved);
      return solver.f();
    };
    CHECK((solve(OneContact(0.5, {-1, 3, 4})) - Eigen::Vector3d(1, -0.3, -0.4)).norm() < 1e-14);
    CHECK((solve(OneContact(0.5, {-1, 0.3, -0.1})) - Eigen::Vector3d(1, -0.3, 0.1)).norm() < 1e-14);
    CHECK(solve(OneContact(0.5, {1, 3, 4})).norm() == 0);
  }
}

TEST_CASE("coulomb: random problems are solved to rounding, from either start") {
  for (const CoulombStart start : {CoulombStart::kSweeps, CoulombStart::kComplete}) {
    CoulombSolver<double> solver({}, start);
    std::int64_t polygons = 0;
    for (int index = 0; index < 240; ++index) {
      CAPTURE(index);
      Choices choices(index);
      const int n = 1 + index % 8;
      const bool definite = index % 2 == 0;
      const Problem problem = RandomRound(n, definite ? 3 * n : 1 + index % 7, definite, choices);
      const RunEnd<> verdict = solver.Run(problem);
      CHECK(verdict.outcome == Outcome::kSolved);
      CHECK(ErrorOf(problem, solver.f(), solver.a()) < (definite ? 1e-13 : 1e-8));
      polygons += verdict.statistics[Counter::kPolygons];
    }
    CHECK((start == CoulombStart::kComplete ? polygons > 200 : polygons < 50));  // f = 0 asks for none
  }
}

// Every contact `copies` times: forces are far from unique. `skew` makes A asymmetric, and leaves b in its
// range.
Problem Repeated(int n, int copies, double skew, Choices& choices) {
  const auto draw = [&] { return static_cast<double>(choices.Integer(-1000, 1000)) / 1000; };
  Problem problem;
  problem.dimension = 3;
  problem.contacts.assign(n * copies, {ContactKind::kStatic, 0.7, {}});
  Problem::Matrix J(3 * n * copies, 3 * n), left;
  for (int i = 0; i < 3 * n; ++i) {
    for (int j = 0; j < 3 * n; ++j) J(i, j) = draw();
  }
  for (int k = 1; k < copies; ++k) J.middleRows(3 * n * k, 3 * n) = J.topRows(3 * n);
  left = J;
  for (double& x : left.reshaped()) x += skew * draw();
  Problem::Vector y(3 * n);
  for (double& x : y) x = draw();
  problem.A = left * J.transpose();
  problem.b = left * y;
  return problem;
}

TEST_CASE("coulomb: repeated contacts are solved without polygons") {
  CoulombSolver<double> solver({.sides = 0});
  for (int index = 0; index < 60; ++index) {
    CAPTURE(index);
    Choices choices(7000 + index);
    const Problem problem = Repeated(2 + index % 3, 2 + index % 4, 0, choices);
    const RunEnd<> verdict = solver.Run(problem);
    CHECK(verdict.outcome == Outcome::kSolved);
    CHECK(ErrorOf(problem, solver.f(), solver.a()) <= 1e-8);
  }
}

// Boxes on top of each other, four contacts each: nothing keeps all of them quite at rest, but for `noise` = 0.
Problem NoisyStack(int boxes, double noise, Choices& choices) {
  const auto draw = [&] { return static_cast<double>(choices.Integer(-1000, 1000)) / 1000; };
  Problem problem;
  problem.dimension = 3;
  problem.contacts.assign(4 * boxes, {ContactKind::kStatic, 0.5, {}});
  Problem::Matrix J = Problem::Matrix::Zero(12 * boxes, 6 * boxes);  // normal, tangents | velocities and spins
  for (int i = 0; i < 4 * boxes; ++i) {
    const int box = i / 4;
    for (const int on : {box, box - 1}) {
      if (on < 0) continue;
      const double sign = on == box ? 1 : -1;
      const Eigen::Vector3d arm(i % 2 - 0.5, i / 2 % 2 - 0.5, -0.5 * sign);
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d along = Eigen::Vector3d::Unit((k + 2) % 3);
        J.block<1, 3>(3 * i + k, 6 * on) = sign * along.transpose();
        J.block<1, 3>(3 * i + k, 6 * on + 3) = 6 * sign * arm.cross(along).transpose();
      }
    }
  }
  Problem::Vector free = Problem::Vector::Zero(6 * boxes);
  for (int box = 0; box < boxes; ++box) free.segment<3>(6 * box) << draw(), draw(), -10;
  problem.A = J * J.transpose();
  problem.b = J * free;
  for (double& x : problem.b) x += noise * draw();
  return problem;
}

TEST_CASE("coulomb: contacts at rest that b does not quite leave at rest are solved without polygons",
          "[slow]") {
  int solved = 0;
  for (int index = 0; index < 60; ++index) {
    CAPTURE(index);
    Choices choices(6000 + index);
    const Problem problem = NoisyStack(1 + index % 3, std::pow(10, -7 + index % 4), choices);
    const Answer<double> answer = Solve(problem, {.method = "fast", .sides = 0});
    solved += answer.Solved();
    if (answer.Solved()) CHECK(answer.errors->Largest() <= kSolvedResidual<double>);
  }
  CHECK(solved > 52);
}

TEST_CASE("coulomb: a slightly asymmetric matrix is solved as it is") {
  CoulombSolver<double> solver;
  for (int index = 0; index < 60; ++index) {
    CAPTURE(index);
    Choices choices(8000 + index);
    Problem problem = Repeated(2 + index % 5, 1, 1e-3, choices);
    CHECK((problem.A - problem.A.transpose()).norm() > 1e-4);
    CHECK(solver.Run(problem).outcome == Outcome::kSolved);
    const Problem::Vector f = solver.f();
    CHECK(ErrorOf(problem, f, Problem::Vector(problem.A * f + problem.b)) <= 1e-8);
  }
}

TEST_CASE("coulomb: asymmetric problems with repeated contacts are solved without polygons too", "[slow]") {
  CoulombSolver<double> solver({.sides = 0});
  const int problems = testing::Few(60);
  int solved = 0;
  for (int index = 0; index < problems; ++index) {
    Choices choices(9000 + index);
    solved += solver.Run(Repeated(6, 4, 1e-3, choices)).outcome == Outcome::kSolved;
  }
  CHECK(solved == problems);
}

TEST_CASE("coulomb: what has no solution is undecided") {
  // A wedge: aN + ax = -1 whatever the forces.
  Problem problem = OneContact(1, {-1, 0, 0});
  problem.A << 1, -1, 0, -1, 1, 0, 0, 0, 1;
  const Answer<double> answer = Solve(problem, {.method = "fast"});
  CHECK(answer.outcome == Outcome::kUndecided);
  CHECK_FALSE(answer.reason.empty());
  problem.b[0] = std::numeric_limits<double>::infinity();
  CHECK(Solve(problem, {.method = "fast"}).outcome == Outcome::kUndecided);
}

TEST_CASE("coulomb: no contacts, no forces") {
  Problem problem;
  problem.dimension = 3;
  problem.A.resize(0, 0);
  problem.b.resize(0);
  CHECK(CoulombSolver<double>().Run(problem).outcome == Outcome::kSolved);
}

TEST_CASE("coulomb: a start that is given is used") {
  const Problem problem = OneContact(0.5, {-1, 3, 4});
  const Problem::Vector start = Eigen::Vector3d(1, -0.3, -0.4);
  CoulombSolver<double> solver;
  const RunEnd<> verdict = solver.Run(problem, &start);
  CHECK(verdict.outcome == Outcome::kSolved);
  CHECK(verdict.statistics[Counter::kSweeps] == 0);
  CHECK(verdict.statistics[Counter::kNewtonSteps] <= 1);
}

}  // namespace
}  // namespace stiction
