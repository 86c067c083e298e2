// SPDX-License-Identifier: Apache-2.0
// PortableInterval: intervals where the processor rounds to nearest only, as WebAssembly does (cli/live).
// Include interval.h.
//
// An end is rounded outward by the sign of what rounding to nearest has left: of a sum by two-sum, otherwise by
// a fused multiplication. So it is the double that rounding toward that side gives, and an interval the same as
// CGAL's. Only below kTiny, where what is left may itself be lost, it is one double further out.

#ifndef STICTION_CERTIFY_EXACT_INTERVAL_PORTABLE_H_
#define STICTION_CERTIFY_EXACT_INTERVAL_PORTABLE_H_

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

namespace stiction {

// Operations rounded up.
class Upward {
 public:
  static double Sum(double x, double y) {
    const double sum = x + y;
    if (!std::isfinite(sum)) return Overflown(sum, std::isfinite(x) && std::isfinite(y));
    const double of_y = sum - x, left = (x - (sum - of_y)) + (y - of_y);
    return left <= 0 ? sum : Next(sum);  // nor is it exact where what is left overflows
  }
  static double Product(double x, double y) {
    if (x == 0 || y == 0) return 0;
    const double product = x * y;
    if (!std::isfinite(product)) return Overflown(product, std::isfinite(x) && std::isfinite(y));
    return IsTiny(product) || std::fma(x, y, -product) > 0 ? Next(product) : product;
  }
  // Requires y != 0.
  static double Quotient(double x, double y) {
    if (x == 0) return 0;
    const double quotient = x / y;
    if (!std::isfinite(quotient)) return Overflown(quotient, std::isfinite(x) && std::isfinite(y));
    const double left = std::fma(-quotient, y, x);  // (x / y - quotient) y
    return IsTiny(x) || IsTiny(quotient) || (y > 0 ? left > 0 : left < 0) ? Next(quotient) : quotient;
  }
  // Requires x >= 0.
  static double Root(double x) {
    const double root = std::sqrt(x);
    if (x == 0 || std::isinf(x)) return root;
    return IsTiny(x) || std::fma(-root, root, x) > 0 ? Next(root) : root;
  }

 private:
  static constexpr double kTiny = 0x1p-960;

  static double Next(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }
  static bool IsTiny(double x) { return std::abs(x) < kTiny; }
  // Of finite numbers that overflow the most negative double; nothing is known of what is no number.
  static double Overflown(double x, bool of_finite) {
    if (std::isnan(x)) return std::numeric_limits<double>::infinity();
    return of_finite && x < 0 ? std::numeric_limits<double>::lowest() : x;
  }
};

class PortableInterval {
 public:
  // Thrown by a comparison that the ends do not decide.
  struct Unsure : std::exception {
    Unsure() = default;
    explicit Unsure(const char* reason) : what_(reason) {}
    const char* what() const noexcept override { return what_; }

   private:
    const char* what_ = "a comparison that the ends of intervals do not decide";
  };

  PortableInterval() = default;
  PortableInterval(int x) : PortableInterval(static_cast<double>(x)) {}  // NOLINT: as numbers
  PortableInterval(double x) : inf_(x), sup_(x) {}                       // NOLINT
  PortableInterval(double inf, double sup) : inf_(inf), sup_(sup) {}

  double inf() const { return inf_; }
  double sup() const { return sup_; }

  PortableInterval operator-() const { return {-sup_, -inf_}; }
  friend PortableInterval operator+(const PortableInterval& x, const PortableInterval& y) {
    return {-Upward::Sum(-x.inf_, -y.inf_), Upward::Sum(x.sup_, y.sup_)};
  }
  friend PortableInterval operator-(const PortableInterval& x, const PortableInterval& y) { return x + -y; }
  friend PortableInterval operator*(const PortableInterval& x, const PortableInterval& y) {
    const auto most = [&y](double a, double b) {
      return std::max({Upward::Product(a, y.inf_), Upward::Product(a, y.sup_), Upward::Product(b, y.inf_),
                       Upward::Product(b, y.sup_)});
    };
    return {-most(-x.inf_, -x.sup_), most(x.inf_, x.sup_)};
  }
  friend PortableInterval operator/(const PortableInterval& x, const PortableInterval& y) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (y.inf_ <= 0 && y.sup_ >= 0) return {-kInfinity, kInfinity};
    const auto most = [&y](double a, double b) {
      return std::max({Upward::Quotient(a, y.inf_), Upward::Quotient(a, y.sup_), Upward::Quotient(b, y.inf_),
                       Upward::Quotient(b, y.sup_)});
    };
    return {-most(-x.inf_, -x.sup_), most(x.inf_, x.sup_)};
  }
  PortableInterval& operator+=(const PortableInterval& y) { return *this = *this + y; }
  PortableInterval& operator-=(const PortableInterval& y) { return *this = *this - y; }
  PortableInterval& operator*=(const PortableInterval& y) { return *this = *this * y; }
  PortableInterval& operator/=(const PortableInterval& y) { return *this = *this / y; }

  friend bool operator<(const PortableInterval& x, const PortableInterval& y) {
    if (x.sup_ < y.inf_) return true;
    if (x.inf_ >= y.sup_) return false;
    throw Unsure();
  }
  friend bool operator>(const PortableInterval& x, const PortableInterval& y) { return y < x; }
  friend bool operator<=(const PortableInterval& x, const PortableInterval& y) { return !(y < x); }
  friend bool operator>=(const PortableInterval& x, const PortableInterval& y) { return !(x < y); }
  friend bool operator==(const PortableInterval& x, const PortableInterval& y) {
    if (x.inf_ > y.sup_ || y.inf_ > x.sup_) return false;
    if (x.inf_ == y.sup_ && y.inf_ == x.sup_) return true;
    throw Unsure();
  }

  // Of what of it is no less than zero.
  friend PortableInterval sqrt(const PortableInterval& x) {
    const double least = x.inf_ > 0 ? std::sqrt(x.inf_) : 0;
    const bool above = least > 0 && (x.inf_ < 0x1p-960 || std::fma(-least, least, x.inf_) < 0);
    return {above ? std::nextafter(least, 0) : least, x.sup_ > 0 ? Upward::Root(x.sup_) : 0};
  }

 private:
  double inf_ = -1, sup_ = 0;
};

}  // namespace stiction

template <>
struct Eigen::NumTraits<stiction::PortableInterval> : Eigen::GenericNumTraits<stiction::PortableInterval> {
  enum { IsSigned = 1 };
};

#endif  // STICTION_CERTIFY_EXACT_INTERVAL_PORTABLE_H_
