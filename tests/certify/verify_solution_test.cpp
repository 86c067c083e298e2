// SPDX-License-Identifier: Apache-2.0
// The exact check of a solution.

#include "certify/exact/verify_solution.h"

#include <catch2/catch.hpp>

#include "search/generators/choices.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;
using Catch::Contains;

TEST_CASE("verify solution: a = A f + b") {
  CHECK(Accelerations(ReferenceProblem(), Vector({1, Rational(-6, 7), Rational(25, 14), Rational(-25, 14)})) ==
        Vector({0, 0, 0, Rational(6, 7)}));
}

TEST_CASE("verify solution: a = A f + b whatever the denominators, of one group of contacts or of many") {
  Choices choices(1);
  for (const int groups : {1, 2, 9}) {
    const int rows = 4, all = groups * rows;
    ExactProblem problem;
    problem.contacts.assign(all, {ContactKind::kFrictionless, 0, {}});
    problem.A = ExactMatrix::Zero(all, all);
    problem.b.resize(all);
    ExactVector f(all);
    const auto number = [&] {
      return Rational(Rational(choices.Integer(-9, 9)) / Rational(choices.Integer(1, 99)));
    };
    for (int i = 0; i < all; ++i) {
      // Denominators that have nothing in common, group by group.
      f[i] = number() / (Rational(1000003 + 2 * (i / rows)) * 1000000007);
      problem.b[i] = number();
      for (int j = 0; j < rows; ++j) problem.A(i, i / rows * rows + j) = number();
    }
    problem.b[0] = -Rational(problem.A.row(0).dot(f));
    const ExactVector a = Accelerations(problem, f);
    CHECK(a == ExactVector(problem.A * f + problem.b));
    CHECK(a[0] == 0);
    CHECK(Accelerations(problem, ExactVector::Zero(all)) == problem.b);
  }
}

TEST_CASE("verify solution: every solution of a problem is accepted, and what lies between is not") {
  for (const auto& f : {Vector({0, 0}), Vector({3, -2}), Vector({1, -1})}) {
    CHECK(FindViolation(ThreeSolutions(), f) == std::nullopt);
  }
  CHECK(FindViolation(ThreeSolutions(), Vector({2, Rational(-3, 2)})) != std::nullopt);
}

TEST_CASE("verify solution: the broken condition is named, with the contact and the number") {
  // One contact with A = 1, mu = 2: a = f + b.
  const auto violation = [](const Rational& b_n, const Rational& b_f, const Rational& f_n,
                            const Rational& f_f) {
    return FindViolation(MakeProblem({-1, 2}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, b_n, b_f}),
                         Vector({0, f_n, f_f}))
        .value_or("none");
  };
  CHECK(violation(-1, -2, 1, 2) == "none");  // sticks at its limit
  CHECK(violation(-1, -3, 1, 2) == "none");  // slips
  CHECK(violation(3, 0, -1, 0) == "contact 2: fN >= 0 is broken, found -1");
  CHECK(violation(-1, 0, 0, 0) == "contact 2: aN >= 0 is broken, found -1");
  CHECK(violation(-1, 0, 3, 0) == "contact 2: fN aN = 0 is broken, found 6");
  CHECK(violation(-1, -3, 1, 3) == "contact 2: abs(fF) <= mu fN is broken, found -1");
  CHECK(violation(-1, 3, 1, Rational(-5, 2)) == "contact 2: abs(fF) <= mu fN is broken, found -1/2");
  CHECK(violation(-1, Rational(-3, 2), 1, 2) == "contact 2: aF fF <= 0 is broken, found 1");
  CHECK(violation(-1, -3, 1, 1) == "contact 2: aF (mu fN - abs(fF)) = 0 is broken, found -2");
}

TEST_CASE("verify solution: a solution with one force moved is refused wherever the solution is isolated") {
  int moved = 0;
  for (int index = 0; index < 500; ++index) {
    CAPTURE(index);
    ExactProblem problem = Random<Rational>(GeneratorId::kIntegers, 1 + index % 3, index);
    for (int i = 0; i < problem.rows(); ++i) problem.A(i, i) += 1;  // definite: every solution is isolated
    const ExactRun run = RunExact(problem, {});
    if (run.verdict.outcome != Outcome::kSolved) continue;
    REQUIRE(FindViolation(problem, run.f) == std::nullopt);
    for (int row = 0; row < problem.rows(); ++row) {
      for (const Rational& by : {Rational(1, 1000000), Rational(-1, 1000000)}) {
        ExactVector f = run.f;
        f[row] += by;
        CHECK(FindViolation(problem, f) != std::nullopt);
        ++moved;
      }
    }
  }
  CHECK(moved > 1000);
}

}  // namespace
}  // namespace stiction
