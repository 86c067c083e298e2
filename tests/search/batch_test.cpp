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
#include "solver/problem/lenient.h"
#include "solver/published/published.ipp"
#include "tests/support.h"

namespace stiction {
namespace {

template <int Rows>
using Small = typename Batch<Rows>::Problem;

std::vector<InstructionSet> SetsOfLanes() {
  std::vector<InstructionSet> sets = InstructionSets();
  REQUIRE(sets.front() == InstructionSet::kNone);
  sets.erase(sets.begin());
  return sets;
}

std::uint64_t BitsOf(double x) { return std::bit_cast<std::uint64_t>(x); }

template <int Rows>
double ErrorOfForces(const Small<Rows>& problem, const typename Small<Rows>::Vector& f) {
  typename Small<Rows>::Vector a = problem.b;
  for (int i = 0; i < Rows; ++i) {
    for (int j = 0; j < Rows; ++j) a[i] += problem.A(i, j) * f[j];
  }
  return MeasureLeniently(problem, FrictionLaw::kCoulomb, f, a).error;
}

struct LaneComparison {
  int problems = 0, left = 0, differ = 0, unsolved = 0, zero_steps = 0, singular = 0;
};

template <int Rows>
bool EndsAlike(const Batch<Rows>& batch, int i, const Small<Rows>& problem, const Verdict& verdict,
               const typename Small<Rows>::Vector& f) {
  const Verdict mine = batch.VerdictOf(i);
  bool same = verdict.outcome == Outcome::kSolved && mine.outcome == verdict.outcome &&
              mine.statistics == verdict.statistics && mine.start == verdict.start &&
              mine.period == verdict.period && mine.reason == verdict.reason;
  for (int row = 0; row < Rows; ++row) same &= BitsOf(batch.Force(i, row)) == BitsOf(f[row]);
  return same && BitsOf(batch.Error(i)) == BitsOf(ErrorOfForces<Rows>(problem, f));
}

template <int Rows>
LaneComparison CompareLanes(InstructionSet set, const std::vector<Small<Rows>>& problems) {
  const Request request;
  PublishedAlgorithm<double, Rows> algorithm(request);
  const auto batch = std::make_unique<Batch<Rows>>(set, request);
  LaneComparison c;
  const int size = static_cast<int>(problems.size());
  for (int first = 0; first < size; first += kBlockProblems) {
    const int count = std::min(kBlockProblems, size - first);
    for (int i = 0; i < count; ++i) batch->Put(i, problems[first + i], {});
    batch->Run(count);
    for (int i = 0; i < count; ++i) {
      const Small<Rows>& problem = problems[first + i];
      const Verdict verdict = algorithm.Run(problem);
      ++c.problems;
      c.unsolved += verdict.outcome != Outcome::kSolved;
      c.left += batch->IsLeft(i);
      if (batch->IsLeft(i)) continue;
      c.differ += !EndsAlike<Rows>(*batch, i, problem, verdict, algorithm.state().f);
      c.zero_steps += verdict.statistics.longest_zero_run > 1;
      c.singular += verdict.statistics.singular_directions > 0;
    }
  }
  return c;
}

template <int Rows>
std::vector<Small<Rows>> DrawnProblems(GeneratorId id, std::span<const MuChoice> palette, int count) {
  std::vector<Small<Rows>> problems(count);
  for (int i = 0; i < count; ++i) {
    Choices choices(ProblemSeed(11, 3, i));
    Generate<double, Rows>(id, Rows / 2, palette, choices, problems[i]);
  }
  return problems;
}

// With no friction and with rounded coefficients.
constexpr std::array<MuChoice, 6> kRoughPalette = {{{0, 1}, {1, 3}, {1, 1}, {7, 5}, {5, 1}, {1000, 1}}};

TEMPLATE_TEST_CASE_SIG(
    "batch: lanes end as the algorithm does, to the bit, whatever the generator and the coefficients", "",
    ((int Rows), Rows), 4, 6, 8) {
  for (const InstructionSet set : SetsOfLanes()) {
    int zero_steps = 0, singular = 0;
    for (const GeneratorRow& row : Generators()) {
      if (!row.IsPlain()) continue;
      CAPTURE(row.name, Name(set));
      const LaneComparison c =
          CompareLanes<Rows>(set, DrawnProblems<Rows>(row.id, kDefaultPalette, testing::Few(6000)));
      CHECK(c.differ == 0);
      CHECK(c.left >= c.unsolved);
      CHECK(c.left < c.problems / 2);
      const LaneComparison rough =
          CompareLanes<Rows>(set, DrawnProblems<Rows>(row.id, kRoughPalette, testing::Few(6000)));
      CHECK(rough.differ == 0);
      zero_steps += c.zero_steps + rough.zero_steps;
      singular += c.singular + rough.singular;
    }
    CHECK(zero_steps > (testing::Short() ? 0 : 3));  // several in a row
    CHECK(singular > (testing::Short() ? 0 : 5));
  }
}

// Small integers, or thirds of them, which are rounded: ties and zeros of either sign, A neither symmetric nor
// semidefinite.
TEMPLATE_TEST_CASE_SIG("batch: lanes end as the algorithm does where A is any matrix", "", ((int Rows), Rows),
                       4, 6, 8) {
  for (const InstructionSet set : SetsOfLanes()) {
    for (const int most : {1, 3}) {
      std::vector<Small<Rows>> problems(60000);
      Choices choices(5);
      double unit = 1;
      const auto entry = [&] { return unit * static_cast<double>(choices.Integer(-most, most)); };
      for (Small<Rows>& problem : problems) {
        unit = choices.Integer(0, 1) == 0 ? 1 : 1.0 / 3;
        for (int i = 0; i < Rows; ++i) {
          problem.b[i] = entry();
          for (int j = 0; j < Rows; ++j) problem.A(i, j) = choices.Integer(0, 9) == 0 ? -0.0 : entry();
          problem.A(i, i) = unit * static_cast<double>(1 + choices.Integer(0, 2 * most));
        }
        for (auto& contact : problem.contacts) contact.mu = static_cast<double>(choices.Integer(0, 4)) / 2;
      }
      const LaneComparison c = CompareLanes<Rows>(set, problems);
      CHECK(c.differ == 0);
      CHECK(c.unsolved > 500);
      CHECK(c.left < 57000);
    }
  }
}

TEMPLATE_TEST_CASE_SIG(
    "batch: numbers that are huge, tiny or not finite are left, or end as the algorithm does", "",
    ((int Rows), Rows), 4, 6, 8) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  const std::vector<Small<Rows>> drawn = DrawnProblems<Rows>(GeneratorId::kPsd, kDefaultPalette, 600);
  std::vector<Small<Rows>> problems;
  for (const double scale : {1e-300, 1e-160, 1e150, 1e307}) {
    for (const double of_b : {1e-200, 1.0, 1e200}) {
      for (Small<Rows> problem : drawn) {
        problem.A *= scale;
        problem.b *= of_b;
        problems.push_back(problem);
      }
    }
  }
  const std::size_t finite = problems.size();
  for (const double bad : {nan, infinity, -infinity}) {
    constexpr int kEntries = Rows * Rows, kNumbers = kEntries + Rows + Rows / 2;
    for (int k = 0; k < kNumbers; ++k) {
      Small<Rows> problem = drawn[k];
      (k < kEntries          ? problem.A(k / Rows, k % Rows)
       : k < kEntries + Rows ? problem.b[k - kEntries]
                             : problem.contacts[k - kEntries - Rows].mu) = bad;
      problems.push_back(problem);
    }
  }
  for (const InstructionSet set : SetsOfLanes()) {
    CHECK(CompareLanes<Rows>(set, problems).differ == 0);
    const LaneComparison bad =
        CompareLanes<Rows>(set, std::vector<Small<Rows>>(problems.begin() + finite, problems.end()));
    CHECK(bad.left == bad.problems);
  }
}

TEMPLATE_TEST_CASE_SIG("batch: problems drawn in lanes are those of the generator, to the bit", "",
                       ((int Rows), Rows), 4, 6, 8) {
  constexpr int kCount = 253;
  for (const InstructionSet set : SetsOfLanes()) {
    const auto batch = std::make_unique<Batch<Rows>>(set, Request{});
    for (const GeneratorRow& row : Generators()) {
      if (!IsDrawnInLanes(row.id)) continue;
      CAPTURE(row.name, Name(set));
      int differ = 0;
      for (std::int64_t first = 0; first < 20 * kCount; first += kCount) {
        batch->Draw(row.id, kRoughPalette, 77, 5, first, kCount);
        for (int i = 0; i < kCount; ++i) {
          Small<Rows> drawn, generated;
          batch->Get(i, drawn);
          Choices choices(ProblemSeed(77, 5, static_cast<std::uint64_t>(first + i)));
          const Drawn expected = Generate<double, Rows>(row.id, Rows / 2, kRoughPalette, choices, generated);
          bool same =
              batch->DrawnOf(i).friction == expected.friction && batch->DrawnOf(i).rank == expected.rank;
          for (int r = 0; r < Rows; ++r) {
            same &= BitsOf(drawn.b[r]) == BitsOf(generated.b[r]);
            for (int j = 0; j < Rows; ++j) same &= BitsOf(drawn.A(r, j)) == BitsOf(generated.A(r, j));
          }
          for (int k = 0; k < Rows / 2; ++k)
            same &= BitsOf(drawn.contacts[k].mu) == BitsOf(generated.contacts[k].mu);
          differ += !same;
        }
      }
      CHECK(differ == 0);
    }
  }
}

TEST_CASE("batch: a unit leaves the same record and findings with every instruction set and with none") {
  Campaign campaign;
  campaign.contacts = {2, 3, 4};
  campaign.unit_problems = 4 * kBlockProblems + 87;
  campaign.audit_every = 100;
  const std::size_t units = Schedule(campaign).size();
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
  Request request;
  CHECK(IsBatched(request));
  request.limits = Campaign().limits;
  CHECK(IsBatched(request));
  request.policy.give_up = GiveUp::kSecond;
  CHECK_FALSE(IsBatched(request));
  request.policy = {};
  request.limits.drives = 3;
  CHECK_FALSE(IsBatched(request));
  request.limits = {};
  request.limits.pivots = 50;
  CHECK_FALSE(IsBatched(request));
  request.limits = {};
  const std::atomic<bool> stop = false;
  request.limits.stop = &stop;
  CHECK_FALSE(IsBatched(request));
}

}  // namespace
}  // namespace stiction
