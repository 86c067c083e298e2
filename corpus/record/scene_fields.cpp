// SPDX-License-Identifier: Apache-2.0
#include "corpus/record/scene_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <utility>

#include "corpus/json.h"
#include "scene/polygon.h"
#include "scene/polyhedron.h"

namespace stiction {

// ---- Rotations -------------------------------------------------------------------------------

void ReadTurn(const JsonPlace& place, Vector2<Rational>& rotation) {
  const auto read = ReadVector<Plane>(place);
  if (!IsUnit(read)) place.Refuse("[cos, sin], cos^2 + sin^2 = 1 up to the rounding of doubles");
  rotation = read;
}

void ReadTurn(const JsonPlace& place, Quaternion<Rational>& rotation) {
  const std::string expected = "a quaternion [w, x, y, z], not zero";
  if (place.Size(expected) != 4) place.Refuse(expected);
  Quaternion<Rational> read;
  for (std::size_t i = 0; i < 4; ++i) read[static_cast<int>(i)] = ExactNumber(place[i]);
  if (read.squaredNorm() == 0) place.Refuse(expected);
  rotation = read;
}

namespace {

// In radians; infinite ones have no cosine.
double ReadAngle(const JsonPlace& place) {
  const double radians = ToDouble(ExactNumber(place));
  if (!std::isfinite(radians)) place.Refuse("an angle in the range of doubles");
  return radians;
}

}  // namespace

void ReadRotation(const JsonPlace& place, Vector2<Rational>& rotation) {
  const auto given = place.Optional("rotation"), angle = place.Optional("angle");
  if (given && angle) angle->Refuse("a rotation or an angle, not both");
  if (given) ReadTurn(*given, rotation);
  if (!angle) return;
  const double radians = ReadAngle(*angle);
  rotation = MakeVector2<Rational>(std::cos(radians), std::sin(radians));
}

void ReadRotation(const JsonPlace& place, Quaternion<Rational>& rotation) {
  const auto given = place.Optional("rotation"), axis = place.Optional("axis"), angle = place.Optional("angle");
  if (given && (axis || angle)) given->Refuse("a rotation, or an axis and an angle, not both");
  if (given) ReadTurn(*given, rotation);
  if (!axis && !angle) return;
  const double half = ReadAngle(place.Required("angle", "an angle about the axis, rad")) / 2;
  const auto direction = ReadDirection<Space>(place.Required("axis", "an axis [x, y, z] of the angle"));
  rotation = MakeQuaternion<Rational>(Rational(std::cos(half)), Rational(std::sin(half)) * direction);
}

Vector2<Rational> SeenFrom(const Vector2<Rational>& b, const Vector2<Rational>& a) { return RotateBack(b, a); }

Quaternion<Rational> SeenFrom(const Quaternion<Rational>& b, const Quaternion<Rational>& a) {
  return Product<Rational>(Conjugate<Rational>(b), a);
}

// ---- Inertia ---------------------------------------------------------------------------------

void ReadInertia(const JsonPlace& place, Rational& inertia) { inertia = Positive(place); }

void ReadInertia(const JsonPlace& place, Matrix3<Rational>& inertia) {
  const std::string expected =
      "principal moments [x, y, z], or a symmetric positive definite matrix of three rows";
  if (place.Size(expected) != 3) place.Refuse(expected);
  Matrix3<Rational>& I = inertia = Zero<Matrix3<Rational>>();
  const bool full = place[0].json().is_array();
  for (int i = 0; i < 3; ++i) {
    const JsonPlace row = place[static_cast<std::size_t>(i)];
    if (full) {
      I.row(i) = ReadVector<Space>(row).transpose();
    } else {
      I(i, i) = Positive(row);
    }
  }
  const Rational minor = I(0, 0) * I(1, 1) - I(0, 1) * I(1, 0);
  const Vector3<Rational> x = I.row(0), y = I.row(1), z = I.row(2);
  const Rational determinant = x.dot(CrossProduct<Rational>(y, z));
  const bool symmetric = I(0, 1) == I(1, 0) && I(0, 2) == I(2, 0) && I(1, 2) == I(2, 1);
  if (!symmetric || I(0, 0) <= 0 || minor <= 0 || determinant <= 0) place.Refuse(expected);
}

Json SpinJson(const Rational& spin) { return ToString(spin); }
Json SpinJson(const Vector3<Rational>& spin) { return ListJson(spin); }

Json InertiaJson(const Rational& inertia) { return ToString(inertia); }

Json InertiaJson(const Matrix3<Rational>& inertia) { return RowsJson(inertia); }

template <class Kind>
typename BodyIn<Kind, Rational>::Inertia UniformInertia(const JsonPlace& place,
                                                        const BodyIn<Kind, Rational>& body) {
  const MassPropertiesIn<Kind> properties = MassPropertiesOf(body.shapes);
  if (!properties.center.isZero(0)) {
    std::vector<std::string> center;
    for (const Rational& x : properties.center) center.push_back(ToString(x));
    place.Refuse(fmt::format("no inertia, and shapes with the centre [{}]", fmt::join(center, ", ")),
                 "shapes about their centre of mass, or an inertia");
  }
  return properties.inertia * Rational(body.mass / properties.mass);
}
template Rational UniformInertia(const JsonPlace&, const RigidBody<Rational>&);
template Matrix3<Rational> UniformInertia(const JsonPlace&, const BodyInSpace<Rational>&);

// ---- Shapes ----------------------------------------------------------------------------------

namespace {

using Corners = std::vector<Vector2<Rational>>;
using CornersInSpace = std::vector<Vector3<Rational>>;

// The convex shape of these corners, and what is wrong with it, or nothing.
std::pair<BodyShape<Rational>, std::string> Cornered(Corners corners) {
  BodyShape<Rational> shape;
  shape.corners = std::move(corners);
  std::string fault = PolygonFault(shape.corners);
  return {std::move(shape), std::move(fault)};
}
std::pair<ShapeInSpace<Rational>, std::string> Cornered(CornersInSpace corners) {
  thread_local CornersInSpace last;  // walls are of one brick
  thread_local Polyhedron polyhedron;
  if (last != corners) polyhedron = MakePolyhedron(last = std::move(corners));
  return {polyhedron.shape, polyhedron.fault};
}

Corners BoxCorners(const Vector2<Rational>& center, const Vector2<Rational>& size) {
  Corners corners;
  for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
    corners.push_back(MakeVector2<Rational>(center[0] + x * size[0] / 2, center[1] + y * size[1] / 2));
  return corners;
}
CornersInSpace BoxCorners(const Vector3<Rational>& center, const Vector3<Rational>& size) {
  CornersInSpace corners(8, center);
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 3; ++k) corners[i][k] += ((i >> k & 1) != 0 ? 1 : -1) * size[k] / 2;
  }
  return corners;
}

template <class Kind>
ShapeIn<Kind, Rational> ReadBox(const JsonPlace& place,
                                const typename Kind::template Vector<Rational>& center) {
  const auto size = ReadVector<Kind>(place);
  for (std::size_t i = 0; i < Kind::kDimension; ++i) {
    if (size[static_cast<int>(i)] <= 0) place[i].Refuse("a number > 0");
  }
  return Cornered(BoxCorners(center, size)).first;
}

template <class Kind>
ShapeIn<Kind, Rational> ReadCornered(const JsonPlace& place) {
  std::vector<typename Kind::template Vector<Rational>> corners;
  const std::size_t count = place.Size("an array of corners");
  for (std::size_t i = 0; i < count; ++i) corners.push_back(ReadVector<Kind>(place[i]));
  auto [shape, fault] = Cornered(std::move(corners));
  if (!fault.empty()) place.Refuse(fault, SceneWords<Kind>::kConvex);
  return std::move(shape);
}

}  // namespace

template <class Kind>
ShapeIn<Kind, Rational> ReadShape(const JsonPlace& place) {
  using Words = SceneWords<Kind>;
  place.RequireObject();
  place.AllowKeys({Words::kCornered, "box", Words::kRound, "center"});
  const auto cornered = place.Optional(Words::kCornered), box = place.Optional("box"),
             round = place.Optional(Words::kRound), center = place.Optional("center");
  if (cornered.has_value() + box.has_value() + round.has_value() != 1) {
    place.Refuse(fmt::format(R"(one of {{"{}": corners}}, {{"box": {}}}, {{"{}": radius}})", Words::kCornered,
                             Words::kBox, Words::kRound));
  }
  ShapeIn<Kind, Rational> shape;
  if (center) shape.center = ReadVector<Kind>(*center);
  if (box) return ReadBox<Kind>(*box, shape.center);
  if (round) {
    shape.radius = Positive(*round);
    return shape;
  }
  if (center) center->Refuse(std::string("no center of a ") + Words::kCornered);
  return ReadCornered<Kind>(*cornered);
}
template BodyShape<Rational> ReadShape<Plane>(const JsonPlace&);
template ShapeInSpace<Rational> ReadShape<Space>(const JsonPlace&);

template <class Kind>
Json ShapeJson(const ShapeIn<Kind, Rational>& shape) {
  using Words = SceneWords<Kind>;
  if (shape.IsRound()) return {{Words::kRound, ToString(shape.radius)}, {"center", ListJson(shape.center)}};
  Json corners = Json::array();
  for (const auto& corner : shape.corners) corners.push_back(ListJson(corner));
  return {{Words::kCornered, std::move(corners)}};
}
template Json ShapeJson(const BodyShape<Rational>&);
template Json ShapeJson(const ShapeInSpace<Rational>&);

}  // namespace stiction
