// SPDX-License-Identifier: Apache-2.0
// Lifting: fractions from digits, and its end.
#include "corpus/lifting.h"

#include <catch2/catch.hpp>

#include "corpus/exact_problem.h"
#include "corpus/stop.h"

namespace stiction {
namespace {

// 1 / (i + j + 1), i, j from 0: its inverse consists of long integers.
ExactProblem::Matrix Hilbert(int size) {
  ExactProblem::Matrix A(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) A(i, j) = Rational(1, i + j + 1);
  return A;
}

}  // namespace

TEST_CASE("lifting: the fractions of a solution, of unlike denominators, solve its equations") {
  for (const int size : {1, 2, 7, 30}) {
    IntegerVector scale;
    const IntegerRows A = InIntegers(Hilbert(size), scale);
    std::vector<Rational> b;
    for (int i = 0; i < size; ++i) b.emplace_back(i - 3, 7 * i + 1);
    for (Rational& x : b) x.canonicalize();
    const auto solved = SolveLifted(A, {b, std::vector<Rational>(size, 0)}, LiftingPrime(0));
    REQUIRE(solved);
    const CommonFractions& x = solved->front();
    for (int i = 0; i < size; ++i) {
      mpz_class sum = 0;
      for (int j = 0; j < size; ++j) sum += A[i][j] * x.numerators[j];
      CHECK(Fractions<Rational>::Quotient(sum, x.denominator) == b[i]);
    }
    CHECK(solved->back().numerators == IntegerVector(size, 0));
  }
}

TEST_CASE("lifting: a matrix that is singular modulo the prime has no solution there") {
  const mpz_class prime(LiftingPrime(0));
  const std::vector<Rational> ones(2, 1);
  CHECK_FALSE(SolveLifted({{prime, 0}, {0, 1}}, {ones}, LiftingPrime(0)));
  const auto solved = SolveLifted({{prime, 0}, {0, 1}}, {ones}, LiftingPrime(1));
  REQUIRE(solved);
  CHECK(Fractions<Rational>::Quotient(solved->front().numerators[0], solved->front().denominator) ==
        Rational(1, prime));
}

TEST_CASE("lifting: it ends when somebody says so") {
  const std::atomic<bool> stopped = true;
  const Stop stop(&stopped);
  CHECK_THROWS_AS(SolveLifted({{2}}, {{Rational(1)}}, LiftingPrime(0)), Stopped);
}

}  // namespace stiction
