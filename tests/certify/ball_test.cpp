// SPDX-License-Identifier: Apache-2.0
// Balls enclose the numbers that rationals compute, whatever their size; zeros by structure stay zero.

#include "solver/problem/ball.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "certify/exact/long_float.h"
#include "certify/exact/wide_ball.h"
#include "search/generators/choices.h"

namespace stiction {
namespace {

Rational Exactly(double x) { return Rational(x); }
Rational Exactly(const dd_real& x) { return Rational(x.x[0]) + Rational(x.x[1]); }
Rational Exactly(const LongFloat& x) {
  Rational exactly;
  mpfr_get_q(exactly.get_mpq_t(), x.backend().data());
  return exactly;
}
bool IsFinite(double x) { return std::isfinite(x); }
bool IsFinite(const dd_real& x) { return std::isfinite(x.x[0]) && std::isfinite(x.x[1]); }
bool IsFinite(const LongFloat& x) { return mpfr_number_p(x.backend().data()) != 0; }

template <class Number>
bool Encloses(const Ball<Number>& ball, const Rational& x) {
  if (!IsFinite(ball.middle()) || !std::isfinite(ball.radius())) return !ball.TellsSign();
  const Rational away = abs(x - Exactly(ball.middle()));
  return away <= Rational(ball.radius());
}

Rational PowerOfTwo(int exponent) {
  Rational x = 1;
  if (exponent >= 0) {
    mpq_mul_2exp(x.get_mpq_t(), x.get_mpq_t(), exponent);
  } else {
    mpq_div_2exp(x.get_mpq_t(), x.get_mpq_t(), -exponent);
  }
  return x;
}

// Of the size 2^-reach to 2^reach, some of them doubles, some zero.
Rational Draw(Choices& choices, int reach) {
  Rational x(choices.Integer(-1000, 1000), choices.Integer(1, 3) == 1 ? choices.Integer(1, 999) : 1);
  x.canonicalize();
  return x * PowerOfTwo(static_cast<int>(choices.Integer(-reach, reach)));
}

template <class Number>
struct Known {
  Rational exact;
  Ball<Number> ball;
};

// x o y, empty where the ball does not tell that y is not zero, or what it is.
template <class Number>
std::optional<Known<Number>> Combined(int operation, const Known<Number>& x, const Known<Number>& y) {
  switch (operation) {
    case 0:
      return Known<Number>{x.exact + y.exact, x.ball + y.ball};
    case 1:
      return Known<Number>{x.exact - y.exact, x.ball - y.ball};
    case 2:
      return Known<Number>{x.exact * y.exact, x.ball * y.ball};
    default:
      if (!y.ball.TellsSign() || y.ball.IsZero()) {
        CHECK_THROWS_AS(x.ball / y.ball, UnsureSign);
        return std::nullopt;
      }
      return Known<Number>{x.exact / y.exact, x.ball / y.ball};
  }
}

// Formulas of a few operations over random numbers. Returns how many results told their sign.
template <class Number>
int CheckFormulas(int reach, int formulas) {
  int told = 0;
  for (int formula = 0; formula < formulas; ++formula) {
    Choices choices(formula * 7919 + reach);
    std::vector<Known<Number>> pool;
    for (int i = 0; i < 3; ++i) {
      const Rational x = Draw(choices, reach);
      pool.push_back({x, BallAround<Number>(x)});
    }
    for (int step = 0; step < 8; ++step) {
      const auto pick = [&]() -> const Known<Number>& {
        return pool[choices.Integer(0, static_cast<int>(pool.size()) - 1)];
      };
      const int operation = static_cast<int>(choices.Integer(0, 3));
      const Known<Number>&x = pick(), &y = pick();
      const std::optional<Known<Number>> result = Combined(operation, x, y);
      if (!result) continue;
      CAPTURE(formula, step, operation, reach, result->ball.radius());
      REQUIRE(Encloses(result->ball, result->exact));
      if (result->ball.TellsSign()) REQUIRE(result->ball.Sign() == sgn(result->exact));
      if (result->ball.IsZero()) REQUIRE(result->exact == 0);
      told += result->ball.TellsSign();
      pool.push_back(*result);
    }
  }
  return told;
}

TEMPLATE_TEST_CASE("balls: they enclose what rationals compute, from the least to the largest doubles", "",
                   double, dd_real, LongFloat) {
  CHECK(CheckFormulas<TestType>(0, 3000) > 15000);
  CHECK(CheckFormulas<TestType>(60, 3000) > 10000);
  CHECK(CheckFormulas<TestType>(500, 3000) > 3000);
  CheckFormulas<TestType>(1074, 3000);
}

TEMPLATE_TEST_CASE("balls: ends about a ball are doubles on either side", "", double, dd_real, LongFloat) {
  Choices choices(5);
  for (int i = 0; i < 3000; ++i) {
    const Rational x = Draw(choices, 100) / 7;
    const auto ball = BallAround<TestType>(x);
    CHECK(Rational(LowEnd(ball)) <= x);
    CHECK(x <= Rational(HighEnd(ball)));
    CHECK(HighEnd(ball) - LowEnd(ball) <= 1e-14 * std::abs(HighEnd(ball)));
  }
  CHECK(LowEnd(Ball<TestType>(3)) == 3);
  CHECK(HighEnd(Ball<TestType>(3)) == 3);
}

TEMPLATE_TEST_CASE("balls: zero by structure stays zero, and nothing else becomes it", "", double, dd_real,
                   LongFloat) {
  using Number = Ball<TestType>;
  const int least = std::is_same_v<TestType, LongFloat> ? -900 : -1074;
  const Number third = BallAround<TestType>(Rational(1, 3)), tiny = BallAround<TestType>(PowerOfTwo(least));
  for (const Number& x : {third, tiny, -third, Number(7)}) {
    CHECK((Number(0) * x).IsZero());
    CHECK((x * Number(0)).IsZero());
    CHECK((Number(0) / x).IsZero());
  }
  CHECK((Number(0) + Number(0)).IsZero());
  CHECK((Number(0) - Number(0)).IsZero());
  CHECK((-Number(0)).IsZero());
  CHECK_FALSE((tiny * tiny).IsZero());  // below all doubles
  CHECK_FALSE((tiny * tiny).TellsSign());
  CHECK_FALSE((third - third).IsZero());  // equal, but not by structure
  CHECK_THROWS_AS(third < third, UnsureSign);
}

TEST_CASE("balls: double-doubles tell what doubles do not") {
  const Rational x = Rational(1, 3) + Rational("1/100000000000000000000");
  CHECK_FALSE((BallAround<double>(x) - BallAround<double>(Rational(1, 3))).TellsSign());
  CHECK((BallAround<dd_real>(x) - BallAround<dd_real>(Rational(1, 3))).Sign() == 1);
}

TEST_CASE("balls: long floats tell what double-doubles do not") {
  const Rational third(1, 3), x = third + PowerOfTwo(-200);
  CHECK_FALSE((BallAround<dd_real>(x) - BallAround<dd_real>(third)).TellsSign());
  CHECK((BallAround<LongFloat>(x) - BallAround<LongFloat>(third)).Sign() == 1);
  CHECK((BallAround<LongFloat>(third) - BallAround<LongFloat>(x)).Sign() == -1);
  CHECK_FALSE((BallAround<LongFloat>(third + PowerOfTwo(-600)) - BallAround<LongFloat>(third)).TellsSign());
  const LongBall tiny = BallAround<LongFloat>(PowerOfTwo(-1074));  // below its reach, and not zero
  CHECK_FALSE(tiny.IsZero());
  CHECK_FALSE(tiny.TellsSign());
}

TEMPLATE_TEST_CASE("balls: what is beyond the doubles decides nothing", "", double, dd_real, LongFloat) {
  using Number = Ball<TestType>;
  const Number huge = BallAround<TestType>(PowerOfTwo(1020)), beyond = BallAround<TestType>(PowerOfTwo(1030));
  CHECK_FALSE(beyond.TellsSign());
  CHECK_FALSE((huge * huge).TellsSign());
  CHECK_FALSE((huge * huge - huge * huge).TellsSign());
  CHECK_THROWS_AS(Number(1) / beyond, UnsureSign);
}

TEST_CASE("balls: a gap that may close is not closed before Earliest") {
  Choices choices(3);
  int later = 0;
  for (int i = 0; i < 2000; ++i) {
    const Rational gap = abs(Draw(choices, 20)), rate = abs(Draw(choices, 20));
    const double slack = ToDouble(rate) * static_cast<double>(choices.Integer(1, 5));
    const NarrowBall unsure(ToDouble(rate), slack + 1e-300);
    if (rate == 0 || gap == 0 || unsure.TellsSign()) continue;
    const Rational earliest = ToDouble(Unsure<NarrowBall>::Earliest(BallAround<double>(gap), unsure).middle());
    CHECK(earliest <= gap / (rate + Rational(slack)));
    later += earliest > 0;
  }
  CHECK(later > 1000);
}

}  // namespace
}  // namespace stiction
