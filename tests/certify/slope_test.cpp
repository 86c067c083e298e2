// SPDX-License-Identifier: Apache-2.0
// Slopes: they enclose what they say, and know what the same parameters do to two numbers.

#include "certify/exact/slope.h"

#include <catch2/catch.hpp>

#include "search/generators/choices.h"
#include "tests/support.h"

namespace stiction {
namespace {

constexpr int kParameters = 4;

// A number as a slope, and at one point of the box and at its centre.
struct Told {
  Slope slope;
  Rational at, centre;
};

bool IsIn(const Rational& x, const Interval& interval) {
  return x >= Rational(interval.inf()) && x <= Rational(interval.sup());
}

// The slopes say of the difference to the centre what they should.
bool Holds(const Told& x) { return IsIn(x.at, x.slope.range()) && IsIn(x.centre, x.slope.centre()); }

Told Parameter(int k, const Rational& e) { return {Slope::Along(k, Interval(1), Interval(-1, 1)), e, 0}; }

Told Combined(const Told& x, const Told& y, int operation) {
  switch (operation) {
    case 0:
      return {x.slope + y.slope, x.at + y.at, x.centre + y.centre};
    case 1:
      return {x.slope - y.slope, x.at - y.at, x.centre - y.centre};
    case 2:
      return {x.slope * y.slope, x.at * y.at, x.centre * y.centre};
    default:
      return {x.slope / y.slope, x.at / y.at, x.centre / y.centre};
  }
}

TEST_CASE("slope: all values of random expressions are enclosed") {
  Choices random(11);
  int divided = 0;
  for (int k = 0; k < testing::Few(400); ++k) {
    std::vector<Told> numbers;
    for (int i = 0; i < kParameters; ++i) {
      const Rational scale(random.Integer(1, 3), 8), shift = random.Integer(-3, 3);
      const Told e = Parameter(i, Rational(random.Integer(-4, 4), 4));
      numbers.push_back({Slope(Around(shift)) + Slope(Around(scale)) * e.slope, shift + scale * e.at, shift});
    }
    for (int step = 0; step < 8; ++step) {
      const Told& x = numbers[random.Integer(0, static_cast<int>(numbers.size()) - 1)];
      const Told& y = numbers[random.Integer(0, static_cast<int>(numbers.size()) - 1)];
      int operation = static_cast<int>(random.Integer(0, 3));
      if (operation == 3 && !(y.slope.range().inf() > 0 || y.slope.range().sup() < 0)) operation = 2;
      divided += operation == 3;
      const Told result = Combined(x, y, operation);
      REQUIRE(Holds(result));
      REQUIRE(Holds(Told{-result.slope, -result.at, -result.centre}));
      numbers.push_back(result);
    }
  }
  CHECK(divided > 50);
}

TEST_CASE("slope: what the same parameter does to two numbers cancels") {
  const Slope e = Slope::Along(0, Interval(1), Interval(-1, 1));
  const Slope x = Slope(9) + e, y = Slope(8) + e;
  CHECK(x > y);  // their ranges overlap
  CHECK((x - y).range().inf() > 0.999);
  // x / (1 + x) rises with x.
  CHECK((x / (Slope(1) + x) - y / (Slope(1) + y)).range().inf() > 0);
  CHECK(IsSurelyZero(Slope(0) * x));
}

TEST_CASE("slope: what is not told throws") {
  const Slope e = Slope::Along(0, Interval(1), Interval(-1, 1)),
              other = Slope::Along(1, Interval(1), Interval(-1, 1));
  CHECK_THROWS(e > other);
  CHECK_THROWS(Slope(1) / e);
  CHECK_THROWS(e == Slope(0));
  CHECK(Slope(1) == Slope(1));
  CHECK_FALSE(Unsure<Slope>::TellsSign(e));
  CHECK(Unsure<Slope>::MayBePositive(e));
  CHECK_FALSE(Unsure<Slope>::MayBePositive(e - Slope(2)));
}

}  // namespace
}  // namespace stiction
