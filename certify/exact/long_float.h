// SPDX-License-Identifier: Apache-2.0
// LongFloat: a float of 512 bits, for balls where those around double-doubles leave a sign open.
//
//   x = sign * m * 2^exponent,   m of kBits bits, the first of them 1
//
// Sums are truncated by less than 2^(1 - kBits) of the larger summand, products and quotients by less than that
// of themselves. What falls below 2^-kReach becomes zero; what grows beyond 2^kReach throws UnsureSign.

#ifndef STICTION_CERTIFY_EXACT_LONG_FLOAT_H_
#define STICTION_CERTIFY_EXACT_LONG_FLOAT_H_

#include <gmp.h>

#include <array>
#include <cmath>
#include <limits>

#include "certify/exact/wide_ball.h"
#include "corpus/rational.h"
#include "solver/problem/ball.h"

namespace stiction {

class LongFloat {
 public:
  static constexpr int kLimbs = 8, kBits = kLimbs * 64;
  static constexpr int kReach = 1000;  // the range of doubles, so that one is near every number

  LongFloat() = default;         // zero
  explicit LongFloat(double x);  // UnsureSign beyond the reach, on either side
  // The nearest towards zero. `is_exact`: whether it is x.
  LongFloat(const Rational& x, bool& is_exact);

  int sign() const { return sign_; }
  // A double within a factor of 1 +- 2^-51.
  double Near() const;
  Rational Exactly() const;

  LongFloat operator-() const {
    LongFloat x = *this;
    x.sign_ = -x.sign_;
    return x;
  }
  friend LongFloat operator+(const LongFloat& x, const LongFloat& y);
  friend LongFloat operator*(const LongFloat& x, const LongFloat& y);
  friend LongFloat operator/(const LongFloat& x, const LongFloat& y);  // requires y != 0
  friend bool operator==(const LongFloat& x, const LongFloat& y) {
    return x.sign_ == y.sign_ && (x.sign_ == 0 || (x.exponent_ == y.exponent_ && x.m_ == y.m_));
  }
  friend bool operator>(const LongFloat& x, const LongFloat& y) { return (x + -y).sign_ > 0; }

 private:
  static_assert(GMP_NUMB_BITS == 64);
  using Limbs = std::array<mp_limb_t, kLimbs>;

  static LongFloat SumOfOrdered(const LongFloat& x, const LongFloat& y);
  void Take(int sign, mp_limb_t* limbs, int size, long exponent);
  void StayInReach();

  int sign_ = 0;  // where it is zero the rest means nothing
  long exponent_ = 0;
  Limbs m_;  // the last limb first
};

template <>
struct Rounding<LongFloat> {
  static constexpr double kUnit = 0x1p-508;  // with a wide margin
  static constexpr double kLost = 0x1p-990;  // more than what becomes zero, and than the least radii

  static double Near(const LongFloat& x) { return x.Near(); }
  static double Size(const LongFloat& x) { return std::abs(x.Near()); }
  static double OfSum(const LongFloat& x, const LongFloat& y, const LongFloat&) {
    const double size = Size(x) + Size(y);
    return size == 0 ? 0 : kUnit * size + kLost;
  }
  static double OfProduct(const LongFloat& product) { return kUnit * Size(product) + kLost; }
  static double OfQuotient(const LongFloat&, const LongFloat& quotient) { return OfProduct(quotient); }
};

using LongBall = Ball<LongFloat>;

template <>
inline LongBall BallAround(const Rational& x) {
  try {
    bool is_exact;
    const LongFloat middle(x, is_exact);
    return {middle, is_exact ? 0 : Rounding<LongFloat>::OfProduct(middle)};
  } catch (const UnsureSign&) {  // out of reach
    return {LongFloat(), std::numeric_limits<double>::infinity()};
  }
}

}  // namespace stiction

#endif  // STICTION_CERTIFY_EXACT_LONG_FLOAT_H_
