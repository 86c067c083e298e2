// SPDX-License-Identifier: Apache-2.0
#include "corpus/record/definite_block.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "corpus/stop_reading.h"
#include "solver/problem/check.h"

#ifndef STICTION_BOOST_RATIONALS
#include <flint/fmpq_mat.h>
#endif

namespace stiction {
namespace {

using Matrix = ExactProblem::Matrix;

// [M | R] becomes [I | inv(M) R] without exchanges of rows, R by rows; false where a pivot is not > 0. M is
// definite if all pivots are.
bool EliminateRows(Matrix& M, Matrix& R) {
  const int size = static_cast<int>(M.rows());
  for (int k = 0; k < size; ++k) {
    StopReading::Check();
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

#ifndef STICTION_BOOST_RATIONALS
class FlintMatrix {
 public:
  FlintMatrix(int rows, int columns) { fmpq_mat_init(matrix_, rows, columns); }
  explicit FlintMatrix(const Matrix& M) : FlintMatrix(static_cast<int>(M.rows()), static_cast<int>(M.cols())) {
    for (int i = 0; i < M.rows(); ++i) {
      for (int j = 0; j < M.cols(); ++j) fmpq_set_mpq(fmpq_mat_entry(matrix_, i, j), M(i, j).get_mpq_t());
    }
  }
  FlintMatrix(const FlintMatrix&) = delete;
  FlintMatrix& operator=(const FlintMatrix&) = delete;
  ~FlintMatrix() { fmpq_mat_clear(matrix_); }

  fmpq_mat_struct* get() { return matrix_; }
  Rational At(int i, int j) const {
    Rational x;
    fmpq_get_mpq(x.get_mpq_t(), fmpq_mat_entry(matrix_, i, j));
    return x;
  }

 private:
  fmpq_mat_t matrix_;
};
#endif

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

// Columns by themselves, so that somebody may stop between them; together they would take about as long.
Matrix SolveDefinite(const Matrix& M, const Matrix& B) {
  FlintMatrix of(M);
  Matrix X(B.rows(), B.cols());
  for (int j = 0; j < B.cols(); ++j) {
    StopReading::Check();
    FlintMatrix right(B.col(j)), x(static_cast<int>(B.rows()), 1);
    STICTION_CHECK(fmpq_mat_solve(x.get(), of.get(), right.get()) != 0, "a block of masses that is singular");
    for (int i = 0; i < B.rows(); ++i) X(i, j) = x.At(i, 0);
  }
  return X;
}

#endif

}  // namespace stiction
