// SPDX-License-Identifier: Apache-2.0
// Numbers as text, against a reading of their own: digits by GMP, doubles by strtod.

#include "corpus/rational.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "corpus/exact_number.h"
#include "corpus/json.h"
#include "solver/problem/check.h"
#include "tests/fuzz/targets.h"

namespace stiction::fuzz {
namespace {

constexpr int kMostExponent = 10000;

bool IsDigits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
}

mpz_class IntegerOf(std::string_view digits) { return mpz_class(std::string(digits), 10); }

Rational Ratio(const mpz_class& x, const mpz_class& y) { return Rational(x) / Rational(y); }

// What stands before the first of these characters, and behind it if there is one.
struct Halves {
  std::string_view before;
  std::optional<std::string_view> behind;
};
Halves SplitAt(std::string_view text, std::string_view any_of) {
  const std::size_t at = text.find_first_of(any_of);
  if (at == text.npos) return {text, std::nullopt};
  return {text.substr(0, at), text.substr(at + 1)};
}

std::optional<int> ExponentOf(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  if (!IsDigits(text) || IntegerOf(text) > kMostExponent) return std::nullopt;
  const int exponent = static_cast<int>(IntegerOf(text).get_si());
  return negative ? -exponent : exponent;
}

// 10^exponent, digit by digit.
mpz_class TenTo(std::size_t exponent) { return mpz_class("1" + std::string(exponent, '0'), 10); }

std::optional<Rational> ReadDecimal(std::string_view text) {
  const Halves number = SplitAt(text, "eE"), point = SplitAt(number.before, ".");
  if (!IsDigits(point.before) || (point.behind && !IsDigits(*point.behind))) return std::nullopt;
  const std::optional<int> exponent = number.behind ? ExponentOf(*number.behind) : 0;
  if (!exponent) return std::nullopt;
  Rational x(IntegerOf(point.before));
  if (point.behind) x += Ratio(IntegerOf(*point.behind), TenTo(point.behind->size()));
  const Rational scale(TenTo(static_cast<std::size_t>(std::abs(*exponent))));
  return *exponent < 0 ? Rational(x / scale) : Rational(x * scale);
}

std::optional<Rational> ReadUnsigned(std::string_view text) {
  const Halves ratio = SplitAt(text, "/");
  if (!ratio.behind) return ReadDecimal(text);
  if (!IsDigits(ratio.before) || !IsDigits(*ratio.behind) || IntegerOf(*ratio.behind) == 0) return std::nullopt;
  return Ratio(IntegerOf(ratio.before), IntegerOf(*ratio.behind));
}

std::optional<Rational> ReadIndependently(std::string_view text) {
  if (!text.starts_with('-')) return ReadUnsigned(text);
  const auto x = ReadUnsigned(text.substr(1));
  return x ? std::optional(Rational(-*x)) : std::nullopt;
}

// No double is nearer; infinite from half a unit beyond the largest on.
void RequireNearest(const Rational& x, double nearest) {
  constexpr double kLargest = std::numeric_limits<double>::max(),
                   kInfinity = std::numeric_limits<double>::infinity();
  if (!std::isfinite(nearest)) {
    const Rational half = (Rational(kLargest) - Rational(std::nextafter(kLargest, 0))) / 2;
    STICTION_CHECK(abs(x) >= Rational(kLargest) + half && (nearest > 0) == (x > 0),
                   "a number that is not infinite");
    return;
  }
  const Rational distance = abs(Rational(x - Rational(nearest)));
  for (const double direction : {-kInfinity, kInfinity}) {
    const double other = std::nextafter(nearest, direction);
    if (std::isfinite(other))
      STICTION_CHECK(distance <= abs(Rational(x - Rational(other))), "a double that is not the nearest");
  }
}

// JSON has fewer numbers: those that it has are taken at their doubles, integers only if they are doubles.
void RequireSameInJson(const std::string& text, const std::optional<Rational>& x) {
  const auto taken = Unrefused([&text] {
    const Json json = ParseJson(text, "number");
    const std::string source = "number";
    return json.is_number() ? ExactNumber(JsonPlace(json, source, "")) : Rational(0);
  });
  if (!taken || !x) return;
  const double nearest = std::strtod(text.c_str(), nullptr);
  STICTION_CHECK(*taken == Rational(nearest), "a JSON number at another double");
  const bool integer = text.find_first_of(".eE") == text.npos;
  STICTION_CHECK(!integer || *taken == *x, "an integer that JSON rounds");
}

}  // namespace

bool FuzzRational(std::string_view bytes) {
  const std::string text(bytes);
  const auto found = ParseRational(text), expected = ReadIndependently(text);
  STICTION_CHECK(found == expected, "a number that is read in two ways");
  RequireSameInJson(text, found);
  if (!found) return false;
  STICTION_CHECK(ParseRational(ToString(*found)) == found, "a number that is read back to another");
  const double nearest = ToDouble(*found);
  RequireNearest(*found, nearest);
  const bool ratio = text.find('/') != text.npos;
  STICTION_CHECK(ratio || std::strtod(text.c_str(), nullptr) == nearest,
                 "a double that strtod reads differently");
  STICTION_CHECK(IsExactDouble(*found) == (std::isfinite(nearest) && Rational(nearest) == *found),
                 "an exact double");
  return true;
}

}  // namespace stiction::fuzz
