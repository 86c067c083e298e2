// SPDX-License-Identifier: Apache-2.0
// LongFloat: a float of 254 bits by MPFR, for balls where those around double-doubles leave a sign open.
//
// It is to the nearest in 2^-254 of itself, and its exponents are without a bound here. Radii are doubles, so
// what falls below the doubles gets a radius of kLost, and what grows beyond them decides nothing.

#pragma once

#include <algorithm>
#include <bit>
#include <boost/multiprecision/mpfr.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "certify/exact/wide_ball.h"
#include "solver/problem/ball.h"

namespace stiction {

using LongFloat = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<76, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

template <>
struct Rounding<LongFloat> {
  static constexpr double kUnit = 0x1p-250;  // with a wide margin
  static constexpr double kLost = 0x1p-990;
  static constexpr double kLeast = 0x1p-900;  // below it a number has a radius of kLost

  static double Near(const LongFloat& x) { return mpfr_get_d(x.backend().data(), MPFR_RNDN); }
  // From the leading 64 bits: a third of the time of Near.
  static double Size(const LongFloat& x) {
    const mpfr_srcptr at = x.backend().data();
    if (!mpfr_regular_p(at)) return std::abs(Near(x));
    const auto* limbs = static_cast<const mp_limb_t*>(mpfr_custom_get_significand(at));
    const auto lead = static_cast<double>(limbs[(mpfr_get_prec(at) - 1) / mp_bits_per_limb]);
    const mpfr_exp_t exponent = std::clamp<mpfr_exp_t>(mpfr_get_exp(at) - mp_bits_per_limb, -3000, 3000);
    constexpr int kUsual = 900, kBias = 1023, kMantissa = 52;  // powers of two that are doubles, by their bits
    if (std::abs(exponent) <= kUsual)
      return lead * std::bit_cast<double>(static_cast<std::int64_t>(exponent + kBias) << kMantissa);
    return std::ldexp(lead, static_cast<int>(exponent));
  }
  static double OfSum(const LongFloat& x, const LongFloat& y, const LongFloat&) {
    return x == 0 || y == 0 ? 0 : kUnit * (Size(x) + Size(y)) + kLost;
  }
  static double OfProduct(const LongFloat& product) { return kUnit * Size(product) + kLost; }
  static double OfQuotient(const LongFloat&, const LongFloat& quotient) { return OfProduct(quotient); }
};

using LongBall = Ball<LongFloat>;

template <>
inline LongBall BallAround(const Rational& x) {
  using Round = Rounding<LongFloat>;
  LongFloat middle;
  const bool is_exact = mpfr_set_q(middle.backend().data(), x.get_mpq_t(), MPFR_RNDN) == 0;
  const double size = Round::Size(middle);
  if (std::isinf(size)) return {LongFloat(0), std::numeric_limits<double>::infinity()};
  const bool is_small = sgn(x) != 0 && size < Round::kLeast;
  return {middle, is_exact && !is_small ? 0 : Round::OfProduct(middle)};
}

}  // namespace stiction
