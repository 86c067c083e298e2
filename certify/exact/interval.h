// SPDX-License-Identifier: Apache-2.0
// Interval: CGAL's interval of doubles as a scalar of the methods. Included before their definitions, by the
// units that run over it only.
//
// A comparison that the ends do not decide throws UnsureComparison.

#pragma once

#include <CGAL/Interval_nt.h>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "certify/exact/solve.h"
#include "corpus/rational.h"
#include "solver/problem/enclosure.h"

namespace stiction {

using Interval = CGAL::Interval_nt<>;
using UnsureComparison = CGAL::Uncertain_conversion_exception;

template <>
inline constexpr Arithmetic kArithmeticOf<Interval> = Arithmetic::kInterval;

// The methods over intervals alone: those in space (published_space.cpp).
template <>
std::span<const Method<Interval>> Methods<Interval>();

template <>
inline bool IsSurelyZero(const Interval& x) {
  return x.inf() == 0 && x.sup() == 0;
}

template <>
inline constexpr bool kEncloses<Interval> = true;

template <>
struct Approximation<Interval> {
  static double Of(const Interval& x) { return (x.inf() + x.sup()) / 2; }
};

template <>
struct Unsure<Interval> {
  static bool TellsSign(const Interval& x) { return x.inf() > 0 || x.sup() < 0 || IsSurelyZero(x); }
  static bool MayBePositive(const Interval& x) { return x.sup() > 0; }
  static Interval Earliest(const Interval& gap, const Interval& rate) {
    const bool tells = gap.inf() > 0 && std::isfinite(gap.inf()) && std::isfinite(rate.sup());
    return tells ? (Interval(gap.inf()) / Interval(rate.sup())).inf() : 0;
  }
  [[noreturn]] static void Refuse() { throw UnsureComparison("a limit that may or may not be the nearest"); }
};

// The double nearest to x, or the two on either side of it.
inline Interval Around(const Rational& x) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double nearest = ToDouble(x);
  if (std::isinf(nearest)) return {-kInfinity, kInfinity};
  const int side = Sign(Rational(Rational(nearest) - x));
  return {side > 0 ? std::nextafter(nearest, -kInfinity) : nearest,
          side < 0 ? std::nextafter(nearest, kInfinity) : nearest};
}

template <class Vector>
std::vector<Enclosure> Enclosures(const Vector& values) {
  std::vector<Enclosure> result;
  for (const Interval& x : values) result.push_back({x.inf(), x.sup()});
  return result;
}

}  // namespace stiction
