// SPDX-License-Identifier: Apache-2.0
// Scalars: what the algorithms ask of a number type.
//
// One algorithm runs over float, double, quad and exact rationals. A Scalar has + - * /,
// comparisons, and construction from int. Branches look at signs only, through Sign(x, tol). Over
// exact scalars the tolerance is ignored: there it is zero by construction, not by convention.

#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

namespace stiction {

// True for the language's floating-point numbers, and for what stands in for one of them.
template <class Scalar>
inline constexpr bool kIsFloatingPoint = std::is_floating_point_v<Scalar>;

// True for number types that round. Specialised beside those that are not the language's own.
template <class Scalar>
inline constexpr bool kIsRounded = std::is_floating_point_v<Scalar>;

// True for number types without rounding.
template <class Scalar>
inline constexpr bool kIsExact = !kIsRounded<Scalar>;

// -1, 0 or 1. Not-a-number has sign 0: callers of inexact runs test for it where it can arise.
template <class Scalar>
int Sign(const Scalar& x) {
  return (x > 0) - (x < 0);
}

// The sign of x, where abs(x) <= tol counts as zero over inexact scalars.
template <class Scalar>
int Sign(const Scalar& x, const Scalar& tol) {
  if constexpr (kIsExact<Scalar>) {
    return Sign(x);
  } else {
    return (x > tol) - (x < -tol);
  }
}

// Whether x is zero and known to be: what may be skipped. Specialised beside a scalar that cannot tell some
// signs.
template <class Scalar>
bool IsSurelyZero(const Scalar& x) {
  return Sign(x) == 0;
}

template <class Scalar>
Scalar Abs(const Scalar& x) {
  if constexpr (!kIsExact<Scalar>) {
    using std::abs;
    return abs(x);  // without a branch
  } else {
    if (Sign(x) < 0) return Scalar(-x);
    return x;
  }
}

// The square root; over rationals, where it is specialised, rounded down.
template <class Scalar>
struct SquareRoot {
  static Scalar Of(const Scalar& x) {
    using std::sqrt;
    return sqrt(x);
  }
};

// sqrt(x^2 + y^2), as exact as the root.
template <class Scalar>
Scalar Length(const Scalar& x, const Scalar& y) {
  if (y == 0) return Abs(x);
  if (x == 0) return Abs(y);
  if constexpr (kIsExact<Scalar>) {
    return SquareRoot<Scalar>::Of(Scalar(x * x + y * y));
  } else {
    using std::hypot;
    return hypot(x, y);
  }
}

// Longest numerator or denominator of an exact scalar, in bits; specialised beside the scalar.
template <class Scalar>
struct BitLength {
  static std::int64_t Of(const Scalar&) { return 0; }
};

// The integers beneath an exact scalar, for elimination without fractions. Specialised beside the scalar;
// without that its own divisions are used.
template <class Scalar>
struct Fractions {
  using Integer = Scalar;
  // The numerator of x over a multiple of its denominator.
  static const Scalar& Numerator(const Scalar& x, const Scalar&) { return x; }
  // Makes `multiple` a multiple of the denominator of x.
  static void Include(Scalar&, const Scalar&) {}
  static Scalar Quotient(const Scalar& x, const Scalar& y) { return x / y; }
};

template <class Scalar>
inline constexpr bool kFractionFree = !std::is_same_v<typename Fractions<Scalar>::Integer, Scalar>;

// A common denominator of the entries of a row or column, 1 where there are no integers.
template <class Scalar, class Values>
typename Fractions<Scalar>::Integer CommonDenominator(const Values& values) {
  typename Fractions<Scalar>::Integer common(1);
  for (int i = 0; i < values.size(); ++i) Fractions<Scalar>::Include(common, values[i]);
  return common;
}

}  // namespace stiction
