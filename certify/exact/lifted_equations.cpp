// SPDX-License-Identifier: Apache-2.0
#include <flint/fmpq_mat.h>
#include <flint/nmod_mat.h>

#include <vector>

#include "certify/exact/linear_equations.h"

namespace stiction {
namespace {

// ---- FLINT's matrices, freed where they go out of scope --------------------------------------------

struct Integers {
  Integers(int rows, int columns) { fmpz_mat_init(of, rows, columns); }
  ~Integers() { fmpz_mat_clear(of); }
  Integers(const Integers&) = delete;
  fmpz* at(int i, int j) { return fmpz_mat_entry(of, i, j); }
  mpz_class operator()(int i, int j) {
    mpz_class value;
    fmpz_get_mpz(value.get_mpz_t(), at(i, j));
    return value;
  }
  fmpz_mat_t of;
};

struct Fractional {
  Fractional(int rows, int columns) { fmpq_mat_init(of, rows, columns); }
  ~Fractional() { fmpq_mat_clear(of); }
  Fractional(const Fractional&) = delete;
  fmpq_mat_t of;
};

// Rows or columns, the first that are independent modulo a prime.
std::vector<int> IndependentColumns(fmpz_mat_t M) {
  constexpr mp_limb_t kPrime = (mp_limb_t{1} << 62) - 57;
  nmod_mat_t residues;
  nmod_mat_init(residues, fmpz_mat_nrows(M), fmpz_mat_ncols(M), kPrime);
  fmpz_mat_get_nmod_mat(residues, M);
  const int rank = static_cast<int>(nmod_mat_rref(residues));
  std::vector<int> columns;
  for (int row = 0, column = 0; row < rank; ++row, ++column) {
    while (nmod_mat_entry(residues, row, column) == 0) ++column;
    columns.push_back(column);
  }
  nmod_mat_clear(residues);
  return columns;
}

std::vector<int> IndependentRows(fmpz_mat_t M) {
  Integers transposed(static_cast<int>(fmpz_mat_ncols(M)), static_cast<int>(fmpz_mat_nrows(M)));
  fmpz_mat_transpose(transposed.of, M);
  return IndependentColumns(transposed.of);
}

}  // namespace

std::optional<ExactVector> SolveByLifting(const ExactMatrix& M, const ExactVector& right,
                                          const ExactVector& guess) {
  const int size = static_cast<int>(M.rows());
  Integers N(size, size);  // rows of M, each times its denominator
  std::vector<mpz_class> scale(size, 1);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) scale[i] = lcm(scale[i], M(i, j).get_den());
    for (int j = 0; j < size; ++j) {
      const mpz_class entry = M(i, j).get_num() * (scale[i] / M(i, j).get_den());
      fmpz_set_mpz(N.at(i, j), entry.get_mpz_t());
    }
  }
  const std::vector<int> columns = IndependentColumns(N.of), rows = IndependentRows(N.of);
  const int rank = static_cast<int>(columns.size());
  ExactVector x = guess;
  for (const int column : columns) x[column] = 0;
  ExactVector rest = right;
  if (!x.isZero(0)) rest -= M * x;
  mpz_class unit = 1;  // of rest, row by row times its scale
  for (int i = 0; i < size; ++i) {
    rest[i] *= scale[i];
    unit = lcm(unit, rest[i].get_den());
  }
  Integers block(rank, rank), target(rank, 1), numerators(rank, 1);
  for (int i = 0; i < rank; ++i) {
    for (int j = 0; j < rank; ++j) fmpz_set(block.at(i, j), N.at(rows[i], columns[j]));
    const mpz_class entry = rest[rows[i]].get_num() * (unit / rest[rows[i]].get_den());
    fmpz_set_mpz(target.at(i, 0), entry.get_mpz_t());
  }
  Fractional solution(rank, 1);
  if (rank > 0 && !fmpq_mat_solve_fmpz_mat(solution.of, block.of, target.of)) return std::nullopt;
  Integers common(1, 1);
  fmpq_mat_get_fmpz_mat_matwise(numerators.of, common.at(0, 0), solution.of);
  const mpz_class denominator = rank > 0 ? common(0, 0) : mpz_class(1);
  Integers all(size, rank), product(size, 1);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < rank; ++j) fmpz_set(all.at(i, j), N.at(i, columns[j]));
  }
  fmpz_mat_mul(product.of, all.of, numerators.of);
  for (int i = 0; i < size; ++i) {
    if (product(i, 0) * rest[i].get_den() != denominator * unit * rest[i].get_num()) return std::nullopt;
  }
  for (int i = 0; i < rank; ++i) {
    Rational value(numerators(i, 0), denominator * unit);
    value.canonicalize();
    x[columns[i]] = value;
  }
  return x;
}

}  // namespace stiction
