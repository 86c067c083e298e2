// SPDX-License-Identifier: Apache-2.0
// Exact numbers: their grammar, and the nearest double.

#include "corpus/rational.h"

#include <catch2/catch.hpp>
#include <cfenv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace stiction {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kTiny = std::numeric_limits<double>::denorm_min();  // 2^-1074

Rational PowerOfTwo(long exponent) {
  const mpz_class power = mpz_class(1) << std::abs(exponent);
  return exponent >= 0 ? Rational(power) : Rational(1, power);
}

std::string RandomDigits(std::mt19937_64& random, int most) {
  std::string digits;
  for (int n = 1 + static_cast<int>(random() % most); n > 0; --n)
    digits += static_cast<char>('0' + random() % 10);
  return digits;
}

TEST_CASE("rational: a text of the grammar is read exactly and in lowest terms") {
  const std::vector<std::pair<std::string, std::string>> table = {
      {"0", "0"},
      {"-0", "0"},
      {"007", "7"},
      {"-12", "-12"},
      {"3/4", "3/4"},
      {"-6/8", "-3/4"},
      {"0/5", "0"},
      {"-0/5", "0"},
      {"6/3", "2"},
      {"010/004", "5/2"},
      {"0.1", "1/10"},
      {"-2.50", "-5/2"},
      {"00.50", "1/2"},
      {"2.5e-3", "1/400"},
      {"1e3", "1000"},
      {"1E+3", "1000"},
      {"-1.5E2", "-150"},
      {"12.5e1", "125"},
      {"0e0", "0"},
      {"0e10000", "0"},
      {"1e0000000003", "1000"},
      {"1e-00", "1"},
      {"-0.0", "0"},
      {"1.000", "1"},
      {"5e-1", "1/2"},
      {"18446744073709551617", "18446744073709551617"},
      {"-36893488147419103234/2", "-18446744073709551617"},
  };
  for (const auto& [text, expected] : table) {
    INFO(text);
    const auto x = ParseRational(text);
    REQUIRE(x.has_value());
    CHECK(ToString(*x) == expected);
  }
}

TEST_CASE("rational: a text outside the grammar is refused") {
  const std::string nul(1, '\0');
  const std::vector<std::string> table = {
      "",     "-",     "+1",    "--1",      " 1",    "1 ",    "1\n",   "1" + nul,  nul + "1",      ".5",
      "5.",   "1.e3",  "1e",    "1e+",      "1e-",   "1e1.5", "1e1e1", "1/",       "/2",           "1/-2",
      "1/+2", "1/2/3", "1.5/2", "1/2.5",    "1e2/3", "1/2e3", "0x10",  "1,5",      "1_000",        "inf",
      "nan",  "NaN",   "-inf",  "Infinity", "1f",    "1e10 ", "- 1",   "\xD9\xA1", "\xEF\xBC\x91",
  };
  for (const std::string& text : table) {
    INFO("'" << text << "'");
    CHECK_FALSE(ParseRational(text).has_value());
  }
}

TEST_CASE("rational: a zero denominator is refused") {
  CHECK_FALSE(ParseRational("1/0").has_value());
  CHECK_FALSE(ParseRational("0/0").has_value());
  CHECK_FALSE(ParseRational("-7/000").has_value());
}

TEST_CASE("rational: an exponent is read up to 10000 in magnitude and refused beyond") {
  const auto largest = ParseRational("1e10000");
  const auto smallest = ParseRational("-1e-10000");
  REQUIRE(largest.has_value());
  REQUIRE(smallest.has_value());
  CHECK(Rational(*largest * *smallest) == -1);
  CHECK(ToString(*largest).size() == 10001);
  CHECK(ParseRational("0.5e-10000").has_value());
  for (const std::string text : {"1e10001", "1e-10001", "0e10001", "1e99999999999999999999999"}) {
    INFO(text);
    CHECK_FALSE(ParseRational(text).has_value());
  }
}

TEST_CASE("rational: what ToString writes is read back to the same number") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 2000; ++i) {
    const std::string text =
        (random() % 2 ? "-" : "") + RandomDigits(random, 40) + "/" + RandomDigits(random, 40) + "1";
    const auto x = ParseRational(text);
    REQUIRE(x.has_value());
    REQUIRE(ParseRational(ToString(*x)) == x);
    REQUIRE(gcd(x->get_num(), x->get_den()) == 1);
  }
}

TEST_CASE("nearest double: a number halfway between two doubles goes to the even one") {
  const Rational two53 = PowerOfTwo(53);
  const std::vector<std::pair<Rational, double>> table = {
      {two53 + 1, 9007199254740992.0},
      {two53 + 3, 9007199254740996.0},
      {two53 + 1 + PowerOfTwo(-200), 9007199254740994.0},
      {two53 + 3 - PowerOfTwo(-200), 9007199254740994.0},
      {1 + PowerOfTwo(-53), 1.0},
      {1 + PowerOfTwo(-53) + PowerOfTwo(-900), std::nextafter(1.0, 2.0)},
      {1 + 3 * PowerOfTwo(-53), 1.0 + std::ldexp(1.0, -51)},
      {1 - PowerOfTwo(-54), 1.0},
      {2 - PowerOfTwo(-53), 2.0},
  };
  for (const auto& [x, expected] : table) {
    INFO(ToString(x));
    CHECK(ToDouble(x) == expected);
    CHECK(ToDouble(-x) == -expected);
  }
}

TEST_CASE("nearest double: no double beside it is nearer, of short numbers and long") {
  std::mt19937_64 random(2);
  for (int i = 0; i < 3000; ++i) {
    const auto digits = [&] { return RandomDigits(random, 1 + random() % 300) + "1"; };
    const Rational x = *ParseRational((random() % 2 ? "-" : "") + digits() + "/" + digits());
    const double nearest = ToDouble(x);
    if (!std::isfinite(nearest)) continue;
    const Rational off = abs(Rational(nearest) - x);
    for (const double end : {-kInfinity, kInfinity}) {
      const double beside = std::nextafter(nearest, end);
      if (std::isfinite(beside)) REQUIRE(off <= abs(Rational(beside) - x));
    }
  }
}

TEST_CASE("nearest double: subnormal numbers are rounded once, at their own last bit") {
  const Rational tiny = PowerOfTwo(-1074);
  const double normal = std::numeric_limits<double>::min();
  const std::vector<std::pair<Rational, double>> table = {
      {tiny, kTiny},
      {tiny / 2, 0.0},
      {tiny / 2 + PowerOfTwo(-3000), kTiny},
      {tiny / 2 - PowerOfTwo(-3000), 0.0},
      {3 * tiny / 2, 2 * kTiny},
      {5 * tiny / 2, 2 * kTiny},
      {5 * tiny / 2 + PowerOfTwo(-3000), 3 * kTiny},
      {PowerOfTwo(-1022) - tiny / 2, normal},
      {PowerOfTwo(-1022) - tiny, normal - kTiny},
      {PowerOfTwo(-1022) + tiny / 2, normal},
      {PowerOfTwo(-20000), 0.0},
      // Rounded to 53 bits first, this would be a tie and go to 2 tiny.
      {5 * tiny / 2 + PowerOfTwo(-1140), 3 * kTiny},
  };
  for (const auto& [x, expected] : table) {
    INFO(ToString(x));
    CHECK(ToDouble(x) == expected);
    CHECK(ToDouble(-x) == -expected);
  }
  CHECK(std::signbit(ToDouble(-PowerOfTwo(-20000))));
  CHECK_FALSE(std::signbit(ToDouble(Rational(0))));
}

TEST_CASE("nearest double: beyond the range of doubles it is infinite") {
  const Rational halfway = PowerOfTwo(1024) - PowerOfTwo(970);  // between the largest double and 2^1024
  CHECK(ToDouble(halfway - 1) == kLargest);
  CHECK(ToDouble(halfway - PowerOfTwo(-50)) == kLargest);
  CHECK(ToDouble(halfway) == kInfinity);
  CHECK(ToDouble(-halfway) == -kInfinity);
  CHECK(ToDouble(PowerOfTwo(1024)) == kInfinity);
  CHECK(ToDouble(-PowerOfTwo(40000)) == -kInfinity);
}

TEST_CASE("nearest double: the rounding mode of the processor does not matter") {
  const std::vector<std::pair<Rational, double>> table = {
      {Rational(1, 3), 0x1.5555555555555p-2},
      {Rational(2, 3), 0x1.5555555555555p-1},
      {PowerOfTwo(53) + 1, 9007199254740992.0},
      {PowerOfTwo(1024), kInfinity},
      {PowerOfTwo(1025) - 1, kInfinity},
      {3 * PowerOfTwo(-1075), 2 * kTiny},
      {PowerOfTwo(-1075), 0.0},
  };
  const int before = std::fegetround();
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    for (const auto& [x, expected] : table) {
      const Rational negative = -x;
      REQUIRE(std::fesetround(mode) == 0);
      const double positive_found = ToDouble(x);
      const double negative_found = ToDouble(negative);
      std::fesetround(before);
      INFO(ToString(x) << " in mode " << mode);
      CHECK(positive_found == expected);
      CHECK(negative_found == -expected);
    }
  }
}

TEST_CASE("nearest double: a double is its own nearest double") {
  std::mt19937_64 random(2);
  for (int i = 0; i < 5000; ++i) {
    const double x = std::ldexp(static_cast<double>(random() >> 11), static_cast<int>(random() % 2044) - 1074);
    if (!std::isfinite(x)) continue;
    REQUIRE(ToDouble(Rational(x)) == x);
  }
}

TEST_CASE("nearest double: a decimal gives the double that strtod reads") {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    const int exponent = static_cast<int>(random() % 700) - 360;
    const std::string text =
        RandomDigits(random, 25) + "." + RandomDigits(random, 25) + "e" + std::to_string(exponent);
    const auto x = ParseRational(text);
    REQUIRE(x.has_value());
    INFO(text);
    REQUIRE(ToDouble(*x) == std::strtod(text.c_str(), nullptr));
  }
}

TEST_CASE("nearest double: no neighbour is nearer to a fraction") {
  std::mt19937_64 random(4);
  for (int i = 0; i < 5000; ++i) {
    const Rational x = *ParseRational(RandomDigits(random, 60) + "/" + RandomDigits(random, 60) + "1");
    const double nearest = ToDouble(x);
    const Rational error = abs(x - Rational(nearest));
    REQUIRE(error <= Rational(abs(x - Rational(std::nextafter(nearest, kInfinity)))));
    REQUIRE(error <= Rational(abs(x - Rational(std::nextafter(nearest, -kInfinity)))));
  }
}

TEST_CASE("bits: the length of the longer of numerator and denominator") {
  CHECK(Bits(Rational(0)) == 1);
  CHECK(Bits(Rational(-1)) == 1);
  CHECK(Bits(Rational(255)) == 8);
  CHECK(Bits(Rational(-256)) == 9);
  CHECK(Bits(Rational(3, 1024)) == 11);
  CHECK(BitLength<Rational>::Of(PowerOfTwo(-100)) == 101);
}

}  // namespace
}  // namespace stiction
