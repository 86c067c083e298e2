// SPDX-License-Identifier: Apache-2.0
// The direction system: its equations, checked one by one over rationals.

#include "solver/linear/direction.ipp"

#include <catch2/catch.hpp>

#include "certify/exact/verify_solution.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;
using enum IndexSet;
using System = DirectionSystem<Rational, Eigen::Dynamic>;
using Status = System::Status;

template <class Scalar>
struct Solved {
  DirectionSystem<Scalar, Eigen::Dynamic> system;
  typename DirectionSystem<Scalar, Eigen::Dynamic>::Status status;
};

template <class Scalar>
Solved<Scalar> Solve(const ExactProblem& exact, const std::vector<IndexSet>& sets, int driven, int sign) {
  const ContactProblem<Scalar> problem = As<Scalar>(exact);
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(problem.contacts);
  Solved<Scalar> solved;
  solved.system.Start(problem);
  solved.status = solved.system.Solve(problem, layout, sets, driven, sign, MakeScale(problem, Tolerances{}));
  return solved;
}

// Change of all forces while that of one row changes by one: the friction at a limit follows its normal.
ExactVector Following(const ExactProblem& problem, const std::vector<IndexSet>& sets, int row) {
  ExactVector change(problem.rows());
  for (Rational& x : change) x = 0;
  change[row] = 1;
  const auto layout = LayoutOf(problem);
  if (layout.IsNormal(row) && layout.HasFriction(row)) {
    change[row + 1] = LimitSign(sets[row + 1]) * problem.contacts[layout.ContactOf(row)].mu;
  }
  return change;
}

int Rank(std::vector<ExactVector> vectors) {
  int rank = 0;
  while (!vectors.empty()) {
    const ExactVector pivot = vectors.back();
    vectors.pop_back();
    int column = 0;
    while (column < pivot.size() && pivot[column] == 0) ++column;
    if (column == pivot.size()) continue;
    ++rank;
    for (ExactVector& other : vectors) {
      const Rational factor = other[column] / pivot[column];
      for (int i = 0; i < pivot.size(); ++i) other[i] -= factor * pivot[i];
    }
  }
  return rank;
}

// What the system is, densely: accelerations of the unknowns' rows per unit of each unknown.
struct Dense {
  std::vector<int> unknowns;
  std::vector<ExactVector> columns;
  ExactVector right;
};

Dense Assemble(const ExactProblem& problem, const std::vector<IndexSet>& sets, int driven) {
  Dense dense;
  for (int row = 0; row < problem.rows(); ++row) {
    if (IsUnknown(sets[row])) dense.unknowns.push_back(row);
  }
  const auto restricted = [&](int row) {
    const ExactVector all = Accelerations(problem, Following(problem, sets, row));
    ExactVector some(dense.unknowns.size());
    for (std::size_t i = 0; i < dense.unknowns.size(); ++i)
      some[i] = all[dense.unknowns[i]] - problem.b[dense.unknowns[i]];
    return some;
  };
  for (const int row : dense.unknowns) dense.columns.push_back(restricted(row));
  dense.right = restricted(driven);
  return dense;
}

void CheckAgainstDense(const ExactProblem& problem, const std::vector<IndexSet>& sets, int driven, int sign) {
  const auto [system, status] = Solve<Rational>(problem, sets, driven, sign);
  const Dense dense = Assemble(problem, sets, driven);
  auto extended = dense.columns;
  extended.push_back(dense.right);
  const int rank = Rank(dense.columns);
  const bool consistent = Rank(extended) == rank;
  REQUIRE((status == Status::kInconsistent) == !consistent);
  REQUIRE((status == Status::kRegular) == (rank == static_cast<int>(dense.unknowns.size())));
  if (!consistent) return;

  // df: the driven variable, the unknowns, and what follows them; nothing else.
  ExactVector expected = Following(problem, sets, driven);
  for (Rational& x : expected) x *= sign;
  for (const int row : dense.unknowns) {
    const ExactVector change = Following(problem, sets, row);
    for (int i = 0; i < problem.rows(); ++i) expected[i] += system.df()[row] * change[i];
  }
  CHECK(system.df() == expected);
  // da = A df, zero in C and CF.
  ExactProblem unloaded = problem;
  for (Rational& x : unloaded.b) x = 0;
  CHECK(system.da() == Accelerations(unloaded, system.df()));
  for (const int row : dense.unknowns) CHECK(system.da()[row] == 0);
  // An unknown whose column depends on those before it is zero.
  for (std::size_t j = 0; j < dense.unknowns.size(); ++j) {
    const auto first = dense.columns.begin();
    const int before = Rank({first, first + static_cast<std::ptrdiff_t>(j)});
    if (Rank({first, first + static_cast<std::ptrdiff_t>(j) + 1}) == before)
      CHECK(system.df()[dense.unknowns[j]] == 0);
  }
}

// Any sets but the driven variable's, which is in none.
std::vector<IndexSet> RandomSets(const ExactProblem& problem, int driven, Choices& choices) {
  const std::array<IndexSet, 3> normal = {kClamped, kClamped, kSeparating};
  const std::array<IndexSet, 4> friction = {kSticking, kAtLower, kAtUpper, kNone};
  const auto layout = LayoutOf(problem);
  std::vector<IndexSet> sets;
  for (int row = 0; row < problem.rows(); ++row) {
    sets.push_back(layout.IsNormal(row) ? normal[choices.Integer(0, 2)] : friction[choices.Integer(0, 3)]);
  }
  sets[driven] = kNone;
  return sets;
}

TEST_CASE("direction: solves the equations of 4.2 and 5.3 exactly, regular, singular or inconsistent") {
  int counts[3] = {};
  for (int index = 0; index < 3000; ++index) {
    CAPTURE(index);
    Choices choices(index);
    const auto id = index % 2 == 0 ? GeneratorId::kSmall : GeneratorId::kDuplicates;
    ExactProblem problem = Random<Rational>(id, 1 + index % 4, index);
    if (index % 7 == 0) problem.A(0, 1) += 1;  // A need not be symmetric
    const int driven = static_cast<int>(choices.Integer(0, problem.rows() - 1));
    const auto sets = RandomSets(problem, driven, choices);
    const int sign = choices.Integer(0, 1) == 0 ? 1 : -1;
    CheckAgainstDense(problem, sets, driven, sign);
    ++counts[static_cast<int>(Solve<Rational>(problem, sets, driven, sign).status)];
  }
  for (const int count : counts) CHECK(count > 30);
}

TEST_CASE("direction: a mixed layout follows the rows of its contacts") {
  const ExactProblem problem = MakeProblem(
      {-1, Rational(1, 2), -1}, {{4, 1, 0, 1}, {1, 5, 2, 0}, {0, 2, 3, 1}, {1, 0, 1, 2}}, {0, 0, 0, 0});
  CheckAgainstDense(problem, {kClamped, kClamped, kAtUpper, kNone}, 3, 1);
  CheckAgainstDense(problem, {kClamped, kClamped, kNone, kClamped}, 2, -1);
  CheckAgainstDense(problem, {kNone, kClamped, kAtLower, kClamped}, 0, 1);
}

TEMPLATE_TEST_CASE("direction: clamped and sticking forces answer so that their accelerations rest", "", float,
                   double, Rational) {
  const ExactProblem problem =
      MakeProblem({1, 1}, {{4, 0, 1, 1}, {0, 4, 0, 0}, {1, 0, 2, 0}, {1, 0, 0, 4}}, {0, 0, 0, 0});
  const auto [system, status] = Solve<TestType>(problem, {kNone, kNone, kClamped, kSticking}, 0, 1);
  CHECK(static_cast<int>(status) == static_cast<int>(Status::kRegular));
  const ExactVector df = Vector({1, 0, Rational(-1, 2), Rational(-1, 4)}),
                    da = Vector({Rational(13, 4), 0, 0, 0});
  for (int row = 0; row < 4; ++row) {
    CHECK(system.df()[row] == To<TestType>(df[row]));
    CHECK(system.da()[row] == To<TestType>(da[row]));
  }
}

TEMPLATE_TEST_CASE("direction: friction at a limit moves with its normal, and can make the system singular", "",
                   float, double, Rational) {
  // A is positive definite, but A_NN - mu A_NF = 0 for the second contact.
  const ExactProblem problem =
      MakeProblem({1, 2}, {{4, 0, 1, 0}, {0, 4, 0, 0}, {1, 0, 2, 1}, {0, 0, 1, 4}}, {0, 0, 0, 0});
  const auto upper = Solve<TestType>(problem, {kNone, kNone, kClamped, kAtUpper}, 0, 1);
  CHECK(static_cast<int>(upper.status) == static_cast<int>(Status::kRegular));
  CHECK(upper.system.df()[2] == To<TestType>(Rational(-1, 4)));
  CHECK(upper.system.df()[3] == To<TestType>(Rational(-1, 2)));
  const auto lower = Solve<TestType>(problem, {kNone, kNone, kClamped, kAtLower}, 0, 1);
  CHECK(static_cast<int>(lower.status) == static_cast<int>(Status::kInconsistent));
  const auto consistent = Solve<TestType>(problem, {kNone, kNone, kClamped, kAtLower}, 1, -1);
  CHECK(static_cast<int>(consistent.status) == static_cast<int>(Status::kSingular));
  CHECK(consistent.system.df()[2] == 0);
  CHECK(consistent.system.df()[1] == -1);
}

}  // namespace
}  // namespace stiction
