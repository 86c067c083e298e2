// SPDX-License-Identifier: Apache-2.0
// ADMM: solved means solved, over every floating-point scalar, in the plane and in space.

#include "solver/numeric/admm.h"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <limits>
#include <utility>

#include "certify/request/quad.h"
#include "corpus/rounded.h"
#include "solver/solve.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

ExactProblem InSpaceBy(const ExactMatrix& A, const ExactVector& b, const Rational& mu) {
  ExactProblem problem;
  problem.dimension = 3;
  problem.contacts = {{ContactKind::kStatic, mu, {}}};
  problem.A = A;
  problem.b = b;
  return problem;
}

Eigen::Vector3d ForceOf(const ExactProblem& problem) {
  const Answer<double> answer = Solve(Rounded<double>(problem), "admm");
  REQUIRE(answer.Solved());
  return answer.f;
}

std::int64_t StepsOf(const ContactProblem<double>& problem, const AdmmOptions& options) {
  Admm<double> method(options);
  const AdmmVerdict verdict = method.Run(problem);
  REQUIRE(verdict.outcome == Outcome::kSolved);
  return verdict.statistics.iterations;
}

}  // namespace

TEST_CASE("admm: one contact sticks, slips against its acceleration, or separates") {
  const ExactMatrix one = ExactMatrix::Identity(3, 3);
  const auto pushed = [](Rational x, Rational y, Rational z) {
    return ExactVector{{std::move(x), std::move(y), std::move(z)}};
  };
  CHECK(ForceOf(InSpaceBy(one, pushed(-2, Rational(1, 2), 0), 1)).isApprox(Eigen::Vector3d(2, -0.5, 0), 1e-7));
  CHECK(
      ForceOf(InSpaceBy(one, pushed(-1, 3, 4), Rational(1, 2))).isApprox(Eigen::Vector3d(1, -0.3, -0.4), 1e-7));
  CHECK(ForceOf(InSpaceBy(one, pushed(1, 3, 4), 1)).isZero());
}

// certify/existence.md: there the convex program without De Saxce's term has no solution.
TEST_CASE("admm: it is Coulomb's law that is solved, not the convex law near it") {
  ExactMatrix A(3, 3);
  A << 2, -2, 1, -2, 2, -1, 1, -1, 2;
  const Eigen::Vector3d f = ForceOf(InSpaceBy(A, ExactVector{{-2, 2, -4}}, 1));
  CHECK((f - Eigen::Vector3d(2, 0, 2) / 3).norm() < 1e-6);
}

TEMPLATE_TEST_CASE("admm: problems of many kinds are solved, or undecided, never wrong", "[slow]", float,
                   double, long double, Quad) {
  using enum GeneratorId;
  int solved = 0, runs = 0;
  for (const GeneratorId id : {kIntegers, kSmall, kBodies, kScenes, kBilateral, kSliding, kSpace}) {
    for (int index = 0; index < Few(60); ++index) {
      CAPTURE(Row(id).name, index);
      const ExactProblem exact = Random<Rational>(id, 1 + index % 4, index);
      const ContactProblem<TestType> problem = Rounded<TestType>(exact);
      const Answer<TestType> answer = Solve(problem, "admm");
      ++runs;
      CHECK((answer.Solved() || answer.outcome == Outcome::kUndecided || answer.outcome == Outcome::kSingular));
      if (!answer.Solved()) continue;
      ++solved;
      CHECK(answer.errors->Largest() <= kSolvedResidual<TestType>);
      ErrorMeter<TestType> meter;
      const TestType theta =
          std::max(TestType(GateOf<TestType>().theta()), WorkingTheta<TestType>(0, problem.rows()));
      CHECK(MeasureErrors(problem, FrictionLaw::kCoulomb, answer.f, answer.a, meter, theta).Largest() <=
            TestType(kSolvedResidual<TestType>));
    }
  }
  CHECK(solved > 0.8 * runs);
}

TEST_CASE("admm: without a solution, with numbers that are not finite, or stopped, it is undecided") {
  ExactProblem problem = InSpaceBy(ExactMatrix::Zero(3, 3), ExactVector{{-1, 0, 0}}, 1);
  CHECK(Solve(Rounded<double>(problem), "admm").outcome == Outcome::kUndecided);
  const std::atomic<bool> stop = true;
  AdmmOptions options;
  options.limits.stop = &stop;
  Admm<double> method(options);
  problem.A = ExactMatrix::Identity(3, 3);
  const AdmmVerdict verdict = method.Run(Rounded<double>(problem));
  CHECK(verdict.outcome == Outcome::kUndecided);
  CHECK(verdict.reason == kStopped);
  CHECK(verdict.statistics.iterations == 0);
  ContactProblem<double> infinite = Rounded<double>(problem);
  infinite.b[0] = -std::numeric_limits<double>::infinity();
  CHECK(Solve(infinite, "admm").outcome == Outcome::kUndecided);
}

TEST_CASE("admm: a balanced penalty forgets where it began, and over-relaxed steps are fewer") {
  std::int64_t relaxed = 0, plain = 0, from_far = 0;
  for (int index = 0; index < 20; ++index) {
    CAPTURE(index);
    const auto problem = Rounded<double>(Random<Rational>(GeneratorId::kSpace, 2, index));
    relaxed += StepsOf(problem, {});
    plain += StepsOf(problem, {.relaxation = 1});
    for (const double penalty : {1e-4, 1e4}) from_far += StepsOf(problem, {.penalty = penalty});
  }
  CHECK(relaxed < plain);
  CHECK(from_far < 8 * relaxed);
}

}  // namespace stiction
