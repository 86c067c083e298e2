// SPDX-License-Identifier: Apache-2.0
// Rational: the exact number of stiction, and numbers as text.

#ifndef STICTION_CORPUS_RATIONAL_H_
#define STICTION_CORPUS_RATIONAL_H_

#include <gmpxx.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "solver/problem/scalar.h"

namespace stiction {

// GMP's rational, always in lowest terms. It is CGAL::Exact_rational too (asserted in certify).
using Rational = mpq_class;

// Reads `-?\d+/\d+` or `-?\d+(\.\d+)?([eE][+-]?\d+)?` exactly. Empty if the text does not match, if the
// denominator is zero, or if the exponent exceeds 10,000 in magnitude.
std::optional<Rational> ParseRational(std::string_view text);

// "-3/4", "7": the form that ParseRational reads back to the same number.
std::string ToString(const Rational& x);

// The double nearest to x (to even on ties); infinite beyond the range of doubles.
double ToDouble(const Rational& x);

// Bits of the longer of numerator and denominator.
std::int64_t Bits(const Rational& x);

template <>
struct BitLength<Rational> {
  static std::int64_t Of(const Rational& x) { return Bits(x); }
};

template <>
struct BitLength<mpz_class> {
  static std::int64_t Of(const mpz_class& x) {
    return static_cast<std::int64_t>(mpz_sizeinbase(x.get_mpz_t(), 2));
  }
};

template <>
struct Fractions<Rational> {
  using Integer = mpz_class;

  static const Integer& Numerator(const Rational& x) { return x.get_num(); }
  static const Integer& Denominator(const Rational& x) { return x.get_den(); }
  static Integer Numerator(const Rational& x, const Integer& multiple) {
    Integer numerator;
    mpz_divexact(numerator.get_mpz_t(), multiple.get_mpz_t(), x.get_den_mpz_t());
    numerator *= x.get_num();
    return numerator;
  }
  static void Include(Integer& multiple, const Rational& x) {
    if (x.get_den() != 1) mpz_lcm(multiple.get_mpz_t(), multiple.get_mpz_t(), x.get_den_mpz_t());
  }
  // Requires y /= 0.
  static Rational Quotient(const Integer& x, const Integer& y) {
    Rational quotient(x, y);
    quotient.canonicalize();
    return quotient;
  }
  static void AddProduct(Integer& sum, const Integer& x, const Integer& y) {
    mpz_addmul(sum.get_mpz_t(), x.get_mpz_t(), y.get_mpz_t());
  }
  static void SubtractProduct(Integer& sum, const Integer& x, const Integer& y) {
    mpz_submul(sum.get_mpz_t(), x.get_mpz_t(), y.get_mpz_t());
  }
  // Requires that y divides x.
  static void DivideExactly(Integer& x, const Integer& y) {
    mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), y.get_mpz_t());
  }
};

}  // namespace stiction

#endif  // STICTION_CORPUS_RATIONAL_H_
