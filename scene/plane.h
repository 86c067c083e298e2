// SPDX-License-Identifier: Apache-2.0
// The plane over any scalar: vectors, rotations as (cos, sin), unit vectors rounded once. And the plane as a
// kind of scene: what templates over the kind ask of it; those of space are in space.h.

#pragma once

#include <gmpxx.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "solver/problem/scalar.h"

namespace stiction {

template <class Scalar>
using Vector2 = Eigen::Matrix<Scalar, 2, 1>;

template <class Scalar>
Vector2<Scalar> MakeVector2(const Scalar& x, const Scalar& y) {
  Vector2<Scalar> v;
  v[0] = x;
  v[1] = y;
  return v;
}

template <class Scalar>
Scalar Dot(const Vector2<Scalar>& a, const Vector2<Scalar>& b) {
  return Scalar(a[0] * b[0] + a[1] * b[1]);
}

// The moment of b at the arm a.
template <class Scalar>
Scalar Cross(const Vector2<Scalar>& a, const Vector2<Scalar>& b) {
  return Scalar(a[0] * b[1] - a[1] * b[0]);
}

// a turned by a quarter, anticlockwise.
template <class Scalar>
Vector2<Scalar> Quarter(const Vector2<Scalar>& a) {
  return MakeVector2<Scalar>(Scalar(-a[1]), a[0]);
}

// rotation: (cos, sin).
template <class Scalar>
Vector2<Scalar> Rotate(const Vector2<Scalar>& rotation, const Vector2<Scalar>& v) {
  return MakeVector2<Scalar>(Scalar(rotation[0] * v[0] - rotation[1] * v[1]),
                             Scalar(rotation[1] * v[0] + rotation[0] * v[1]));
}

template <class Scalar>
Vector2<Scalar> RotateBack(const Vector2<Scalar>& rotation, const Vector2<Scalar>& v) {
  return MakeVector2<Scalar>(Scalar(rotation[0] * v[0] + rotation[1] * v[1]),
                             Scalar(rotation[0] * v[1] - rotation[1] * v[0]));
}

// A scalar, vector or matrix of zeros.
template <class T>
T Zero() {
  if constexpr (requires { T::RowsAtCompileTime; }) {
    return T::Constant(typename T::Scalar(0));
  } else {
    return T(0);
  }
}

// The rotation that turns nothing, 1 of the complex numbers and of the quaternions.
template <class Rotation>
Rotation NoRotation() {
  Rotation one = Zero<Rotation>();
  one[0] = typename Rotation::Scalar(1);
  return one;
}

// v / abs(v). Over rationals exactly that where abs(v) is rational, otherwise doubles near it: the one rounding
// of irrational geometry. Requires v /= 0.
template <class Scalar>
Vector2<Scalar> UnitVector(const Vector2<Scalar>& v) {
  const Scalar length = std::hypot(v[0], v[1]);
  return MakeVector2<Scalar>(v[0] / length, v[1] / length);
}
template <>
Vector2<mpq_class> UnitVector(const Vector2<mpq_class>& v);

// abs(v), rounded where it must be.
template <class Scalar>
Scalar Length(const Vector2<Scalar>& v) {
  return std::hypot(v[0], v[1]);
}
template <>
mpq_class Length(const Vector2<mpq_class>& v);

// The direction of v, v /= 0: over rationals of length 1 exactly and near it, (1 - t^2, 2 t) / (1 + t^2) with
// the tangent t of half the rounded angle.
template <class Scalar>
std::array<Scalar, 2> ExactDirection(const Vector2<Scalar>& v) {
  const Vector2<Scalar> unit = UnitVector<Scalar>(v);
  if constexpr (!kIsExact<Scalar>) return {unit[0], unit[1]};
  const bool right = unit[0] >= 0;  // else of the opposite, so that nothing cancels
  const Scalar t = unit[1] / (1 + Abs<Scalar>(unit[0]));
  const Scalar scale = 1 + t * t, cosine = (1 - t * t) / scale, sine = 2 * t / scale;
  return {right ? cosine : Scalar(-cosine), sine};
}

// ---- A kind of scene -------------------------------------------------------------------------

// pin     the points at_a and at_b coincide (2 rows)
// rail    at_a stays on the line through at_b along `direction`, which turns with b (1 row)
// slider  a rail on which a does not turn relative to b either (2 rows)
enum class JointKind : std::uint8_t { kPin, kRail, kSlider };

struct Plane {
  static constexpr int kDimension = 2, kDof = 3;  // x, y, spin
  template <class Scalar>
  using Vector = Vector2<Scalar>;
  template <class Scalar>
  using Rotation = Vector2<Scalar>;  // (cos, sin)
  template <class Scalar>
  using Spin = Scalar;  // and moments, anticlockwise
  template <class Scalar>
  using Inertia = Scalar;
  // What a convex piece has beside its corners, in order anticlockwise.
  template <class Scalar>
  struct Surface {};

  using JointKind = stiction::JointKind;
  static constexpr std::array<std::string_view, 3> kJointNames = {"pin", "rail", "slider"};
};

// A rotation as Rotate and RotateBack take it.
template <class Scalar>
const Vector2<Scalar>& TurnOf(const Vector2<Scalar>& rotation) {
  return rotation;
}

// The moment of d at the arm.
template <class Scalar>
Scalar Moment(const Vector2<Scalar>& arm, const Vector2<Scalar>& d) {
  return Cross<Scalar>(arm, d);
}

// Of the point at the arm under a spin: its velocity, and its acceleration toward the centre.
template <class Scalar>
Vector2<Scalar> SpinVelocity(const Scalar& spin, const Vector2<Scalar>& arm) {
  return spin * Quarter<Scalar>(arm);
}
template <class Scalar>
Vector2<Scalar> Centripetal(const Scalar& spin, const Vector2<Scalar>& arm) {
  const Scalar factor = -spin * spin;
  return factor * arm;
}

template <class Scalar>
std::array<Vector2<Scalar>, 1> TangentsOf(const Vector2<Scalar>& normal) {
  return {Quarter<Scalar>(normal)};
}

}  // namespace stiction
