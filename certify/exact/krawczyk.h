// SPDX-License-Identifier: Apache-2.0
// Krawczyk's test: whether quadratic equations F have a zero in a box X around x, over rationals.
//
// With any matrix Y, if x - Y F(x) + (I - Y F'(X)) (X - x) lies inside X, then X has a zero of F, and only one.
//
// Source   R. Krawczyk, Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken, Computing 4,
// 1969;
//          R. E. Moore, SIAM J. Numer. Anal. 14, 1977. certify/certificates.md has the proof.

#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "certify/exact/properties.h"
#include "solver/problem/scalar.h"

namespace stiction {

// A quadratic function at a point: its value, its slopes, half the sum of its second derivatives' absolute
// values.
template <class Scalar>
struct Quadratic {
  Scalar value = Scalar(0);
  std::vector<Scalar> slopes;
  Scalar bend = Scalar(0);

  // No value within the radius of the point is smaller.
  Scalar Least(const Scalar& radius) const {
    Scalar sum = Scalar(0);
    for (const Scalar& slope : slopes) sum += Abs(slope);
    return value - radius * sum - radius * radius * bend;
  }

  void Add(const Scalar& factor, const Quadratic& q) {
    if (factor == 0) return;
    value += factor * q.value;
    for (std::size_t k = 0; k < slopes.size(); ++k)
      if (q.slopes[k] != 0) slopes[k] += factor * q.slopes[k];
    bend += Abs(factor) * q.bend;
  }
};

// The first unknown that the test lets come as far from x as the radius of the box, or further, and how far;
// empty if there is a zero no further than the radius from x in any unknown. `equations` at x; inverse: Y, a
// row for each unknown. Only + - x and comparisons, numbers brought over common denominators apart.
std::optional<std::pair<int, Rational>> FindLeaving(const std::vector<Quadratic<Rational>>& equations,
                                                    const ExactMatrix& inverse, const Rational& radius);

}  // namespace stiction
