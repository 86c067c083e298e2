// SPDX-License-Identifier: Apache-2.0
// Dials and buildings of `stiction bench`, and its statistics by hand.

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <set>

#include "bench/counted.h"
#include "bench/dials.h"
#include "bench/peak.h"
#include "bench/peers/plain_gauss.h"
#include "bench/structure.h"
#include "certify/exact/exact.h"
#include "certify/exact/properties.h"
#include "corpus/json.h"
#include "corpus/order_statistics.h"
#include "corpus/record/problem_file.h"
#include "search/generators/drawing.h"
#include "solver/numeric/fast.h"
#include "solver/published/published.ipp"
#include "solver/solve.h"
#include "tests/methods.h"

namespace stiction {
namespace {

TEST_CASE("bench: quartiles by hand") {
  const Quartiles q = QuartilesOf({7, 1, 3, 5, 9, 2, 8, 4});  // sorted 1 2 3 4 5 7 8 9
  CHECK(q.low == 3);
  CHECK(q.median == 5);
  CHECK(q.high == 8);
  CHECK(q.ninety == 9);
  CHECK((q.least == 1 && q.most == 9));
  CHECK(QuartilesOf({}).most == 0);
  const Quartiles one = QuartilesOf({4});
  CHECK((one.low == 4 && one.median == 4 && one.high == 4 && one.ninety == 4));
}

// Whether b = A x for some x, to rounding.
bool IsInRange(const ContactProblem<double>& problem) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(1e-11);
  solver.compute(problem.A);
  const Eigen::VectorXd rest = problem.A * solver.solve(problem.b) - problem.b;
  return rest.lpNorm<Eigen::Infinity>() <= 1e-6 * problem.b.lpNorm<Eigen::Infinity>();
}

bool IsSymmetric(const ContactProblem<double>& problem) {
  return (problem.A - problem.A.transpose()).cwiseAbs().maxCoeff() <= 1e-12 * problem.A.maxCoeff();
}

TEST_CASE("bench: buildings are of their size, symmetric, b in the range of A, with friction or without") {
  for (const bool friction : {true, false}) {
    for (const int dimension : {2, 3}) {
      const Building building = {dimension, friction, 2};
      const int rows = friction ? dimension : 1, faces = dimension == 2 ? 2 : 4;
      Choices choices(7);
      const auto stack = StackProblem(3, building, choices), wall = WallProblem(3, 2, building, choices);
      CHECK(stack.rows() == 3 * faces * rows);
      CHECK(wall.rows() > stack.rows());
      for (const auto& problem : {stack, wall}) {
        CHECK(problem.dimension == dimension);
        CHECK((IsSymmetric(problem) && IsInRange(problem)));
        for (const auto& contact : problem.contacts) CHECK((contact.mu > 0) == friction);
      }
    }
  }
  Choices choices(7);
  const auto channel = ChannelProblem(4, {2, true, 0}, choices);
  CHECK(channel.contacts.size() == 8);  // floor or disc below, and a wall
  CHECK((IsSymmetric(channel) && IsInRange(channel)));
}

TEST_CASE("bench: stacks and walls of equal masses are solved by guesses, though their forces are not unique") {
  for (const bool wall : {false, true}) {
    int driven = 0;
    FastSolver<double> solver;
    for (int seed = 0; seed < 20; ++seed) {
      Choices choices(seed);
      const auto problem = wall ? WallProblem(5, 4, {}, choices) : StackProblem(10, {}, choices);
      const auto answer = Solve(problem, {.method = "fast"});
      CHECK(answer.Solved());
      const RunEnd<> verdict = solver.Run(problem);
      CHECK(verdict.outcome == Outcome::kSolved);
      driven += verdict.statistics[Counter::kPublished] > 0;
    }
    CHECK(driven <= 1);  // of 20; where a singular M is given up, 4 stacks and 20 walls
  }
}

TEST_CASE("bench: masses of a building differ as much as is asked for, and the seed draws them") {
  const auto most = [](int decades) {
    double spread = 0;
    for (int seed = 0; seed < 5; ++seed) {
      Choices choices(seed);
      const Eigen::VectorXd diagonal = StackProblem(10, {2, true, decades}, choices).A.diagonal();
      spread = std::max(spread, diagonal.maxCoeff() / diagonal.minCoeff());
    }
    return spread;
  };
  CHECK(most(0) < 10);
  CHECK(most(4) > 1e3);
  CHECK(most(4) < 1e5);
  const auto with_seed = [](int seed) {
    Choices choices(seed);
    return StackProblem(10, {2, true, 4}, choices).A;
  };
  CHECK(with_seed(1) == with_seed(1));
  CHECK(with_seed(1) != with_seed(2));
}

TEST_CASE("bench: a dial is a function of its arguments, of its dimension, and semidefinite over rationals") {
  for (const Dials which : {Dials::kLadder, Dials::kGate}) {
    for (const Source& source : DialSources(which, {})) {
      if (source.is_large) continue;
      CAPTURE(source.family, source.setting);
      const ExactProblem problem = source.make(3, 1);
      CHECK(*ProblemToJson(problem) == *ProblemToJson(source.make(3, 1)));
      CHECK(problem.dimension == (source.family.rfind("space-", 0) == 0 ? 3 : 2));
      CHECK(problem.rows() == RowCount(problem.contacts, problem.dimension));
      CHECK(std::holds_alternative<LdltFactors>(DecideSemidefinite(problem.A)));
    }
  }
  CHECK(DialSources(Dials::kLadder, {"tame", "stack"}).size() == 6);
  CHECK_THROWS_WITH(DialSources(Dials::kLadder, {"jam"}), Catch::Contains("found 'jam'"));
}

TEST_CASE("bench: a double that counts ends as a double does, and counts") {
  PublishedAlgorithm<Counted, 4> counted;
  PublishedAlgorithm<double, 4> plain;
  for (int index = 0; index < 200; ++index) {
    ContactProblem<double, 4> problem;
    ContactProblem<Counted, 4> same;
    Choices choices(ProblemSeed(1, 1, index)), again(ProblemSeed(1, 1, index));
    Generate<double, 4>(GeneratorId::kIntegers, 2, kDefaultPalette, choices, problem);
    generators::DrawFriction(kDefaultPalette, again, same);
    generators::FillIntegers(again, same);
    const Verdict expected = plain.Run(problem), verdict = counted.Run(same);
    CHECK(verdict.outcome == expected.outcome);
    CHECK(verdict.statistics == expected.statistics);
    for (int row = 0; row < 4; ++row) CHECK(counted.state().f[row].value() == plain.state().f[row]);
  }
  Counted::counts() = {};
  Counted x = 3;
  x = (x + 1) * x - x / 2;
  CHECK((x > 10 && x <= 10.5));
  const OperationCounts counts = Counted::counts();
  CHECK((counts.sums == 2 && counts.products == 1 && counts.quotients == 1 && counts.comparisons == 2));
}

TEST_CASE("bench: the peak of a processor is positive") {
  for (const InstructionSet set : InstructionSets()) {
    const Peak peak = MeasurePeak(set);
    CHECK((peak.operations > 0 && peak.quotients > 0 && peak.bytes > 0));
  }
}

TEST_CASE("bench: plain elimination solves the system") {
  Choices choices(1);
  ContactProblem<double> problem;
  Generate<double, Eigen::Dynamic>(GeneratorId::kPsd, 8, kDefaultPalette, choices, problem);
  problem.A.diagonal().array() += 1;
  PlainGauss gauss;
  gauss.Solve(problem.A, problem.b);
  const Eigen::VectorXd rest = problem.A * gauss.x() + problem.b;
  CHECK(rest.lpNorm<Eigen::Infinity>() <= 1e-6 * problem.b.lpNorm<Eigen::Infinity>());
}

}  // namespace
}  // namespace stiction
