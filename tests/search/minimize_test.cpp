// SPDX-License-Identifier: Apache-2.0
// The minimizer: what it returns is simpler, shows the same, and cannot be made simpler by it.

#include "search/units/minimize.h"

#include <catch2/catch.hpp>

#include "certify/exact/properties.h"
#include "certify/exact/published_space.h"
#include "corpus/json.h"
#include "corpus/record/problem_file.h"
#include "search/generators/rounding.h"
#include "search/units/signature.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;
using Catch::Contains;

bool Same(const ExactProblem& x, const ExactProblem& y) { return *ProblemToJson(x) == *ProblemToJson(y); }

std::string Lack(const ExactProblem& problem, const MinimizeOptions& options) {
  try {
    (void)Minimize(problem, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST_CASE("minimize: units are found for numbers that no double holds") {
  const Rational large(mpz_class("1" + std::string(400, '0')));
  ExactProblem problem;
  problem.contacts.assign(2, {.kind = ContactKind::kFrictionless, .mu = 0, .slip = {0, 0}});
  problem.A = ExactMatrix::Constant(2, 2, Rational(0));
  problem.A(0, 0) = large;
  problem.A(1, 1) = 1 / large;
  problem.b = ExactVector::Constant(2, Rational(-1));
  const ExactProblem even = Equilibrated(problem);
  for (int i = 0; i < 2; ++i) CHECK((even.A(i, i) >= Rational(1, 4) && even.A(i, i) <= 4));
}

TEST_CASE("minimize: outcome and assumptions are kept, the problem becomes simpler and cannot become simpler",
          "[slow]") {
  for (const CyclingSeed& seed : CyclingSeeds()) {
    CAPTURE(seed.index, seed.contacts);
    const ExactProblem problem = Cycling(seed);
    const Minimized small = Minimize(problem, {});
    CHECK(RunExact(small.problem, {}).verdict.outcome == Outcome::kCycle);
    CHECK(MeetsAssumptions(small.problem));
    CHECK(SimplicityOf(small.problem) < SimplicityOf(problem));
    CHECK(small.accepted > 0);
    CHECK(small.candidates >= small.accepted);
    CHECK_FALSE(small.cancelled);
    const Minimized again = Minimize(small.problem, {});
    CHECK(Same(again.problem, small.problem));
    CHECK(again.accepted == 0);
  }
}

// As problems that were rounded to doubles for a solver under test.
TEST_CASE("minimize: what only `keeps` asks for may have an A that is not semidefinite") {
  ExactProblem problem = ReferenceProblem();
  problem.A.setConstant(Rational(2, 7));
  problem.A.diagonal().setConstant(Rational(1, 7));
  MinimizeOptions options;
  options.keeps = [](const ExactProblem& candidate) {
    return !std::holds_alternative<LdltFactors>(DecideSemidefinite(candidate.A));
  };
  const Minimized small = Minimize(problem, options);
  CHECK(SimplicityOf(small.problem) < SimplicityOf(problem));
  CHECK(options.keeps(small.problem));
}

// As of a solver that answers by chance.
TEST_CASE("minimize: what does not hold a second time stays as it was") {
  MinimizeOptions options;
  options.keeps = [](const ExactProblem&) { return false; };
  const Minimized same = Minimize(ReferenceProblem(), options);
  CHECK(same.candidates > 0);
  CHECK(Same(same.problem, ReferenceProblem()));
}

TEST_CASE("minimize: the signature asked for is kept") {
  const ExactProblem problem = Cycling(CyclingSeeds().front());
  MinimizeOptions options;
  options.signature = Signature(problem, RunExact(problem, {}));
  const ExactProblem small = Minimize(problem, options).problem;
  CHECK(Signature(small, RunExact(small, {})) == *options.signature);
}

TEST_CASE("minimize: what every policy asked for shows, every one still shows") {
  std::vector<Policy> policies;
  for (const PolicyClass& equal : RunPolicies(ReferenceProblem(), PlanarGrid(), {})) {
    if (equal.verdict.outcome == Outcome::kCycle)
      policies.insert(policies.end(), equal.policies.begin(), equal.policies.end());
  }
  REQUIRE(policies.size() == 1320);
  MinimizeOptions options;
  options.policies = policies;
  const ExactProblem small = Minimize(ReferenceProblem(), options).problem;
  CHECK(AllEndIn(Outcome::kCycle, small, policies, {}));
  CHECK_FALSE(SimplicityOf(ReferenceProblem()) < SimplicityOf(small));
}

TEST_CASE("minimize: a cycle that the whole grid shows is kept under the whole grid") {
  int found = 0;
  for (const CyclingSeed& seed : CyclingSeeds()) {
    const ExactProblem problem = Cycling(seed);
    if (!AllEndIn(Outcome::kCycle, problem, PlanarGrid(), {})) continue;
    ++found;
    MinimizeOptions options;
    options.policies = PlanarGrid();
    const ExactProblem small = Minimize(problem, options).problem;
    CHECK(AllEndIn(Outcome::kCycle, small, PlanarGrid(), {}));
    CHECK(MeetsAssumptions(small));
  }
  CHECK(found > 0);
}

TEST_CASE("minimize: a problem that is not interesting is refused with what it lacks") {
  CHECK_THAT(Lack(ThreeSolutions(), {}), Contains("under paper it ends in solved, not in cycle"));
  ExactProblem problem = ReferenceProblem();
  problem.A(0, 1) += 1;
  CHECK_THAT(Lack(problem, {}), Contains("not symmetric"));
  problem.A(1, 0) += 1;
  problem.A(1, 1) = 0;
  CHECK_THAT(Lack(problem, {}), Contains("not positive semidefinite"));
  CHECK_THAT(Lack(NoSolution(), {}), Contains("not in range(A)"));
  MinimizeOptions grid;
  grid.policies = PlanarGrid();
  CHECK_THAT(Lack(ReferenceProblem(), grid), Contains("not every policy"));
  MinimizeOptions other;
  other.signature = "cycle-2c-1d-1s";
  CHECK_THAT(Lack(ReferenceProblem(), other), Contains("another signature"));
}

TEST_CASE("minimize: no number of what is left can be made zero, its mirror with it") {
  const ExactProblem small = Minimize(ReferenceProblem(), {}).problem;
  int tried = 0;
  const auto is_interesting = [&tried](const ExactProblem& candidate) {
    ++tried;
    return MeetsAssumptions(candidate) && RunExact(candidate, {}).verdict.outcome == Outcome::kCycle;
  };
  for (int i = 0; i < small.rows(); ++i) {
    for (int j = 0; j < i; ++j) {
      ExactProblem candidate = small;
      if (candidate.A(i, j) == 0) continue;
      candidate.A(i, j) = candidate.A(j, i) = 0;
      CHECK_FALSE(is_interesting(candidate));
    }
    ExactProblem candidate = small;
    if (candidate.b[i] == 0) continue;
    candidate.b[i] = 0;
    CHECK_FALSE(is_interesting(candidate));
  }
  CHECK(tried > 4);
}

TEST_CASE("minimize: a solved problem shrinks to nothing") {
  MinimizeOptions options;
  options.keep = Outcome::kSolved;
  CHECK(Minimize(GiveUpProblem(), options).problem.contacts.empty());
}

TEST_CASE("minimize: once cancelled, what was reached is returned and still interesting") {
  const ExactProblem problem = Cycling(CyclingSeeds().back());
  int asked = 0;
  MinimizeOptions options;
  options.cancelled = [&asked] { return ++asked > 200; };
  const Minimized stopped = Minimize(problem, options);
  CHECK(stopped.cancelled);
  CHECK(RunExact(stopped.problem, {}).verdict.outcome == Outcome::kCycle);
  CHECK(MeetsAssumptions(stopped.problem));
}

TEST_CASE("simplicity: contacts count before rows, then nonzeros, bits and magnitude") {
  const ExactProblem two = MakeProblem({-1, -1}, {{0, 0}, {0, 0}}, {0, 0});
  const ExactProblem one = MakeProblem({1}, {{1000, 1000}, {1000, 1000}}, {1000, 1000});
  const ExactProblem smooth = MakeProblem({-1}, {{1000}}, {1000});
  const ExactProblem sparse = MakeProblem({1}, {{1000, 0}, {0, 1000}}, {1000, 1000});
  const ExactProblem shorter = MakeProblem({1}, {{1000, 0}, {0, 1000}}, {1000, 500});
  const ExactProblem smaller = MakeProblem({1}, {{1000, 0}, {0, 1000}}, {1000, 999});
  const std::vector<ExactProblem> rising = {NoContacts(), smooth, shorter, smaller, sparse, one, two};
  for (std::size_t i = 0; i < rising.size(); ++i) {
    for (std::size_t j = 0; j < rising.size(); ++j) {
      CAPTURE(i, j);
      CHECK((SimplicityOf(rising[i]) < SimplicityOf(rising[j])) == (i < j));
    }
  }
  const ExactProblem negative = MakeProblem({-1}, {{1000}}, {-1000});
  CHECK(SimplicityOf(smooth) < SimplicityOf(negative));
  const ExactProblem fraction = MakeProblem({-1}, {{1000}}, {Rational(1000, 7)});
  CHECK(SimplicityOf(smooth) < SimplicityOf(fraction));
}

TEST_CASE("minimize: bilateral contacts are taken out, a sliding one with no part in the loop is dropped") {
  ExactProblem problem = Bordered(ReferenceProblem());
  const int rows = problem.rows();
  ExactProblem larger = problem;
  larger.contacts.push_back({ContactKind::kSliding, Rational(1, 3), {Rational(-1), Rational(0)}});
  larger.A = ExactMatrix::Zero(rows + 2, rows + 2);
  larger.A.topLeftCorner(rows, rows) = problem.A;
  larger.A(rows, rows) = larger.A(rows + 1, rows + 1) = 1;
  larger.b = ExactVector::Zero(rows + 2);
  larger.b.head(rows) = problem.b;
  larger.b[rows] = -1;
  REQUIRE(RunExact(larger, {}).verdict.outcome == Outcome::kCycle);
  MinimizeOptions options;
  options.signature = Signature(larger, RunExact(larger, {}));
  const ExactProblem small = Minimize(larger, options).problem;
  CHECK(small.contacts.size() == 2);
  CHECK(RunExact(small, {}).verdict.outcome == Outcome::kCycle);
  CHECK(Signature(small, RunExact(small, {})) == *options.signature);
}

TEST_CASE("minimize: in space what intervals prove is kept, and contacts go with all their rows") {
  ExactProblem loop;  // corpus/space/cycle-under-both-slips.json
  loop.dimension = 3;
  loop.contacts.assign(2, {ContactKind::kStatic, 3, {}});
  loop.A.resize(6, 6);
  loop.A << 3, 0, 0, 0, 0, 1, 0, 3, 1, 0, 1, -1, 0, 1, 3, -1, 1, 0, 0, 0, -1, 2, 0, 0, 0, 1, 1, 0, 3, 0, 1, -1,
      0, 0, 0, 3;
  loop.b.resize(6);
  loop.b << -1, 2, 0, -1, -2, 1;
  const int rows = loop.rows();
  ExactProblem larger = loop;
  larger.contacts.insert(larger.contacts.begin(), {ContactKind::kFrictionless, 0, {}});
  larger.contacts.push_back({ContactKind::kStatic, Rational(1, 3), {}});
  const int more = rows + 4;
  larger.A = 5 * ExactMatrix::Identity(more, more);
  larger.A.block(1, 1, rows, rows) = 3 * loop.A;
  larger.b = ExactVector::Constant(more, Rational(7, 3));
  larger.b.segment(1, rows) = 3 * loop.b;
  MinimizeOptions options;
  REQUIRE(RunIntervalsInSpace(larger, {}).outcome == Outcome::kCycle);
  const ExactProblem small = Minimize(larger, options).problem;
  CHECK(small.dimension == 3);
  CHECK(small.contacts.size() == 2);
  CHECK(MeetsAssumptions(small));
  CHECK(RunIntervalsInSpace(small, {}).outcome == Outcome::kCycle);
  CHECK(SimplicityOf(small) < SimplicityOf(larger));
  options.keep = Outcome::kRay;
  CHECK(Lack(larger, options) == "minimize: under paper it ends in cycle, not in ray");
}

}  // namespace
}  // namespace stiction
