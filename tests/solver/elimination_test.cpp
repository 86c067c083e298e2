// SPDX-License-Identifier: Apache-2.0
// Elimination without fractions against plain elimination over rationals: the same pivots, signs and solutions.

#include "solver/linear/elimination.ipp"

#include <catch2/catch.hpp>
#include <cmath>

#include "solver/complete/complete.ipp"
#include "solver/published/published.ipp"
#include "tests/solver/plain_rational.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// Gauss' elimination of [M | right], the first entry of a column that is not zero as pivot.
struct Gauss {
  ExactMatrix M;
  int unknowns = 0;
  int swaps = 0;
  std::vector<int> pivots;  // columns

  Gauss(ExactMatrix augmented, int columns) : M(std::move(augmented)), unknowns(columns) {
    for (int column = 0; column < unknowns; ++column) {
      const int rank = static_cast<int>(pivots.size());
      int pivot = rank;
      while (pivot < M.rows() && M(pivot, column) == 0) ++pivot;
      if (pivot == M.rows()) continue;
      swaps += pivot != rank;
      if (pivot != rank) M.row(pivot).swap(M.row(rank));
      for (int i = rank + 1; i < M.rows(); ++i) {
        const Rational factor = M(i, column) / M(rank, column);
        for (int j = column; j < M.cols(); ++j) M(i, j) -= factor * M(rank, j);
      }
      pivots.push_back(column);
    }
  }

  Rational Determinant() const {  // of the pivots
    Rational determinant = swaps % 2 == 0 ? 1 : -1;
    for (std::size_t i = 0; i < pivots.size(); ++i) determinant *= M(static_cast<int>(i), pivots[i]);
    return determinant;
  }

  bool IsConsistent() const {
    for (int i = static_cast<int>(pivots.size()); i < M.rows(); ++i) {
      if (M(i, unknowns) != 0) return false;
    }
    return true;
  }

  ExactVector Solution() const {
    ExactVector x(unknowns);
    for (Rational& value : x) value = 0;
    for (int i = static_cast<int>(pivots.size()) - 1; i >= 0; --i) {
      Rational value = M(i, unknowns);
      for (int j = pivots[i] + 1; j < unknowns; ++j) value -= M(i, j) * x[j];
      x[pivots[i]] = value / M(i, pivots[i]);
    }
    return x;
  }
};

// Entries are zero, small integers, fractions, or of 80 bits; some columns and rows depend on those before.
ExactMatrix RandomAugmented(int rows, int columns, Choices& choices) {
  ExactMatrix M(rows, columns);
  const int kind = static_cast<int>(choices.Integer(0, 3));
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      M(i, j) = static_cast<long>(choices.Integer(-3, 3));
      if (kind == 1) M(i, j) /= static_cast<long>(choices.Integer(1, 12));
      if (kind == 2) M(i, j) *= Rational(mpz_class(1) << 70) + static_cast<long>(choices.Integer(0, 1 << 20));
      if (kind == 3) M(i, j) = Rational(std::ldexp(static_cast<double>(choices.Integer(-99, 99)), -40));
    }
  }
  for (int j = 1; j + 1 < columns; ++j) {
    if (choices.Integer(0, 5) == 0) M.col(j) = M.col(j - 1) * Rational(Rational(choices.Integer(-2, 2)) / 3);
  }
  for (int i = 1; i < rows; ++i) {
    if (choices.Integer(0, 5) == 0) M.row(i) = M.row(i - 1) * Rational(2, 3);
    if (choices.Integer(0, 11) == 0) M.row(i).head(columns - 1) = M.row(0).head(columns - 1);
  }
  return M;
}

TEST_CASE("elimination: without fractions it finds the pivots, signs and solutions of plain elimination") {
  int regular = 0, singular = 0, inconsistent = 0, negative = 0;
  for (int index = 0; index < 4000; ++index) {
    CAPTURE(index);
    Choices choices(index);
    const int unknowns = index % 9, rows = index % 4 == 0 ? static_cast<int>(choices.Integer(0, 8)) : unknowns;
    const ExactMatrix M = RandomAugmented(rows, unknowns + 1, choices);
    const Gauss expected(M, unknowns);
    Elimination<Rational> found;
    found.Assign(M);
    found.Run(rows, unknowns, unknowns + 1);

    const int rank = static_cast<int>(expected.pivots.size());
    REQUIRE(found.rank() == rank);
    for (int i = 0; i < rank; ++i) CHECK(found.pivot_column(i) == expected.pivots[i]);
    CHECK(found.Orientation() == sgn(expected.Determinant()));
    negative += found.Orientation() < 0;
    if (rank < rows) {
      CHECK(found.Orientation(unknowns) == sgn(expected.Determinant()) * sgn(expected.M(rank, unknowns)));
    }
    REQUIRE(found.IsConsistent(unknowns) == expected.IsConsistent());
    if (rows == unknowns) CHECK(found.Determinant() == (rank == rows ? expected.Determinant() : Rational(0)));
    if (!expected.IsConsistent()) {
      ++inconsistent;
      continue;
    }
    found.BackSubstitute(unknowns);
    const ExactVector x = expected.Solution();
    for (int j = 0; j < unknowns; ++j) CHECK(found.Solution(j) == x[j]);
    ++(rank == unknowns ? regular : singular);
  }
  CHECK(regular > 300);
  CHECK(singular > 300);
  CHECK(inconsistent > 300);
  CHECK(negative > 300);
}

TEST_CASE("elimination: a system without unknowns or without equations") {
  Elimination<Rational> none;
  none.Assign(ExactMatrix(0, 1));
  none.Run(0, 0, 1);
  CHECK(none.rank() == 0);
  CHECK(none.Orientation() == 1);
  CHECK(none.Determinant() == 1);
  CHECK(none.IsConsistent(0));
}

TEST_CASE("elimination: over doubles the largest entry is the pivot, and small ones are none") {
  Elimination<double, 2> system;
  system.Resize(2, 3);
  const double rows[2][3] = {{1, 2, 3}, {-4, 0, 8}};
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 3; ++j) system(i, j) = rows[i][j];
  }
  system.Run(2, 2, 3, 1e-9);
  CHECK(system(0, 0) == -4);
  CHECK(system.Orientation() == 1);
  CHECK(system.Determinant() == 8);
  system.BackSubstitute(2);
  CHECK(system.Solution(0) == -2);
  CHECK(system.Solution(1) == 2.5);
  system(0, 0) = system(0, 1) = system(1, 0) = 1;
  system(1, 1) = 1 + 1e-12;
  system.Run(2, 2, 3, 1e-9);
  CHECK(system.rank() == 1);
}

template <class Run, class Plain>
void CheckSame(const Run& run, const Plain& plain) {
  REQUIRE(run.size() == plain.size());
  for (std::size_t i = 0; i < run.size(); ++i) {
    CHECK(run[i].limiting == plain[i].limiting);
    CHECK(run[i].s == plain[i].s);
    CHECK(run[i].df == plain[i].df.template cast<Rational>());
    CHECK(run[i].da == plain[i].da.template cast<Rational>());
    CHECK(run[i].f == plain[i].f.template cast<Rational>());
    CHECK(run[i].sets == plain[i].sets);
  }
}

TEST_CASE("elimination: runs over rationals and over rationals of unknown integers take the same steps") {
  static_assert(kFractionFree<Rational> && !kFractionFree<PlainRational>);
  int inexact_mu = 0;
  for (int index = 0; index < 280; ++index) {
    CAPTURE(index);
    ExactProblem problem =
        Random<Rational>(static_cast<GeneratorId>(index % kOrdinaryGeneratorCount), 1 + index % 5, index);
    if (index % 3 == 0) {  // so that columns are scaled
      for (auto& contact : problem.contacts) contact.mu *= Rational(2, 3);
      ++inexact_mu;
    }
    const ContactProblem<PlainRational> plain = Plain(problem);
    Trace<Rational> trace;
    Trace<PlainRational> plain_trace;
    CompleteDriving<Rational>().Run(problem, &trace);
    CompleteDriving<PlainRational>().Run(plain, &plain_trace);
    CheckSame(trace.pivots, plain_trace.pivots);
    const Verdict verdict = PublishedAlgorithm<Rational>().Run(problem, &trace);
    CHECK(PublishedAlgorithm<PlainRational>().Run(plain, &plain_trace).outcome == verdict.outcome);
    CheckSame(trace.pivots, plain_trace.pivots);
  }
  CHECK(inexact_mu > 90);
}

}  // namespace
}  // namespace stiction
