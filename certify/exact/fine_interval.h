// SPDX-License-Identifier: Apache-2.0
// FineInterval: a number between two ends, integers over 2^bits, rounded outwards; over a box, also between
// which ends it is at the centre, and its slopes, the derivatives by coordinates from -1 to 1 along the sides
// of the box. An enclosure (solver/problem/enclosure.h); a comparison that it leaves open throws, as those of
// intervals do.
//
// With slopes F' over the box, F(x) is in F(0) + F' x for every x in it (mean value theorem). After every
// operation the ends are drawn in to that: so a box of many rounds of an algorithm is not overestimated in
// proportion to its size. Slopes are intervals of doubles, since they say how wide, not where.
//
// Bits   those of the thread, from the making of a FineBits to its end: no number outlives it.

#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "certify/exact/interval.h"

namespace stiction {

class FineBits {
 public:
  explicit FineBits(int bits) : before_(now_) { now_ = bits; }
  ~FineBits() { now_ = before_; }
  FineBits(const FineBits&) = delete;
  FineBits& operator=(const FineBits&) = delete;
  static int Now() { return now_; }

 private:
  inline static thread_local int now_ = 256;
  int before_;
};

// The largest absolute value.
inline double SizeOf(const Interval& slope) { return std::max(-slope.inf(), slope.sup()); }

// Integers over 2^bits.
struct FineEnds {
  mpz_class low, high;

  bool AreZero() const { return low == 0 && high == 0; }
  // A double below, or above.
  Interval Rounded() const { return {Rounded(low, -1), Rounded(high, 1)}; }
  FineEnds operator-() const { return {-high, -low}; }
  friend FineEnds operator+(const FineEnds& x, const FineEnds& y) { return {x.low + y.low, x.high + y.high}; }
  friend FineEnds operator*(const FineEnds& x, const FineEnds& y);

 private:
  static double Rounded(const mpz_class& x, int side) {
    constexpr int kLeast = -1000, kMost = 1000;  // exponents of doubles end beyond
    if (x == 0) return 0;
    signed long exponent = 0;
    double part = mpz_get_d_2exp(&exponent, x.get_mpz_t());  // toward zero
    const bool outward = sgn(x) == side;
    exponent -= FineBits::Now();
    if (exponent > kMost) Unsure<Interval>::Refuse();
    if (exponent < kLeast) return outward ? std::ldexp(side, kLeast) : 0;
    const bool is_exact = mpz_sizeinbase(x.get_mpz_t(), 2) - mpz_scan1(x.get_mpz_t(), 0) <= 53;
    if (outward && !is_exact) part = std::nextafter(part, 2 * side);
    return std::ldexp(part, static_cast<int>(exponent));
  }
};

class FineInterval {
 public:
  using Slopes = std::vector<Interval>;  // by coordinate; those that are not listed are zero

  FineInterval() = default;
  FineInterval(int x)  // NOLINT(google-explicit-constructor): a scalar
      : ends_{mpz_class(x) << FineBits::Now(), mpz_class(x) << FineBits::Now()} {}
  explicit FineInterval(FineEnds ends) : ends_(std::move(ends)) {}

  // No further from x than the radius.
  static FineInterval Around(const Rational& x, const Rational& radius = 0) {
    return FineInterval({Floor(x - radius), -Floor(-x - radius)});
  }
  // Side k of a box, around x.
  static FineInterval Side(int k, const Rational& x, const Rational& radius) {
    return Moving(Around(x, radius).ends_, x, k, Around(radius).ends_);
  }
  // x alone, with the derivative 1 by coordinate k.
  static FineInterval Variable(int k, const Rational& x) {
    return Moving(Around(x).ends_, x, k, FineInterval(1).ends_);
  }

  const FineEnds& ends() const { return ends_; }
  const Slopes& slopes() const { return slopes_; }
  Rational Low() const { return Over(ends_.low); }
  Rational High() const { return Over(ends_.high); }
  Rational Middle() const { return (Low() + High()) / 2; }
  static Rational Over(const mpz_class& x) {
    Rational result(x, mpz_class(1) << FineBits::Now());
    result.canonicalize();
    return result;
  }
  // Zero everywhere in the box.
  bool IsZero() const {
    return ends_.AreZero() && std::ranges::all_of(slopes_, [](const Interval& s) { return IsSurelyZero(s); });
  }

  FineInterval operator-() const {
    FineInterval result = *this;
    result.ends_ = -ends_;
    result.centre_ = -centre_;
    for (Interval& slope : result.slopes_) slope = -slope;
    return result;
  }
  friend FineInterval operator+(const FineInterval& x, const FineInterval& y) {
    if (x.slopes_.empty() && y.slopes_.empty()) return FineInterval(x.ends_ + y.ends_);
    return DrawnIn(x.ends_ + y.ends_, x.AtCentre() + y.AtCentre(), Sum(x.slopes_, y.slopes_));
  }
  friend FineInterval operator-(const FineInterval& x, const FineInterval& y) { return x + -y; }
  friend FineInterval operator*(const FineInterval& x, const FineInterval& y) {
    if (x.IsZero() || y.IsZero()) return {};
    if (x.slopes_.empty() && y.slopes_.empty()) return FineInterval(x.ends_ * y.ends_);
    return DrawnIn(x.ends_ * y.ends_, x.AtCentre() * y.AtCentre(),
                   Sum(Times(x.slopes_, y.ends_), Times(y.slopes_, x.ends_)));
  }
  friend FineInterval operator/(const FineInterval& x, const FineInterval& y) {
    return x.IsZero() ? FineInterval() : x * y.Inverted();
  }
  FineInterval& operator+=(const FineInterval& y) { return *this = *this + y; }
  FineInterval& operator-=(const FineInterval& y) { return *this = *this - y; }
  FineInterval& operator*=(const FineInterval& y) { return *this = *this * y; }
  FineInterval& operator/=(const FineInterval& y) { return *this = *this / y; }

  friend FineInterval sqrt(const FineInterval& x) {
    if (x.IsZero()) return {};
    FineEnds root = Root(x.ends_);
    if (x.slopes_.empty()) return FineInterval(std::move(root));
    const FineEnds over = Inverse(root + root);
    return DrawnIn(std::move(root), Root(x.centre_), Times(x.slopes_, over));
  }

  friend bool operator<(const FineInterval& x, const FineInterval& y) {
    if (x.ends_.high < y.ends_.low) return true;
    if (x.ends_.low < y.ends_.high) Unsure<Interval>::Refuse();
    return false;
  }
  friend bool operator==(const FineInterval& x, const FineInterval& y) {
    const bool points = x.ends_.low == x.ends_.high && y.ends_.low == y.ends_.high;
    if (points && x.ends_.low == y.ends_.low) return true;
    if (!(x.ends_.high < y.ends_.low || y.ends_.high < x.ends_.low)) Unsure<Interval>::Refuse();
    return false;
  }
  friend bool operator>(const FineInterval& x, const FineInterval& y) { return y < x; }
  friend bool operator<=(const FineInterval& x, const FineInterval& y) { return !(y < x); }
  friend bool operator>=(const FineInterval& x, const FineInterval& y) { return !(x < y); }
  friend bool operator!=(const FineInterval& x, const FineInterval& y) { return !(x == y); }

 private:
  static mpz_class Floor(const Rational& x) {
    const mpz_class numerator = x.get_num() << FineBits::Now();
    mpz_class floor;
    mpz_fdiv_q(floor.get_mpz_t(), numerator.get_mpz_t(), x.get_den_mpz_t());
    return floor;
  }
  static FineInterval Moving(FineEnds ends, const Rational& centre, int k, const FineEnds& slope) {
    FineInterval moving(std::move(ends));
    moving.centre_ = Around(centre).ends_;
    moving.slopes_.assign(k + 1, Interval(0));
    moving.slopes_[k] = slope.Rounded();
    return moving;
  }
  static FineInterval DrawnIn(FineEnds ends, const FineEnds& centre, Slopes slopes) {
    FineInterval result(std::move(ends));
    Interval sum = 0;
    for (const Interval& slope : slopes) sum += Interval(SizeOf(slope));
    if (!std::isfinite(sum.sup())) Unsure<Interval>::Refuse();
    const mpz_class far = Above(sum.sup());
    result.ends_.low = std::max<mpz_class>(result.ends_.low, centre.low - far);
    result.ends_.high = std::min<mpz_class>(result.ends_.high, centre.high + far);
    result.centre_ = centre;
    result.slopes_ = std::move(slopes);
    return result;
  }
  const FineEnds& AtCentre() const { return slopes_.empty() ? ends_ : centre_; }
  // As an integer over 2^bits, or the next larger.
  static mpz_class Above(double x) {
    int exponent = 0;
    mpz_class above = std::ldexp(std::frexp(x, &exponent), 53);
    exponent += FineBits::Now() - 53;
    if (exponent >= 0) return above << exponent;
    mpz_cdiv_q_2exp(above.get_mpz_t(), above.get_mpz_t(), -exponent);
    return above;
  }
  static Slopes Times(Slopes slopes, const FineEnds& factor) {
    if (slopes.empty()) return slopes;
    const Interval rounded = factor.Rounded();
    for (Interval& slope : slopes) slope = IsSurelyZero(slope) ? slope : slope * rounded;
    return slopes;
  }
  static Slopes Sum(Slopes x, const Slopes& y) {
    if (x.size() < y.size()) x.resize(y.size(), Interval(0));
    for (std::size_t k = 0; k < y.size(); ++k) x[k] += y[k];
    return x;
  }
  static FineEnds Root(const FineEnds& x) {
    if (x.low <= 0) Unsure<Interval>::Refuse();
    const mpz_class low = x.low << FineBits::Now(), high = x.high << FineBits::Now();
    FineEnds root = {::sqrt(low), ::sqrt(high)};
    if (root.high * root.high < high) ++root.high;
    return root;
  }
  static FineEnds Inverse(const FineEnds& x) {
    if (x.low <= 0 && x.high >= 0) Unsure<Interval>::Refuse();
    const mpz_class one = mpz_class(1) << 2 * FineBits::Now();
    FineEnds inverse;
    mpz_fdiv_q(inverse.low.get_mpz_t(), one.get_mpz_t(), x.high.get_mpz_t());
    mpz_cdiv_q(inverse.high.get_mpz_t(), one.get_mpz_t(), x.low.get_mpz_t());
    return inverse;
  }
  FineInterval Inverted() const {
    FineEnds inverse = Inverse(ends_);
    if (slopes_.empty()) return FineInterval(std::move(inverse));
    const FineEnds square = -(inverse * inverse);
    return DrawnIn(std::move(inverse), Inverse(centre_), Times(slopes_, square));
  }

  FineEnds ends_, centre_;  // centre_: where there are slopes; otherwise it is in ends_
  Slopes slopes_;
};

inline FineEnds operator*(const FineEnds& x, const FineEnds& y) {
  FineEnds product;
  if (x.low >= 0) {
    product = {(y.low >= 0 ? x.low : x.high) * y.low, (y.high >= 0 ? x.high : x.low) * y.high};
  } else if (x.high <= 0) {
    product = {(y.high >= 0 ? x.low : x.high) * y.high, (y.low >= 0 ? x.high : x.low) * y.low};
  } else {
    product = {std::min<mpz_class>(x.low * y.high, x.high * y.low),
               std::max<mpz_class>(x.low * y.low, x.high * y.high)};
  }
  mpz_fdiv_q_2exp(product.low.get_mpz_t(), product.low.get_mpz_t(), FineBits::Now());
  mpz_cdiv_q_2exp(product.high.get_mpz_t(), product.high.get_mpz_t(), FineBits::Now());
  return product;
}

template <>
inline bool IsSurelyZero(const FineInterval& x) {
  return x.IsZero();
}

template <>
inline int Sign(const FineInterval& x) {
  if (x.ends().low > 0) return 1;
  if (x.ends().high < 0) return -1;
  if (!x.ends().AreZero()) Unsure<Interval>::Refuse();
  return 0;
}

template <>
inline constexpr bool kEncloses<FineInterval> = true;

template <>
struct Approximation<FineInterval> {
  static double Of(const FineInterval& x) {
    signed long exponent = 0;
    const mpz_class twice = x.ends().low + x.ends().high;
    const double mantissa = mpz_get_d_2exp(&exponent, twice.get_mpz_t());
    return std::ldexp(mantissa, static_cast<int>(exponent) - FineBits::Now() - 1);
  }
};

template <>
struct Unsure<FineInterval> {
  static bool TellsSign(const FineInterval& x) {
    return x.ends().low > 0 || x.ends().high < 0 || IsSurelyZero(x);
  }
  static bool MayBePositive(const FineInterval& x) { return x.ends().high > 0; }
  static FineInterval Earliest(const FineInterval&, const FineInterval&) { return {}; }
  [[noreturn]] static void Refuse() { Unsure<Interval>::Refuse(); }
};

}  // namespace stiction

namespace Eigen {

template <>
struct NumTraits<stiction::FineInterval> : GenericNumTraits<stiction::FineInterval> {
  enum { IsSigned = 1, ReadCost = 100, AddCost = 1000, MulCost = 2000 };
};

}  // namespace Eigen
