// SPDX-License-Identifier: Apache-2.0
// Runs that start from the sets of another run.

#include <catch2/catch.hpp>

#include "solver/problem/errors.h"
#include "solver/published/published.h"
#include "tests/support.h"

namespace stiction {
namespace {

using enum IndexSet;
using Problem = ContactProblem<double>;
using Algorithm = PublishedAlgorithm<double>;
using Sets = IndexSets<Eigen::Dynamic>;

double Draw(Choices& choices) { return static_cast<double>(choices.Integer(-1000000, 1000000)) * 1e-6; }

// A = J J' of full rank.
Problem MakeProblem(int contacts, bool friction, Choices& choices) {
  const int rows = friction ? 2 * contacts : contacts;
  Eigen::MatrixXd J(rows, rows);
  for (double& x : J.reshaped()) x = Draw(choices);
  Problem problem;
  problem.A = J * J.transpose();
  problem.b.resize(rows);
  for (double& x : problem.b) x = Draw(choices);
  for (int i = 0; i < contacts; ++i)
    problem.contacts.push_back(
        {friction ? ContactKind::kStatic : ContactKind::kFrictionless, friction ? 0.5 : 0, {}});
  return problem;
}

Problem Nearby(Problem problem, double change, Choices& choices) {
  for (double& x : problem.b) x += change * Draw(choices);
  return problem;
}

double Residual(const Problem& problem, const Algorithm& algorithm) {
  const Eigen::VectorXd a = problem.A * algorithm.state().f + problem.b;
  return MeasureErrors(problem, FrictionLaw::kCoulomb, algorithm.state().f, a).Largest();
}

Sets RandomSets(const Problem& problem, Choices& choices) {
  Sets sets;
  for (const auto& contact : problem.contacts) {
    sets.push_back(std::array{kNone, kClamped, kSeparating}[choices.Integer(0, 2)]);
    if (!contact.HasFrictionRows()) continue;
    sets.push_back(std::array{kNone, kSticking, kAtLower, kAtUpper, kSuspended}[choices.Integer(0, 4)]);
  }
  return sets;
}

TEST_CASE("warm start: the same problem takes no step, a problem nearby fewer, and ends where it should") {
  for (const bool friction : {false, true}) {
    std::int64_t warm_steps = 0, cold_steps = 0;
    for (int index = 0; index < 30; ++index) {
      CAPTURE(friction, index);
      Choices choices(index);
      const Problem problem = MakeProblem(5 + index, friction, choices);
      Algorithm first, warm, cold;
      if (first.Run(problem).outcome != Outcome::kSolved) continue;
      const Verdict again = warm.RunFrom(problem, first.state().sets);
      CHECK(again.outcome == Outcome::kSolved);
      CHECK(again.statistics.steps == 0);
      const Problem nearby = Nearby(problem, 0.1, choices);
      if (cold.Run(nearby).outcome != Outcome::kSolved) continue;
      const Verdict verdict = warm.RunFrom(nearby, first.state().sets);
      REQUIRE(verdict.outcome == Outcome::kSolved);
      CHECK(Residual(nearby, warm) < 1e-9);
      if (!friction) CHECK((warm.state().f - cold.state().f).norm() < 1e-8 * (1 + cold.state().f.norm()));
      warm_steps += verdict.statistics.steps;
      cold_steps += cold.Run(nearby).statistics.steps;
    }
    CHECK(warm_steps > 0);
    CHECK(3 * warm_steps < cold_steps);
  }
}

TEST_CASE("warm start: whatever the guess, the run starts where the conditions of all sets hold") {
  int kept = 0;
  for (int index = 0; index < 200; ++index) {
    CAPTURE(index);
    Choices choices(index);
    const Problem problem = MakeProblem(1 + index % 12, index % 3 != 0, choices);
    RowLayout<Eigen::Dynamic> layout;
    layout.Assign(problem.contacts);
    Algorithm algorithm;
    algorithm.options().limits.pivots = 0;  // the state stays as it was adopted
    algorithm.RunFrom(problem, RandomSets(problem, choices));
    const auto& [f, a, sets] = algorithm.state();
    CHECK((problem.A * f + problem.b - a).norm() < 1e-9 * (1 + f.norm()));
    for (int row = 0; row < problem.rows(); ++row) {
      CAPTURE(row);
      kept += IsUnknown(sets[row]);
      const double bound = layout.IsNormal(row) ? 0 : 0.5 * f[row - 1];
      const bool rests = IsUnknown(sets[row]);
      if (layout.IsNormal(row)) CHECK(f[row] > -1e-8);
      if (rests) CHECK(a[row] == 0);
      if (!rests && LimitSign(sets[row]) == 0) CHECK(f[row] == 0);
      if (sets[row] == kSeparating) CHECK(a[row] > -1e-8);
      if (sets[row] == kSticking) CHECK(std::abs(f[row]) < bound + 1e-8);
      if (LimitSign(sets[row]) != 0) CHECK(f[row] == LimitSign(sets[row]) * bound);
      if (LimitSign(sets[row]) * bound > 0) CHECK(LimitSign(sets[row]) * a[row] < 1e-8);
    }
    algorithm.options().limits.pivots = 100000;
    if (index % 3 == 0)
      CHECK(algorithm.RunFrom(problem, RandomSets(problem, choices)).outcome == Outcome::kSolved);
  }
  CHECK(kept > 200);
}

TEST_CASE("warm start: exactly, the sets of an answer give it back") {
  int frictions = 0;
  for (int index = 0; index < 100; ++index) {
    CAPTURE(index);
    const auto problem = testing::Random<Rational>(GeneratorId::kIntegers, 1 + index % 3, index);
    PublishedAlgorithm<Rational> first, again;
    if (first.Run(problem).outcome != Outcome::kSolved) continue;
    const auto sets = first.state().sets;
    const Verdict verdict = again.RunFrom(problem, sets);
    REQUIRE(verdict.outcome == Outcome::kSolved);
    const ExactProblem::Vector a = problem.A * again.state().f + problem.b;
    CHECK(again.state().a == a);
    if (std::find(sets.begin(), sets.end(), kNone) != sets.end()) continue;
    CHECK(verdict.statistics.steps == 0);
    CHECK(again.state().f == first.state().f);
    frictions += std::find(sets.begin(), sets.end(), kSticking) != sets.end();
  }
  CHECK(frictions > 3);
}

TEST_CASE("warm start: forces that do not exist leave the run at f = 0, and no rows have none") {
  Problem problem;
  problem.A = Eigen::MatrixXd::Ones(2, 2);
  problem.b = Eigen::Vector2d(-1, -2);
  problem.contacts.assign(2, {ContactKind::kFrictionless, 0, {}});
  Algorithm warm, cold;
  const Verdict verdict = warm.RunFrom(problem, Sets{kClamped, kClamped}), expected = cold.Run(problem);
  CHECK(verdict.outcome == expected.outcome);
  CHECK(verdict.statistics == expected.statistics);
  CHECK(warm.state().f == cold.state().f);
  CHECK(warm.RunFrom(Problem{}, Sets{}).outcome == Outcome::kSolved);
}

}  // namespace
}  // namespace stiction
