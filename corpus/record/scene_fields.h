// SPDX-License-Identifier: Apache-2.0
// Fields of scene files that the plane and space have of their own, or in words of their own.

#pragma once

#include "corpus/exact_number.h"
#include "corpus/json_text.h"
#include "scene/scene.h"

namespace stiction {

template <class Kind>
struct SceneWords;

template <>
struct SceneWords<Plane> {
  static constexpr const char* kAxes = "[x, y]";
  static constexpr const char* kVector = "a pair of numbers [x, y]";
  static constexpr const char* kBox = "[width, height]";
  static constexpr const char* kCornered = "polygon";
  static constexpr const char* kRound = "disc";
  static constexpr const char* kConvex = "a strictly convex polygon, its corners anticlockwise";
};

template <>
struct SceneWords<Space> {
  static constexpr const char* kAxes = "[x, y, z]";
  static constexpr const char* kVector = "three numbers [x, y, z]";
  static constexpr const char* kBox = "[x, y, z]";
  static constexpr const char* kCornered = "polyhedron";
  static constexpr const char* kRound = "ball";
  static constexpr const char* kConvex = "the corners of a convex polyhedron";
};

// ---- Numbers ---------------------------------------------------------------------------------

inline Rational Positive(const JsonPlace& place) {
  Rational x = ExactNumber(place);
  if (x <= 0) place.Refuse("a number > 0");
  return x;
}

inline Rational NotNegative(const JsonPlace& place) {
  Rational x = ExactNumber(place);
  if (x < 0) place.Refuse("a number >= 0");
  return x;
}

template <class Kind>
auto ReadVector(const JsonPlace& place) {
  typename Kind::template Vector<Rational> v;
  if (place.Size(SceneWords<Kind>::kVector) != Kind::kDimension) place.Refuse(SceneWords<Kind>::kVector);
  for (std::size_t i = 0; i < Kind::kDimension; ++i) v[static_cast<int>(i)] = ExactNumber(place[i]);
  return v;
}

// Up to the rounding of doubles.
template <class Vector>
bool IsUnit(const Vector& v) {
  const Rational excess = abs(v.squaredNorm() - 1);
  return excess < Rational(1, 1000000000000000);
}

// A direction: made a unit vector unless it is one.
template <class Kind>
auto ReadDirection(const JsonPlace& place) {
  const auto v = ReadVector<Kind>(place);
  if (v.isZero(0)) place.Refuse("a direction, not zero");
  return IsUnit(v) ? v : UnitVector(v);
}

// A spin or a moment.
inline void ReadSpin(const JsonPlace& place, Rational& spin) { spin = ExactNumber(place); }
inline void ReadSpin(const JsonPlace& place, Vector3<Rational>& spin) { spin = ReadVector<Space>(place); }
Json SpinJson(const Rational& spin);
Json SpinJson(const Vector3<Rational>& spin);

// ---- Rotations -------------------------------------------------------------------------------

// In numbers: [cos, sin], or a quaternion [w, x, y, z].
void ReadTurn(const JsonPlace& place, Vector2<Rational>& rotation);
void ReadTurn(const JsonPlace& place, Quaternion<Rational>& rotation);

// Of a body: "rotation" in numbers, or "angle" in radians, in space about "axis".
void ReadRotation(const JsonPlace& place, Vector2<Rational>& rotation);
void ReadRotation(const JsonPlace& place, Quaternion<Rational>& rotation);

// Of a, seen from b.
Vector2<Rational> SeenFrom(const Vector2<Rational>& b, const Vector2<Rational>& a);
Quaternion<Rational> SeenFrom(const Quaternion<Rational>& b, const Quaternion<Rational>& a);

// ---- Inertia ---------------------------------------------------------------------------------

// Of a body in space: principal moments [x, y, z], or a symmetric matrix.
void ReadInertia(const JsonPlace& place, Rational& inertia);
void ReadInertia(const JsonPlace& place, Matrix3<Rational>& inertia);
Json InertiaJson(const Rational& inertia);
Json InertiaJson(const Matrix3<Rational>& inertia);

// A uniform body of that mass and these shapes. Requires shapes.
template <class Kind>
typename BodyIn<Kind, Rational>::Inertia UniformInertia(const JsonPlace& place,
                                                        const BodyIn<Kind, Rational>& body);

// ---- Shapes ----------------------------------------------------------------------------------

// {"polygon": corners} or {"polyhedron": corners}, a box, or a disc or ball.
template <class Kind>
ShapeIn<Kind, Rational> ReadShape(const JsonPlace& place);
template <class Kind>
Json ShapeJson(const ShapeIn<Kind, Rational>& shape);

}  // namespace stiction
