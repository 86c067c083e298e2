// SPDX-License-Identifier: Apache-2.0
// Backward errors: the problem that they speak of is one that the forces solve exactly.

#include "solver/problem/backward_error.h"

#include <catch2/catch.hpp>

#include "certify/solve.h"
#include "certify/verify_solution.h"
#include "corpus/rounded.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

LongVector Long(const Eigen::VectorXd& f) { return f.cast<long double>(); }

// Moves b, and mu where friction needs it, so that the law holds: within what `error` allows.
ExactProblem Nearby(const ExactProblem& problem, const ExactVector& f, const BackwardError& error) {
  ExactProblem nearby = problem;
  const ExactVector a = Accelerations(problem, f);
  Rational max_b = 0;
  for (const Rational& b : problem.b) max_b = std::max<Rational>(max_b, abs(b));
  const auto move = [&](int row, const Rational& by) {
    CHECK(abs(by) <= Rational(error.of_b) * max_b);
    nearby.b[row] += by;
  };
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const int row = 2 * static_cast<int>(i);
    if (f[row] > 0 || a[row] < 0) move(row, -a[row]);
    if (f[row] == 0) continue;
    // It slides at the limit of a mu nearby, or it is brought to rest, within a mu nearby if need be.
    Rational& mu = nearby.contacts[i].mu;
    const Rational ratio = abs(f[row + 1]) / f[row];
    const bool slides = a[row + 1] * f[row + 1] <= 0 && abs(ratio - mu) <= Rational(error.of_mu) * mu;
    if (slides || ratio > mu) {
      CHECK(abs(ratio - mu) <= Rational(error.of_mu) * mu);
      mu = ratio;
    }
    if (!slides) move(row + 1, -a[row + 1]);
  }
  return nearby;
}

TEST_CASE("backward error: the forces solve a problem so near exactly") {
  int bounded = 0, moved_mu = 0;
  for (const GeneratorId id : {GeneratorId::kIntegers, GeneratorId::kConditioned, GeneratorId::kNearDegenerate,
                               GeneratorId::kScenes}) {
    for (int index = 0; index < Few(80); ++index) {
      const ContactProblem<double> problem = Rounded<double>(Random<Rational>(id, 1 + index % 4, index));
      for (const char* method : {"complete", "fast"}) {
        CAPTURE(Row(id).name, index, method);
        const Answer<double> answer = Solve(problem, method);
        if (!answer.Solved()) continue;
        const auto error = FindBackwardError(problem, Long(answer.f));
        if (!error) continue;
        ++bounded;
        moved_mu += error->of_mu > 0;
        const ExactVector f = answer.f.unaryExpr([](double x) { return Rational(x); });
        const auto violation = FindViolation(Nearby(Unrounded(problem), f, *error), f);
        CHECK(violation.value_or("") == "");
        CHECK(error->of_data < 1e-6);
      }
    }
  }
  CHECK(bounded > Few(400));
  CHECK(moved_mu > 0);
}

TEST_CASE("backward error: nothing helps where a force pulls, or friction stands alone") {
  const auto problem = As<double>(MakeProblem({1}, {{2, 0}, {0, 3}}, {-2, 1}));
  const auto of = [&problem](double fN, double fF) {
    return FindBackwardError(problem, Long(Eigen::Vector2d(fN, fF)));
  };
  CHECK_FALSE(of(-1, 0));
  CHECK_FALSE(of(0, 1));
  CHECK_FALSE(of(std::numeric_limits<double>::quiet_NaN(), 0));
  REQUIRE(of(1, -1.0 / 3));
  CHECK(of(1, -1.0 / 3)->of_data < 1e-15);
  CHECK(of(1, -1.0 / 3)->of_mu == 0);
  CHECK(of(1.5, -1.0 / 3)->of_data == Approx(0.2));  // aN = 1 of 3 + 2
  CHECK(of(1, -1.25)->of_mu == Approx(0.25));
}

}  // namespace
}  // namespace stiction
