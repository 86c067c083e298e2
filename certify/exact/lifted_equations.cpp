// SPDX-License-Identifier: Apache-2.0
#include <flint/fmpq_mat.h>

#include "certify/exact/linear_equations.h"
#include "corpus/lifting.h"

namespace stiction {
namespace {

IntegerRows Transposed(const IntegerRows& A) {
  IntegerRows transposed(A.empty() ? 0 : A[0].size());
  for (const IntegerVector& row : A)
    for (std::size_t j = 0; j < row.size(); ++j) transposed[j].push_back(row[j]);
  return transposed;
}

IntegerRows PartOf(const IntegerRows& A, const std::vector<int>& rows, const std::vector<int>& columns) {
  IntegerRows part(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const int column : columns) part[i].push_back(A[rows[i]][column]);
  return part;
}

// Equations of a square matrix by rows and columns that are independent modulo a prime, and so are.
class LiftedEquations {
 public:
  LiftedEquations(const ExactMatrix& M, std::uint64_t prime)
      : prime_(prime),
        N_(InIntegers(M, scale_)),
        columns_(IndependentColumns(N_, prime)),
        rows_(IndependentColumns(Transposed(N_), prime)),
        block_(PartOf(N_, rows_, columns_)) {}

  const std::vector<int>& columns() const { return columns_; }

  // x, zero at the other columns. Empty, and `failed` the first row that it fails, if it fails one.
  std::optional<ExactVector> Solve(ExactVector right, int& failed) const {
    std::vector<Rational> target;
    for (int i = 0; i < right.size(); ++i) right[i] *= scale_[i];
    for (const int row : rows_) target.push_back(right[row]);
    const CommonFractions solution = SolveLifted(block_, {target}, prime_)->front();
    for (failed = 0; failed < right.size(); ++failed) {
      mpz_class product = 0;
      for (std::size_t j = 0; j < columns_.size(); ++j)
        product += N_[failed][columns_[j]] * solution.numerators[j];
      if (product * right[failed].get_den() != solution.denominator * right[failed].get_num())
        return std::nullopt;
    }
    ExactVector x = ExactVector::Zero(right.size());
    for (std::size_t j = 0; j < columns_.size(); ++j)
      x[columns_[j]] = Fractions<Rational>::Quotient(solution.numerators[j], solution.denominator);
    return x;
  }

  // y, 1 at `row`, the others among the rows: y'M = 0 modulo the prime.
  ExactVector Dependence(int row) const {
    std::vector<Rational> target;
    for (const int column : columns_) target.emplace_back(N_[row][column]);
    const CommonFractions z = SolveLifted(Transposed(block_), {target}, prime_)->front();
    ExactVector y = ExactVector::Zero(static_cast<int>(N_.size()));
    y[row] = 1;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const int other = rows_[k];
      y[other] = Fractions<Rational>::Quotient(-z.numerators[k] * scale_[other], z.denominator * scale_[row]);
    }
    return y;
  }

 private:
  std::uint64_t prime_;
  IntegerVector scale_;
  IntegerRows N_;  // rows of M, each times its scale
  std::vector<int> columns_, rows_;
  IntegerRows block_;
};

}  // namespace

// Rows times their denominators are independent where they are.
std::vector<int> IndependentRows(const Eigen::SparseMatrix<Rational, Eigen::RowMajor>& M) {
  using Row = Eigen::SparseMatrix<Rational, Eigen::RowMajor>::InnerIterator;
  IntegerRows transposed(M.cols(), IntegerVector(M.rows()));
  for (int i = 0; i < M.rows(); ++i) {
    mpz_class scale = 1;
    for (Row of(M, i); of; ++of) Fractions<Rational>::Include(scale, of.value());
    for (Row of(M, i); of; ++of) transposed[of.col()][i] = Fractions<Rational>::Numerator(of.value(), scale);
  }
  return IndependentColumns(transposed, LiftingPrime(0));
}

std::optional<ExactVector> SolveByLifting(const ExactMatrix& M, const ExactVector& right,
                                          const ExactVector& guess) {
  const LiftedEquations equations(M, LiftingPrime(0));
  ExactVector free = guess;
  for (const int column : equations.columns()) free[column] = 0;
  int failed = 0;
  auto x = equations.Solve(free.isZero(0) ? right : ExactVector(right - M * free), failed);
  if (x) *x += free;
  return x;
}

// Rows that depend on others modulo a prime that divides a minor may not: then another prime has more.
std::variant<ExactVector, Obstacle> DecideRange(const ExactMatrix& A, const ExactVector& b) {
  for (int prime = 0;; ++prime) {
    const LiftedEquations equations(A, LiftingPrime(prime));
    int failed = 0;
    if (auto x = equations.Solve(b, failed)) return *std::move(x);
    ExactVector y = equations.Dependence(failed);
    if ((A.transpose() * y).isZero(0)) return Obstacle{y, y.dot(b)};
  }
}

std::pair<std::vector<int>, ExactMatrix> ReducedRows(const ExactMatrix& M) {
  const int rows = static_cast<int>(M.rows()), columns = static_cast<int>(M.cols());
  fmpq_mat_t reduced;
  fmpq_mat_init(reduced, rows, columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) fmpq_set_mpq(fmpq_mat_entry(reduced, i, j), M(i, j).get_mpq_t());
  const int rank = static_cast<int>(fmpq_mat_rref(reduced, reduced));
  std::pair<std::vector<int>, ExactMatrix> result({}, ExactMatrix(rank, columns));
  for (int i = 0, pivot = 0; i < rank; ++i, ++pivot) {
    while (fmpq_is_zero(fmpq_mat_entry(reduced, i, pivot)) != 0) ++pivot;
    result.first.push_back(pivot);
    for (int j = 0; j < columns; ++j)
      fmpq_get_mpq(result.second(i, j).get_mpq_t(), fmpq_mat_entry(reduced, i, j));
  }
  fmpq_mat_clear(reduced);
  return result;
}

}  // namespace stiction
