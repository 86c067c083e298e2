// SPDX-License-Identifier: Apache-2.0
// Problems in lanes: what the algorithm makes of them one by one, to the bit, in every instruction set at hand.

#include "search/lanes/batch.h"

#include <fmt/format.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "search/generators/generators.h"
#include "search/units/unit.h"
#include "solver/problem/errors.h"
#include "solver/published/published.ipp"

namespace stiction {
namespace {

using SmallProblem = Batch::Problem;

std::vector<InstructionSet> SetsOfLanes() {
  std::vector<InstructionSet> sets = InstructionSets();
  REQUIRE(sets.front() == InstructionSet::kNone);
  sets.erase(sets.begin());
  return sets;
}

std::uint64_t BitsOf(double x) { return std::bit_cast<std::uint64_t>(x); }

double ErrorOfForces(const SmallProblem& problem, const SmallProblem::Vector& f) {
  SmallProblem::Vector a = problem.b;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) a[i] += problem.A(i, j) * f[j];
  }
  return MeasureErrors(problem, FrictionLaw::kCoulomb, f, a).Largest();
}

struct LaneComparison {
  int problems = 0, left = 0, differ = 0, unsolved = 0, zero_steps = 0, singular = 0;
};

bool EndsAlike(const Batch& batch, int i, const SmallProblem& problem, const Verdict& verdict,
               const SmallProblem::Vector& f) {
  const Verdict mine = batch.VerdictOf(i);
  bool same = verdict.outcome == Outcome::kSolved && mine.outcome == verdict.outcome &&
              mine.statistics == verdict.statistics && mine.start == verdict.start &&
              mine.period == verdict.period && mine.reason == verdict.reason;
  for (int row = 0; row < 4; ++row) same &= BitsOf(batch.Forces(i)[row]) == BitsOf(f[row]);
  return same && BitsOf(batch.Error(i)) == BitsOf(ErrorOfForces(problem, f));
}

LaneComparison CompareLanes(InstructionSet set, const std::vector<SmallProblem>& problems) {
  const PublishedOptions options;
  PublishedAlgorithm<double, 4> algorithm(options);
  const auto batch = std::make_unique<Batch>(set, options);
  LaneComparison c;
  const int size = static_cast<int>(problems.size());
  for (int first = 0; first < size; first += kBlockProblems) {
    const int count = std::min(kBlockProblems, size - first);
    for (int i = 0; i < count; ++i) batch->Put(i, problems[first + i], {});
    batch->Run(count);
    for (int i = 0; i < count; ++i) {
      const SmallProblem& problem = problems[first + i];
      const Verdict verdict = algorithm.Run(problem);
      ++c.problems;
      c.unsolved += verdict.outcome != Outcome::kSolved;
      c.left += batch->IsLeft(i);
      if (batch->IsLeft(i)) continue;
      c.differ += !EndsAlike(*batch, i, problem, verdict, algorithm.state().f);
      c.zero_steps += verdict.statistics.longest_zero_run > 1;
      c.singular += verdict.statistics.singular_directions > 0;
    }
  }
  return c;
}

std::vector<SmallProblem> DrawnProblems(GeneratorId id, std::span<const MuChoice> palette, int count) {
  std::vector<SmallProblem> problems(count);
  for (int i = 0; i < count; ++i) {
    Choices choices(ProblemSeed(11, 3, i));
    Generate<double, 4>(id, 2, palette, choices, problems[i]);
  }
  return problems;
}

// With no friction and with rounded coefficients.
constexpr std::array<MuChoice, 6> kRoughPalette = {{{0, 1}, {1, 3}, {1, 1}, {7, 5}, {5, 1}, {1000, 1}}};

TEST_CASE("batch: lanes end as the algorithm does, to the bit, whatever the generator and the coefficients") {
  for (const InstructionSet set : SetsOfLanes()) {
    int zero_steps = 0, singular = 0;
    for (const GeneratorRow& row : Generators()) {
      if (!row.IsPlain()) continue;
      CAPTURE(row.name, Name(set));
      const LaneComparison c = CompareLanes(set, DrawnProblems(row.id, kDefaultPalette, 6000));
      CHECK(c.differ == 0);
      CHECK(c.left >= c.unsolved);
      CHECK(c.left < c.problems / 2);
      const LaneComparison rough = CompareLanes(set, DrawnProblems(row.id, kRoughPalette, 6000));
      CHECK(rough.differ == 0);
      zero_steps += c.zero_steps + rough.zero_steps;
      singular += c.singular + rough.singular;
    }
    CHECK(zero_steps > 3);  // several in a row
    CHECK(singular > 5);
  }
}

// Small integers, or thirds of them, which are rounded: ties and zeros of either sign, A neither symmetric nor
// semidefinite.
TEST_CASE("batch: lanes end as the algorithm does where A is any matrix") {
  for (const InstructionSet set : SetsOfLanes()) {
    for (const int most : {1, 3}) {
      std::vector<SmallProblem> problems(60000);
      Choices choices(5);
      double unit = 1;
      const auto entry = [&] { return unit * static_cast<double>(choices.Integer(-most, most)); };
      for (SmallProblem& problem : problems) {
        unit = choices.Integer(0, 1) == 0 ? 1 : 1.0 / 3;
        for (int i = 0; i < 4; ++i) {
          problem.b[i] = entry();
          for (int j = 0; j < 4; ++j) problem.A(i, j) = choices.Integer(0, 9) == 0 ? -0.0 : entry();
          problem.A(i, i) = unit * static_cast<double>(1 + choices.Integer(0, 2 * most));
        }
        for (auto& contact : problem.contacts) contact.mu = static_cast<double>(choices.Integer(0, 4)) / 2;
      }
      const LaneComparison c = CompareLanes(set, problems);
      CHECK(c.differ == 0);
      CHECK(c.unsolved > 500);
      CHECK(c.left < 57000);
    }
  }
}

TEST_CASE("batch: numbers that are huge, tiny or not finite are left, or end as the algorithm does") {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  const std::vector<SmallProblem> drawn = DrawnProblems(GeneratorId::kPsd, kDefaultPalette, 600);
  std::vector<SmallProblem> problems;
  for (const double scale : {1e-300, 1e-160, 1e150, 1e307}) {
    for (const double of_b : {1e-200, 1.0, 1e200}) {
      for (SmallProblem problem : drawn) {
        problem.A *= scale;
        problem.b *= of_b;
        problems.push_back(problem);
      }
    }
  }
  const std::size_t finite = problems.size();
  for (const double bad : {nan, infinity, -infinity}) {
    for (int k = 0; k < 22; ++k) {
      SmallProblem problem = drawn[k];
      (k < 16 ? problem.A(k / 4, k % 4) : k < 20 ? problem.b[k - 16] : problem.contacts[k - 20].mu) = bad;
      problems.push_back(problem);
    }
  }
  for (const InstructionSet set : SetsOfLanes()) {
    CHECK(CompareLanes(set, problems).differ == 0);
    const LaneComparison bad = CompareLanes(set, {problems.begin() + finite, problems.end()});
    CHECK(bad.left == bad.problems);
  }
}

TEST_CASE("batch: problems drawn in lanes are those of the generator, to the bit") {
  constexpr int kCount = 253;
  for (const InstructionSet set : SetsOfLanes()) {
    const auto batch = std::make_unique<Batch>(set, PublishedOptions{});
    for (const GeneratorRow& row : Generators()) {
      if (!IsDrawnInLanes(row.id)) continue;
      CAPTURE(row.name, Name(set));
      int differ = 0;
      for (std::int64_t first = 0; first < 20 * kCount; first += kCount) {
        batch->Draw(row.id, kRoughPalette, 77, 5, first, kCount);
        for (int i = 0; i < kCount; ++i) {
          SmallProblem drawn, generated;
          batch->Get(i, drawn);
          Choices choices(ProblemSeed(77, 5, static_cast<std::uint64_t>(first + i)));
          const Drawn expected = Generate<double, 4>(row.id, 2, kRoughPalette, choices, generated);
          bool same =
              batch->DrawnOf(i).friction == expected.friction && batch->DrawnOf(i).rank == expected.rank;
          for (int r = 0; r < 4; ++r) {
            same &= BitsOf(drawn.b[r]) == BitsOf(generated.b[r]);
            for (int j = 0; j < 4; ++j) same &= BitsOf(drawn.A(r, j)) == BitsOf(generated.A(r, j));
          }
          for (int k = 0; k < 2; ++k) same &= BitsOf(drawn.contacts[k].mu) == BitsOf(generated.contacts[k].mu);
          differ += !same;
        }
      }
      CHECK(differ == 0);
    }
  }
}

TEST_CASE("batch: a unit leaves the same record and findings with every instruction set and with none") {
  Campaign campaign;
  campaign.contacts = {2};
  campaign.unit_problems = 2 * kBlockProblems + 87;
  campaign.audit_every = 100;
  const std::size_t units = campaign.generators.size();
  UnitRunner alone(campaign, {.lanes = InstructionSet::kNone});
  std::vector<UnitResult> expected;
  for (std::size_t unit = 0; unit < units; ++unit) expected.push_back(alone.Run(unit));
  for (const InstructionSet set : SetsOfLanes()) {
    UnitRunner batched(campaign, {.lanes = set});
    for (std::size_t unit = 0; unit < units; ++unit) {
      CAPTURE(unit, Name(set));
      const UnitResult result = batched.Run(unit);
      CHECK(result.problems == expected[unit].problems);
      CHECK(result.record == expected[unit].record);
      CHECK(result.candidates == expected[unit].candidates);
    }
  }
}

TEST_CASE("batch: other readings, small budgets and what can be stopped are not batched") {
  PublishedOptions options;
  CHECK(IsBatched(options));
  options.limits = Campaign().limits;
  CHECK(IsBatched(options));
  options.policy.give_up = GiveUp::kSecond;
  CHECK_FALSE(IsBatched(options));
  options.policy = {};
  options.limits.drives = 3;
  CHECK_FALSE(IsBatched(options));
  options.limits = {};
  options.limits.pivots = 50;
  CHECK_FALSE(IsBatched(options));
  options.limits = {};
  const std::atomic<bool> stop = false;
  options.limits.stop = &stop;
  CHECK_FALSE(IsBatched(options));
}

}  // namespace
}  // namespace stiction
