// SPDX-License-Identifier: Apache-2.0
// The planar methods over intervals: the pivots of rationals, and forces within their ends.

#include "certify/intervals.h"

#include <catch2/catch.hpp>

#include "certify/exact.h"
#include "certify/existence.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// Positive definite, numbers that are no doubles and tie by no accident.
ExactProblem Generic(int contacts, std::uint64_t seed) {
  Choices choices(seed);
  static const std::vector<Rational> palette = {Rational(1, 5), Rational(1, 3), 1, 2, 5};
  ExactProblem problem;
  const int rows = 2 * contacts;
  for (int i = 0; i < contacts; ++i)
    problem.contacts.push_back({ContactKind::kStatic, palette[choices.Integer(0, 4)], {}});
  ExactMatrix J(rows, rows);
  for (Rational& x : J.reshaped()) x = Rational(choices.Integer(-1000, 1000)) / 7;
  problem.A = J * J.transpose();
  problem.b.resize(rows);
  for (int i = 0; i < rows; ++i) {
    problem.A(i, i) += 1;
    problem.b[i] = Rational(choices.Integer(-1000, i % 2 == 0 ? 300 : 1000)) / 3;
  }
  return problem;
}

// What the pivots did, in words.
template <class Scalar>
std::vector<std::string> Steps(const std::vector<Pivot<Scalar>>& pivots) {
  std::vector<std::string> steps;
  for (const auto& pivot : pivots) {
    steps.push_back(std::to_string(pivot.driven) + " " + std::to_string(pivot.limiting) + " " + Name(pivot.to) +
                    " " + pivot.entering + " " + pivot.leaving);
  }
  return steps;
}

void CheckEnclosed(const std::vector<Enclosure>& ends, const ExactVector& values) {
  REQUIRE(ends.size() == static_cast<std::size_t>(values.size()));
  for (std::size_t i = 0; i < ends.size(); ++i) {
    CHECK(Rational(ends[i].low) <= values[i]);
    CHECK(values[i] <= Rational(ends[i].high));
  }
}

// Whether the run was decided. What it says is what the exact run says, pivot by pivot.
bool Agrees(const IntervalRun& run, const Verdict& verdict, const std::vector<Pivot<Rational>>& pivots,
            const ExactVector& f, const ExactVector& a) {
  const auto steps = Steps(run.pivots), exact = Steps(pivots);
  REQUIRE(steps.size() <= exact.size());
  CHECK(std::equal(steps.begin(), steps.end(), exact.begin()));
  if (run.verdict.outcome == Outcome::kUndecided) {
    CHECK(run.verdict.reason == "a sign is unsure");
    return false;
  }
  CHECK(run.verdict.outcome == verdict.outcome);
  CHECK(run.verdict.statistics == verdict.statistics);
  CHECK(steps.size() == exact.size());
  if (verdict.outcome == Outcome::kSolved) {
    CheckEnclosed(run.f, f);
    CheckEnclosed(run.a, a);
  }
  return true;
}

bool PublishedAgrees(const ExactProblem& problem, const PublishedOptions& options) {
  const ExactRun exact = RunExact(problem, options);
  return Agrees(RunPublishedOverIntervals(problem, options, KeepTrace::kYes), exact.verdict, exact.trace.pivots,
                exact.state.f, exact.a);
}

bool LemkeAgrees(const ExactProblem& problem) {
  LemkeAlgorithm<Rational> lemke;
  Trace<Rational> trace;
  const Verdict verdict = lemke.Run(problem, &trace);
  return Agrees(RunLemkeOverIntervals(problem, {}, KeepTrace::kYes), verdict, trace.pivots, lemke.f(),
                lemke.a());
}

TEST_CASE("intervals: of 300 generic problems the published algorithm is decided on 297 or more") {
  int decided = 0, bounces = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    const ExactProblem problem = Generic(1 + static_cast<int>(seed % 5), seed);
    decided += PublishedAgrees(problem, {});
    bounces += RunExact(problem, {}).verdict.statistics.zero_steps > 0;
  }
  CAPTURE(bounces);
  CHECK(decided >= 297);
  CHECK(bounces > 0);  // zero steps are known from the sets
}

TEST_CASE("intervals: of 300 generic problems Lemke's method is decided on 297 or more") {
  int decided = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    decided += LemkeAgrees(Generic(1 + static_cast<int>(seed % 5), seed));
  }
  CHECK(decided >= 297);
}

TEST_CASE("intervals: a problem beyond the doubles is undecided or refused, nothing worse") {
  const Rational huge = Number("1e309");
  for (int entry = 0; entry < 4; ++entry) {
    ExactProblem problem = MakeProblem({1}, {{2, 0}, {0, 3}}, {-1, 1});
    if (entry == 0) problem.A(0, 0) = huge;
    if (entry == 1) problem.A(1, 1) = huge;
    if (entry == 2) problem.b[0] = -huge;
    if (entry == 3) problem.contacts[0].mu = huge;
    CAPTURE(entry);
    const IntervalRun run = RunPublishedOverIntervals(problem, {});
    if (run.verdict.outcome == Outcome::kSolved)
      CHECK(RunExact(problem, {}).verdict.outcome == Outcome::kSolved);
  }
}

TEST_CASE("intervals: with ties, cycles and rays no verdict is wrong") {
  int decided = 0, all = 0;
  for (const GeneratorRow& generator : Generators()) {
    if (!generator.IsPlain()) continue;
    for (int index = 0; index < 15; ++index) {
      const ExactProblem problem = Random<Rational>(generator.id, 1 + index % 3, index);
      for (const char* policy : {"paper", "admit=eager,file=yes,apex=suspended"}) {
        CAPTURE(generator.name, index, policy);
        PublishedOptions options;
        options.policy = ParsePolicy(policy);
        decided += PublishedAgrees(problem, options);
        ++all;
      }
      LemkeAgrees(problem);
    }
  }
  CHECK(decided > 0);
  CHECK(decided < all);
  for (const CyclingSeed& seed : CyclingSeeds()) PublishedAgrees(Cycling(seed), {});
  PublishedAgrees(GiveUpProblem(), {});
  PublishedAgrees(NoSolution(), {});
  LemkeAgrees(NoSolution());
  CHECK(PublishedAgrees(NoContacts(), {}));
  CHECK(LemkeAgrees(NoContacts()));
}

TEST_CASE("intervals: bilateral and sliding contacts leave exactly, and runs are told in their terms") {
  int decided = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    const ExactProblem problem = Bordered(Generic(2, seed));
    const ExactRun exact = RunExact(problem, {});
    const IntervalRun run = RunPublishedOverIntervals(problem, {}, KeepTrace::kYes);
    decided += Agrees(run, exact.verdict, exact.trace.pivots, exact.state.f, exact.a);
    const IntervalRun lemke = RunLemkeOverIntervals(problem, {});
    REQUIRE(lemke.verdict.outcome == Outcome::kSolved);
    CHECK(lemke.f.size() == static_cast<std::size_t>(problem.rows()));
  }
  CHECK(decided >= 55);
}

}  // namespace
}  // namespace stiction
