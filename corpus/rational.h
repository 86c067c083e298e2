// SPDX-License-Identifier: Apache-2.0
// Rational: the exact number of stiction, and numbers as text.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "solver/problem/scalar.h"

#ifdef STICTION_BOOST_RATIONALS
#include "corpus/rational_boost.h"
#else
#include "corpus/rational_gmp.h"
#endif

namespace stiction {

// Reads `-?\d+/\d+` or `-?\d+(\.\d+)?([eE][+-]?\d+)?` exactly. Empty if the text does not match, if the
// denominator is zero, or if the exponent exceeds 10,000 in magnitude.
std::optional<Rational> ParseRational(std::string_view text);

// "-3/4", "7": the form that ParseRational reads back to the same number.
std::string ToString(const Rational& x);

// The double nearest to x (to even on ties); infinite beyond the range of doubles.
double ToDouble(const Rational& x);
bool IsExactDouble(const Rational& x);

// Bits of the longer of numerator and denominator.
std::int64_t Bits(const Rational& x);

// Within 2^-100 of the root, from below. Requires x >= 0.
template <>
struct SquareRoot<Rational> {
  static Rational Of(const Rational& x);
};

template <>
struct BitLength<Rational> {
  static std::int64_t Of(const Rational& x) { return Bits(x); }
};

}  // namespace stiction
