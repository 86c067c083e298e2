// SPDX-License-Identifier: Apache-2.0
// Sparse factors: with pivots kept, as with pivots of their own; what does not suit is noticed.

#include "solver/linear/sparse_lu.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <random>

namespace stiction {
namespace {

using Dense = Eigen::MatrixXd;

// Of one pattern, three entries a column: those of one place are `ratio` times as large as the others.
SparseLu::Matrix DrawnMatrix(std::mt19937& random, int large = 0, double ratio = 10) {
  constexpr int kSize = 30;
  std::uniform_real_distribution<double> number(0.5, 1);
  SparseLu::Matrix K(kSize, kSize);
  for (int j = 0; j < kSize; ++j) {
    int place = 0;
    for (const int i : {j, (j + 1) % kSize, (j + 7) % kSize})
      K.insert(i, j) = number(random) * (place++ == large ? ratio : 1);
  }
  K.makeCompressed();
  return K;
}

double ErrorOf(const SparseLu::Matrix& K, const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  return (x - Dense(K).fullPivLu().solve(y)).norm() / x.norm();
}

TEST_CASE("sparse lu: pivots of one matrix serve others of its pattern") {
  std::mt19937 random(1);
  SparseLu lu;
  lu.Order(DrawnMatrix(random));
  for (int repeat = 0; repeat < 20; ++repeat) {
    const SparseLu::Matrix K = DrawnMatrix(random);
    const Eigen::VectorXd y = Eigen::VectorXd::LinSpaced(K.rows(), -1, 2);
    REQUIRE(lu.Factor(K));
    CHECK(ErrorOf(K, lu.Solve(K, y), y) < 1e-13);
  }
}

TEST_CASE("sparse lu: pivots that do not suit are chosen anew") {
  std::mt19937 random(2);
  SparseLu lu;
  lu.Order(DrawnMatrix(random));
  for (const int large : {0, 1, 2, 0}) {
    INFO(large);
    const SparseLu::Matrix K = DrawnMatrix(random, large, 1e13);
    const Eigen::VectorXd y = Eigen::VectorXd::LinSpaced(K.rows(), -1, 2);
    REQUIRE(lu.Factor(K));
    CHECK(ErrorOf(K, lu.Solve(K, y), y) < 1e-10);
  }
}

TEST_CASE("sparse lu: answers do not depend on matrices before, once pivots are forgotten") {
  std::mt19937 random(3);
  SparseLu used;
  const SparseLu::Matrix first = DrawnMatrix(random, 1, 1e13), second = DrawnMatrix(random);
  const Eigen::VectorXd y = Eigen::VectorXd::LinSpaced(first.rows(), -1, 2);
  used.Order(first);
  REQUIRE(used.Factor(first));
  used.ForgetPivots();
  SparseLu fresh;
  fresh.Order(second);
  REQUIRE(used.Factor(second));
  REQUIRE(fresh.Factor(second));
  CHECK(used.Solve(second, y) == fresh.Solve(second, y));
}

TEST_CASE("sparse lu: a singular matrix has no factors") {
  std::mt19937 random(4);
  SparseLu::Matrix K = DrawnMatrix(random);
  for (SparseLu::Matrix::InnerIterator of(K, 3); of; ++of) of.valueRef() = 0;
  SparseLu lu;
  CHECK_FALSE(lu.Factor(K));  // nothing is ordered
  lu.Order(K);
  CHECK_FALSE(lu.Factor(K));
  CHECK_FALSE(lu.Factor(K));
}

}  // namespace
}  // namespace stiction
