// SPDX-License-Identifier: Apache-2.0
// Refinement: noise that methods leave is taken away, and what passes is left as it is.

#include "solver/numeric/refine.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "corpus/rounded.h"
#include "solver/problem/gate.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

Refined RefinedOf(const ExactProblem& problem, const Eigen::VectorXd& f) {
  return Refine(Rounded<double>(problem), FrictionLaw::kCoulomb, GateOf<double>(), f);
}

// Contacts 1 and 3 bear all, 1 with friction at its limit though it rests; 2 touches and bears nothing. As (A,
// b) of integers have it: f = (15, -30, 0, 0, 55, 46) / 74.
ExactProblem IdleContact() {
  return MakeProblem({2, 2, 1},
                     {{19, -25, 11, 2, -1, -2},
                      {-25, 45, 3, 9, 15, -11},
                      {11, 3, 35, 30, 7, -10},
                      {2, 9, 30, 54, -30, 25},
                      {-1, 15, 7, -30, 59, -54},
                      {-2, -11, -10, 25, -54, 50}},
                     {-12, 19, 0, 10, -4, 5});
}

TEST_CASE("refine: a contact that touches and bears noise is idle, and keeps still") {
  Eigen::VectorXd f(6);
  f << 0.20270270270270346, -0.4054054054054069, 4.8e-16, 9.6e-16, 0.7432432432432542, 0.6216216216216327;
  const auto problem = Rounded<double>(IdleContact());
  REQUIRE(BoundErrors(problem, FrictionLaw::kCoulomb, f, GateOf<double>()).Largest() > 1e-8);
  const Refined refined = RefinedOf(IdleContact(), f);
  CHECK(refined.errors.Largest() < 1e-8);
  CHECK(refined.f[2] == 0);
  CHECK(refined.f[3] == 0);
  CHECK(std::abs(refined.f[0] - 15.0 / 74) < 1e-14);
  CHECK(std::abs(refined.f[4] - 55.0 / 74) < 1e-14);
}

// Two contacts that do not see each other: 1 rests, 2 parts.
ExactProblem OneParts() {
  return MakeProblem({1, 1}, {{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 2, 0}, {0, 0, 0, 2}}, {-2, 2, 3, 0});
}

TEST_CASE("refine: forces at a contact that parts, and friction above its limit, are noise") {
  const Refined refined = RefinedOf(OneParts(), Eigen::Vector4d(1, -1 - 1e-15, 1e-13, 1e-14));
  CHECK(refined.errors.Largest() < 1e-8);
  CHECK(refined.f == Eigen::Vector4d(1, -1, 0, 0));
}

TEST_CASE("refine: what passes stays to the last bit, and what is no solution stays refused") {
  const Eigen::Vector4d right(1 + 1e-12, -1 - 1e-12, 0, 0);
  CHECK(RefinedOf(OneParts(), right).f == right);
  CHECK(RefinedOf(NoSolution(), Eigen::Vector2d(1, 1)).errors.Largest() > 1e-8);
}

TEST_CASE("refine: forces that press for nothing are replaced by the least") {
  // Between two walls: (1, 1) along the normals does no work, and lends its rounding.
  const ExactProblem jam =
      MakeProblem({1, 1}, {{2, 0, -2, 0}, {0, 2, 0, 2}, {-2, 0, 2, 0}, {0, 2, 0, 2}}, {0, -1, 0, -1});
  const Refined refined = RefinedOf(jam, Eigen::Vector4d(1e9, 0.25, 1e9, 0.25));
  CHECK(refined.errors.Largest() < 1e-8);
  CHECK(refined.f.maxCoeff() < 10);
}

}  // namespace
}  // namespace stiction
