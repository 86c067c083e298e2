// SPDX-License-Identifier: Apache-2.0
// Equations over rationals: by lifting as by elimination, to the last digit.
#include <catch2/catch.hpp>
#include <random>

#include "certify/exact/linear_equations.h"
#include "certify/exact/properties.h"

namespace stiction {
namespace {

Rational DrawnRational(std::mt19937_64& random) {
  Rational value(static_cast<long>(random() % 201) - 100, static_cast<long>(random() % 12) + 1);
  value.canonicalize();
  return value;
}

ExactMatrix DrawnMatrix(std::mt19937_64& random, int rows, int columns) {
  ExactMatrix M(rows, columns);
  for (Rational& entry : M.reshaped()) entry = random() % 3 == 0 ? Rational(0) : DrawnRational(random);
  return M;
}

}  // namespace

TEST_CASE("lifted equations: the numbers of elimination, where unknowns are free, too") {
  std::mt19937_64 random(20);
  for (const int size : {0, 1, 2, 5, 16, 24, 40}) {
    for (const int rank : {0, size / 3, size - 1, size}) {
      if (rank < 0) continue;
      const ExactMatrix L = DrawnMatrix(random, size, rank), R = DrawnMatrix(random, rank, size), M = L * R;
      const ExactVector some = DrawnMatrix(random, size, 1), guess = DrawnMatrix(random, size, 1);
      const ExactVector right = M * some;
      const auto lifted = SolveByLifting(M, right, guess), eliminated = SolveEquations(M, right, guess);
      INFO("size " << size << ", rank " << rank);
      REQUIRE(lifted);
      REQUIRE(eliminated);
      CHECK(M * *lifted == right);
      CHECK(*lifted == *eliminated);
    }
  }
}

TEST_CASE("lifted equations: those that contradict each other have no solution") {
  std::mt19937_64 random(21);
  for (const int size : {1, 3, 20}) {
    ExactMatrix M = DrawnMatrix(random, size, size);
    M.row(size - 1) = M.topRows(size - 1).colwise().sum();
    ExactVector right = M * DrawnMatrix(random, size, 1);
    const ExactVector none = ExactVector::Zero(size);
    REQUIRE(SolveByLifting(M, right, none));
    // The last row, the sum of the others, no longer says the same.
    right[size - 1] += Rational(1, 1000000007);
    CHECK(!SolveByLifting(M, right, none));
    CHECK(!SolveEquations(M, right, none));
  }
}

TEST_CASE("lifted equations: independent rows are the first, and reduced rows make all of M of its columns") {
  std::mt19937_64 random(23);
  for (const int rank : {0, 1, 7, 12}) {
    ExactMatrix M = DrawnMatrix(random, 15, rank) * DrawnMatrix(random, rank, 12);
    M.row(3) = M.row(1) * Rational(-2, 3);
    INFO("rank " << rank);
    std::vector<int> first;
    for (int i = 0; i < M.rows(); ++i) {
      const ExactMatrix top = M.topRows(i + 1);
      if (RankOf(top * top.transpose()) > std::ssize(first)) first.push_back(i);
    }
    CHECK(IndependentRows(M.sparseView()) == first);
    const auto [pivots, reduced] = ReducedRows(M.transpose());
    CHECK(pivots == first);
    CHECK(M.transpose() == M.transpose()(Eigen::all, pivots) * reduced);
    CHECK(reduced(Eigen::all, pivots).isIdentity(0));
  }
}

TEST_CASE("lifted equations: entries of a thousand digits") {
  std::mt19937_64 random(22);
  ExactMatrix M = DrawnMatrix(random, 18, 18);
  Rational large = 1;
  for (int i = 0; i < 500; ++i) large *= 99;
  for (Rational& entry : M.reshaped()) entry = entry * large + DrawnRational(random) / large;
  const ExactVector right = DrawnMatrix(random, 18, 1), none = ExactVector::Zero(18);
  const auto x = SolveByLifting(M, right, none);
  REQUIRE(x);
  CHECK(M * *x == right);
}

}  // namespace stiction
