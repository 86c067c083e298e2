// SPDX-License-Identifier: Apache-2.0
// Rationals of Boost.Multiprecision, which are headers alone: for the solver in a browser (cli/live), where
// there is no GMP. Include rational.h.

#pragma once

#include <Eigen/Core>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <string>

// Boost 1.74 asks of whatever a number might be made of whether it is a container of bytes, and in doing so
// what the iterator of a matrix points to, which has none.
template <class T>
requires requires(const T* x) {
  []<class Of>(const Eigen::EigenBase<Of>*) {}(x);
}
struct boost::multiprecision::detail::is_byte_container<T> : boost::false_type {};

namespace stiction {

// Always in lowest terms.
using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;

using BoostInteger =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;

// Of decimal digits. Boost takes a number with a leading zero for octal.
inline BoostInteger IntegerOf(const std::string& digits) {
  const std::size_t first = digits.find_first_not_of('0');
  return first == digits.npos ? BoostInteger(0) : BoostInteger(digits.substr(first));
}

inline BoostInteger PowerOfTen(unsigned long exponent) {
  return boost::multiprecision::pow(BoostInteger(10), static_cast<unsigned>(exponent));
}

// Requires at most 53 bits.
inline double DoubleOf(const BoostInteger& x) { return x.convert_to<double>(); }

inline std::string TextOf(const Rational& x) { return x.str(); }

template <>
struct BitLength<BoostInteger> {
  // 1 for zero, as GMP counts.
  static std::int64_t Of(const BoostInteger& x) {
    return x.is_zero() ? 1 : static_cast<std::int64_t>(boost::multiprecision::msb(BoostInteger(abs(x)))) + 1;
  }
};

template <>
struct Fractions<Rational> {
  using Integer = BoostInteger;

  static Integer Numerator(const Rational& x) { return numerator(x); }
  static Integer Denominator(const Rational& x) { return denominator(x); }
  static Integer Numerator(const Rational& x, const Integer& multiple) {
    return multiple / denominator(x) * numerator(x);
  }
  static void Include(Integer& multiple, const Rational& x) {
    const Integer own = denominator(x);
    if (own != 1) multiple = lcm(multiple, own);
  }
  // Requires y /= 0. Boost 1.74 refuses a negative denominator of unbounded integers.
  static Rational Quotient(const Integer& x, const Integer& y) {
    return y < 0 ? Rational(Integer(-x), Integer(-y)) : Rational(x, y);
  }
  static void AddProduct(Integer& sum, const Integer& x, const Integer& y) { sum += x * y; }
  static void SubtractProduct(Integer& sum, const Integer& x, const Integer& y) { sum -= x * y; }
  // Requires that y divides x.
  static void DivideExactly(Integer& x, const Integer& y) { x /= y; }
};

}  // namespace stiction
