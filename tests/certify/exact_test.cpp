// SPDX-License-Identifier: Apache-2.0
// Runs of the whole grid: policies share a run only if they take the same steps.

#include "certify/exact.h"

#include <array>
#include <catch2/catch.hpp>
#include <set>

#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// Every policy of the grid run by itself, against the class that speaks for it.
void CheckAgainstBruteForce(const ExactProblem& problem) {
  std::set<std::string> seen;
  for (const PolicyClass& equal : RunPolicies(problem, PlanarGrid(), {})) {
    for (const Policy& policy : equal.policies) {
      CAPTURE(PolicyName(policy), PolicyName(equal.policies.front()));
      CHECK(seen.insert(PolicyName(policy)).second);
      const Verdict verdict = RunExact(problem, {policy, {}, {}}).verdict;
      REQUIRE(verdict.outcome == equal.verdict.outcome);
      REQUIRE(verdict.start == equal.verdict.start);
      REQUIRE(verdict.period == equal.verdict.period);
      REQUIRE(verdict.statistics == equal.verdict.statistics);
    }
  }
  CHECK(seen.size() == PlanarGrid().size());
}

TEST_CASE("policy classes: on problems that cycle the grid ends as it does policy by policy") {
  CheckAgainstBruteForce(ReferenceProblem());
  for (const CyclingSeed& seed : CyclingSeeds()) {
    CAPTURE(seed.index);
    CheckAgainstBruteForce(Cycling(seed));
  }
}

TEST_CASE("policy classes: on other problems too") {
  CheckAgainstBruteForce(GiveUpProblem());
  CheckAgainstBruteForce(NoContacts());
  CheckAgainstBruteForce(NoSolution());
  for (const int index : {2104, 2202, 2458}) {  // where the order of ties matters
    CheckAgainstBruteForce(Random<Rational>(GeneratorId::kSmall, 3, index));
  }
  for (int index = 0; index < 30; ++index) {
    CAPTURE(index);
    const auto id = index % 2 == 0 ? GeneratorId::kSmall : GeneratorId::kDuplicates;
    CheckAgainstBruteForce(Random<Rational>(id, 2 + index % 2, index));
  }
}

TEST_CASE("policy classes: all end in an outcome if each does") {
  const std::vector<Policy> cycling = {Policy{}, ParsePolicy("ties=contacts"), ParsePolicy("resume=round")};
  CHECK(AllEndIn(Outcome::kCycle, ReferenceProblem(), cycling, {}));
  CHECK_FALSE(AllEndIn(Outcome::kCycle, ReferenceProblem(), PlanarGrid(), {}));
  CHECK(AllEndIn(Outcome::kSolved, ThreeSolutions(), PlanarGrid(), {}));
  CHECK(AllEndIn(Outcome::kSolved, ReferenceProblem(), {}, {}));
}

// readings.md, 7: each drive ends with another clamped set, ties or not, whatever is given up on the way.
TEST_CASE("exact runs: without friction every policy solves within 2^n - 1 drives, degenerate or not") {
  // safe-tie-yet-given-up of the corpus.
  const ExactProblem tie =
      MakeProblem({-1, -1, -1}, {{20, -10, -2}, {-10, 20, 20}, {-2, 20, 40}}, {2, -20, -100});
  const Verdict verdict = RunExact(tie, {ParsePolicy("apex=suspended"), {}, {}}).verdict;
  CHECK(verdict.outcome == Outcome::kSolved);
  CHECK(verdict.statistics.give_ups == 1);
  CHECK(verdict.statistics.drives == 4);
  for (int index = 0; index < 150; ++index) {
    const int contacts = 2 + index % 4;
    Choices choices(ProblemSeed(1994, 77, static_cast<std::uint64_t>(index)));
    // A = J J', b = J y of rank at most two, of entries -1, 0, 1.
    std::vector<std::vector<Rational>> A(contacts, std::vector<Rational>(contacts));
    std::vector<Rational> b(contacts);
    std::vector<std::array<std::int64_t, 2>> J(contacts);
    const std::array<std::int64_t, 2> y = {choices.Integer(-1, 1), choices.Integer(-1, 1)};
    for (auto& row : J) row = {choices.Integer(-1, 1), choices.Integer(-1, 1)};
    for (int i = 0; i < contacts; ++i) {
      b[i] = J[i][0] * y[0] + J[i][1] * y[1];
      for (int j = 0; j < contacts; ++j) A[i][j] = J[i][0] * J[j][0] + J[i][1] * J[j][1];
    }
    const ExactProblem problem = MakeProblem(std::vector<Rational>(contacts, -1), A, b);
    for (const PolicyClass& equal : RunPolicies(problem, PlanarGrid(), {})) {
      CAPTURE(index, PolicyName(equal.policies.front()));
      CHECK(equal.verdict.outcome == Outcome::kSolved);
      CHECK(equal.verdict.statistics.drives < (1 << contacts));
    }
  }
}

TEST_CASE("variables are named by kind and contact, counted from one") {
  const ExactProblem problem = MakeProblem({-1, 1}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0});
  CHECK(VariableNames(problem) == std::vector<std::string>{"N1", "N2", "F2"});
}

}  // namespace
}  // namespace stiction
