// SPDX-License-Identifier: Apache-2.0
// Newton's method in the space of bodies: solved means solved; from a solution nothing is left to do; answers
// do not depend on earlier runs.

#include "solver/numeric/body_newton.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "solver/problem/gate.h"
#include "tests/factored.h"

namespace stiction {
namespace {

using testing::InFactors;

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}

  double Number() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  int Integer(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }

  // Contacts of the kinds given on fewer velocities than rows, so that A is singular. Without sliding contacts
  // it has solutions: b is in range(A).
  FactoredProblem<double> Problem(int dimension, const std::vector<ContactKind>& kinds) {
    std::vector<Contact<double>> contacts;
    for (int i = Integer(1, 8); i > 0; --i) {
      Contact<double> contact;
      contact.kind = kinds[static_cast<std::size_t>(Integer(0, static_cast<int>(kinds.size()) - 1))];
      if (contact.HasFrictionRows()) contact.mu = Integer(0, 4) / 4.0;
      if (contact.kind == ContactKind::kSliding) contact.slip = {1, 0};
      contacts.push_back(contact);
    }
    const int rows = RowCount(contacts, dimension), velocities = Integer(1, rows);
    const Eigen::MatrixXd J = Eigen::MatrixXd::NullaryExpr(rows, velocities, [this] { return Number(); });
    const Eigen::VectorXd w = Eigen::VectorXd::NullaryExpr(velocities, [this] { return Number(); });
    return InFactors(dimension, contacts, J, w, Eigen::VectorXd::Zero(rows));
  }

 private:
  std::mt19937 random_;
};

double GateErrorOf(const FactoredProblem<double>& problem, const Eigen::VectorXd& f) {
  return BoundErrors(DenseOf(problem), FrictionLaw::kCoulomb, f, GateOf<double>()).Largest();
}

TEST_CASE("body newton: from a solution it factors nothing, and stays there") {
  Draw draw(3);
  BodyNewton<double> method;
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
  Draw draw(4);
  std::vector<FactoredProblem<double>> problems;
  for (int repeat = 0; repeat < 40; ++repeat)
    problems.push_back(draw.Problem(2 + repeat % 2, {ContactKind::kStatic}));
  problems.push_back(problems.back());  // of the same pattern
  problems.back().contacts[0].mu = 3;
  BodyNewton<double> used;
  for (const auto& problem : problems) {
    BodyNewton<double> fresh;
    const RunEnd<> one = used.Run(problem), other = fresh.Run(problem);
    CHECK(one.statistics == other.statistics);
    CHECK(used.f() == fresh.f());
  }
}

TEST_CASE("body newton: nor on those of the same pattern, whose pivots were others") {
  Draw draw(6);
  const std::vector<Contact<double>> contacts(6, {ContactKind::kSliding, 3000, {0.6, 0.8}});
  BodyNewton<double> used;
  int loaded = 0;
  for (int repeat = 0; repeat < 40; ++repeat) {
    const Eigen::MatrixXd J = Eigen::MatrixXd::NullaryExpr(18, 12, [&draw] { return draw.Number(); });
    const Eigen::VectorXd w = Eigen::VectorXd::NullaryExpr(12, [&draw] { return draw.Number(); });
    const auto problem = InFactors(3, contacts, J, w, Eigen::VectorXd::Zero(18));
    BodyNewton<double> fresh;
    CHECK(used.Run(problem).statistics == fresh.Run(problem).statistics);
    CHECK(used.f() == fresh.f());
    loaded += used.f().norm() > 0;
  }
  CHECK(loaded > 10);
}

TEST_CASE("body newton: a contact in other units is the same contact") {
  // J -> D J, c -> D c with a power of two per contact: the same run, forces over D, to the bit.
  Draw draw(5);
  BodyNewton<double> method;
  for (int repeat = 0; repeat < 60; ++repeat) {
    const FactoredProblem<double> problem =
        draw.Problem(2 + repeat % 2, {ContactKind::kStatic, ContactKind::kBilateral});
    Eigen::VectorXd D(problem.rows());
    int row = 0;
    for (const auto& contact : problem.contacts) {
      const double unit = std::ldexp(1.0, draw.Integer(-30, 30));
      for (int k = contact.HasFrictionRows() ? problem.dimension : 1; k > 0; --k) D[row++] = unit;
    }
    const Eigen::MatrixXd J = problem.A.J();
    const FactoredProblem<double> scaled = InFactors(problem.dimension, problem.contacts, D.asDiagonal() * J,
                                                     problem.w, D.cwiseProduct(problem.c));
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
  BodyNewton<double> method;
  const RunEnd<> verdict = method.Run(problem);
  CHECK(verdict.outcome == Outcome::kUndecided);
  CHECK(!verdict.reason.empty());
  problem.c[0] = problem.b[0] = 1;
  CHECK(method.Run(problem).outcome == Outcome::kSolved);
  CHECK(method.f()[0] == 0);
}

TEST_CASE("body newton: stopped, it tells the best forces so far, of a start that solves all of them") {
  const FactoredProblem<double> problem =
      InFactors(2, {{ContactKind::kFrictionless, 0.0, {0, 0}}}, Eigen::MatrixXd::Identity(1, 1),
                Eigen::VectorXd::Constant(1, -2), Eigen::VectorXd::Zero(1));
  const std::atomic<bool> stop = true;
  BodyNewton<double> method;
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
    BodyNewton<double> method;
    REQUIRE(method.Run(problem).outcome == Outcome::kSolved);
    CHECK(method.f()[0] == Approx(1));
    CHECK(method.f()[1] == Approx(-std::min(down, 0.5)));
    CHECK(method.a()[1] == Approx(std::max(0.0, down - 0.5)).margin(1e-9));
  }
}

}  // namespace
}  // namespace stiction
