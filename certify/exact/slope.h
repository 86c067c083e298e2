// SPDX-License-Identifier: Apache-2.0
// Slope: a number that depends on parameters e_1, e_2, ..., each anywhere in [-1, 1], enclosed together with
// how it depends on them. An enclosure (solver/problem/enclosure.h); a comparison that it leaves open throws,
// as those of intervals do.
//
// Of x it has three things, over all e:
//
//   centre     encloses x(0)
//   slopes     x(e) - x(0) = sum s_k(e) e_k, each s_k(e) in slopes[k]; those that are not listed are zero
//   range      encloses x(e); never wider than centre + sum slopes[k] [-1, 1]
//
// Where the same parameters act on two numbers, their difference knows it: what intervals overestimate in
// proportion to the size of a box, this does in proportion to its square. Rules, from (x y)(e) - (x y)(0) =
// x(e) (y(e) - y(0)) + y(0) (x(e) - x(0)) and the like:
//
//   x y    slopes  range_x slopes_y + centre_y slopes_x
//   x / y  slopes  (slopes_x - (centre_x / centre_y) slopes_y) / range_y
//
// Source: R. Krawczyk, A. Neumaier, Interval slopes for rational functions and associated centered forms, SIAM
// J. Numer. Anal. 22, 1985 (cited from memory; the rules are derived above).

#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "certify/exact/interval.h"

namespace stiction {

class Slope {
 public:
  using Slopes = std::vector<Interval>;

  Slope() : Slope(0) {}
  Slope(int x) : centre_(x), range_(x) {}  // NOLINT(google-explicit-constructor): a scalar
  // A number that no parameter moves.
  explicit Slope(const Interval& x) : centre_(x), range_(x) {}
  Slope(const Interval& centre, const Interval& range, Slopes slopes)
      : centre_(centre), range_(range), slopes_(std::move(slopes)) {
    Interval reach = centre_;
    for (const Interval& slope : slopes_) reach += slope * Interval(-1, 1);
    const double low = std::max(range_.inf(), reach.inf()), high = std::min(range_.sup(), reach.sup());
    if (!std::isfinite(low) || !std::isfinite(high)) Unsure<Interval>::Refuse();
    range_ = Interval(low, high);
  }

  // x(e) = e_k s(e), with s(e) in `factor` and x(e) in `range`.
  static Slope Along(int k, const Interval& factor, const Interval& range) {
    Slopes slopes(k + 1, Interval(0));
    slopes[k] = factor;
    return {Interval(0), range, std::move(slopes)};
  }

  const Interval& centre() const { return centre_; }
  const Interval& range() const { return range_; }
  bool IsZero() const { return IsSurelyZero(range_); }

  Slope operator-() const {
    return {-centre_, -range_, Combined({}, *this, [](const auto&, const auto& s) { return Interval(-s); })};
  }
  friend Slope operator+(const Slope& x, const Slope& y) {
    if (x.IsZero()) return y;
    if (y.IsZero()) return x;
    return {x.centre_ + y.centre_, x.range_ + y.range_,
            Combined(x, y, [](const Interval& s, const Interval& t) { return Interval(s + t); })};
  }
  friend Slope operator-(const Slope& x, const Slope& y) {
    if (y.IsZero()) return x;
    return {x.centre_ - y.centre_, x.range_ - y.range_,
            Combined(x, y, [](const Interval& s, const Interval& t) { return Interval(s - t); })};
  }
  friend Slope operator*(const Slope& x, const Slope& y) {
    if (x.IsZero() || y.IsZero()) return {};
    return {x.centre_ * y.centre_, x.range_ * y.range_,
            Combined(x, y, [&](const Interval& s, const Interval& t) {
              return Interval(x.range_ * t + y.centre_ * s);
            })};
  }
  friend Slope operator/(const Slope& x, const Slope& y) {
    if (!(y.range_.inf() > 0 || y.range_.sup() < 0)) Unsure<Interval>::Refuse();
    if (x.IsZero()) return {};
    const Interval quotient = x.centre_ / y.centre_;
    return {quotient, x.range_ / y.range_, Combined(x, y, [&](const Interval& s, const Interval& t) {
              return Interval((s - quotient * t) / y.range_);
            })};
  }
  Slope& operator+=(const Slope& y) { return *this = *this + y; }
  Slope& operator-=(const Slope& y) { return *this = *this - y; }
  Slope& operator*=(const Slope& y) { return *this = *this * y; }
  Slope& operator/=(const Slope& y) { return *this = *this / y; }

  friend bool operator<(const Slope& x, const Slope& y) { return (x - y).range_ < 0; }
  friend bool operator>(const Slope& x, const Slope& y) { return (x - y).range_ > 0; }
  friend bool operator<=(const Slope& x, const Slope& y) { return (x - y).range_ <= 0; }
  friend bool operator>=(const Slope& x, const Slope& y) { return (x - y).range_ >= 0; }
  friend bool operator==(const Slope& x, const Slope& y) { return (x - y).range_ == 0; }
  friend bool operator!=(const Slope& x, const Slope& y) { return (x - y).range_ != 0; }

 private:
  template <class Rule>
  static Slopes Combined(const Slope& x, const Slope& y, const Rule& rule) {
    static const Interval kZero(0);
    Slopes slopes(std::max(x.slopes_.size(), y.slopes_.size()));
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      slopes[k] =
          rule(k < x.slopes_.size() ? x.slopes_[k] : kZero, k < y.slopes_.size() ? y.slopes_[k] : kZero);
    }
    return slopes;
  }

  Interval centre_, range_;
  Slopes slopes_;
};

template <>
inline bool IsSurelyZero(const Slope& x) {
  return x.IsZero();
}

template <>
inline int Sign(const Slope& x) {
  return Sign(x.range());
}

template <>
inline constexpr bool kEncloses<Slope> = true;

template <>
struct Approximation<Slope> {
  static double Of(const Slope& x) { return Approximation<Interval>::Of(x.centre()); }
};

template <>
struct Unsure<Slope> {
  static bool TellsSign(const Slope& x) { return Unsure<Interval>::TellsSign(x.range()); }
  static bool MayBePositive(const Slope& x) { return Unsure<Interval>::MayBePositive(x.range()); }
  static Slope Earliest(const Slope& gap, const Slope& rate) {
    return Slope(Unsure<Interval>::Earliest(gap.range(), rate.range()));
  }
  [[noreturn]] static void Refuse() { Unsure<Interval>::Refuse(); }
};

}  // namespace stiction

namespace Eigen {

template <>
struct NumTraits<stiction::Slope> : GenericNumTraits<stiction::Slope> {
  enum { IsSigned = 1, ReadCost = 100, AddCost = 1000, MulCost = 2000 };
};

}  // namespace Eigen
