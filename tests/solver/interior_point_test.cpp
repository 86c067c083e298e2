// SPDX-License-Identifier: Apache-2.0
// The interior point method in the space of bodies: solved means solved; it ends where Newton's method without
// a start does not; answers do not depend on earlier runs, nor on the unit of a contact.

#include "solver/numeric/interior_point.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/solver/draw_factors.h"

namespace stiction {
namespace {

using testing::DrawFactors;
using testing::GateErrorOf;
using testing::InFactors;

TEST_CASE("interior point: static and bilateral contacts are solved, all but a few, and solved means solved") {
  DrawFactors draw(11);
  InteriorPoint method;
  int solved = 0;
  constexpr int kProblems = 300;
  for (int repeat = 0; repeat < kProblems; ++repeat) {
    const FactoredProblem<double> problem = draw.Problem(
        2 + repeat % 2,
        {ContactKind::kStatic, ContactKind::kStatic, ContactKind::kFrictionless, ContactKind::kBilateral});
    if (method.Run(problem).outcome != Outcome::kSolved) continue;
    ++solved;
    CHECK(method.error() <= 1e-8);
    CHECK(GateErrorOf(problem, method.f()) <= 2e-8);
    CHECK((method.a() - problem.Accelerations(method.f())).norm() <= 1e-12 * (1 + method.f().norm()));
  }
  CHECK(solved >= kProblems * 98 / 100);
}

TEST_CASE("interior point: sliding contacts obey their law where it ends") {
  DrawFactors draw(12);
  InteriorPoint method;
  int solved = 0;
  for (int repeat = 0; repeat < 100; ++repeat) {
    const FactoredProblem<double> problem =
        draw.Problem(2 + repeat % 2, {ContactKind::kSliding, ContactKind::kStatic});
    const RunEnd<> end = method.Run(problem);
    CHECK(end.reason.empty() == (end.outcome == Outcome::kSolved));
    if (end.outcome != Outcome::kSolved) continue;
    ++solved;
    CHECK(GateErrorOf(problem, method.f()) <= 2e-8);
  }
  CHECK(solved > 50);
}

TEST_CASE("interior point: answers do not depend on the runs before") {
  DrawFactors draw(4);
  std::vector<FactoredProblem<double>> problems;
  for (int repeat = 0; repeat < 40; ++repeat)
    problems.push_back(draw.Problem(2 + repeat % 2, {ContactKind::kStatic}));
  problems.push_back(problems.back());  // of the same pattern
  problems.back().contacts[0].mu = 3;
  InteriorPoint used;
  for (const auto& problem : problems) {
    InteriorPoint fresh;
    CHECK(used.Run(problem).statistics == fresh.Run(problem).statistics);
    CHECK(used.f() == fresh.f());
  }
}

TEST_CASE("interior point: a contact in other units is the same contact") {
  DrawFactors draw(5);
  InteriorPoint method;
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

TEST_CASE("interior point: no forces where they are a solution, and nothing is factored for it") {
  InteriorPoint method;
  const FactoredProblem<double> parts =
      InFactors(3, {{ContactKind::kStatic, 0.5, {0, 0}}}, Eigen::MatrixXd::Identity(3, 3),
                Eigen::Vector3d(1, 2, 0), Eigen::VectorXd::Zero(3));
  const RunEnd<> end = method.Run(parts);
  CHECK(end.outcome == Outcome::kSolved);
  CHECK(end.statistics[Counter::kFactorizations] == 0);
  CHECK(method.f().isZero(0));
}

TEST_CASE("interior point: without a solution it is undecided, and says why, as it does when it is stopped") {
  FactoredProblem<double> problem =
      InFactors(2, {{ContactKind::kFrictionless, 0.0, {0, 0}}}, Eigen::MatrixXd::Zero(1, 1),
                Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, -1));
  InteriorPoint method;
  const RunEnd<> without = method.Run(problem);
  CHECK(without.outcome == Outcome::kUndecided);
  CHECK(!without.reason.empty());
  CHECK(method.f().size() == 1);
  const std::atomic<bool> stop = true;
  method.request().limits.stop = &stop;
  problem.c[0] = problem.b[0] = -2;
  const RunEnd<> stopped = method.Run(problem);
  CHECK(stopped.outcome == Outcome::kUndecided);
  CHECK(stopped.reason == kStopped);
  CHECK(stopped.statistics[Counter::kFactorizations] == 0);
  InteriorPoint other;  // that has no forces of an earlier run
  other.request().limits.stop = &stop;
  other.Run(problem);
  CHECK(other.f().isZero(0));
  CHECK(other.f().size() == 1);
}

TEST_CASE("interior point: a block on a slope in space rests inside its cone, and slides outside it") {
  for (const double down : {0.49, 0.51}) {
    const FactoredProblem<double> problem =
        InFactors(3, {{ContactKind::kStatic, 0.5, {0, 0}}}, Eigen::MatrixXd::Identity(3, 3),
                  Eigen::Vector3d(-1, down, 0), Eigen::VectorXd::Zero(3));
    InteriorPoint method;
    REQUIRE(method.Run(problem).outcome == Outcome::kSolved);
    CHECK(method.f()[0] == Approx(1));
    CHECK(method.f()[1] == Approx(-std::min(down, 0.5)));
    CHECK(method.a()[1] == Approx(std::max(0.0, down - 0.5)).margin(1e-9));
  }
}

// In the plane: rows, velocities, mu; the diagonal of M; w; c; a row of J each line, as column:entry.
FactoredProblem<double> ReadImpact(const std::string& name) {
  std::ifstream in(std::string(STICTION_SOURCES) + "/tests/solver/" + name);
  int rows = 0, velocities = 0;
  double mu = 0;
  REQUIRE(in >> rows >> velocities >> mu);
  Eigen::VectorXd masses(velocities), w(velocities), c(rows);
  for (double& x : masses) in >> x;
  for (double& x : w) in >> x;
  for (double& x : c) in >> x;
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(rows, velocities);
  std::string line;
  std::getline(in, line);
  for (int row = 0; row < rows; ++row) {
    REQUIRE(std::getline(in, line));
    std::istringstream entries(line);
    int column = 0;
    char colon = 0;
    double x = 0;
    while (entries >> column >> colon >> x) J(row, column) = x;
  }
  FactoredProblem<double> problem;
  Eigen::SparseMatrix<double> M(velocities, velocities), W(velocities, velocities);
  for (int k = 0; k < velocities; ++k) {
    M.insert(k, k) = masses[k];
    W.insert(k, k) = 1 / masses[k];
  }
  problem.dimension = 2;
  problem.contacts.assign(static_cast<std::size_t>(rows / 2), {ContactKind::kStatic, mu, {0, 0}});
  problem.A = FactoredMatrix<double>(J.sparseView(), W);
  problem.M = M;
  problem.w = w;
  problem.c = c;
  problem.b = J * w + c;
  return problem;
}

// Neither ends below 1e-8 in steps to smaller tau alone.
TEST_CASE("interior point: a path that turns back is followed to its end") {
  for (const char* name : {"path_that_turns_back.txt", "path_to_its_end.txt"}) {
    const FactoredProblem<double> problem = ReadImpact(name);
    InteriorPoint method({.noise = 1e-11 * problem.b.cwiseAbs().maxCoeff()});
    method.measure = BestForces::Measure::kLenient;
    method.loose = 1e-5;
    const RunEnd<> end = method.Run(problem);
    INFO(name);
    CHECK(end.outcome == Outcome::kSolved);
    CHECK(end.statistics[Counter::kStarts] == 3);  // the first that goes by the curve's length
    CHECK(method.error() <= 1e-8);
  }
}

TEST_CASE("interior point: a contact that hardly feels an impact is right in its own unit") {
  // Two blocks in a row; the second touches the first by a thread of 1e-10.
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(4, 4);
  J.topLeftCorner(2, 2).setIdentity();
  J.bottomRightCorner(2, 2).setIdentity();
  J(2, 0) = 1e-10;
  const Eigen::Vector4d w(-1, 0.2, 0, 1e-12);
  const FactoredProblem<double> problem = InFactors(
      2, std::vector<Contact<double>>(2, {ContactKind::kStatic, 0.5, {0, 0}}), J, w, Eigen::VectorXd::Zero(4));
  InteriorPoint method;
  REQUIRE(method.Run(problem).outcome == Outcome::kSolved);
  CHECK(GateErrorOf(problem, method.f()) <= 1e-8);
  // The first is stopped: so the second feels nothing normal.
  CHECK(method.f()[0] == Approx(1).epsilon(1e-9));
  CHECK(std::abs(method.a()[2]) < 1e-18);
}

}  // namespace
}  // namespace stiction
