// SPDX-License-Identifier: Apache-2.0
// Friction polygons: the disc abs(fF) <= mu fN of a contact in space, replaced by mu fN times a polygon.
//
// The corners d_k are points of the unit circle in anticlockwise order. With the edge t_k = d_(k+1) - d_k, its
// outer normal n_k (of the length of t_k) and reach h_k = n_k.d_k the polygon is { x : n_k.x <= h_k for all k
// }. It contains the disc of radius min h_k / abs(n_k), its inner radius.
//
// Corners over rationals are exact: ((1 - t^2) / (1 + t^2), 2 t / (1 + t^2)) with t rational, and quarter
// turns.

#pragma once

#include <array>
#include <vector>

#include "solver/problem/check.h"
#include "solver/problem/scalar.h"

namespace stiction {

template <class Scalar>
using Planar = std::array<Scalar, 2>;  // a tangential vector

template <class Scalar>
Scalar Dot(const Planar<Scalar>& x, const Planar<Scalar>& y) {
  return x[0] * y[0] + x[1] * y[1];
}

template <class Scalar>
Scalar Cross(const Planar<Scalar>& x, const Planar<Scalar>& y) {
  return x[0] * y[1] - x[1] * y[0];
}

// The point of the unit circle at the angle 2 arctan t, exact over rationals.
template <class Scalar>
Planar<Scalar> OnCircle(const Scalar& t) {
  const Scalar length = 1 + t * t;
  return {Scalar((1 - t * t) / length), Scalar(2 * t / length)};
}

template <class Scalar>
class FrictionPolygon {
 public:
  // Corners at t = j / m, j = 0 .. m - 1, and their quarter turns. Requires sides = 4 m, m >= 1.
  explicit FrictionPolygon(int sides) {
    STICTION_CHECK(sides >= 4 && sides % 4 == 0, "the sides of a friction polygon are a multiple of 4");
    const int m = sides / 4;
    for (int j = 0; j < m; ++j) corners_.push_back(OnCircle(Scalar(Scalar(j) / Scalar(m))));
    for (int k = m; k < sides; ++k) {
      const Planar<Scalar> before = corners_[k - m];
      corners_.push_back({Scalar(-before[1]), before[0]});
    }
    Measure();
  }

  // With the corners of another number type.
  template <class Other, class Convert>
  FrictionPolygon(const FrictionPolygon<Other>& other, Convert convert) {
    for (int k = 0; k < other.sides(); ++k)
      corners_.push_back({convert(other.corner(k)[0]), convert(other.corner(k)[1])});
    Measure();
  }

  int sides() const { return static_cast<int>(corners_.size()); }
  // Cyclic: any k >= -1.
  const Planar<Scalar>& corner(int k) const { return corners_[Wrap(k)]; }
  const Planar<Scalar>& edge(int k) const { return edges_[Wrap(k)]; }
  Planar<Scalar> normal(int k) const { return {edge(k)[1], Scalar(-edge(k)[0])}; }
  const Scalar& reach(int k) const { return reaches_[Wrap(k)]; }
  int Wrap(int k) const { return (k + sides()) % sides(); }

  // Adds a corner. False if it is there already. Requires: a point of the unit circle.
  bool Insert(const Planar<Scalar>& corner) {
    for (int k = 0; k < sides(); ++k) {
      if (Sign(Cross(corners_[k], corner)) <= 0 || Sign(Cross(corner, this->corner(k + 1))) <= 0) continue;
      corners_.insert(corners_.begin() + k + 1, corner);
      Measure();
      return true;
    }
    return false;
  }

  // The point of radius times the polygon that is nearest to x. Requires radius >= 0.
  Planar<Scalar> Project(const Planar<Scalar>& x, const Scalar& radius) const {
    Planar<Scalar> nearest = x;
    bool outside = false;
    Scalar least(0);
    for (int k = 0; k < sides(); ++k) {
      if (Sign(Scalar(Dot(normal(k), x) - radius * reaches_[k])) <= 0) continue;
      const Planar<Scalar>& d = corners_[k];
      const Planar<Scalar>& t = edges_[k];
      Scalar along =
          Dot(t, Planar<Scalar>{Scalar(x[0] - radius * d[0]), Scalar(x[1] - radius * d[1])}) / Dot(t, t);
      if (along < 0) along = Scalar(0);
      if (along > radius) along = radius;
      const Planar<Scalar> p = {Scalar(radius * d[0] + along * t[0]), Scalar(radius * d[1] + along * t[1])};
      const Planar<Scalar> gap = {Scalar(x[0] - p[0]), Scalar(x[1] - p[1])};
      const Scalar distance = Dot(gap, gap);
      if (outside && distance >= least) continue;
      outside = true;
      least = distance;
      nearest = p;
    }
    return nearest;
  }

 private:
  void Measure() {
    edges_.clear();
    reaches_.clear();
    for (int k = 0; k < sides(); ++k) {
      const Planar<Scalar>&from = corners_[k], &to = corner(k + 1);
      edges_.push_back({Scalar(to[0] - from[0]), Scalar(to[1] - from[1])});
      reaches_.push_back(Cross(from, to));  // n_k.d_k
    }
  }

  std::vector<Planar<Scalar>> corners_, edges_;
  std::vector<Scalar> reaches_;
};

}  // namespace stiction
