// SPDX-License-Identifier: Apache-2.0
// The theorems of [Baraff94] on runs of its algorithm: each with its hypotheses, and with a counterexample
// where the printed statement is wider than what holds.

#include <catch2/catch.hpp>

#include "certify/exact/properties.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// visit(run) for frictionless problems, positive definite and nondegenerate.
template <class Visit>
void ForEachFrictionlessRun(Visit visit) {
  for (int seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    const ExactRun run = RunExact(RandomFrictionless(2 + seed % 7, 5000 + seed), {});
    REQUIRE(run.verdict.outcome == Outcome::kSolved);
    visit(run);
  }
  visit(RunExact(ExponentialFamily(6), {}));
}

// visit(before, after) for consecutive steps of one drive.
template <class Visit>
void ForEachPairOfSteps(const ExactRun& run, Visit visit) {
  for (std::size_t k = 1; k < run.trace.pivots.size(); ++k) {
    const Pivot<Rational>&before = run.trace.pivots[k - 1], &after = run.trace.pivots[k];
    if (before.drive == after.drive) visit(before, after);
  }
}

// Static problems that meet the paper's assumptions, with every policy in turn.
template <class Visit>
void ForEachStaticRun(int count, Visit visit) {
  using enum GeneratorId;
  constexpr std::array<GeneratorId, 4> kinds = {kIntegers, kPsd, kSmall, kDuplicates};
  for (int index = 0; index < count; ++index) {
    CAPTURE(index);
    Choices choices(index);
    const ExactProblem problem = Random<Rational>(kinds[index % 4], 1 + index % 4, 700000 + index);
    visit(problem, RunExact(problem, {.policy = RandomPolicy(choices)}));
  }
}

TEST_CASE("theorem 1, strengthened: no drive of a static problem is unlimited, whatever was given up before") {
  // A symmetric positive semidefinite, b in range(A). The paper's proof needs theorem 3 and A nonsingular;
  // this one does not: see readings.md, 6.
  int against = 0, after_give_up = 0;
  ForEachStaticRun(4000, [&](const ExactProblem&, const ExactRun& run) {
    REQUIRE(run.verdict.outcome != Outcome::kRay);
    bool gave_up = false;
    for (const Pivot<Rational>& pivot : run.trace.pivots) {
      against += pivot.driven % 2 == 0 && pivot.da[pivot.driven] <= 0;
      after_give_up += gave_up;
      gave_up |= pivot.gave_up;
    }
  });
  CHECK(against > 10);  // driving fN can lower aN for a while (5.3), in the plane with friction
  CHECK(after_give_up > 10);
  // Without b in range(A) it fails.
  CHECK(RunExact(NoSolution(), {}).verdict.outcome == Outcome::kRay);
}

TEST_CASE("theorem 2: v1'x + alpha is positive for A definite, and not negative for A semidefinite") {
  int zeros = 0;
  for (int seed = 0; seed < 400; ++seed) {
    CAPTURE(seed);
    Choices choices(seed);
    const int size = static_cast<int>(choices.Integer(1, 6));
    const int rank = seed % 2 == 0 ? size + 1 : static_cast<int>(choices.Integer(1, size));
    Eigen::Matrix<Rational, Eigen::Dynamic, Eigen::Dynamic> J(size, rank);
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < rank; ++j) J(i, j) = choices.Integer(-5, 5);
    }
    ExactMatrix A = J * J.transpose();
    if (seed % 2 == 0) A += ExactMatrix::Identity(size, size);
    const int k = size - 1;
    const ExactVector v1 = A.col(k).head(k);
    const auto solved = DecideRange(A.topLeftCorner(k, k), ExactVector(-v1));  // the appendix: always in range
    const auto* x = std::get_if<ExactVector>(&solved);
    REQUIRE(x != nullptr);
    Rational value = A(k, k);
    for (int i = 0; i < k; ++i) value += v1[i] * (*x)[i];
    if (seed % 2 == 0) {
      CHECK(value > 0);
    } else {
      CHECK(value >= 0);
      zeros += value == 0;
    }
  }
  CHECK(zeros > 20);  // so the strict inequality needs A nonsingular: A = (1 1; 1 1) has 0
}

TEST_CASE("theorem 3: without friction no set C recurs within a drive") {
  // Also where A is singular or the problem degenerate, as long as steps are positive; lengths are checked.
  ForEachFrictionlessRun([](const ExactRun& run) {
    for (std::size_t i = 0; i < run.trace.pivots.size(); ++i) {
      CHECK(run.trace.pivots[i].s > 0);
      for (std::size_t j = i + 1; j < run.trace.pivots.size(); ++j) {
        if (run.trace.pivots[j].drive != run.trace.pivots[i].drive) break;
        REQUIRE(run.trace.pivots[i].sets != run.trace.pivots[j].sets);
      }
    }
  });
}

// Steps of a drive that lead back to sets which an earlier step of it had left, nothing given up between.
struct Recurrences {
  int where_left = 0;  // at the forces at which the sets were left
  int elsewhere = 0;
};
Recurrences FindRecurrences(const ExactRun& run) {
  Recurrences found;
  for (std::size_t left = 0; left < run.trace.pivots.size(); ++left) {
    const Pivot<Rational>& leaving = run.trace.pivots[left];
    std::vector<IndexSet> sets = leaving.sets;
    sets[leaving.limiting] = leaving.from;
    for (std::size_t k = left; k < run.trace.pivots.size(); ++k) {
      const Pivot<Rational>& pivot = run.trace.pivots[k];
      if (pivot.drive != leaving.drive || pivot.gave_up) break;
      if (pivot.sets == sets) ++(pivot.f == leaving.f ? found.where_left : found.elsewhere);
    }
  }
  return found;
}

TEST_CASE("theorem 3, corrected: with friction sets recur within a drive, but only where they were left") {
  // "Exactly the same" proof divides by the difference of the driven force at both times, which is zero in a
  // run of zero steps. give-up=second lets a variable come back once.
  const ExactRun example = RunExact(GiveUpProblem(), {.policy = ParsePolicy("give-up=second")});
  CHECK(FindRecurrences(example).where_left == 2);
  int recurrences = 0;
  ForEachStaticRun(4000, [&](const ExactProblem&, const ExactRun& run) {
    const Recurrences found = FindRecurrences(run);
    REQUIRE(found.elsewhere == 0);
    recurrences += found.where_left;
  });
  CHECK(recurrences > 0);
}

TEST_CASE("theorems 4 and 5: without friction a variable that changes its set moves away from the border") {
  // A definite and the problem nondegenerate: C to NC, a_i increases (4); NC to C, f_i increases (5).
  int opened = 0, closed = 0;
  ForEachFrictionlessRun([&](const ExactRun& run) {
    ForEachPairOfSteps(run, [&](const Pivot<Rational>& before, const Pivot<Rational>& after) {
      const int i = before.limiting;
      if (before.to == IndexSet::kSeparating) {
        ++opened;
        REQUIRE(after.da[i] > 0);
      } else {
        REQUIRE(before.to == IndexSet::kClamped);
        ++closed;
        REQUIRE(after.df[i] > 0);
      }
    });
  });
  CHECK(opened > 30);
  CHECK(closed > 30);
}

TEST_CASE("theorems 4 and 5 do not extend to friction: a variable is turned back at once") {
  // Positive definite and nondegenerate; F1 leaves C_F for NC- and aF1 at once wants back.
  const ExactRun run = RunExact(GiveUpProblem(), {});
  int turned_back = 0;
  ForEachPairOfSteps(run, [&](const Pivot<Rational>& before, const Pivot<Rational>& after) {
    if (before.s == 0 || after.limiting != before.limiting) return;
    CHECK(before.from == IndexSet::kSticking);
    CHECK(before.to == IndexSet::kAtLower);
    CHECK(after.da[before.limiting] < 0);  // NC- keeps aF >= 0
    CHECK(after.s == 0);
    ++turned_back;
  });
  CHECK(turned_back == 1);
}

}  // namespace
}  // namespace stiction
