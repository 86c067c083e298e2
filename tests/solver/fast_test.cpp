// SPDX-License-Identifier: Apache-2.0
// The fast method: solved means solved, whatever the guesses were; warm starts; other kinds of contacts.

#include "solver/numeric/fast.h"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// ---- No wrong answer is called solved --------------------------------------------------------

TEST_CASE("fast: singular frictionless problems of many contacts are solved without complete driving") {
  FastSolver<double> solver;
  std::int64_t updates = 0;
  for (int index = 0; index < 40; ++index) {
    CAPTURE(index);
    Choices choices(index);
    const int contacts = 20 + index;
    Eigen::MatrixXd J(contacts, contacts / 2);
    for (double& x : J.reshaped()) x = static_cast<double>(choices.Integer(-1000, 1000));
    Eigen::VectorXd y(contacts / 2);
    for (double& x : y) x = static_cast<double>(choices.Integer(-1000, 1000));
    ContactProblem<double> problem;
    problem.contacts.assign(contacts, {ContactKind::kFrictionless, 0, {}});
    problem.A = J * J.transpose();
    problem.b = J * y;
    const RunEnd<> verdict = solver.Run(problem);
    CHECK(verdict.outcome == Outcome::kSolved);
    CHECK(verdict.statistics[Counter::kFallbacks] == 0);
    updates += verdict.statistics[Counter::kUpdates];
    // Contacts that the method does not need are dropped: at most rank many carry a force.
    CHECK((solver.f().array() != 0).count() <= contacts / 2);
  }
  CHECK(updates > 100);
}

TEST_CASE("fast: problems of more than a panel of unknowns are solved") {
  FastSolver<double> solver;
  for (const bool friction : {false, true}) {
    for (int contacts : {33, 70, 120}) {
      CAPTURE(friction, contacts);
      Choices choices(contacts);
      const int rows = friction ? 2 * contacts : contacts;
      Eigen::MatrixXd J(rows, rows);
      for (double& x : J.reshaped()) x = static_cast<double>(choices.Integer(-1000, 1000)) / 1000;
      ContactProblem<double> problem;
      const ContactKind kind = friction ? ContactKind::kStatic : ContactKind::kFrictionless;
      problem.contacts.assign(contacts, {kind, friction ? 0.5 : 0.0, {}});
      problem.A = J * J.transpose();
      problem.b.resize(rows);
      for (double& x : problem.b) x = static_cast<double>(choices.Integer(-1000, 1000)) / 1000;
      const RunEnd<> verdict = solver.Run(problem);
      CHECK(verdict.outcome == Outcome::kSolved);
      CHECK(verdict.statistics[Counter::kFallbacks] == 0);
    }
  }
}

// ---- The way there ---------------------------------------------------------------------------

// The exchanges go round in circles, from every sweep.
ExactProblem CirclingProblem() {
  return MakeProblem({1, 1}, {{5, -4, -4, -6}, {-4, 7, 1, 6}, {-4, 1, 5, 5}, {-6, 6, 5, 10}}, {-1, -3, -2, 2});
}

TEST_CASE("fast: where guessing goes round in circles, the published algorithm finds the solution") {
  FastSolver<double> solver;
  const RunEnd<> verdict = solver.Run(As<double>(CirclingProblem()));
  CHECK(verdict.outcome == Outcome::kSolved);
  CHECK(verdict.statistics[Counter::kPublished] == 1);
  CHECK(verdict.statistics[Counter::kFallbacks] == 0);
  CHECK(verdict.statistics[Counter::kExchanges] > 0);
  CHECK(solver.Word() == "SS");
  CHECK(solver.f().isApprox(Eigen::Vector4d(27, 65.0 / 3, 88.0 / 3, -35.0 / 3)));
}

TEST_CASE("fast: where the published algorithm loops, too, complete driving finds the solution") {
  FastSolver<double> solver;
  const ExactProblem both = Decoupled(CirclingProblem(), ReferenceProblem());
  const RunEnd<> verdict = solver.Run(As<double>(both));
  CHECK(verdict.outcome == Outcome::kSolved);
  CHECK(verdict.statistics[Counter::kPublished] == 1);
  CHECK(verdict.statistics[Counter::kFallbacks] == 1);
  solver.drives = false;
  const RunEnd<> guessed = solver.Run(As<double>(both));
  CHECK(guessed.outcome == Outcome::kUndecided);
  CHECK(guessed.statistics[Counter::kPublished] == 0);
}

TEST_CASE("fast: a budget of complete driving ends the run, and says which") {
  FastSolver<double> solver;
  solver.request().limits.pivots = 1;
  const RunEnd<> verdict = solver.Run(As<double>(CirclingProblem()));
  CHECK(verdict.outcome == Outcome::kLimit);
  CHECK(verdict.reason == "pieces");
}

TEST_CASE(
    "fast: started in the cells of the solution it factors once, or twice if singular, and exchanges nothing") {
  FastSolver<double> solver;
  int exchanged = 0, twice = 0;
  for (int index = 0; index < 200; ++index) {
    const auto problem = Random<double>(GeneratorId::kIntegers, 1 + index % 8, index);
    const RunEnd<> cold = solver.Run(problem);
    if (cold.outcome != Outcome::kSolved || cold.statistics[Counter::kPublished] > 0) continue;
    exchanged += cold.statistics[Counter::kExchanges] > 0;
    const std::vector<Cell> cells = solver.cells();
    const Eigen::VectorXd f = solver.f();
    const RunEnd<> warm = solver.Run(problem, cells);
    CHECK(warm.outcome == Outcome::kSolved);
    const std::int64_t factored = warm.statistics[Counter::kFactorizations];
    warm.statistics.ForEach([](Counter c, std::int64_t value) {
      if (c != Counter::kFactorizations) CHECK(value == 0);
    });
    CHECK(factored <= 2);
    twice += factored == 2;
    if (problem.A.fullPivLu().isInvertible()) CHECK(solver.f().isApprox(f, 1e-6));
  }
  CHECK(exchanged > 20);
  CHECK(twice < 20);
}

TEST_CASE("fast: a guess that is wrong, or that the contacts cannot be in, leads to the solution too") {
  FastSolver<double> solver;
  const auto problem = As<double>(RandomFrictionless(6, 4));
  solver.Run(problem);
  const Eigen::VectorXd f = solver.f();
  for (const Cell cell : {Cell::kNone, Cell::kBreak, Cell::kStick, Cell::kUpper, Cell::kLower, Cell::kFree}) {
    const std::vector<Cell> guess(6, cell);
    REQUIRE(solver.Run(problem, guess).outcome == Outcome::kSolved);
    CHECK(solver.f().isApprox(f, 1e-9));
  }
  REQUIRE(solver.Run(problem, std::vector<Cell>(5, Cell::kBreak)).outcome ==
          Outcome::kSolved);  // of another size
  CHECK(solver.f().isApprox(f, 1e-9));
}

// ---- Kinds -----------------------------------------------------------------------------------

TEST_CASE("fast: no contacts at all are solved, and so is one") {
  FastSolver<double> solver;
  CHECK(solver.Run(As<double>(NoContacts())).outcome == Outcome::kSolved);
  CHECK(solver.f().size() == 0);
  CHECK(solver.Run(As<double>(MakeProblem({-1}, {{4}}, {-2}))).outcome == Outcome::kSolved);
  CHECK(solver.f()[0] == 0.5);
  CHECK(solver.Run(As<double>(MakeProblem({-1}, {{4}}, {2}))).outcome == Outcome::kSolved);
  CHECK(solver.f()[0] == 0);
  CHECK(solver.Run(As<double>(MakeProblem({1}, {{2, 0}, {0, 2}}, {-2, 4}))).outcome == Outcome::kSolved);
  CHECK(solver.f() == Eigen::Vector2d(1, -1));
  CHECK(solver.Word() == "-");
  CHECK(solver.Run(As<double>(MakeProblem({0}, {{2, 1}, {1, 2}}, {-2, 4}))).outcome == Outcome::kSolved);
  CHECK(solver.f() == Eigen::Vector2d(1, 0));
}

TEST_CASE("fast: a matrix that is not symmetric is noticed") {
  FastSolver<double> solver;
  const auto problem = As<double>(MakeProblem({-1, -1}, {{2, -1}, {1, 2}}, {-1, -3}));
  const RunEnd<> verdict = solver.Run(problem);
  REQUIRE(verdict.outcome == Outcome::kSolved);
  CHECK(verdict.statistics[Counter::kFallbacks] == 0);
  CHECK(solver.f().isApprox(Eigen::Vector2d(1, 1)));
}

TEST_CASE("fast: without friction the active set method is for symmetric matrices only") {
  FastSolver<double> solver;
  std::int64_t updates = 0, fallbacks = 0;
  for (const bool symmetric : {true, false}) {
    for (int index = 0; index < 100; ++index) {
      Choices choices(index);
      const auto draw = [&choices] { return static_cast<double>(choices.Integer(-3, 3)); };
      constexpr int kRows = 8, kRank = 3;
      Eigen::MatrixXd B(kRows, kRank), C(kRank, kRows);
      for (double& x : B.reshaped()) x = draw();
      for (double& x : C.reshaped()) x = draw();
      ContactProblem<double> problem;
      problem.contacts.assign(kRows, {ContactKind::kFrictionless, 0, {}});
      problem.A = B * (symmetric ? Eigen::MatrixXd(B.transpose()) : C);
      problem.b.resize(kRows);
      for (double& x : problem.b) x = draw();
      problem.b = (problem.A * problem.b).eval();
      const RunEnd<> verdict = solver.Run(problem);
      if (symmetric) updates += verdict.statistics[Counter::kUpdates];
      if (!symmetric) CHECK(verdict.statistics[Counter::kUpdates] == 0);
      fallbacks += verdict.statistics[Counter::kFallbacks];
    }
  }
  CHECK(updates > 0);
  CHECK(fallbacks > 0);
}

TEST_CASE("fast: what has no solution is undecided") {
  FastSolver<double> solver;
  CHECK(solver.Run(As<double>(NoSolution())).outcome == Outcome::kUndecided);
  CHECK(solver.Run(As<double>(MakeProblem({-1, -1}, {{1, -1}, {-1, 1}}, {-1, 0}))).outcome ==
        Outcome::kUndecided);
}

TEST_CASE("fast: numbers that are not finite are undecided, wherever they stand") {
  FastSolver<double> solver;
  for (const double bad : {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    for (int place = 0; place < 20; ++place) {
      auto problem = As<double>(CirclingProblem());
      if (place < 4) problem.b = Eigen::Vector4d(1, 1, 1, 1);  // no force is needed
      (place < 4    ? problem.A.data()[5 * place]
       : place < 16 ? problem.A.data()[place]
                    : problem.b[place - 16]) = bad;
      CAPTURE(bad, place);
      CHECK(solver.Run(problem).outcome == Outcome::kUndecided);
    }
  }
}

TEST_CASE("fast: a solver that has seen larger problems solves as a new one does") {
  FastSolver<double> used;
  used.Run(Random<double>(GeneratorId::kIntegers, 8, 1));
  for (int index = 0; index < 50; ++index) {
    const auto problem = Random<double>(GeneratorId::kPsd, 1 + index % 8, index);
    FastSolver<double> fresh;
    CHECK(used.Run(problem).statistics == fresh.Run(problem).statistics);
    CHECK(used.f() == fresh.f());
  }
}

// ---- The factors -----------------------------------------------------------------------------

Eigen::MatrixXd RandomMatrix(int rows, int columns, Choices& choices) {
  Eigen::MatrixXd M(rows, columns);
  for (double& x : M.reshaped()) x = static_cast<double>(choices.Integer(-1000, 1000)) / 1000;
  return M;
}

void Fill(DenseFactor<double>& factor, const Eigen::MatrixXd& M) {
  factor.Reserve(static_cast<int>(M.rows()));
  for (int j = 0; j < M.cols(); ++j) std::copy(M.col(j).begin(), M.col(j).end(), factor.Column(j));
}

TEST_CASE("dense factor: both factorizations solve, whatever the size") {
  Choices choices(1);
  for (int size = 1; size <= 70; ++size) {
    CAPTURE(size);
    const Eigen::MatrixXd G = RandomMatrix(size, size, choices);
    const Eigen::MatrixXd M = G * G.transpose() + Eigen::MatrixXd::Identity(size, size);
    const Eigen::VectorXd x = RandomMatrix(size, 1, choices);
    DenseFactor<double> factor;
    Fill(factor, M.triangularView<Eigen::Lower>());
    CHECK(factor.FactorSymmetric(size, 1e-11) == 0);
    Eigen::VectorXd y = M * x;
    factor.SolveSymmetric(y.data());
    CHECK((y - x).norm() <= 1e-9);
    Fill(factor, G);
    REQUIRE(factor.FactorGeneral(size, 1e-14));
    y = G * x;
    factor.SolveGeneral(y.data());
    CHECK((G * (y - x)).norm() <= 1e-9);
  }
}

TEST_CASE("dense factor: dependent columns are dropped, and the system still solved") {
  Choices choices(2);
  for (const int size : {2, 5, 16, 17, 40, 61}) {
    CAPTURE(size);
    const int rank = (size + 1) / 2;
    const Eigen::MatrixXd J = RandomMatrix(size, rank, choices), M = J * J.transpose();
    DenseFactor<double> factor;
    Fill(factor, M);
    CHECK(factor.FactorSymmetric(size, 1e-11) == size - rank);
    const Eigen::VectorXd right = J * RandomMatrix(rank, 1, choices);
    Eigen::VectorXd y = right;
    factor.SolveSymmetric(y.data());
    CHECK((M * y - right).norm() <= 1e-8);
    for (int j = 0; j < size; ++j) CHECK((!factor.IsDropped(j) || y[j] == 0));
    Fill(factor, M);
    CHECK_FALSE(factor.FactorGeneral(size, 1e-11));
  }
}

TEST_CASE("dense factor: rows and columns come and go") {
  Choices choices(3);
  const int most = 24;
  const Eigen::MatrixXd G = RandomMatrix(most, most, choices);
  const Eigen::MatrixXd M = G * G.transpose() + 0.1 * Eigen::MatrixXd::Identity(most, most);
  DenseFactor<double> factor;
  factor.Reserve(most);
  factor.FactorSymmetric(0, 1e-11);
  std::vector<int> kept;
  for (int turn = 0; turn < 400; ++turn) {
    std::vector<int> out;
    for (int i = 0; i < most; ++i) {
      if (std::find(kept.begin(), kept.end(), i) == kept.end()) out.push_back(i);
    }
    if (kept.empty() || (!out.empty() && choices.Integer(0, 1) == 0)) {
      const int row = out[choices.Integer(0, static_cast<int>(out.size()) - 1)];
      Eigen::VectorXd column = M(kept, row);
      REQUIRE(factor.Append(column.data(), M(row, row), 1e-11));
      kept.push_back(row);
    } else {
      const int p = static_cast<int>(choices.Integer(0, static_cast<int>(kept.size()) - 1));
      factor.Remove(p);
      kept.erase(kept.begin() + p);
    }
    const Eigen::VectorXd x = RandomMatrix(static_cast<int>(kept.size()), 1, choices);
    Eigen::VectorXd y = M(kept, kept) * x;
    factor.SolveSymmetric(y.data());
    REQUIRE((y - x).norm() <= 1e-8);
  }
  if (kept.empty()) return;
  Eigen::VectorXd copy = M(kept, kept[0]);  // a second copy of the first column
  CHECK_FALSE(factor.Append(copy.data(), M(kept[0], kept[0]), 1e-11));
}

}  // namespace
}  // namespace stiction
