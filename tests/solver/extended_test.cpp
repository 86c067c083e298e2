// SPDX-License-Identifier: Apache-2.0
// Extended against the long double of x86, to the bit, signs of zeros too. Elsewhere nothing is compared.
#include "solver/problem/extended.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

namespace stiction {
namespace {

constexpr bool kIsX86 = std::numeric_limits<long double>::digits == 64;

struct Pair {
  long double wide = 0;
  Extended by_integers;
};

// The same double, and what is left of it.
bool AreSame(long double x, const Extended& y) {
  if (std::isnan(x)) return !(y == y);
  const double near_x = static_cast<double>(x), near_y = static_cast<double>(y);
  if (std::memcmp(&near_x, &near_y, sizeof(double)) != 0) return false;
  if (std::isinf(near_x)) return std::isinf(x) == !isfinite(y);
  return static_cast<double>(x - near_x) == static_cast<double>(y - Extended(near_y));
}

class Numbers {
 public:
  explicit Numbers(int span) : span_(span) {}

  // Of up to 64 digits, often small integers, zeros and near relatives of each other.
  Pair Next() {
    const double one = Double(), other = Double();
    Pair pair{one, Extended(one)};
    const auto how = random_() % 4;
    if (how == 1) pair = {pair.wide + other, pair.by_integers + Extended(other)};
    if (how == 2) pair = {pair.wide * other, pair.by_integers * Extended(other)};
    if (how == 3 && other != 0) pair = {pair.wide / other, pair.by_integers / Extended(other)};
    return pair;
  }

 private:
  double Double() {
    const int exponent = static_cast<int>(random_() % (2 * span_ + 1)) - span_;
    const auto bits = static_cast<std::int64_t>(random_());
    const bool is_short = random_() % 4 == 0;
    return std::ldexp(is_short ? static_cast<double>(bits % 9) : static_cast<double>(bits), exponent);
  }

  std::uint64_t span_;
  std::mt19937_64 random_{1};
};

TEST_CASE("extended: arithmetic by integers is that of the processor, to the bit") {
  if (!kIsX86) return;
  const int span = GENERATE(1, 30, 300);
  Numbers numbers(span);
  bool sums = true, products = true, quotients = true, roots = true, lengths = true, orders = true;
  for (int i = 0; i < 200000; ++i) {
    const Pair x = numbers.Next(), y = numbers.Next();
    sums &= AreSame(x.wide + y.wide, x.by_integers + y.by_integers);
    sums &= AreSame(x.wide - y.wide, x.by_integers - y.by_integers);
    products &= AreSame(x.wide * y.wide, x.by_integers * y.by_integers);
    quotients &= AreSame(x.wide / y.wide, x.by_integers / y.by_integers);
    roots &= AreSame(std::sqrt(x.wide), sqrt(x.by_integers));
    lengths &= AreSame(std::hypot(x.wide, y.wide), hypot(x.by_integers, y.by_integers));
    orders &= (x.wide < y.wide) == (x.by_integers < y.by_integers) &&
              (x.wide <= y.wide) == (x.by_integers <= y.by_integers) &&
              (x.wide == y.wide) == (x.by_integers == y.by_integers);
  }
  CHECK(sums);
  CHECK(products);
  CHECK(quotients);
  CHECK(roots);
  CHECK(lengths);
  CHECK(orders);
}

TEST_CASE("extended: the ends of the range, and what lies beyond them") {
  if (!kIsX86) return;
  Numbers numbers(300);
  for (int i = 0; i < 20000; ++i) {
    const Pair x = numbers.Next();
    if (x.wide == 0) continue;
    CHECK(std::ilogb(x.wide) == ilogb(x.by_integers));
    for (const int exponent : {-16440, -16400, -16000, 16000, 16384}) {
      // There and back: digits that are lost below the normal numbers stay lost.
      const long double there = std::ldexp(x.wide, exponent);
      const Extended same = ldexp(x.by_integers, exponent);
      REQUIRE(AreSame(std::ldexp(there, -exponent), ldexp(same, -exponent)));
    }
  }
  using Limits = std::numeric_limits<Extended>;
  using Wide = std::numeric_limits<long double>;
  CHECK(AreSame(Wide::epsilon(), Limits::epsilon()));
  CHECK(AreSame(std::ldexp(Wide::min(), 16000), ldexp(Limits::min(), 16000)));
  CHECK(AreSame(std::ldexp(Wide::max(), -16000), ldexp(Limits::max(), -16000)));
  const Extended infinity = Limits::infinity(), none = infinity - infinity;
  CHECK_FALSE(none == none);
  CHECK_FALSE(isfinite(Limits::max() * 2));
  CHECK(infinity > Limits::max());
  CHECK(static_cast<double>(Extended(1) / infinity) == 0);
  for (const double x : {5e-324, -1e-310, 1e308, 0.0, -0.0}) CHECK(AreSame(x, Extended(x)));
}

}  // namespace
}  // namespace stiction
