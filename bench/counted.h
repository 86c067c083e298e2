// SPDX-License-Identifier: Apache-2.0
// A double that counts what is done with it.

#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>

#include "solver/problem/scalar.h"

namespace stiction {

struct OperationCounts {
  std::int64_t sums = 0, products = 0, quotients = 0, comparisons = 0;
};

// One count for the whole program: for one thread.
class Counted {
 public:
  Counted() = default;
  Counted(double x) : x_(x) {}  // NOLINT: as a double does
  explicit operator std::int64_t() const { return static_cast<std::int64_t>(x_); }
  double value() const { return x_; }

  static OperationCounts& counts() {
    static OperationCounts counts;
    return counts;
  }

  Counted operator-() const { return -x_; }
  friend Counted operator+(Counted x, Counted y) { return ++counts().sums, x.x_ + y.x_; }
  friend Counted operator-(Counted x, Counted y) { return ++counts().sums, x.x_ - y.x_; }
  friend Counted operator*(Counted x, Counted y) { return ++counts().products, x.x_ * y.x_; }
  friend Counted operator/(Counted x, Counted y) { return ++counts().quotients, x.x_ / y.x_; }
  Counted& operator+=(Counted y) { return *this = *this + y; }
  Counted& operator-=(Counted y) { return *this = *this - y; }
  Counted& operator*=(Counted y) { return *this = *this * y; }
  Counted& operator/=(Counted y) { return *this = *this / y; }
  friend bool operator<(Counted x, Counted y) { return ++counts().comparisons, x.x_ < y.x_; }
  friend bool operator>(Counted x, Counted y) { return ++counts().comparisons, x.x_ > y.x_; }
  friend bool operator<=(Counted x, Counted y) { return ++counts().comparisons, x.x_ <= y.x_; }
  friend bool operator>=(Counted x, Counted y) { return ++counts().comparisons, x.x_ >= y.x_; }
  friend bool operator==(Counted x, Counted y) { return ++counts().comparisons, x.x_ == y.x_; }
  friend bool operator!=(Counted x, Counted y) { return ++counts().comparisons, x.x_ != y.x_; }
  friend Counted abs(Counted x) { return std::abs(x.x_); }
  friend Counted sqrt(Counted x) { return ++counts().quotients, std::sqrt(x.x_); }  // as dear as one
  friend Counted hypot(Counted x, Counted y) { return ++counts().quotients, std::hypot(x.x_, y.x_); }

 private:
  double x_ = 0;
};

template <>
inline constexpr bool kIsRounded<Counted> = true;

}  // namespace stiction

template <>
class std::numeric_limits<stiction::Counted> : public std::numeric_limits<double> {};

template <>
struct Eigen::NumTraits<stiction::Counted> : Eigen::NumTraits<double> {
  using Real = stiction::Counted;
  using NonInteger = stiction::Counted;
  using Nested = stiction::Counted;
  using Literal = stiction::Counted;
};
