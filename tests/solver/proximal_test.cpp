// SPDX-License-Identifier: Apache-2.0
// Proximal points: solved means solved; large sparse problems, singular ones among them; all kinds of contacts.

#include "solver/numeric/proximal.h"

#include <catch2/catch.hpp>

#include "corpus/record/sparse_matrix.h"
#include "corpus/rounded.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

SparseContactProblem<double> InDoubles(const ExactEntries& problem) {
  return Converted<double>(problem, &ToDouble);
}

// The error of the doubles in which a run ended, evaluated over rationals.
Rational ExactResidual(const ExactEntries& problem, const ProximalNewton<double>& method) {
  const ExactVector f = method.f().unaryExpr([](double x) { return Rational(x); });
  return LenientErrorOf(problem, f, ExactVector(problem.A * f + problem.b));
}

// `columns` discs of unit mass in a row of columns, `height` in each, between walls: a disc touches the one
// below and the one to its left. Gravity pulls down, and each disc is pushed by a small force of its own. Walls
// and floor carry two layers of contacts, so that A is singular.
ExactEntries Discs(int columns, int height, const Rational& mu) {
  struct Touch {
    int disc, other;  // other < 0: fixed
    bool below;
  };
  std::vector<Touch> touches;
  const auto disc = [height](int x, int y) { return x * height + y; };
  for (int x = 0; x < columns; ++x) {
    for (int y = 0; y < height; ++y) {
      for (int copy = 0; copy < (y == 0 ? 2 : 1); ++copy)
        touches.push_back({disc(x, y), y == 0 ? -1 : disc(x, y - 1), true});
      for (int copy = 0; copy < (x == 0 ? 2 : 1); ++copy)
        touches.push_back({disc(x, y), x == 0 ? -1 : disc(x - 1, y), false});
      if (x == columns - 1) touches.push_back({disc(x, y), -2, false});
    }
  }
  // Rows of J: per disc x, y and rotation times radius, whose inertia is 1/2.
  const int rows = 2 * static_cast<int>(touches.size());
  std::map<int, std::vector<std::pair<int, Rational>>> of_coordinate;
  ExactEntries problem;
  SparseMatrix A;
  problem.contacts.assign(touches.size(), {ContactKind::kStatic, mu, {}});
  problem.b = ExactVector::Constant(rows, Rational(0));
  for (int c = 0; c < static_cast<int>(touches.size()); ++c) {
    const Touch& touch = touches[c];
    const int outward = touch.other == -2 ? -1 : 1;
    const auto add = [&](int row, int d, int axis, int value) {
      const int push = (7 * d + 3) % 5 - 2;
      of_coordinate[3 * d + axis].emplace_back(row, value);
      if (axis < 2) problem.b[row] += value * (axis == 1 ? Rational(-10) : Rational(push, 4));
    };
    for (const int side : {1, -1}) {
      const int d = side == 1 ? touch.disc : touch.other;
      if (d < 0) continue;
      add(2 * c, d, touch.below ? 1 : 0, side * outward);
      add(2 * c + 1, d, touch.below ? 0 : 1, side * outward);
      add(2 * c + 1, d, 2, touch.below ? 1 : -1);
    }
  }
  for (const auto& [coordinate, entries] : of_coordinate) {
    const int inverse_mass = coordinate % 3 == 2 ? 2 : 1;
    for (const auto& [i, x] : entries) {
      for (const auto& [j, y] : entries) A[{i, j}] += inverse_mass * x * y;
    }
  }
  problem.A = ToEigen(A, rows, rows);
  return problem;
}

TEST_CASE("proximal: a thousand contacts of a heap, A singular, with friction and without", "[slow]") {
  for (const Rational& mu : {Rational(1, 5), Rational(0), Rational(3, 2)}) {
    if (Short() && mu != Rational(1, 5)) continue;
    CAPTURE(mu);
    const ExactEntries heap = Discs(30, 16, mu);
    REQUIRE(heap.contacts.size() > 1000);
    ProximalNewton<double> method;
    const RunEnd<> verdict = method.Run(InDoubles(heap));
    CHECK(verdict.outcome == Outcome::kSolved);
    CHECK(ExactResidual(heap, method) <= Rational(1, 100000000));
  }
}

TEST_CASE("proximal: bilateral, frictionless and sliding contacts, and an A without diagonal") {
  // A sliding contact with fF = -fN / 2 beside a bilateral row and a frictionless one.
  ExactProblem problem =
      MakeProblem({-1, -1, 1}, {{3, 1, 0, 1}, {1, 2, 1, 0}, {0, 1, 4, 1}, {1, 0, 1, 5}}, {1, -2, -3, 0});
  problem.contacts[0].kind = ContactKind::kBilateral;
  problem.contacts[2] = {ContactKind::kSliding, Rational(1, 2), {1, 0}};
  ProximalNewton<double> method;
  REQUIRE(method.Run(InDoubles(EntriesOf(problem))).outcome == Outcome::kSolved);
  const Eigen::VectorXd f = method.f(), a = method.a();
  CHECK(std::abs(a[0]) < 1e-7);
  CHECK(f[0] < 0);  // a bilateral force may pull
  CHECK(f[3] == Approx(-f[2] / 2));
  CHECK(a[1] >= -1e-7);
  CHECK(ExactResidual(EntriesOf(problem), method) <= Rational(1, 100000000));

  CHECK(method.Run(InDoubles(EntriesOf(NoContacts()))).outcome == Outcome::kSolved);
  const ExactProblem weightless = MakeProblem({-1}, {{0}}, {1});
  CHECK(method.Run(InDoubles(EntriesOf(weightless))).outcome == Outcome::kSolved);
}

// Of the first, forces that grow without end solve a problem whose mu differs by ever less: they may be called
// solved once that is within the residual.
TEST_CASE("proximal: without a solution, undecided, or solved by forces so large that mu need hardly differ") {
  ProximalNewton<double> method;
  for (const ExactProblem& problem : {NoSolution(), MakeProblem({-1}, {{0}}, {-1})}) {
    const RunEnd<> verdict = method.Run(InDoubles(EntriesOf(problem)));
    if (verdict.outcome == Outcome::kSolved) {
      CHECK(method.f().cwiseAbs().maxCoeff() > 1e7);
      continue;
    }
    CHECK(verdict.outcome == Outcome::kUndecided);
    CHECK(!verdict.reason.empty());
  }
}

}  // namespace
}  // namespace stiction
