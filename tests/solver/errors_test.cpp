// SPDX-License-Identifier: Apache-2.0
// Errors of forces: what known ones miss. tests/model holds that they are zero on solutions and nowhere else.

#include "solver/problem/errors.h"

#include <catch2/catch.hpp>
#include <limits>

#include "certify/exact/verify_solution.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

Rational Residual(const ExactProblem& problem, const ExactVector& f) {
  return ErrorOf(problem, f, Accelerations(problem, f));
}

TEST_CASE("errors: the three solutions of one contact have none") {
  for (const auto& f : {Vector({0, 0}), Vector({3, -2}), Vector({1, -1})})
    CHECK(Residual(ThreeSolutions(), f) == 0);
  CHECK(Residual(ThreeSolutions(), Vector({2, -1})) > 0);
}

TEST_CASE("errors: a contact that pulls has no friction to spend") {
  const ExactProblem problem = MakeProblem({1}, {{1, 0}, {0, 1}}, {1, -3});
  const ExactVector f = Vector({-1, 3});
  REQUIRE(Accelerations(problem, f) == Vector({0, 0}));
  CHECK(ErrorOf(problem, f, Accelerations(problem, f)) >= 1);  // all of b is held by it
}

TEST_CASE("errors: forces of any size are judged alike") {
  for (int i = 0; i < 20; ++i) {
    const ExactProblem problem = Random<Rational>(GeneratorId::kBodies, 2, i);
    const ExactVector f = RunExact(problem, {}).f;
    for (const char* unit : {"1e-300", "1e300", "1e-4000", "1e4000"}) {
      CAPTURE(i, unit);
      const Rational factor = *ParseRational(unit);
      ExactProblem other = problem;
      other.A *= factor;
      const ExactVector same = f / factor, wrong = Rational(1, 2) * same;
      CHECK(Residual(other, same) == Residual(problem, f));
      CHECK(abs(Rational(Residual(other, wrong) - Residual(problem, f / 2))) <
            Rational("1/10000000000000000000000000"));
    }
  }
}

TEST_CASE("errors: of no contacts and of a problem of zeros it is zero") {
  CHECK(Residual(NoContacts(), Vector({})) == 0);
  CHECK(Residual(MakeProblem({1}, {{0, 0}, {0, 0}}, {0, 0}), Vector({0, 0})) == 0);
}

TEMPLATE_TEST_CASE("errors: is that of exact arithmetic, to rounding", "", float, double) {
  const ExactProblem problem = ReferenceProblem();
  const ExactVector f = Vector({1, Rational(-1, 2), 2, -1});
  const auto rounded = As<TestType>(problem);
  typename ContactProblem<TestType>::Vector g(4);
  for (int i = 0; i < 4; ++i) g[i] = To<TestType>(f[i]);
  const auto a = (rounded.A * g + rounded.b).eval();
  CHECK(static_cast<double>(ErrorOf(rounded, g, a)) == Approx(ToDouble(Residual(problem, f))).epsilon(1e-4));
}

TEMPLATE_TEST_CASE("errors: forces or accelerations that are no numbers are never small", "", float, double) {
  const auto problem = As<TestType>(ThreeSolutions());
  using V = typename ContactProblem<TestType>::Vector;
  const auto residual = [&](int position, TestType bad) {
    V f = V::Zero(2), a = problem.b;
    (position < 2 ? f : a)[position % 2] = bad;
    return ErrorOf(problem, f, a);
  };
  for (int i = 0; i < 4; ++i) {
    CAPTURE(i);
    CHECK_FALSE(residual(i, std::numeric_limits<TestType>::quiet_NaN()) <= TestType(1e-6));
  }
  CHECK_FALSE(residual(0, std::numeric_limits<TestType>::infinity()) <= TestType(1e-6));
  CHECK_FALSE(residual(1, std::numeric_limits<TestType>::infinity()) <= TestType(1e-6));
}

TEST_CASE("errors: a bilateral contact must not accelerate, and a sliding one has friction against its slip") {
  ContactProblem<double> problem;
  problem.contacts = {{ContactKind::kBilateral, 0, {}}, {ContactKind::kSliding, 0.5, {-1, 0}}};
  problem.A = 2 * Eigen::Matrix3d::Identity();
  problem.b = Eigen::Vector3d(6, -4, 0);
  const auto residual = [&problem](double f0, double f1, double f2) {
    const Eigen::VectorXd f = Eigen::Vector3d(f0, f1, f2), a = problem.A * f + problem.b;
    return ErrorOf(problem, f, a);
  };
  CHECK(residual(-3, 2, 1) == 0);
  CHECK(residual(0, 2, 1) == Approx(1));    // all of its b
  CHECK(residual(-3, 2, -1) == Approx(2));  // 2 N of mu fN, which is 1 N
  CHECK(residual(-3, 2, 0) == Approx(1));   // 1 N
  CHECK(residual(-3, 0, 0) == Approx(1));
}

}  // namespace
}  // namespace stiction
