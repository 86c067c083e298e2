// SPDX-License-Identifier: Apache-2.0
// WideBall: a ball around a double-double of the QD library, of about 100 bits. And balls around rationals.
//
// Error bounds, with a wide margin over those proved (Joldes, Muller and Popescu 2017: a few 2^-106): QD adds
// in the "sloppy" way, whose error is relative to the summands; products and quotients round relative to
// themselves, unless parts of them are lost below the least double, which is at most kLost for products and
// excluded for quotients.

#pragma once

#include <qd/dd_real.h>

#include <cmath>
#include <limits>
#include <optional>

#include "corpus/rational.h"
#include "solver/problem/ball.h"

namespace stiction {

template <>
struct Rounding<dd_real> {
  static constexpr double kUnit = 0x1p-98;
  static constexpr double kLost = 0x1p-1000;
  static constexpr double kLeastOfQuotients = 0x1p-900;

  static double Near(const dd_real& x) { return x.x[0]; }
  static double Size(const dd_real& x) { return std::abs(x.x[0]); }
  static double OfSum(const dd_real& x, const dd_real& y, const dd_real&) {
    return kUnit * (Size(x) + Size(y));
  }
  static double OfProduct(const dd_real& product) { return kUnit * Size(product) + kLost; }
  static double OfQuotient(const dd_real& x, const dd_real& quotient) {
    const bool holds = (Size(x) >= kLeastOfQuotients && Size(quotient) >= kLeastOfQuotients) || Size(x) == 0;
    return holds ? kUnit * Size(quotient) + kLost : std::numeric_limits<double>::infinity();
  }
};

using NarrowBall = Ball<double>;
using WideBall = Ball<dd_real>;

// A ball around x, a point where x is a double, or two.
template <class Number>
Ball<Number> BallAround(const Rational& x);

// Whether x is an integer that a double holds: the usual number of a problem.
inline bool IsShortInteger(const Rational& x) {
  return mpz_cmp_ui(x.get_den_mpz_t(), 1) == 0 && mpz_sizeinbase(x.get_num_mpz_t(), 2) <= 53;
}

// mpq_get_d truncates, by less than the unit of a product.
template <>
inline NarrowBall BallAround(const Rational& x) {
  const double middle = x.get_d();
  if (IsShortInteger(x)) return NarrowBall(middle);
  if (std::isinf(middle)) return {0, std::numeric_limits<double>::infinity()};
  return {middle, Rational(middle) == x ? 0 : Rounding<double>::OfProduct(middle)};
}

// Where the denominator is a power of two, as in most problems: the same ball, from integers alone.
inline std::optional<WideBall> BallAroundDyadic(const Rational& x) {
  constexpr std::size_t kMostBits = 900;  // nothing is beyond the doubles
  const mpz_srcptr numerator = x.get_num_mpz_t();
  const std::size_t shift = mpz_sizeinbase(x.get_den_mpz_t(), 2) - 1;
  if (mpz_scan1(x.get_den_mpz_t(), 0) != shift || shift > kMostBits || mpz_sizeinbase(numerator, 2) > kMostBits)
    return std::nullopt;
  thread_local mpz_class rest, part;
  const double high = mpz_get_d(numerator);
  mpz_set_d(part.get_mpz_t(), high);
  mpz_sub(rest.get_mpz_t(), numerator, part.get_mpz_t());
  const double low = mpz_get_d(rest.get_mpz_t());
  double below;
  const double near = qd::quick_two_sum(high, low, below), scale = std::ldexp(1.0, -static_cast<int>(shift));
  const bool is_exact = mpz_cmp_d(rest.get_mpz_t(), low) == 0;
  return WideBall(dd_real(near * scale, below * scale),
                  is_exact ? 0 : Rounding<dd_real>::OfProduct(low * scale));
}

template <>
inline WideBall BallAround(const Rational& x) {
  if (const auto ball = BallAroundDyadic(x)) return *ball;
  const double high = x.get_d();
  if (IsShortInteger(x)) return WideBall(high);
  if (std::isinf(high)) return {0, std::numeric_limits<double>::infinity()};
  const Rational rest = x - Rational(high);
  const double low = rest.get_d();
  double below;
  const double near = qd::quick_two_sum(high, low, below);
  if (std::isinf(near)) return {0, std::numeric_limits<double>::infinity()};
  return {dd_real(near, below), Rational(low) == rest ? 0 : Rounding<double>::OfProduct(low)};
}

// Doubles below and above a ball.
template <class Number>
double HighEnd(const Ball<Number>& x) {
  if (x.radius() == 0 && Number(Rounding<Number>::Near(x.middle())) == x.middle())
    return Rounding<Number>::Near(x.middle());
  const double reach = Rounding<Number>::Near(x.middle()) + x.radius() * (1 + 0x1p-40);
  return std::nextafter(reach + 0x1p-50 * std::abs(reach), std::numeric_limits<double>::infinity());
}
template <class Number>
double LowEnd(const Ball<Number>& x) {
  return -HighEnd(-x);
}

}  // namespace stiction
