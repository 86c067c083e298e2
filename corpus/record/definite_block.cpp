// SPDX-License-Identifier: Apache-2.0
#include "corpus/record/definite_block.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "corpus/stop.h"
#include "solver/problem/check.h"

#ifndef STICTION_BOOST_RATIONALS
#include "corpus/lifting.h"
#endif

namespace stiction {
namespace {

using Matrix = ExactProblem::Matrix;

// [M | R] becomes [I | inv(M) R] without exchanges of rows, R by rows; false where a pivot is not > 0. M is
// definite if all pivots are.
bool EliminateRows(Matrix& M, Matrix& R) {
  const int size = static_cast<int>(M.rows());
  for (int k = 0; k < size; ++k) {
    Stop::Check();
    const Rational pivot = M(k, k);
    if (pivot <= 0) return false;
    M.row(k) /= pivot;
    if (R.cols() > 0) R.row(k) /= pivot;
    for (int i = 0; i < size; ++i) {
      const Rational factor = M(i, k);
      if (i == k || factor == 0) continue;
      for (int j = k; j < size; ++j) M(i, j) -= factor * M(k, j);
      for (int j = 0; j < R.cols(); ++j) R(i, j) -= factor * R(k, j);
    }
  }
  return true;
}

// D M D over doubles, with powers of two in D that bring the diagonal between 1/2 and 4. Empty where a diagonal
// is not > 0, or no double.
std::optional<Eigen::MatrixXd> InScaledDoubles(const Matrix& M) {
  const int size = static_cast<int>(M.rows());
  std::vector<Rational> scale;
  for (int i = 0; i < size; ++i) {
    const double diagonal = ToDouble(M(i, i));
    if (!(diagonal > std::numeric_limits<double>::min()) || !std::isfinite(diagonal)) return std::nullopt;
    scale.emplace_back(std::ldexp(1.0, -std::ilogb(diagonal) / 2));
  }
  Eigen::MatrixXd rounded(size, size);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j <= i; ++j) rounded(i, j) = rounded(j, i) = ToDouble(scale[i] * M(i, j) * scale[j]);
  }
  return rounded;
}

// Proved by Cholesky's factorization: the rounding of the entries, of at most 4 in a definite matrix, and that
// of the factorization are each a quarter of c at most.
bool IsProvedDefinite(const Eigen::MatrixXd& scaled) {
  const double size = static_cast<double>(scaled.rows());
  const double c = 8 * (size + 4) * std::numeric_limits<double>::epsilon() * scaled.trace();
  Eigen::MatrixXd less = scaled;
  less.diagonal().array() -= c;
  return scaled.allFinite() && Eigen::LLT<Eigen::MatrixXd>(less).info() == Eigen::Success;
}

// By the direction of the least curvature of doubles, over rationals.
bool IsProvedIndefinite(const Matrix& M, const Eigen::MatrixXd& rounded) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(rounded);
  if (solver.info() != Eigen::Success || !solver.eigenvectors().allFinite()) return false;
  const ExactProblem::Vector x = solver.eigenvectors().col(0).unaryExpr([](double v) { return Rational(v); });
  const ExactProblem::Vector y = M * x;
  return x.dot(y) <= 0;
}

}  // namespace

std::optional<Matrix> InverseOfDefinite(const Matrix& M) {
  const auto size = M.rows();
  Matrix rest = M, W = Matrix::Constant(size, size, Rational(0));
  for (int i = 0; i < size; ++i) W(i, i) = 1;
  if (!EliminateRows(rest, W)) return std::nullopt;
  return W;
}

bool IsDefinite(const Matrix& M) {
  const auto scaled = InScaledDoubles(M);
  if (scaled && IsProvedDefinite(*scaled)) return true;
  for (int i = 0; i < M.rows(); ++i) {
    if (M(i, i) <= 0) return false;
  }
  const Eigen::MatrixXd rounded = M.unaryExpr(&ToDouble);
  if (rounded.allFinite() && IsProvedIndefinite(M, rounded)) return false;
  Matrix rest = M, none(M.rows(), 0);
  return EliminateRows(rest, none);
}

#ifdef STICTION_BOOST_RATIONALS

Matrix SolveDefinite(const Matrix& M, const Matrix& B) {
  Matrix rest = M, X = B;
  STICTION_CHECK(EliminateRows(rest, X), "a block of masses that is not definite");
  return X;
}

#else

Matrix SolveDefinite(const Matrix& M, const Matrix& B) {
  const int size = static_cast<int>(M.rows());
  IntegerVector scale;
  const IntegerRows A = InIntegers(M, scale);
  std::vector<std::vector<Rational> > right(B.cols());
  for (int j = 0; j < B.cols(); ++j)
    for (int i = 0; i < size; ++i) right[j].emplace_back(B(i, j) * scale[i]);
  std::optional<std::vector<CommonFractions> > columns;
  for (int prime = 0; !columns; ++prime) columns = SolveLifted(A, right, LiftingPrime(prime));
  Matrix X(size, B.cols());
  for (int j = 0; j < B.cols(); ++j)
    for (int i = 0; i < size; ++i)
      X(i, j) = Fractions<Rational>::Quotient((*columns)[j].numerators[i], (*columns)[j].denominator);
  return X;
}

#endif

}  // namespace stiction
