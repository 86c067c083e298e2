// SPDX-License-Identifier: Apache-2.0
// Robust loops: the radius is that of a box in which every problem loops alike, and is not claimed where some
// do not.

#include "certify/robust.h"

#include <catch2/catch.hpp>

#include "search/choices.h"
#include "tests/support.h"

namespace stiction {
namespace {

using testing::MakeProblem;
using testing::ReferenceProblem;

const Limits kLimits = {1000, 10000, 100000};

// corpus/two-contact-cycle-every-policy-period-4.json: no ties.
ExactProblem Loop() {
  return MakeProblem({2, 2}, {{3, 2, 0, 3}, {2, 5, -3, 0}, {0, -3, 3, 2}, {3, 0, 2, 6}}, {1, 4, -2, 1});
}

// A problem on or in the box, not symmetric in general.
ExactProblem Moved(const ExactProblem& problem, const Rational& radius, Choices& random) {
  ExactProblem moved = problem;
  Rational A = 0, b = 0;
  for (const Rational& x : problem.A.reshaped()) A = std::max<Rational>(A, abs(x));
  for (const Rational& x : problem.b) b = std::max<Rational>(b, abs(x));
  const auto part = [&] { return Rational(radius * random.Integer(-8, 8) / 8); };
  for (Rational& x : moved.A.reshaped()) x += A * part();
  for (Rational& x : moved.b) x += b * part();
  for (auto& contact : moved.contacts) contact.mu *= 1 + part();
  return moved;
}

TEST_CASE("robust: every problem of the box loops with the same start and period") {
  const ExactProblem problem = Loop();
  const PublishedOptions options{{}, {}, kLimits};
  const auto radius = RadiusOfLoop(problem, options);
  REQUIRE(radius.has_value());
  CHECK(*radius > Rational(1, 100000));
  const ExactRun run = RunExact(problem, options);
  Choices random(5);
  for (int k = 0; k < 200; ++k) {
    const ExactRun near = RunExact(Moved(problem, *radius, random), options);
    REQUIRE(near.verdict.outcome == Outcome::kCycle);
    CHECK(near.verdict.start == run.verdict.start);
    CHECK(near.verdict.period == run.verdict.period);
    CHECK(near.state.sets == run.state.sets);
  }
}

TEST_CASE("robust: a box that holds a problem without the loop is not proved") {
  const ExactProblem problem = Loop();
  const PublishedOptions options{{}, {}, kLimits};
  const ExactRun run = RunExact(problem, options);
  Choices random(6);
  int others = 0;
  for (int k = 4; k <= 64; ++k) {
    const Rational radius(1, k);
    bool other = false;
    for (int i = 0; i < 50 && !other; ++i) {
      const ExactRun near = RunExact(Moved(problem, radius, random), options);
      other = near.verdict.outcome != Outcome::kCycle || near.verdict.start != run.verdict.start ||
              near.verdict.period != run.verdict.period;
    }
    if (!other) continue;
    ++others;
    CHECK_FALSE(LoopsWithin(problem, run, options, radius));
  }
  CHECK(others > 0);
}

TEST_CASE("robust: no radius for a run that solves") {
  ExactProblem problem = ReferenceProblem();
  for (auto& contact : problem.contacts) contact.mu = Rational(1, 8);
  const PublishedOptions options{{}, {}, kLimits};
  REQUIRE(RunExact(problem, options).verdict.outcome == Outcome::kSolved);
  CHECK_FALSE(RadiusOfLoop(problem, options).has_value());
}

TEST_CASE("robust: no radius where two limits are met at once") {
  const PublishedOptions options{{}, {}, kLimits};
  REQUIRE(RunExact(ReferenceProblem(), options).verdict.outcome == Outcome::kCycle);
  CHECK_FALSE(RadiusOfLoop(ReferenceProblem(), options).has_value());
}

TEST_CASE("robust: a loop beside another keeps its radius or a part of it") {
  const ExactProblem one = Loop();
  const auto rows = one.A.rows();
  ExactProblem two;
  two.dimension = 2;
  two.contacts = one.contacts;
  two.contacts.insert(two.contacts.end(), one.contacts.begin(), one.contacts.end());
  two.A = ExactProblem::Matrix::Constant(2 * rows, 2 * rows, Rational(0));
  two.A.topLeftCorner(rows, rows) = one.A;
  two.A.bottomRightCorner(rows, rows) = one.A;
  two.b.resize(2 * rows);
  two.b << one.b, one.b;
  // The first copy loops before the second is looked at.
  const auto radius = RadiusOfLoop(two, {{}, {}, kLimits});
  CHECK(radius.value_or(0) > 0);
  CHECK(radius.value_or(1) <= RadiusOfLoop(one, {{}, {}, kLimits}).value_or(0));
}

}  // namespace
}  // namespace stiction
