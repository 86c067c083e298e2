// SPDX-License-Identifier: Apache-2.0
// Extended: the long double of x86, by integers, for machines whose own is another (cli/live).
//
//   x = (-1)^sign m 2^(e - 63),   2^63 <= m < 2^64,   -16382 <= e <= 16383
//
// zero, infinities and what is not a number; every operation rounded once, to nearest, ties to even, as IEEE
// says of a format of 64 bits, signs of zeros too. Numbers below the normal ones lose their digits as they do
// there. Hypot goes the way of the C library (glibc 2.36), whose last bit is no matter of IEEE.
//
// Boost's cpp_bin_float_double_extended is the same, but for that of Debian 12 (1.74): it rounds x - y to the
// even neighbour of an odd x where y, no power of two, is between 1/4 and 1/2 of its last digit. 1.81 is right.

#ifndef STICTION_SOLVER_PROBLEM_EXTENDED_H_
#define STICTION_SOLVER_PROBLEM_EXTENDED_H_

#include <Eigen/Core>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "solver/problem/scalar.h"

namespace stiction {

class Extended {
 public:
  constexpr Extended() = default;
  constexpr Extended(int x)  // NOLINT: as long double
      : Extended(
            FromInteger(x < 0, x < 0 ? 0 - static_cast<std::uint64_t>(x) : static_cast<std::uint64_t>(x))) {}
  constexpr Extended(double x)  // NOLINT: as long double
      : Extended(FromDouble(x)) {}

  // To nearest, ties to even.
  explicit operator double() const {
    if (kind_ != Kind::kFinite) return kind_ == Kind::kNone ? std::nan("") : Signed(HUGE_VAL);
    const int places = e_ < -1022 ? 53 - (-1022 - e_) : 53;  // a subnormal double has fewer
    if (m_ == 0 || places < 0) return Signed(0.0);
    const Wide kept = RoundedShift(m_, 64 - places, false);
    return Signed(std::ldexp(static_cast<double>(static_cast<std::uint64_t>(kept)), e_ + 1 - places));
  }

  friend Extended operator+(const Extended& x, const Extended& y) {
    if (x.kind_ != Kind::kFinite || y.kind_ != Kind::kFinite) return SumOfEnds(x, y);
    if (x.m_ == 0 && y.m_ == 0) return Extended(Kind::kFinite, x.negative_ && y.negative_, 0, 0);
    if (x.m_ == 0) return y;
    if (y.m_ == 0) return x;
    const bool swaps = x.e_ < y.e_ || (x.e_ == y.e_ && x.m_ < y.m_);
    const Extended &big = swaps ? y : x, &small = swaps ? x : y;
    const int gap = big.e_ - small.e_;
    const Wide one = Wide{big.m_} << 63, other = gap > 126 ? 0 : (Wide{small.m_} << 63) >> gap;
    const bool rest = gap > 126 || (other << gap) != Wide{small.m_} << 63;
    const Wide sum = big.negative_ == small.negative_ ? one + other : one - other - (rest ? 1 : 0);
    return Rounded(sum != 0 && big.negative_, sum, big.e_ - 126, rest);
  }
  friend Extended operator-(const Extended& x, const Extended& y) { return x + -y; }
  friend Extended operator*(const Extended& x, const Extended& y) {
    const bool negative = x.negative_ != y.negative_;
    if (x.kind_ != Kind::kFinite || y.kind_ != Kind::kFinite) {
      const bool none = x.kind_ == Kind::kNone || y.kind_ == Kind::kNone || x.IsZero() || y.IsZero();
      return none ? None() : Infinite(negative);
    }
    return Rounded(negative, Wide{x.m_} * y.m_, x.e_ + y.e_ - 126, false);
  }
  friend Extended operator/(const Extended& x, const Extended& y) {
    const bool negative = x.negative_ != y.negative_;
    const bool finite = x.kind_ == Kind::kFinite && y.kind_ == Kind::kFinite;
    if (!finite || y.m_ == 0) return QuotientOfEnds(x, y, negative);
    const Wide above = Wide{x.m_} << 64, quotient = above / y.m_, rest = (above % y.m_) << 1;
    const bool bit = rest >= y.m_;  // 64 bits of a quotient, and one to round by
    return Rounded(negative, quotient << 1 | (bit ? 1 : 0), x.e_ - y.e_ - 65, rest != (bit ? Wide{y.m_} : 0));
  }
  Extended operator-() const {
    Extended x = *this;
    x.negative_ = !x.negative_;
    return x;
  }
  const Extended& operator+() const { return *this; }
  Extended& operator+=(const Extended& y) { return *this = *this + y; }
  Extended& operator-=(const Extended& y) { return *this = *this - y; }
  Extended& operator*=(const Extended& y) { return *this = *this * y; }
  Extended& operator/=(const Extended& y) { return *this = *this / y; }

  friend bool operator<(const Extended& x, const Extended& y) { return AreNumbers(x, y) && Order(x, y) < 0; }
  friend bool operator>(const Extended& x, const Extended& y) { return y < x; }
  friend bool operator<=(const Extended& x, const Extended& y) { return AreNumbers(x, y) && Order(x, y) <= 0; }
  friend bool operator>=(const Extended& x, const Extended& y) { return y <= x; }
  friend bool operator==(const Extended& x, const Extended& y) { return AreNumbers(x, y) && Order(x, y) == 0; }

  friend Extended sqrt(const Extended& x) {
    if (x.IsZero()) return x;
    if (x.kind_ == Kind::kNone || x.negative_) return None();
    if (x.kind_ == Kind::kInfinite) return x;
    const int odd = x.e_ & 1;
    const Wide square = Wide{x.m_} << (63 + odd);  // the root has 64 bits
    Wide root = 0, rest = square;
    for (int bit = 63; bit >= 0; --bit) {
      const Wide step = (root << (bit + 1)) + (Wide{1} << (2 * bit));  // of root^2, if the bit is set
      if (step > rest) continue;
      rest -= step;
      root |= Wide{1} << bit;
    }
    const bool above = rest > root;  // (root + 1/2)^2; it is never equal to that
    return Rounded(false, root << 1 | (above ? 1 : 0), (x.e_ - odd) / 2 - 64, rest != 0);
  }
  friend Extended abs(const Extended& x) { return x.negative_ ? -x : x; }
  friend bool isfinite(const Extended& x) { return x.kind_ == Kind::kFinite; }
  // Of what is finite, and not zero.
  friend int ilogb(const Extended& x) { return x.e_; }
  friend Extended ldexp(const Extended& x, int exponent) {
    return x.kind_ == Kind::kFinite && x.m_ != 0 ? Rounded(x.negative_, x.m_, x.e_ - 63 + exponent, false) : x;
  }
  friend Extended hypot(const Extended& x, const Extended& y) {
    const Extended ax = abs(x), ay = abs(y);
    if (ax.kind_ == Kind::kInfinite || ay.kind_ == Kind::kInfinite) return Infinite(false);
    return ax < ay ? HypotOf(ay, ax) : HypotOf(ax, ay);
  }

  static constexpr Extended PowerOfTwo(int e) { return {Kind::kFinite, false, e, std::uint64_t{1} << 63}; }
  static constexpr Extended Infinite(bool negative) { return {Kind::kInfinite, negative, 0, 0}; }
  static constexpr Extended Largest() { return {Kind::kFinite, false, kMostExponent, ~std::uint64_t{0}}; }

 private:
  __extension__ using Wide = unsigned __int128;
  enum class Kind : std::uint8_t { kFinite, kInfinite, kNone };
  static constexpr int kLeastExponent = -16382, kMostExponent = 16383;

  constexpr Extended(Kind kind, bool negative, int e, std::uint64_t m)
      : m_(m), e_(e), negative_(negative), kind_(kind) {}

  static constexpr Extended None() { return {Kind::kNone, false, 0, 0}; }
  static constexpr Extended FromInteger(bool negative, std::uint64_t size) {
    if (size == 0) return {};
    const int shift = std::countl_zero(size);
    return {Kind::kFinite, negative, 63 - shift, size << shift};
  }
  static constexpr Extended FromDouble(double x) {
    const auto bits = __builtin_bit_cast(std::uint64_t, x);  // libc++ 14 has no std::bit_cast
    const bool negative = bits >> 63;
    const int field = static_cast<int>(bits >> 52 & 0x7ff);
    const std::uint64_t digits = bits & ((std::uint64_t{1} << 52) - 1);
    if (field == 0x7ff) return digits == 0 ? Infinite(negative) : None();
    if (field == 0 && digits == 0) return {Kind::kFinite, negative, 0, 0};
    Extended result = FromInteger(negative, field == 0 ? digits : digits | std::uint64_t{1} << 52);
    result.e_ += (field == 0 ? 1 : field) - 1075;
    return result;
  }

  bool IsZero() const { return kind_ == Kind::kFinite && m_ == 0; }
  double Signed(double size) const { return negative_ ? -size : size; }

  // x 2^-shift, to nearest, ties to even; `rest`: x is more than its digits say, by less than one.
  static Wide RoundedShift(Wide x, int shift, bool rest) {
    if (shift <= 0) return x;
    if (shift > 127) return 0;
    const Wide kept = x >> shift, lost = x - (kept << shift), half = Wide{1} << (shift - 1);
    const bool up = lost > half || (lost == half && (rest || (kept & 1) != 0));
    return kept + (up ? 1 : 0);
  }

  // digits 2^e, and less than 2^e more where `rest`, rounded. Where `rest`, digits has more than 64 bits.
  static Extended Rounded(bool negative, Wide digits, int e, bool rest) {
    if (digits == 0) return {Kind::kFinite, negative, 0, 0};
    const auto high = static_cast<std::uint64_t>(digits >> 64), low = static_cast<std::uint64_t>(digits);
    const int size = high != 0 ? 128 - std::countl_zero(high) : 64 - std::countl_zero(low);
    const int shift = std::max(size - 64, kLeastExponent - 63 - e);  // by more where it is no normal number
    Wide kept = shift > 0 ? RoundedShift(digits, shift, rest) : digits << -shift;
    if (kept == 0) return {Kind::kFinite, negative, 0, 0};
    int at = e + shift;
    if (kept >> 64 != 0) {
      kept >>= 1;
      ++at;
    }
    const int up = std::countl_zero(static_cast<std::uint64_t>(kept));
    if (at - up + 63 > kMostExponent) return Infinite(negative);
    return {Kind::kFinite, negative, at - up + 63, static_cast<std::uint64_t>(kept << up)};
  }

  static Extended SumOfEnds(const Extended& x, const Extended& y) {
    if (x.kind_ == Kind::kNone || y.kind_ == Kind::kNone) return None();
    if (x.kind_ == y.kind_ && x.negative_ != y.negative_) return None();
    return x.kind_ == Kind::kInfinite ? x : y;
  }
  static Extended QuotientOfEnds(const Extended& x, const Extended& y, bool negative) {
    if (x.kind_ == Kind::kNone || y.kind_ == Kind::kNone || (x.IsZero() && y.IsZero())) return None();
    if (y.kind_ == Kind::kInfinite)
      return x.kind_ == Kind::kInfinite ? None() : Extended(Kind::kFinite, negative, 0, 0);
    return Infinite(negative);
  }

  static bool AreNumbers(const Extended& x, const Extended& y) {
    return x.kind_ != Kind::kNone && y.kind_ != Kind::kNone;
  }
  static int Order(const Extended& x, const Extended& y) {
    if (x.IsZero() && y.IsZero()) return 0;
    if (x.IsZero()) return y.negative_ ? 1 : -1;
    if (y.IsZero() || x.negative_ != y.negative_) return x.negative_ ? -1 : 1;
    const int sign = x.negative_ ? -1 : 1;
    if (x.kind_ != y.kind_) return x.kind_ == Kind::kInfinite ? sign : -sign;
    if (x.kind_ == Kind::kInfinite || (x.e_ == y.e_ && x.m_ == y.m_)) return 0;
    return std::pair(x.e_, x.m_) > std::pair(y.e_, y.m_) ? sign : -sign;
  }

  // Requires ax >= ay >= 0, or what is not a number. Its squares are far within the range for doubles.
  static Extended HypotOf(const Extended& ax, const Extended& ay) {
    if (ay <= ax * PowerOfTwo(-65)) return ax + ay;
    const Extended h = sqrt(ax * ax + ay * ay);
    Extended one, other;
    if (h <= 2 * ay) {
      const Extended delta = h - ay;
      one = ax * (2 * delta - ax);
      other = (delta - 2 * (ax - ay)) * delta;
    } else {
      const Extended delta = h - ax;
      one = 2 * delta * (ax - 2 * ay);
      other = (4 * delta - ay) * ay + delta * delta;
    }
    return h - (one + other) / (2 * h);
  }

  std::uint64_t m_ = 0;
  std::int32_t e_ = 0;
  bool negative_ = false;
  Kind kind_ = Kind::kFinite;
};

template <>
inline constexpr bool kIsRounded<Extended> = true;
template <>
inline constexpr bool kIsFloatingPoint<Extended> = true;

}  // namespace stiction

template <>
struct std::numeric_limits<stiction::Extended> {
  using Extended = stiction::Extended;
  static constexpr bool is_specialized = true, is_signed = true, is_integer = false, is_exact = false,
                        has_infinity = true;
  static constexpr int radix = 2, digits = 64, digits10 = 18, max_exponent = 16384, min_exponent = -16381;
  static constexpr Extended min() { return Extended::PowerOfTwo(-16382); }
  static constexpr Extended max() { return Extended::Largest(); }
  static Extended lowest() { return -Extended::Largest(); }
  static constexpr Extended epsilon() { return Extended::PowerOfTwo(-63); }
  static constexpr Extended infinity() { return Extended::Infinite(false); }
};

template <>
struct Eigen::NumTraits<stiction::Extended> : Eigen::GenericNumTraits<stiction::Extended> {};

#endif  // STICTION_SOLVER_PROBLEM_EXTENDED_H_
