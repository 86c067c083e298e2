// SPDX-License-Identifier: Apache-2.0
// Ball: a number known as a middle and a radius around it, an enclosure (enclosure.h) at nearly the speed of
// its middle. The methods run over it as they do over exact scalars; a comparison that the radius leaves open
// throws UnsureSign.
//
// Rounding is to nearest throughout, so that no mode of the processor is switched. For every operation x o y
//
//   radius >= what the radii of x and y can move the result  +  the rounding of the middle (Rounding<Number>)
//
// and the doubles in which radii are computed are rounded up by kUpward, which exceeds the rounding of every
// formula below. Zero with radius zero is the number zero, and stays so under all operations: what is zero by
// structure is known to be. Overflow ends in a radius that decides nothing.
// Exactness: sums of doubles are exact where they are subnormal, products lose at most half of the least
// double; `kLeast` makes up for that.
//
// Source: Rump, Fast and parallel interval arithmetic, BIT 39, 1999; Joldes, Muller and Popescu, Tight and
// rigorous error bounds for basic building blocks of double-word arithmetic, ACM TOMS 44, 2017.

#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <type_traits>

#include "solver/problem/enclosure.h"
#include "solver/problem/scalar.h"

namespace stiction {

// How far the operations of a number type round. Specialised beside it: double here.
//   Near(x)              a double near x
//   Size(x)              |x| as a double, within a factor of 1 +- 2^-50
//   OfSum(x, y, sum)     |x + y - sum| <= this, for sums and differences
//   OfProduct(product)   |x y - product| <= this, for products of numbers that are not zero
//   OfQuotient(x, quotient)   the same for x / y
template <class Number>
struct Rounding;

template <>
struct Rounding<double> {
  static constexpr double kUnit = 0x1p-52;  // twice the rounding, for its own rounding
  static constexpr double kLeast = 4 * std::numeric_limits<double>::denorm_min();

  static double Near(double x) { return x; }
  static double Size(double x) { return std::abs(x); }
  static double OfSum(double, double, double sum) { return kUnit * std::abs(sum); }
  static double OfProduct(double product) { return kUnit * std::abs(product) + kLeast; }
  static double OfQuotient(double, double quotient) { return OfProduct(quotient); }
};

template <class Number>
class Ball {
 public:
  Ball() : middle_(0), radius_(0) {}
  Ball(int x) : middle_(x), radius_(0) {}  // NOLINT(google-explicit-constructor): a scalar
  explicit Ball(double x) : middle_(x), radius_(0) {}
  Ball(const Number& middle, double radius) : middle_(middle), radius_(radius) {}

  const Number& middle() const { return middle_; }
  double radius() const { return radius_; }
  double Size() const { return Round::Size(middle_); }
  bool IsZero() const { return middle_ == Number(0) && radius_ == 0; }

  // The sign of x, if the ball tells it.
  bool TellsSign() const { return Size() * kDownward > radius_ || IsZero(); }
  int Sign() const {
    if (Size() * kDownward > radius_) return middle_ > Number(0) ? 1 : -1;
    if (!IsZero()) throw UnsureSign();
    return 0;
  }

  Ball operator-() const { return {Number(-middle_), radius_}; }

  friend Ball operator+(const Ball& x, const Ball& y) {
    const Number sum = x.middle_ + y.middle_;
    return {sum, kUpward * (x.radius_ + y.radius_ + Round::OfSum(x.middle_, y.middle_, sum))};
  }
  friend Ball operator-(const Ball& x, const Ball& y) { return x + -y; }

  friend Ball operator*(const Ball& x, const Ball& y) {
    const Number product = x.middle_ * y.middle_;
    const double rounding = x.IsZero() || y.IsZero() ? 0 : Round::OfProduct(product);
    const double moved = x.Size() * y.radius_ + x.radius_ * (y.Size() + y.radius_);
    return {product, kUpward * (moved + rounding)};
  }

  // With q the quotient of the middles: |x / y - q| <= (x.radius + |q| y.radius) / (|y| - y.radius)
  friend Ball operator/(const Ball& x, const Ball& y) {
    const double least = y.Size() * kDownward - y.radius_;
    if (!(least > 0)) throw UnsureSign();
    if (x.IsZero()) return {};
    const Number quotient = x.middle_ / y.middle_;
    const double rounding = Round::OfQuotient(x.middle_, quotient);
    const double reached =
        x.radius_ + (Round::Size(quotient) + rounding) * y.radius_ + Rounding<double>::kLeast;
    const bool points = x.radius_ == 0 && y.radius_ == 0;
    const double moved = points ? 0 : reached / (least * kDownward);
    return {quotient, kUpward * (moved + rounding)};
  }

  Ball& operator+=(const Ball& y) { return *this = *this + y; }
  Ball& operator-=(const Ball& y) { return *this = *this - y; }
  Ball& operator*=(const Ball& y) { return *this = *this * y; }
  Ball& operator/=(const Ball& y) { return *this = *this / y; }

  friend bool operator<(const Ball& x, const Ball& y) { return Order(x, y) < 0; }
  friend bool operator>(const Ball& x, const Ball& y) { return Order(x, y) > 0; }
  friend bool operator<=(const Ball& x, const Ball& y) { return Order(x, y) <= 0; }
  friend bool operator>=(const Ball& x, const Ball& y) { return Order(x, y) >= 0; }
  friend bool operator==(const Ball& x, const Ball& y) { return Order(x, y) == 0; }
  friend bool operator!=(const Ball& x, const Ball& y) { return Order(x, y) != 0; }

 private:
  using Round = Rounding<Number>;

  static constexpr double kUpward = 1 + 0x1p-46, kDownward = 1 - 0x1p-46;

  static int Order(const Ball& x, const Ball& y) { return (x - y).Sign(); }

  Number middle_;
  double radius_;
};

template <class Number>
inline constexpr bool kEncloses<Ball<Number>> = true;

template <class Number>
struct Approximation<Ball<Number>> {
  static double Of(const Ball<Number>& x) { return Rounding<Number>::Near(x.middle()); }
};

template <class Number>
struct Unsure<Ball<Number>> {
  using Scalar = Ball<Number>;

  static bool TellsSign(const Scalar& x) { return x.TellsSign(); }
  static bool MayBePositive(const Scalar& x) { return !x.TellsSign() || x.Sign() > 0; }
  static Scalar Earliest(const Scalar& gap, const Scalar& rate) {
    if (!gap.TellsSign() || gap.Sign() <= 0) return {};
    return Scalar(Number((gap.Size() - gap.radius()) / (rate.Size() + rate.radius()) * (1 - 0x1p-40)), 0);
  }
  [[noreturn]] static void Refuse() { throw UnsureSign(); }
};

template <class Number>
int Sign(const Ball<Number>& x) {
  return x.Sign();
}

template <class Number>
bool IsSurelyZero(const Ball<Number>& x) {
  return x.IsZero();
}

template <class Number>
Ball<Number> Abs(const Ball<Number>& x) {
  return x.Sign() < 0 ? -x : x;
}

}  // namespace stiction

namespace Eigen {

template <class Number>
struct NumTraits<stiction::Ball<Number>> : GenericNumTraits<stiction::Ball<Number>> {
  enum {
    IsSigned = 1,
    RequireInitialization = !std::is_trivially_copyable_v<Number>,
    ReadCost = 2,
    AddCost = 4,
    MulCost = 8
  };
};

}  // namespace Eigen
