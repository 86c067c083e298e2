// SPDX-License-Identifier: Apache-2.0
// Fine intervals: they enclose what they say, and so do their derivatives.

#include "certify/exact/fine_interval.h"

#include <catch2/catch.hpp>

#include "certify/exact/properties.h"
#include "search/generators/choices.h"
#include "tests/support.h"

namespace stiction {
namespace {

constexpr int kCoordinates = 3;

// A number over a box, at one point of it and at its centre.
struct OverBox {
  FineInterval fine;
  Rational at, centre;
};

bool Encloses(const FineInterval& x, const Rational& value) { return x.Low() <= value && value <= x.High(); }

// What the derivatives say of the way from the centre to the point.
bool EnclosesChange(const OverBox& x, const ExactVector& moves) {
  Rational low = 0, high = 0;
  for (int k = 0; k < static_cast<int>(x.fine.slopes().size()); ++k) {
    const Rational one = Rational(x.fine.slopes()[k].inf()) * moves[k];
    const Rational other = Rational(x.fine.slopes()[k].sup()) * moves[k];
    low += std::min(one, other);
    high += std::max(one, other);
  }
  return low <= x.at - x.centre && x.at - x.centre <= high;
}

bool TellsSign(const FineInterval& x) { return Unsure<FineInterval>::TellsSign(x) && !IsSurelyZero(x); }

OverBox Applied(const OverBox& x, const OverBox& y, int operation) {
  switch (operation) {
    case 0:
      return {x.fine + y.fine, x.at + y.at, x.centre + y.centre};
    case 1:
      return {x.fine - y.fine, x.at - y.at, x.centre - y.centre};
    case 2:
      return {x.fine * y.fine, x.at * y.at, x.centre * y.centre};
    default:
      return {x.fine / y.fine, x.at / y.at, x.centre / y.centre};
  }
}

TEST_CASE("fine interval: values and changes of random expressions are enclosed") {
  const FineBits bits(90);
  Choices random(5);
  int divided = 0;
  for (int k = 0; k < testing::Few(400); ++k) {
    std::vector<OverBox> numbers;
    ExactVector moves(kCoordinates);
    for (int i = 0; i < kCoordinates; ++i) {
      const Rational centre(random.Integer(-9, 9), 7), radius(1, random.Integer(3, 40));
      moves[i] = Rational(random.Integer(-4, 4), 4);
      numbers.push_back({FineInterval::Side(i, centre, radius), centre + radius * moves[i], centre});
    }
    for (int step = 0; step < 8; ++step) {
      const OverBox x = numbers[random.Integer(0, static_cast<int>(numbers.size()) - 1)];
      const OverBox y = numbers[random.Integer(0, static_cast<int>(numbers.size()) - 1)];
      int operation = static_cast<int>(random.Integer(0, 3));
      if (operation == 3 && !TellsSign(y.fine)) operation = 2;
      divided += operation == 3;
      numbers.push_back(Applied(x, y, operation));
      REQUIRE(Encloses(numbers.back().fine, numbers.back().at));
      REQUIRE(Encloses(numbers.back().fine, numbers.back().centre));
      REQUIRE(EnclosesChange(numbers.back(), moves));
    }
  }
  CHECK(divided > 20);
}

TEST_CASE("fine interval: a root is enclosed as narrowly as the bits allow, and so is its derivative") {
  const FineBits bits(100);
  const Rational centre(9, 4), radius(1, 100);
  const FineInterval root = sqrt(FineInterval::Side(0, centre, radius));
  CHECK(Encloses(root, Rational(3, 2)));
  CHECK(root.Low() * root.Low() <= centre - radius);
  CHECK(root.High() * root.High() >= centre + radius);
  CHECK(Rational(root.slopes()[0].inf()) <= radius / 3);
  CHECK(Rational(root.slopes()[0].sup()) >= radius / 3);
  const FineInterval at_once = sqrt(FineInterval::Variable(0, centre));
  CHECK(Rational(at_once.slopes()[0].inf()) <= Rational(1, 3));
  CHECK(Rational(at_once.slopes()[0].sup()) >= Rational(1, 3));
  CHECK(at_once.High() - at_once.Low() <= 1 / Rational(mpz_class(1) << 100));
  const FineInterval two = sqrt(FineInterval(2));
  CHECK(two.High() - two.Low() <= 1 / Rational(mpz_class(1) << 100));
  CHECK(IsSurelyZero(sqrt(FineInterval(0))));
}

TEST_CASE("fine interval: over a small box its ends are as far apart as its derivatives say") {
  const FineBits bits(200);
  const Rational radius = 1 / Rational(mpz_class(1) << 60);
  const FineInterval side = FineInterval::Side(0, 1, radius);
  FineInterval x = side;
  for (int k = 0; k < 30; ++k)  // x = (10 side - 1) / 9, where ends alone grow by a factor each time
    x = x * side - side * (x - FineInterval(1)) + (side - FineInterval(1)) / FineInterval(9);
  CHECK(x.High() - x.Low() < 3 * radius);
  CHECK((side - side).High() == 0);
}

TEST_CASE("fine interval: what the ends leave open throws") {
  const FineBits bits(70);
  const FineInterval wide = FineInterval::Around(0, 1), third = FineInterval::Around(Rational(1, 3));
  CHECK_THROWS_AS(Sign(wide), UnsureComparison);
  CHECK_THROWS_AS(wide < FineInterval(1), UnsureComparison);
  CHECK_THROWS_AS(third == FineInterval::Around(Rational(1, 3)), UnsureComparison);
  CHECK_THROWS_AS(FineInterval(1) / wide, UnsureComparison);
  CHECK_THROWS_AS(sqrt(wide), UnsureComparison);
  CHECK(wide < FineInterval(2));
  CHECK_FALSE(FineInterval(1) < FineInterval(1));
  CHECK(Sign(FineInterval(0)) == 0);
  CHECK_FALSE(IsSurelyZero(third - third));
}

TEST_CASE("fine interval: slopes below the doubles are not taken for zero, and beyond them nothing is told") {
  const FineBits bits(2304);
  const auto side = [](int exponent) {
    const Rational power(mpz_class(1) << std::abs(exponent));
    return FineInterval::Side(0, 1, exponent < 0 ? Rational(1 / power) : power);
  };
  const FineInterval least = side(-1500) - FineInterval(1);
  CHECK_FALSE(IsSurelyZero(least.slopes()[0]));
  CHECK(least.High() >= 1 / Rational(mpz_class(1) << 1500));
  CHECK_THROWS_AS(side(1500), UnsureComparison);
}

TEST_CASE("fine interval: more bits make a narrower number, and the bits before come back") {
  const int before = FineBits::Now();
  const auto width = [](int bits) {
    const FineBits now(bits);
    const FineInterval third = FineInterval::Around(Rational(1, 3));
    return Rational(third.High() - third.Low());
  };
  CHECK(width(200) < width(100));
  CHECK(FineBits::Now() == before);
}

}  // namespace
}  // namespace stiction
