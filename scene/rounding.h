// SPDX-License-Identifier: Apache-2.0
// From rationals to doubles and to roots: what irrational geometry is rounded with.

#ifndef STICTION_SCENE_ROUNDING_H_
#define STICTION_SCENE_ROUNDING_H_

#include <gmpxx.h>

#include <Eigen/Core>
#include <cmath>
#include <optional>

namespace stiction {

// The double nearest to x, up to one unit of its last place; infinite beyond them.
inline double Nearest(const mpq_class& x) {
  const double below = x.get_d();  // toward zero
  const double above = std::nextafter(below, sgn(x) < 0 ? -HUGE_VAL : HUGE_VAL);
  if (!std::isfinite(below) || !std::isfinite(above)) return below;
  const mpq_class from_below = abs(x - mpq_class(below)), from_above = abs(mpq_class(above) - x);
  return from_above < from_below ? above : below;
}

template <int Rows, int Columns>
Eigen::Matrix<double, Rows, Columns> Nearest(const Eigen::Matrix<mpq_class, Rows, Columns>& numbers) {
  return numbers.unaryExpr([](const mpq_class& x) { return Nearest(x); });
}

// The root of x >= 0 if it is rational.
inline std::optional<mpq_class> RationalRoot(const mpq_class& x) {
  if (mpz_perfect_square_p(x.get_num_mpz_t()) == 0 || mpz_perfect_square_p(x.get_den_mpz_t()) == 0) return {};
  return mpq_class(sqrt(x.get_num()), sqrt(x.get_den()));
}

}  // namespace stiction

#endif  // STICTION_SCENE_ROUNDING_H_
