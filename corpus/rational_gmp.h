// SPDX-License-Identifier: Apache-2.0
// Rationals of GMP: those of the program. Include rational.h.

#pragma once

#include <gmpxx.h>

#include <cstdint>
#include <string>

namespace stiction {

// Always in lowest terms. It is CGAL::Exact_rational too (asserted in certify).
using Rational = mpq_class;

// Of decimal digits.
inline mpz_class IntegerOf(const std::string& digits) { return mpz_class(digits, 10); }

inline mpz_class PowerOfTen(unsigned long exponent) {
  mpz_class power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, exponent);
  return power;
}

// Requires at most 53 bits.
inline double DoubleOf(const mpz_class& x) { return x.get_d(); }

inline std::string TextOf(const Rational& x) { return x.get_str(); }

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
