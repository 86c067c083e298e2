// SPDX-License-Identifier: Apache-2.0
// Without friction: section 4 of [Baraff94], against solutions found by enumeration.

#include <catch2/catch.hpp>
#include <optional>

#include "certify/exact/properties.h"
#include "certify/exact/verify_solution.h"
#include "solver/published/published.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// f with a = 0 in the rows of `clamped` and f = 0 elsewhere; empty if A is singular there.
std::optional<ExactVector> Complementary(const ExactProblem& problem, unsigned clamped) {
  ExactMatrix M(problem.rows(), problem.rows());
  ExactVector right(problem.rows());
  for (int i = 0; i < problem.rows(); ++i) {
    const bool in_C = (clamped >> i & 1) != 0;
    right[i] = in_C ? Rational(-problem.b[i]) : Rational(0);
    for (int j = 0; j < problem.rows(); ++j) M(i, j) = in_C ? problem.A(i, j) : Rational(i == j ? 1 : 0);
  }
  const auto solved = DecideRange(M, right);
  const auto* point = std::get_if<ExactVector>(&solved);
  return point != nullptr ? std::optional(*point) : std::nullopt;
}

std::vector<ExactVector> EnumeratedSolutions(const ExactProblem& problem) {
  std::vector<ExactVector> solutions;
  for (unsigned clamped = 0; clamped < 1u << problem.rows(); ++clamped) {
    const auto f = Complementary(problem, clamped);
    if (f && !FindViolation(problem, *f)) solutions.push_back(*f);
  }
  return solutions;
}

TEST_CASE("frictionless: every policy finds the enumerated solution, and none gives up (theorems 4, 5)") {
  for (int seed = 0; seed < 120; ++seed) {
    CAPTURE(seed);
    const ExactProblem problem = RandomFrictionless(1 + seed % 6, seed);
    const auto solutions = EnumeratedSolutions(problem);
    REQUIRE(solutions.size() == 1);  // positive definite and nondegenerate
    for (const PolicyClass& equal : RunPolicies(problem, PlanarGrid(), {})) {
      CHECK(equal.verdict.outcome == Outcome::kSolved);
      CHECK(equal.verdict.statistics.give_ups == 0);
      CHECK(equal.verdict.statistics.zero_steps == 0);
      CHECK(RunExact(problem, {.policy = equal.policies.front()}).f == solutions.front());
    }
  }
}

TEMPLATE_TEST_CASE("frictionless: the family E_n takes 2^n - 1 pivots, 2^(k-1) of them in drive k", "", float,
                   double, Rational) {
  // A float holds b_i of E_6 with few digits to spare, E_8 not at all.
  for (int n = 1; n <= (std::is_same_v<TestType, float> ? 4 : 8); ++n) {
    CAPTURE(n);
    PublishedAlgorithm<TestType> algorithm;
    Trace<TestType> trace;
    const Verdict verdict = algorithm.Run(As<TestType>(ExponentialFamily(n)), &trace);
    CHECK(verdict.outcome == Outcome::kSolved);
    CHECK(verdict.statistics.pivots == (1 << n) - 1);
    CHECK(verdict.statistics.drives == n);
    CHECK(verdict.statistics.zero_steps == 0);
    std::vector<int> in_drive(n);
    for (const auto& pivot : trace.pivots) ++in_drive[pivot.drive - 1];
    for (int k = 0; k < n; ++k) CHECK(in_drive[k] == 1 << k);
  }
}

TEST_CASE("frictionless: 2^n - 1 pivots for E_n up to n = 12, exactly") {
  for (int n = 9; n <= 12; ++n) {
    const ExactRun run = RunExact(ExponentialFamily(n), {});
    CHECK(run.verdict.outcome == Outcome::kSolved);
    CHECK(run.verdict.statistics.pivots == (1 << n) - 1);
  }
}

// readings.md, part 10: the order of the scan decides, and no other switch.
TEST_CASE("frictionless: E_n takes 2^n - 1 pivots under every scan that takes the lowest violated normal") {
  constexpr int n = 5, kMost = (1 << n) - 1;
  int lowest = 0;
  for (const Policy& policy : PlanarGrid()) {
    CAPTURE(PolicyName(policy));
    const Request request{.policy = policy};
    const auto pivots = [&](bool scaled) {
      const ExactRun run = RunExact(ExponentialFamily(n, scaled), request);
      CHECK(run.verdict.outcome == Outcome::kSolved);
      return run.verdict.statistics.pivots;
    };
    if (policy.scan == Scan::kHighest) {
      CHECK(pivots(false) < kMost);
    } else {
      CHECK(pivots(true) == kMost);
      CHECK((pivots(false) == kMost) == (policy.scan != Scan::kMostViolated));
      ++lowest;
    }
  }
  CHECK(lowest == 1536 * 3 / 4);
}

}  // namespace
}  // namespace stiction
