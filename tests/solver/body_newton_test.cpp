// SPDX-License-Identifier: Apache-2.0
// Newton's method in the space of bodies: solved means solved; from a solution nothing is left to do; answers
// do not depend on earlier runs.

#include "solver/numeric/body_newton.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/solver/draw_factors.h"

namespace stiction {
namespace {

using testing::DrawFactors;
using testing::GateErrorOf;
using testing::InFactors;

TEST_CASE("body newton: from a solution it factors nothing, and stays there") {
  DrawFactors draw(3);
  BodyNewton method;
  int solved = 0;
  for (int repeat = 0; repeat < 100; ++repeat) {
    const FactoredProblem<double> problem = draw.Problem(2 + repeat % 2, {ContactKind::kStatic});
    method.aim = 1e-11;
    if (method.Run(problem).outcome != Outcome::kSolved || GateErrorOf(problem, method.f()) > 1e-12) continue;
    ++solved;
    const Eigen::VectorXd f = method.f();
    const RunEnd<> again = method.Run(problem, &f);
    CHECK(again.outcome == Outcome::kSolved);
    CHECK(again.statistics[Counter::kFactorizations] == 0);
    CHECK(method.f() == f);
  }
  CHECK(solved > 30);
}

TEST_CASE("body newton: answers do not depend on the runs before") {
  DrawFactors draw(4);
  std::vector<FactoredProblem<double>> problems;
  for (int repeat = 0; repeat < 40; ++repeat)
    problems.push_back(draw.Problem(2 + repeat % 2, {ContactKind::kStatic}));
  problems.push_back(problems.back());  // of the same pattern
  problems.back().contacts[0].mu = 3;
  BodyNewton used;
  for (const auto& problem : problems) {
    BodyNewton fresh;
    const RunEnd<> one = used.Run(problem), other = fresh.Run(problem);
    CHECK(one.statistics == other.statistics);
    CHECK(used.f() == fresh.f());
  }
}

TEST_CASE("body newton: nor on those of the same pattern, whose pivots were others") {
  DrawFactors draw(6);
  const std::vector<Contact<double>> contacts(6, {ContactKind::kSliding, 3000, {0.6, 0.8}});
  BodyNewton used;
  int loaded = 0;
  for (int repeat = 0; repeat < 40; ++repeat) {
    const Eigen::MatrixXd J = Eigen::MatrixXd::NullaryExpr(18, 12, [&draw] { return draw.Number(); });
    const Eigen::VectorXd w = Eigen::VectorXd::NullaryExpr(12, [&draw] { return draw.Number(); });
    const auto problem = InFactors(3, contacts, J, w, Eigen::VectorXd::Zero(18));
    BodyNewton fresh;
    CHECK(used.Run(problem).statistics == fresh.Run(problem).statistics);
    CHECK(used.f() == fresh.f());
    loaded += used.f().norm() > 0;
  }
  CHECK(loaded > 10);
}

TEST_CASE("body newton: a contact in other units is the same contact") {
  // J -> D J, c -> D c with a power of two per contact: the same run, forces over D, to the bit.
  DrawFactors draw(5);
  BodyNewton method;
  for (int repeat = 0; repeat < 60; ++repeat) {
    const FactoredProblem<double> problem =
        draw.Problem(2 + repeat % 2, {ContactKind::kStatic, ContactKind::kBilateral});
    const Eigen::VectorXd D = draw.Units(problem);
    const FactoredProblem<double> scaled = testing::InOtherUnits(problem, D);
    const RunEnd<> one = method.Run(problem);
    const Eigen::VectorXd f = method.f();
    const RunEnd<> other = method.Run(scaled);
    CHECK(one.outcome == other.outcome);
    CHECK(one.statistics == other.statistics);
    CHECK(f == D.cwiseProduct(method.f()));
  }
}

TEST_CASE("body newton: without a solution it is undecided, and says why") {
  // One contact that nothing can keep from closing: its row is zero, and b < 0.
  FactoredProblem<double> problem =
      InFactors(2, {{ContactKind::kFrictionless, 0.0, {0, 0}}}, Eigen::MatrixXd::Zero(1, 1),
                Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, -1));
  BodyNewton method;
  const RunEnd<> verdict = method.Run(problem);
  CHECK(verdict.outcome == Outcome::kUndecided);
  CHECK(!verdict.reason.empty());
  problem.c[0] = problem.b[0] = 1;
  CHECK(method.Run(problem).outcome == Outcome::kSolved);
  CHECK(method.f()[0] == 0);
}

TEST_CASE("body newton: from a start that is far off it begins as from none") {
  DrawFactors draw(7);
  BodyNewton method;
  method.failures = 1;
  method.steps = 6;
  int from_none = 0, from_start = 0;
  for (int repeat = 0; repeat < 200; ++repeat) {
    const FactoredProblem<double> problem = draw.Problem(2 + repeat % 2, {ContactKind::kStatic});
    const Eigen::VectorXd start =
        Eigen::VectorXd::NullaryExpr(problem.rows(), [&draw] { return draw.Number(); });
    from_none += method.Run(problem).outcome == Outcome::kSolved;
    from_start += method.Run(problem, &start).outcome == Outcome::kSolved;
  }
  CHECK(from_none > 50);
  CHECK(from_start > 95);  // 84 if it raised eps by and by
}

TEST_CASE(
    "body newton: from a start, points that gain nothing come to an end where no forces are good enough") {
  // Any force misses a millionth of what acts: two rows want different velocities of one body.
  Eigen::MatrixXd J(2, 1);
  J << 1, 1;
  const FactoredProblem<double> problem =
      InFactors(2, std::vector<Contact<double>>(2, {ContactKind::kBilateral, 0.0, {0, 0}}), J,
                Eigen::VectorXd::Constant(1, -1), Eigen::Vector2d(0, 1e-6));
  BodyNewton method;
  const Eigen::VectorXd start = Eigen::Vector2d::Ones();
  const RunEnd<> verdict = method.Run(problem, &start);
  CHECK(verdict.outcome == Outcome::kUndecided);
  CHECK(verdict.statistics[Counter::kPoints] < 30);
}

TEST_CASE("body newton: stopped, it tells the best forces so far, of a start that solves all of them") {
  const FactoredProblem<double> problem =
      InFactors(2, {{ContactKind::kFrictionless, 0.0, {0, 0}}}, Eigen::MatrixXd::Identity(1, 1),
                Eigen::VectorXd::Constant(1, -2), Eigen::VectorXd::Zero(1));
  const std::atomic<bool> stop = true;
  BodyNewton method;
  method.request().limits.stop = &stop;
  RunEnd<> verdict = method.Run(problem);
  CHECK(verdict.outcome == Outcome::kUndecided);
  CHECK(verdict.reason == kStopped);
  CHECK(verdict.statistics[Counter::kFactorizations] == 0);
  CHECK(method.f()[0] == 0);
  const Eigen::VectorXd near = Eigen::VectorXd::Constant(1, 2 + 1e-9);
  verdict = method.Run(problem, &near);
  CHECK(verdict.outcome == Outcome::kSolved);
  CHECK(method.f() == near);
}

TEST_CASE("body newton: a block on a slope in space rests inside its cone, and slides outside it") {
  // J = identity on one contact; w is gravity turned by the slope.
  for (const double down : {0.49, 0.51}) {
    const FactoredProblem<double> problem =
        InFactors(3, {{ContactKind::kStatic, 0.5, {0, 0}}}, Eigen::MatrixXd::Identity(3, 3),
                  Eigen::Vector3d(-1, down, 0), Eigen::VectorXd::Zero(3));
    BodyNewton method;
    REQUIRE(method.Run(problem).outcome == Outcome::kSolved);
    CHECK(method.f()[0] == Approx(1));
    CHECK(method.f()[1] == Approx(-std::min(down, 0.5)));
    CHECK(method.a()[1] == Approx(std::max(0.0, down - 0.5)).margin(1e-9));
  }
}

}  // namespace
}  // namespace stiction
