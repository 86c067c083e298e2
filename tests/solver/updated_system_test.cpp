// SPDX-License-Identifier: Apache-2.0
// Updated direction systems beside those that are eliminated afresh: directions, signs, whole runs.

#include "solver/linear/updated_system.ipp"

#include <catch2/catch.hpp>
#include <limits>
#include <utility>

#include "certify/exact/exact.h"
#include "corpus/json_text.h"
#include "search/generators/choices.h"
#include "solver/complete/complete.ipp"
#include "solver/problem/errors.h"
#include "solver/published/published.ipp"

namespace stiction {
namespace {

using enum IndexSet;
constexpr int kNever = std::numeric_limits<int>::max();
using Problem = ContactProblem<double>;
using Sets = IndexSets<Eigen::Dynamic>;

// A = J J', J of rows x rank with integers in [-entry, entry], and b = J y or, of full rank, y.
Problem MakeProblem(int contacts, bool friction, int rank, int entry, Choices& choices) {
  const int rows = friction ? 2 * contacts : contacts;
  Eigen::MatrixXd J(rows, rank);
  for (double& x : J.reshaped()) x = static_cast<double>(choices.Integer(-entry, entry));
  Problem problem;
  problem.A = J * J.transpose();
  Eigen::VectorXd y(rank);
  for (double& x : y) x = static_cast<double>(choices.Integer(-1000000, 1000000)) * 1e-3;
  problem.b = rank == rows ? y : Eigen::VectorXd(J * y);
  for (int i = 0; i < contacts; ++i) {
    const double mu = static_cast<double>(choices.Integer(1, 8)) / 4;
    problem.contacts.push_back(
        {friction ? ContactKind::kStatic : ContactKind::kFrictionless, friction ? mu : 0, {}});
  }
  return problem;
}

// ---- The inverse -----------------------------------------------------------------------------

Eigen::MatrixXd Shown(const Inverse<double>& inverse) {
  const int size = inverse.size();
  Eigen::MatrixXd B(size, size);
  Eigen::VectorXd column(size);
  for (int j = 0; j < size; ++j) {
    inverse.Multiply(Eigen::VectorXd::Unit(size, j), column);
    B.col(j) = column;
  }
  return B;
}

void CheckInverse(const Inverse<double>& inverse, const Eigen::MatrixXd& M) {
  REQUIRE(inverse.size() == M.rows());
  CHECK((Shown(inverse) * M - Eigen::MatrixXd::Identity(M.rows(), M.rows())).norm() < 1e-12);
  CHECK(inverse.determinant_sign() == (M.determinant() < 0 ? -1 : 1));
}

TEST_CASE("inverse: rows and columns come, change and go, close to a singular matrix nothing happens") {
  Eigen::Matrix4d M;
  M << 2, 1, 0, 3, -1, 1, 4, 0, 5, 0, 1, 1, 1, 2, -2, 1;
  Inverse<double> inverse;
  inverse.Reserve(4);
  for (int k = 0; k < 4; ++k) {
    REQUIRE(inverse.Append(M.row(k).head(k).transpose(), M.col(k).head(k), M(k, k)));
    CheckInverse(inverse, M.topLeftCorner(k + 1, k + 1));
  }
  M.col(1) << 0, -3, 1, 1;
  REQUIRE(inverse.ReplaceColumn(1, M.col(1)));
  CheckInverse(inverse, M);
  CHECK_FALSE(inverse.ReplaceColumn(1, M.col(0) + 1e-10 * M.col(1)));
  CheckInverse(inverse, M);
  REQUIRE(inverse.Remove(1));
  const std::array<int, 3> left = {0, 3, 2};
  CheckInverse(inverse, M(left, left));
  const Eigen::Vector3d row(1, 2, 3), column = M(left, left).col(2);
  CHECK_FALSE(inverse.Append(row, column, 3 + 1e-10));  // the last column again
  CheckInverse(inverse, M(left, left));
  REQUIRE(inverse.Invert(
      2, [](int i, int j) { return i == j ? 1e-9 : 1.0; }, 1e-6));
  CHECK(inverse.determinant_sign() == -1);
  CHECK_FALSE(inverse.Remove(0));
  CHECK(inverse.size() == 2);
  CHECK_FALSE(inverse.Invert(
      2, [](int, int) { return 1.0; }, 1e-6));
  CHECK(inverse.size() == 0);
}

// ---- One direction after another -------------------------------------------------------------

struct Pair {
  Problem problem;
  RowLayout<Eigen::Dynamic> layout;
  Scale<double> scale;
  DirectionSystem<double, Eigen::Dynamic> updated, fresh;

  explicit Pair(const Problem& p, int update_from = 1) : problem(p) {
    layout.Assign(problem.contacts);
    scale = MakeScale(problem, Tolerances{});
    updated.Start(problem, update_from);
    fresh.Start(problem, kNever);
  }

  double Difference() const {
    const double df = (updated.df() - fresh.df()).cwiseAbs().maxCoeff() / fresh.df().cwiseAbs().maxCoeff();
    const double da = (updated.da() - fresh.da()).cwiseAbs().maxCoeff() / problem.A.cwiseAbs().maxCoeff() /
                      fresh.df().cwiseAbs().maxCoeff();
    return std::max(df, da);
  }
};

// da is zero at the unknowns; returns how far A df is from that.
double Residual(const Pair& pair, const Sets& sets) {
  const auto& df = pair.updated.df();
  const Eigen::VectorXd da = pair.problem.A * df;
  double worst = 0;
  for (int row = 0; row < pair.problem.rows(); ++row) {
    if (!IsUnknown(sets[row])) continue;
    REQUIRE(pair.updated.da()[row] == 0);
    worst = std::max(worst, std::abs(da[row]));
  }
  return worst / pair.problem.A.cwiseAbs().maxCoeff() / df.cwiseAbs().maxCoeff();
}

IndexSet Draw(bool normal, Choices& choices) {
  const std::array<IndexSet, 4> normals = {kClamped, kClamped, kClamped, kSeparating};
  const std::array<IndexSet, 4> frictions = {kSticking, kAtLower, kAtUpper, kNone};
  return normal ? normals[choices.Integer(0, 3)] : frictions[choices.Integer(0, 3)];
}

struct Tally {
  int regular = 0, singular = 0, negative = 0;
  double difference = 0;
  double residual = 0;  // of the accelerations that should rest, relative to A and df
};

// Changes up to `changes` sets at random, `steps` times, and compares.
Tally Compare(Pair& pair, int steps, int changes, Choices& choices) {
  using System = DirectionSystem<double, Eigen::Dynamic>;
  Tally tally;
  const int rows = pair.problem.rows();
  Sets sets(rows);
  for (int row = 0; row < rows; ++row) sets[row] = Draw(pair.layout.IsNormal(row), choices);
  for (int step = 0; step < steps; ++step) {
    CAPTURE(step);
    for (std::int64_t k = choices.Integer(0, changes); k > 0; --k) {
      const int row = static_cast<int>(choices.Integer(0, rows - 1));
      sets[row] = Draw(pair.layout.IsNormal(row), choices);
    }
    const int driven = static_cast<int>(choices.Integer(0, rows - 1));
    const int sign = choices.Integer(0, 1) == 0 ? 1 : -1;
    const IndexSet kept = std::exchange(sets[driven], kNone);
    const auto status = pair.fresh.Solve(pair.problem, pair.layout, sets, driven, sign, pair.scale);
    REQUIRE(pair.updated.Solve(pair.problem, pair.layout, sets, driven, sign, pair.scale) == status);
    tally.regular += status == System::Status::kRegular;
    tally.singular += status != System::Status::kRegular;
    if (status != System::Status::kInconsistent) {
      tally.difference = std::max(tally.difference, pair.Difference());
      tally.residual = std::max(tally.residual, Residual(pair, sets));
    }
    const SetUnknowns<double, Eigen::Dynamic> unknowns = {pair.problem, pair.layout, sets, driven, sign};
    const auto oriented = pair.fresh.SolveOriented(pair.problem, unknowns, pair.scale);
    REQUIRE(pair.updated.SolveOriented(pair.problem, unknowns, pair.scale) == oriented);
    sets[driven] = kept;
    if (!oriented) continue;
    tally.negative += *oriented < 0;
    tally.difference = std::max(tally.difference, pair.Difference());
  }
  return tally;
}

TEST_CASE("updated system: random sequences of sets, as eliminated afresh") {
  int negative = 0;
  for (int index = 0; index < 20; ++index) {
    CAPTURE(index);
    Choices choices(index);
    Pair pair(MakeProblem(12 + index, true, 24 + 2 * index, 1000, choices));
    const Tally tally = Compare(pair, 150, 3, choices);
    CHECK(tally.difference < 1e-9);
    CHECK(tally.residual < 1e-13);
    CHECK(tally.regular == 150);
    negative += tally.negative;
    const auto& counts = pair.updated.updated().counts();
    CHECK(counts.solved == 300);
    CHECK(counts.inverted < 20);
  }
  CHECK(negative > 100);
}

TEST_CASE("updated system: singular matrices are left to elimination, and it goes on behind them") {
  int regular = 0, singular = 0;
  std::int64_t solved = 0;
  for (int index = 0; index < 30; ++index) {
    CAPTURE(index);
    Choices choices(index);
    Pair pair(MakeProblem(10, true, 10 + index % 6, 1, choices));
    const Tally tally = Compare(pair, 100, 4, choices);
    CHECK(tally.difference < 1e-8);
    regular += tally.regular;
    singular += tally.singular;
    solved += pair.updated.updated().counts().solved;
  }
  CHECK(regular > 300);
  CHECK(singular > 300);
  CHECK(solved > regular);
}

TEST_CASE("updated system: errors of the inverse are seen and mended") {
  std::int64_t refined = 0, inverted = 0;
  for (int index = 0; index < 10; ++index) {
    CAPTURE(index);
    Choices choices(index);
    Problem problem = MakeProblem(20, true, 40, 1000, choices);
    Eigen::MatrixXd J(40, 40);
    for (double& x : J.reshaped()) x = static_cast<double>(choices.Integer(-1000, 1000));
    for (int j = 0; j < 40; ++j) J.col(j) *= std::pow(10, -0.1 * j);
    problem.A = J * J.transpose();
    Pair pair(problem);
    CHECK(Compare(pair, 300, 3, choices).residual < 1e-13);
    const auto& counts = pair.updated.updated().counts();
    refined += counts.refined;
    inverted += counts.inverted;
  }
  CHECK(refined > 50);
  CHECK(inverted > 20);
}

TEST_CASE("updated system: below the number of unknowns it does nothing, exact and fixed sizes have none") {
  Choices choices(1);
  Pair pair(MakeProblem(10, false, 10, 1000, choices), 11);
  Compare(pair, 20, 3, choices);
  CHECK(pair.updated.updated().counts().solved == 0);
  CHECK_FALSE(DirectionSystem<double, 4>::kUpdates);
  CHECK_FALSE(DirectionSystem<Rational, Eigen::Dynamic>::kUpdates);
}

// ---- Whole runs ------------------------------------------------------------------------------

const Eigen::VectorXd& ForcesOf(const PublishedAlgorithm<double>& run) { return run.state().f; }
const Eigen::VectorXd& ForcesOf(const CompleteDriving<double>& run) { return run.f(); }
const Sets& EndOf(const PublishedAlgorithm<double>& run) { return run.state().sets; }
const CellWord& EndOf(const CompleteDriving<double>& run) { return run.word(); }

template <class Algorithm>
void CompareRuns(const Problem& problem) {
  Algorithm updated, fresh;
  updated.UpdateFrom(4);
  fresh.UpdateFrom(kNever);
  const auto verdict = updated.Run(problem), expected = fresh.Run(problem);
  REQUIRE(expected.outcome == Outcome::kSolved);
  CHECK(verdict.outcome == expected.outcome);
  CHECK(verdict.statistics == expected.statistics);
  CHECK(EndOf(updated) == EndOf(fresh));
  const Eigen::VectorXd f = ForcesOf(updated);
  CHECK((f - ForcesOf(fresh)).cwiseAbs().maxCoeff() < 1e-7 * ForcesOf(fresh).cwiseAbs().maxCoeff());
  const Eigen::VectorXd a = problem.A * f + problem.b;
  CHECK(MeasureErrors(problem, FrictionLaw::kCoulomb, f, a).Largest() < 1e-9);
  CHECK(updated.direction().updated().counts().solved >= 30);
  CHECK(fresh.direction().updated().counts().solved == 0);
}

TEST_CASE("updated system: whole runs end with the same steps and forces, frictionless") {
  for (const int contacts : {60, 80, 100}) {
    CAPTURE(contacts);
    Choices choices(contacts);
    const Problem full = MakeProblem(contacts, false, contacts, 1000, choices);
    CompareRuns<PublishedAlgorithm<double>>(full);
    CompareRuns<CompleteDriving<double>>(full);
  }
}

// Steps of length zero are many, and their ties are told by rounding: the runs differ, the accelerations do
// not.
TEST_CASE("updated system: whole runs are solved where A is singular, too") {
  for (const int contacts : {40, 70, 100}) {
    CAPTURE(contacts);
    Choices choices(contacts);
    const Problem problem = MakeProblem(contacts, false, contacts / 2, 1000, choices);
    Eigen::VectorXd a[2];
    for (const bool fresh : {false, true}) {
      PublishedAlgorithm<double> algorithm;
      algorithm.UpdateFrom(fresh ? kNever : 4);
      REQUIRE(algorithm.Run(problem).outcome == Outcome::kSolved);
      a[fresh] = problem.A * algorithm.state().f + problem.b;
      CHECK(MeasureErrors(problem, FrictionLaw::kCoulomb, algorithm.state().f, a[fresh]).Largest() < 1e-9);
    }
    CHECK((a[0] - a[1]).cwiseAbs().maxCoeff() < 1e-7 * problem.b.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("updated system: whole runs end with the same steps and forces, static friction") {
  for (const int contacts : {20, 30, 40}) {
    CAPTURE(contacts);
    Choices choices(contacts);
    const Problem problem = MakeProblem(contacts, true, 2 * contacts, 1000, choices);
    CompareRuns<PublishedAlgorithm<double>>(problem);
    CompareRuns<CompleteDriving<double>>(problem);
  }
}

// Corners, edges and sticking contacts come and go: columns of the inverse change, and rows.
TEST_CASE("updated system: whole runs in space end with the same steps and forces") {
  std::int64_t solved = 0, inverted = 0;
  for (int index = 0; index < 12; ++index) {
    CAPTURE(index);
    const int contacts = 8 + index % 3;
    Choices choices(index);
    Problem problem = MakeProblem(3 * contacts, false, 3 * contacts, 1000, choices);
    problem.dimension = 3;
    problem.contacts.clear();
    for (int i = 0; i < contacts; ++i)
      problem.contacts.push_back({ContactKind::kStatic, static_cast<double>(choices.Integer(1, 8)) / 4, {}});
    const std::vector<FrictionPolygon<double>> polygons(contacts, FrictionPolygon<double>(8));
    CompleteDriving<double> updated, fresh;
    updated.UpdateFrom(4);
    fresh.UpdateFrom(kNever);
    const auto verdict = updated.Run(problem, polygons), expected = fresh.Run(problem, polygons);
    REQUIRE(expected.outcome == Outcome::kSolved);
    CHECK(verdict.outcome == expected.outcome);
    CHECK(verdict.statistics == expected.statistics);
    CHECK(updated.word() == fresh.word());
    CHECK((updated.f() - fresh.f()).cwiseAbs().maxCoeff() < 1e-7 * fresh.f().cwiseAbs().maxCoeff());
    const auto& counts = updated.direction().updated().counts();
    solved += counts.solved;
    inverted += counts.inverted;
  }
  CHECK(solved >= 120);
  CHECK(inverted < solved / 2);
}

}  // namespace
}  // namespace stiction
