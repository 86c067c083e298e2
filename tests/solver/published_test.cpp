// SPDX-License-Identifier: Apache-2.0
// The published algorithm on problems with known behaviour, and how runs end.

#include "solver/published/published.h"

#include <catch2/catch.hpp>
#include <limits>
#include <map>

#include "certify/exact/verify_solution.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

std::vector<Rational> StepsOfPeriod(const ExactRun& run) {
  std::vector<Rational> steps;
  for (const auto& pivot : run.trace.pivots) {
    if (pivot.drive > run.verdict.start) steps.push_back(pivot.s);
  }
  return steps;
}

const std::vector<Rational>& ReferencePeriod() {
  static const std::vector<Rational> steps = {Rational(6, 5),
                                              0,
                                              Rational(39, 290),
                                              Rational(791, 310),
                                              0,
                                              Rational(3, 62),
                                              Rational(19, 310),
                                              Rational(1, 10),
                                              Rational(1, 9),
                                              Rational(65, 63)};
  return steps;
}

TEST_CASE("published: the reference problem cycles step for step as the specification says") {
  const ExactRun run = RunExact(ReferenceProblem(), {});
  CHECK(run.verdict.outcome == Outcome::kCycle);
  CHECK(run.verdict.start == 3);
  CHECK(run.verdict.period == 4);
  CHECK(StepsOfPeriod(run) == ReferencePeriod());
}

TEMPLATE_TEST_CASE("published: inexact arithmetic sees the cycle of the reference problem", "", float, double) {
  PublishedAlgorithm<TestType> algorithm;
  Trace<TestType> trace;
  const auto problem = As<TestType>(ReferenceProblem());
  const Verdict verdict = algorithm.Run(problem, &trace);
  CHECK(verdict.outcome == Outcome::kCycle);
  CHECK(verdict.period == 4);
  const ExactRun exact = RunExact(ReferenceProblem(), {});
  REQUIRE(trace.pivots.size() >= exact.trace.pivots.size());
  for (std::size_t k = 0; k < exact.trace.pivots.size(); ++k) {
    CHECK(trace.pivots[k].limiting == exact.trace.pivots[k].limiting);
    CHECK(trace.pivots[k].to == exact.trace.pivots[k].to);
    CHECK(static_cast<double>(trace.pivots[k].s) == Approx(ToDouble(exact.trace.pivots[k].s)).margin(1e-4));
  }
}

TEST_CASE("published: of the grid 1320 policies cycle on the reference problem, and 216 solve it") {
  std::map<Outcome, std::size_t> counts;
  for (const PolicyClass& equal : RunPolicies(ReferenceProblem(), PlanarGrid(), {})) {
    counts[equal.verdict.outcome] += equal.policies.size();
    if (equal.verdict.outcome != Outcome::kSolved) continue;
    CHECK(RunExact(ReferenceProblem(), {.policy = equal.policies.front()}).f ==
          Vector({1, Rational(-6, 7), Rational(25, 14), Rational(-25, 14)}));
    for (const Policy& policy : equal.policies) {
      CHECK((policy.file == File::kYes && policy.drop == Drop::kVariable));
    }
  }
  CHECK(counts == std::map<Outcome, std::size_t>{{Outcome::kCycle, 1320}, {Outcome::kSolved, 216}});
}

TEST_CASE("published: the problem of theory 6.3 is solved with a give-up after a zero step") {
  const ExactRun run = RunExact(GiveUpProblem(), {});
  CHECK(run.verdict.outcome == Outcome::kSolved);
  CHECK(run.verdict.statistics.give_ups >= 1);
  CHECK(run.verdict.statistics.bounces >= 1);
  CHECK(run.verdict.statistics.zero_steps >= 1);
  CHECK(FindViolation(GiveUpProblem(), run.f) == std::nullopt);
}

TEST_CASE("published: the problem of theory 6.4 cycles under file=yes and kin only") {
  const ExactProblem problem =
      MakeProblem({10, 3}, {{6, 2, 5, 5}, {2, 6, 7, 3}, {5, 7, 10, 7}, {5, 3, 7, 10}}, {-7, 9, 1, 9});
  const ExactVector solution =
      Vector({Rational(169, 212), Rational(-845, 106), Rational(5383, 636), Rational(-3073, 636)});
  CHECK(RunExact(problem, {}).f == solution);
  std::size_t cycles = 0;
  for (const PolicyClass& equal : RunPolicies(problem, PlanarGrid(), {})) {
    if (equal.verdict.outcome == Outcome::kSolved) {
      CHECK(RunExact(problem, {.policy = equal.policies.front()}).f == solution);
      continue;
    }
    CHECK(equal.verdict.outcome == Outcome::kCycle);
    cycles += equal.policies.size();
    for (const Policy& policy : equal.policies) CHECK(policy.file == File::kYes);
  }
  CHECK(cycles > 0);
}

TEST_CASE("published: no contacts and no violated condition are solved without a drive") {
  for (const Policy& policy :
       {Policy{}, ParsePolicy("scan=highest"), ParsePolicy("scan=most-violated,resume=round")}) {
    for (const ExactProblem& problem : {NoContacts(), ThreeSolutions()}) {
      const Verdict verdict = RunExact(problem, {.policy = policy}).verdict;
      CHECK(verdict.outcome == Outcome::kSolved);
      CHECK(verdict.statistics.drives == 0);
      CHECK(verdict.statistics.outer_scans == 1);
    }
  }
}

// The rows that are driven, one for each drive.
std::vector<int> DrivenRows(const ExactRun& run) {
  std::vector<int> rows;
  for (const auto& pivot : run.trace.pivots) {
    if (pivot.drive > static_cast<int>(rows.size())) rows.push_back(pivot.driven);
  }
  return rows;
}

TEST_CASE("published: most-violated takes normals by -aN, then frictions by abs(aF), of equal ones the first") {
  ExactProblem problem = MakeProblem({1, 1, 1}, {}, {-1, 1, -1, Rational(-2), -1, Rational(2)});
  problem.A = ExactMatrix::Identity(6, 6);
  const Request request = {.policy = ParsePolicy("scan=most-violated")};
  CHECK(DrivenRows(RunExact(problem, request)) == std::vector{0, 2, 4, 3, 5, 1});
  problem.b[4] = -3;
  problem.b[1] = 5;
  CHECK(DrivenRows(RunExact(problem, request)) == std::vector{4, 0, 2, 1, 3, 5});
}

TEST_CASE("published: a driven friction that reaches zero after a zero step is not given up") {
  const ExactRun run = RunExact(ReferenceProblem(), {.policy = ParsePolicy("give-up=previous")});
  int found = 0;
  for (std::size_t k = 1; k < run.trace.pivots.size(); ++k) {
    const auto &pivot = run.trace.pivots[k], &before = run.trace.pivots[k - 1];
    if (pivot.goal != DriveGoal::kZero || pivot.limiting != pivot.driven) continue;
    CHECK_FALSE(pivot.gave_up);
    found += before.drive == pivot.drive && before.s == 0;
  }
  CHECK(found > 0);
}

TEST_CASE("published: without b in range(A) there can be a ray, with its direction") {
  const ExactRun run = RunExact(MakeProblem({1}, {{0, 0}, {0, 0}}, {-1, 0}), {});
  CHECK(run.verdict.outcome == Outcome::kRay);
  CHECK(run.ray == Vector({1, 0}));
  CHECK(RunExact(NoSolution(), {}).verdict.outcome != Outcome::kSolved);
}

TEST_CASE("published: a direction system without a solution ends in `singular`") {
  // N2 takes over from N1; driving N3 brings N1 back, and [1 1; 1 1] x = [1; 0] has no solution.
  const ExactProblem problem = MakeProblem({-1, -1, -1}, {{1, 1, -1}, {1, 1, 0}, {-1, 0, 5}}, {-1, -2, -10});
  const Verdict verdict = RunExact(problem, {}).verdict;
  CHECK(verdict.outcome == Outcome::kSingular);
  CHECK(verdict.statistics.singular_directions == 1);
  CHECK(PublishedAlgorithm<double>().Run(As<double>(problem)).outcome == Outcome::kSingular);
}

// ---- Budgets ---------------------------------------------------------------------------------

TEMPLATE_TEST_CASE("published: a budget that just suffices changes nothing, one less ends in `limit`", "",
                   double, Rational) {
  const auto problem = As<TestType>(GiveUpProblem());
  PublishedAlgorithm<TestType> algorithm;
  const Verdict free = algorithm.Run(problem);
  REQUIRE(free.outcome == Outcome::kSolved);
  const auto run = [&](const Limits& limits) {
    algorithm.request().limits = limits;
    return algorithm.Run(problem);
  };
  const std::int64_t drives = free.statistics.drives, steps = free.statistics.steps;
  CHECK(run({.drives = drives}).statistics == free.statistics);
  CHECK(run({.pivots = steps}).statistics == free.statistics);
  const Verdict few_drives = run({.drives = drives - 1}), few_pivots = run({.pivots = steps - 1});
  CHECK(few_drives.outcome == Outcome::kLimit);
  CHECK(few_drives.reason == "drives");
  CHECK(few_pivots.outcome == Outcome::kLimit);
  CHECK(few_pivots.reason == "pivots");
  CHECK(few_pivots.statistics.steps == steps - 1);
}

TEST_CASE("published: forces with more bits than the budget end in `limit`") {
  const Verdict verdict = RunExact(ReferenceProblem(), {.limits = {.bits = 4}}).verdict;
  CHECK(verdict.outcome == Outcome::kLimit);
  CHECK(verdict.reason == "bits");
  CHECK(RunExact(ReferenceProblem(), {.limits = {.bits = 64}}).verdict.outcome == Outcome::kCycle);
}

// ---- What is no number -----------------------------------------------------------------------

// Every number of a problem in turn: visit(reference to it).
template <class Scalar, class Visit>
void ForEachNumber(ContactProblem<Scalar>& problem, Visit visit) {
  for (int i = 0; i < problem.rows(); ++i) {
    visit(problem.b[i]);
    for (int j = 0; j < problem.rows(); ++j) visit(problem.A(i, j));
  }
  for (auto& contact : problem.contacts) visit(contact.mu);
}

TEMPLATE_TEST_CASE("published: a problem with a number that is none is undecided, never solved", "", float,
                   double) {
  auto problem = As<TestType>(ReferenceProblem());
  PublishedAlgorithm<TestType> algorithm;
  int position = 0;
  ForEachNumber(problem, [&](TestType& number) {
    const TestType kept = number;
    for (const TestType bad :
         {std::numeric_limits<TestType>::quiet_NaN(), std::numeric_limits<TestType>::infinity()}) {
      CAPTURE(position, bad);
      number = bad;
      CHECK(Name(algorithm.Run(problem).outcome) == "undecided");
    }
    number = kept;
    ++position;
  });
}

TEST_CASE("published: an overflow on the way is undecided, never solved") {
  const Rational tiny = Number("1e-300"), huge = Number("1e300");
  const auto problem = As<double>(MakeProblem({1}, {{tiny, 0}, {0, tiny}}, {-huge, huge}));
  CHECK(Name(PublishedAlgorithm<double>().Run(problem).outcome) == "undecided");
}

}  // namespace
}  // namespace stiction
