// SPDX-License-Identifier: Apache-2.0
#include "corpus/lifting.h"

#include <flint/fmpq.h>
#include <flint/nmod_mat.h>

#include <algorithm>
#include <utility>

#include "corpus/stop.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

// A matrix modulo a prime.
struct Residues {
  Residues(const IntegerRows& A, std::uint64_t prime) {
    nmod_mat_init(of, static_cast<slong>(A.size()), A.empty() ? 0 : static_cast<slong>(A[0].size()), prime);
    for (std::size_t i = 0; i < A.size(); ++i)
      for (std::size_t j = 0; j < A[i].size(); ++j)
        nmod_mat_entry(of, i, j) = mpz_fdiv_ui(A[i][j].get_mpz_t(), prime);
  }
  ~Residues() { nmod_mat_clear(of); }
  Residues(const Residues&) = delete;
  Residues& operator=(const Residues&) = delete;

  nmod_mat_t of;
};

struct FlintInteger {
  FlintInteger() { fmpz_init(of); }
  explicit FlintInteger(const mpz_class& x) : FlintInteger() { fmpz_set_mpz(of, x.get_mpz_t()); }
  ~FlintInteger() { fmpz_clear(of); }
  FlintInteger(const FlintInteger&) = delete;
  FlintInteger& operator=(const FlintInteger&) = delete;

  mpz_class Value() const {
    mpz_class value;
    fmpz_get_mpz(value.get_mpz_t(), of);
    return value;
  }

  fmpz_t of;
};

// Hadamard: of A x = b the determinants of Cramer's rule, at most; that of a numerator, and the denominator's.
std::pair<mpz_class, mpz_class> BoundsOf(const IntegerRows& A, const IntegerVector& b) {
  mpz_class of_A = 1, of_both = 1;  // squares
  for (std::size_t i = 0; i < A.size(); ++i) {
    mpz_class square = 0;
    for (const mpz_class& x : A[i]) square += x * x;
    of_A *= square;
    of_both *= square + b[i] * b[i];
  }
  return {sqrt(of_both) + 1, sqrt(of_A) + 1};
}

// A number of digits in base p, the last one first.
mpz_class FromDigits(IntegerVector digits, const IntegerVector& powers) {
  for (std::size_t k = 0; digits.size() > 1; ++k) {  // powers[k] = p^(2^k)
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
      digits[i / 2] = digits[i] + digits[i + 1] * powers[k];
    if (digits.size() % 2 == 1) digits[digits.size() / 2] = digits.back();
    digits.resize((digits.size() + 1) / 2);
  }
  return digits[0];
}

// The fractions n / d with x_i d = n modulo `modulus`, which is above twice the product of the bounds of n and
// d: mostly of the denominator that those before have.
CommonFractions Reconstruct(const IntegerVector& x, const mpz_class& modulus, const mpz_class& most_n,
                            const mpz_class& most_d) {
  const FlintInteger m(modulus), most_numerator(most_n), most_denominator(most_d);
  CommonFractions fractions;
  IntegerVector known;  // denominators
  for (const mpz_class& residue : x) {
    mpz_class numerator = residue * fractions.denominator % modulus;
    const mpz_class negative = numerator - modulus;
    if (-negative <= most_n) {
      numerator = negative;
    } else if (numerator > most_n) {
      const FlintInteger given(numerator);
      FlintInteger n, d;
      const int found =
          _fmpq_reconstruct_fmpz_2(n.of, d.of, given.of, m.of, most_numerator.of, most_denominator.of);
      STICTION_CHECK(found != 0, "digits that are of no fraction within its bounds");
      numerator = n.Value();
      fractions.denominator *= d.Value();
    }
    fractions.numerators.push_back(std::move(numerator));
    known.push_back(fractions.denominator);
  }
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i] != fractions.denominator) fractions.numerators[i] *= fractions.denominator / known[i];
  return fractions;
}

CommonFractions Lift(const IntegerRows& A, const Residues& inverse, const std::vector<Rational>& right,
                     std::uint64_t prime) {
  mpz_class unit = 1;
  for (const Rational& x : right) Fractions<Rational>::Include(unit, x);
  IntegerVector rest;
  for (const Rational& x : right) rest.push_back(Fractions<Rational>::Numerator(x, unit));
  const auto [most_n, most_d] = BoundsOf(A, rest);
  const std::size_t size = A.size();
  const mpz_class most = 2 * most_n * most_d;
  const std::size_t count = mpz_sizeinbase(most.get_mpz_t(), 2) / (FLINT_BIT_COUNT(prime) - 1) + 1;
  IntegerRows digits(size);
  std::vector<mp_limb_t> residues(size), digit(size);
  for (std::size_t k = 0; k < count; ++k) {
    Stop::Check();
    for (std::size_t i = 0; i < size; ++i) residues[i] = mpz_fdiv_ui(rest[i].get_mpz_t(), prime);
    nmod_mat_mul_nmod_vec(digit.data(), inverse.of, residues.data(), static_cast<slong>(size));
    for (std::size_t i = 0; i < size; ++i) {
      digits[i].emplace_back(digit[i]);
      for (std::size_t j = 0; j < size; ++j) {
        if (sgn(A[i][j]) != 0) mpz_submul_ui(rest[i].get_mpz_t(), A[i][j].get_mpz_t(), digit[j]);
      }
      mpz_divexact_ui(rest[i].get_mpz_t(), rest[i].get_mpz_t(), prime);
    }
  }
  IntegerVector powers(1, mpz_class(prime)), x;
  for (std::size_t reached = 2; reached < count; reached *= 2)
    powers.emplace_back(powers.back() * powers.back());
  for (IntegerVector& of : digits) x.push_back(FromDigits(std::move(of), powers));
  mpz_class modulus;
  mpz_ui_pow_ui(modulus.get_mpz_t(), prime, count);
  CommonFractions fractions = Reconstruct(x, modulus, most_n, most_d);
  fractions.denominator *= unit;
  return fractions;
}

}  // namespace

std::uint64_t LiftingPrime(int number) {
  std::uint64_t prime = (std::uint64_t{1} << 62) - 57;  // the greatest
  for (; number > 0; --number) {
    do prime -= 2;
    while (n_is_prime(prime) == 0);
  }
  return prime;
}

std::vector<int> IndependentColumns(const IntegerRows& A, std::uint64_t prime) {
  Residues residues(A, prime);
  const int rank = static_cast<int>(nmod_mat_rref(residues.of));
  std::vector<int> columns;
  for (int row = 0, column = 0; row < rank; ++row, ++column) {
    while (nmod_mat_entry(residues.of, row, column) == 0) ++column;
    columns.push_back(column);
  }
  return columns;
}

std::optional<std::vector<CommonFractions>> SolveLifted(const IntegerRows& A,
                                                        const std::vector<std::vector<Rational>>& right,
                                                        std::uint64_t prime) {
  Residues inverse(A, prime);
  if (!A.empty() && nmod_mat_inv(inverse.of, inverse.of) == 0) return std::nullopt;
  std::vector<CommonFractions> solutions;
  for (const std::vector<Rational>& b : right) solutions.push_back(Lift(A, inverse, b, prime));
  return solutions;
}

}  // namespace stiction
