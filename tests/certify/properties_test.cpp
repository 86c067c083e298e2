// SPDX-License-Identifier: Apache-2.0
// The paper's assumptions, decided exactly: every witness is checked by its defining equation.

#include "certify/exact/properties.h"

#include <catch2/catch.hpp>

#include "certify/exact/bounds.h"
#include "certify/exact/linear_system.h"
#include "corpus/lifting.h"
#include "corpus/stop.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

ExactMatrix RandomMatrix(int size, bool symmetric, Choices& choices) {
  ExactMatrix A(size, size);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) A(i, j) = choices.Integer(-2, 2);
    for (int j = 0; symmetric && j < i; ++j) A(i, j) = A(j, i);
  }
  return A;
}

ExactVector RandomVector(int size, Choices& choices) {
  ExactVector x(size);
  for (Rational& value : x) value = choices.Integer(-3, 3);
  return x;
}

ExactVector Times(const ExactMatrix& A, const ExactVector& x) {
  ExactVector y(x.size());
  for (int i = 0; i < x.size(); ++i) {
    y[i] = 0;
    for (int j = 0; j < x.size(); ++j) y[i] += A(i, j) * x[j];
  }
  return y;
}

Rational Dot(const ExactVector& x, const ExactVector& y) {
  Rational sum = 0;
  for (int i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

void CheckFactors(const ExactMatrix& A, const LdltFactors& factors) {
  for (int i = 0; i < A.rows(); ++i) {
    CHECK(factors.D[i] >= 0);
    for (int j = 0; j < A.rows(); ++j) {
      if (j >= i) CHECK(factors.L(i, j) == (i == j ? 1 : 0));
      Rational entry = 0;
      for (int k = 0; k < A.rows(); ++k) entry += factors.L(i, k) * factors.D[k] * factors.L(j, k);
      CHECK(entry == A(i, j));
    }
  }
}

void CheckCurvature(const ExactMatrix& A, const Obstacle& witness) {
  CHECK(witness.value < 0);
  CHECK(Dot(witness.x, Times(A, witness.x)) == witness.value);
}

TEST_CASE("symmetry: the first pair that differs is named") {
  CHECK(FindAsymmetry(Matrix({{1, 2}, {2, 5}})) == std::nullopt);
  CHECK(FindAsymmetry(Matrix({})) == std::nullopt);
  CHECK(FindAsymmetry(Matrix({{1, 2, 3}, {2, 5, 6}, {0, 7, 1}})) == std::pair(0, 2));
  CHECK(FindAsymmetry(Matrix({{1, 2, 3}, {2, 5, 6}, {3, 7, 1}})) == std::pair(1, 2));
}

TEST_CASE("semidefinite: L diag(D) L' is A, or x'Ax < 0, of every symmetric matrix") {
  int counts[2] = {};
  for (int index = 0; index < 2000; ++index) {
    CAPTURE(index);
    Choices choices(index);
    const ExactMatrix A = index % 2 == 0 ? RandomMatrix(1 + index % 4, true, choices)
                                         : Random<Rational>(GeneratorId::kDuplicates, 1 + index % 4, index).A;
    const auto decision = DecideSemidefinite(A);
    ++counts[decision.index()];
    if (const auto* factors = std::get_if<LdltFactors>(&decision)) {
      CheckFactors(A, *factors);
    } else {
      CHECK(index % 2 == 0);  // A = J J' is semidefinite
      CheckCurvature(A, std::get<Obstacle>(decision));
    }
  }
  CHECK(counts[0] > 500);
  CHECK(counts[1] > 500);
}

TEST_CASE("semidefinite: a zero pivot whose column is not zero has a witness") {
  for (const auto& A : {Matrix({{0, 1}, {1, 0}}), Matrix({{0, 1}, {1, 1000}}), Matrix({{0, -1}, {-1, -1}}),
                        Matrix({{4, 2, 2}, {2, 1, 3}, {2, 3, 9}})}) {
    const auto decision = DecideSemidefinite(A);
    REQUIRE(std::holds_alternative<Obstacle>(decision));
    CheckCurvature(A, std::get<Obstacle>(decision));
  }
}

TEST_CASE("semidefinite: of an asymmetric matrix x'Ax decides, which is that of its symmetric part") {
  CHECK(std::holds_alternative<LdltFactors>(DecideSemidefinite(Matrix({{1, 5}, {-5, 1}}))));
  for (int index = 0; index < 500; ++index) {
    Choices choices(index);
    const ExactMatrix A = RandomMatrix(1 + index % 4, false, choices);
    const auto decision = DecideSemidefinite(A);
    if (const auto* witness = std::get_if<Obstacle>(&decision)) CheckCurvature(A, *witness);
  }
}

TEST_CASE("range: an entry that a prime of lifting divides hides nothing") {
  const Rational prime(mpz_class(LiftingPrime(0)));
  const auto inside = DecideRange(Matrix({{prime, 0}, {0, 1}}), Vector({1, 1}));
  REQUIRE(std::holds_alternative<ExactVector>(inside));
  CHECK(std::get<ExactVector>(inside) == Vector({1 / prime, 1}));
  const auto outside = DecideRange(Matrix({{prime, prime}, {1, 1}}), Vector({1, 1}));
  REQUIRE(std::holds_alternative<Obstacle>(outside));
  CHECK(std::get<Obstacle>(outside).x == Vector({1, -prime}));
}

TEST_CASE("properties: all of them end when somebody says so") {
  const std::atomic<bool> stopped = true;
  const Stop stop(&stopped);
  const ExactProblem problem = ReferenceProblem();
  CHECK_THROWS_AS(DecideSemidefinite(problem.A), Stopped);
  CHECK_THROWS_AS(DecideRange(problem.A, problem.b), Stopped);
  CHECK_THROWS_AS(IsRegularModuloPrime(problem), Stopped);
  CHECK_THROWS_AS(BoundRangeDistance(problem), Stopped);
  LinearSystem system{{false}, {{{1}, -1, Relation::kZero}}};
  CHECK_THROWS_AS(Solve(system), Stopped);
  CHECK_THROWS_AS(Minimize({{2}}, {-1}), Stopped);
}

TEST_CASE("range: A x = b, or y'A = 0 and y'b /= 0, of every matrix and vector") {
  int counts[2] = {};
  for (int index = 0; index < 2000; ++index) {
    CAPTURE(index);
    Choices choices(index);
    const int size = 1 + index % 5;
    ExactMatrix A = RandomMatrix(size, index % 2 == 0, choices);
    if (size > 1 && index % 3 != 0) A.row(size - 1) = A.row(0);  // singular
    const bool inside = choices.Integer(0, 1) == 0;
    const ExactVector b = inside ? Times(A, RandomVector(size, choices)) : RandomVector(size, choices);
    const auto decision = DecideRange(A, b);
    ++counts[decision.index()];
    if (const auto* point = std::get_if<ExactVector>(&decision)) {
      CHECK(Times(A, *point) == b);
      continue;
    }
    CHECK_FALSE(inside);
    const auto& [y, value] = std::get<Obstacle>(decision);
    CHECK(value != 0);
    CHECK(Dot(y, b) == value);
    const ExactVector yA = Times(A.transpose(), y);
    for (const Rational& entry : yA) CHECK(entry == 0);
  }
  CHECK(counts[0] > 300);
  CHECK(counts[1] > 300);
}

TEST_CASE("assumptions: the reference problem meets them, and each broken one is noticed") {
  CHECK(MeetsAssumptions(ReferenceProblem()));
  CHECK(MeetsAssumptions(NoContacts()));
  ExactProblem problem = ReferenceProblem();
  problem.A(3, 0) += 1;
  CHECK_FALSE(IsSymmetric(problem));
  CHECK_FALSE(MeetsAssumptions(problem));
  problem = ReferenceProblem();
  problem.A(2, 2) = 0;
  CHECK_FALSE(IsPositiveSemidefinite(problem));
  CHECK_FALSE(MeetsAssumptions(problem));
  CHECK(IsPositiveSemidefinite(NoSolution()));
  CHECK_FALSE(IsInRange(NoSolution()));
  CHECK_FALSE(MeetsAssumptions(NoSolution()));
}

}  // namespace
}  // namespace stiction
