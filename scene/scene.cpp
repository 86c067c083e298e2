// SPDX-License-Identifier: Apache-2.0
// Rounding: unit vectors over rationals, and scenes to doubles.

#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace stiction {
namespace {

using Exact = mpq_class;

// The double nearest to x, up to one unit of its last place; infinite beyond them.
double Nearest(const Exact& x) {
  const double below = x.get_d();  // toward zero
  const double above = std::nextafter(below, sgn(x) < 0 ? -HUGE_VAL : HUGE_VAL);
  if (!std::isfinite(below) || !std::isfinite(above)) return below;
  const Exact from_below = abs(x - Exact(below)), from_above = abs(Exact(above) - x);
  return from_above < from_below ? above : below;
}

template <int Rows, int Columns>
Eigen::Matrix<double, Rows, Columns> Nearest(const Eigen::Matrix<Exact, Rows, Columns>& numbers) {
  return numbers.unaryExpr([](const Exact& x) { return Nearest(x); });
}

// The root of x >= 0 if it is rational.
std::optional<Exact> RationalRoot(const Exact& x) {
  if (mpz_perfect_square_p(x.get_num_mpz_t()) == 0 || mpz_perfect_square_p(x.get_den_mpz_t()) == 0) return {};
  return Exact(sqrt(x.get_num()), sqrt(x.get_den()));
}

template <int Size>
Exact LargestEntry(const Eigen::Matrix<Exact, Size, 1>& v) {
  Exact largest(0);
  for (int i = 0; i < Size; ++i) largest = std::max<Exact>(largest, abs(v[i]));
  return largest;
}

template <int Size>
Exact RoundedLength(const Eigen::Matrix<Exact, Size, 1>& v) {
  const Exact square = v.squaredNorm();
  if (const auto root = RationalRoot(square)) return *root;
  if (const double nearest = Nearest(square); std::isnormal(nearest)) return Exact(std::sqrt(nearest));
  const Exact scale = LargestEntry(v);  // so that nothing overflows or underflows
  return scale * Exact(std::sqrt(Nearest(Exact(square / (scale * scale)))));
}

template <int Size>
Eigen::Matrix<Exact, Size, 1> RoundedUnitVector(const Eigen::Matrix<Exact, Size, 1>& v) {
  if (const auto root = RationalRoot(Exact(v.squaredNorm()))) return v / *root;
  const Exact scale = LargestEntry(v);  // so that nothing overflows
  const Eigen::Matrix<Exact, Size, 1> scaled = v / scale;
  return UnitVector(Nearest(scaled)).template cast<Exact>();
}

}  // namespace

template <>
Exact Length(const Vector2<Exact>& v) {
  return RoundedLength(v);
}
template <>
Exact Length(const Vector3<Exact>& v) {
  return RoundedLength(v);
}
template <>
Vector2<Exact> UnitVector(const Vector2<Exact>& v) {
  return RoundedUnitVector(v);
}
template <>
Vector3<Exact> UnitVector(const Vector3<Exact>& v) {
  return RoundedUnitVector(v);
}

namespace {

void RoundSurface(const BodyShape<Exact>&, BodyShape<double>&) {}

void RoundSurface(const ShapeInSpace<Exact>& shape, ShapeInSpace<double>& rounded) {
  for (const auto& normal : shape.normals) rounded.normals.push_back(Nearest(normal));
  rounded.faces = shape.faces;
  rounded.edges = shape.edges;
}

template <class Kind>
ShapeIn<Kind, double> Round(const ShapeIn<Kind, Exact>& shape) {
  ShapeIn<Kind, double> rounded;
  for (const auto& corner : shape.corners) rounded.corners.push_back(Nearest(corner));
  rounded.center = Nearest(shape.center);
  rounded.radius = Nearest(shape.radius);
  RoundSurface(shape, rounded);
  return rounded;
}

Vector2<double> NearestRotation(const Vector2<Exact>& rotation) { return Nearest(rotation); }
Quaternion<double> NearestRotation(const Quaternion<Exact>& rotation) { return Nearest(rotation).normalized(); }

template <class Kind>
BodyIn<Kind, double> Round(const BodyIn<Kind, Exact>& body) {
  BodyIn<Kind, double> rounded;
  rounded.name = body.name;
  rounded.fixed = body.fixed;
  rounded.mass = Nearest(body.mass);
  rounded.inertia = Nearest(body.inertia);
  rounded.position = Nearest(body.position);
  rounded.rotation = NearestRotation(body.rotation);
  rounded.velocity = Nearest(body.velocity);
  rounded.spin = Nearest(body.spin);
  rounded.acceleration = Nearest(body.acceleration);
  rounded.force = Nearest(body.force);
  rounded.torque = Nearest(body.torque);
  rounded.level = body.level;
  for (const auto& shape : body.shapes) rounded.shapes.push_back(Round(shape));
  return rounded;
}

PairRule<double> Round(const PairRule<Exact>& rule) {
  PairRule<double> rounded = {rule.a, rule.b, {}, rule.collide};
  if (rule.mu) rounded.mu = Nearest(*rule.mu);
  return rounded;
}

}  // namespace

template <class Kind>
SceneIn<Kind, double> Round(const SceneIn<Kind, Exact>& scene) {
  SceneIn<Kind, double> rounded;
  rounded.name = scene.name;
  rounded.gravity = Nearest(scene.gravity);
  rounded.mu = Nearest(scene.mu);
  rounded.gap = Nearest(scene.gap);
  rounded.rest = Nearest(scene.rest);
  for (const auto& body : scene.bodies) rounded.bodies.push_back(Round(body));
  for (const auto& joint : scene.joints) {
    rounded.joints.push_back({joint.kind, joint.a, joint.b, Nearest(joint.at_a), Nearest(joint.at_b),
                              Nearest(joint.direction), NearestRotation(joint.relative_rotation)});
  }
  for (const auto& given : scene.contacts)
    rounded.contacts.push_back(
        {given.a, given.b, Nearest(given.at_a), Nearest(given.at_b), Nearest(given.normal)});
  for (const auto& pair : scene.pairs) rounded.pairs.push_back(Round(pair));
  return rounded;
}

template Scene<double> Round(const Scene<Exact>&);
template SceneInSpace<double> Round(const SceneInSpace<Exact>&);

}  // namespace stiction
