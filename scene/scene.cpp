// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.h"

#include <CGAL/Cartesian.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/mpq_class.h>

#include <algorithm>
#include <iterator>
#include <numbers>

#include "scene/rounding.h"

namespace stiction {
namespace {

using Exact = mpq_class;
using Kernel = CGAL::Cartesian<Exact>;

Exact SquaredLength(const Vector2<Exact>& v) { return Dot<Exact>(v, v); }

Vector2<double> NearestVector(const Vector2<Exact>& v) { return {Nearest(v[0]), Nearest(v[1])}; }

void AddPolygon(MassProperties<Exact>& sum, const std::vector<Vector2<Exact>>& polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2<Exact>&p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Exact cross = Cross<Exact>(p, q);
    sum.area += cross / 2;
    for (int k = 0; k < 2; ++k) sum.center[k] += cross * (p[k] + q[k]) / 6;
    sum.inertia += cross * (Dot<Exact>(p, p) + Dot<Exact>(p, q) + Dot<Exact>(q, q)) / 12;
  }
}

void AddDisc(MassProperties<Exact>& sum, const BodyShape<Exact>& disc) {
  const Exact square = disc.radius * disc.radius;
  const Exact area = Exact(std::numbers::pi) * square;
  sum.area += area;
  for (int k = 0; k < 2; ++k) sum.center[k] += area * disc.center[k];
  sum.inertia += area * (square / 2 + SquaredLength(disc.center));
}

}  // namespace

template <>
Vector2<Exact> UnitVector(const Vector2<Exact>& v) {
  if (const auto root = RationalRoot(SquaredLength(v))) return MakeVector2<Exact>(v[0] / *root, v[1] / *root);
  const Exact scale = std::max(Exact(abs(v[0])), Exact(abs(v[1])));  // so that nothing overflows
  const Vector2<double> unit =
      UnitVector<double>(NearestVector(MakeVector2<Exact>(v[0] / scale, v[1] / scale)));
  return MakeVector2<Exact>(unit[0], unit[1]);
}

template <>
Exact Length(const Vector2<Exact>& v) {
  const Exact square = SquaredLength(v);
  if (const auto root = RationalRoot(square)) return *root;
  return Exact(std::sqrt(Nearest(square)));
}

std::string PolygonFault(const std::vector<Vector2<Exact>>& polygon) {
  if (polygon.size() < 3) return "fewer than three corners";
  std::vector<Kernel::Point_2> points;
  for (const auto& corner : polygon) points.emplace_back(corner[0], corner[1]);
  // One turn to the left at every corner is not enough: a star has that too.
  if (!CGAL::is_simple_2(points.begin(), points.end(), Kernel())) return "edges that cross or touch";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto turn =
        CGAL::orientation(points[i], points[(i + 1) % points.size()], points[(i + 2) % points.size()]);
    if (turn != CGAL::LEFT_TURN)
      return "no turn to the left at corner " + std::to_string((i + 1) % points.size());
  }
  return "";
}

MassProperties<Exact> MassPropertiesOf(const std::vector<BodyShape<Exact>>& shapes) {
  MassProperties<Exact> sum;
  for (const auto& shape : shapes) {
    if (shape.IsDisc()) {
      AddDisc(sum, shape);
    } else {
      AddPolygon(sum, shape.polygon);
    }
  }
  for (int k = 0; sum.area != 0 && k < 2; ++k) sum.center[k] /= sum.area;
  return sum;
}

PairRule<double> Round(const PairRule<Exact>& rule) {
  PairRule<double> rounded = {rule.a, rule.b, {}, rule.collide};
  if (rule.mu) rounded.mu = Nearest(*rule.mu);
  return rounded;
}

Scene<double> Round(const Scene<Exact>& scene) {
  Scene<double> rounded;
  rounded.name = scene.name;
  rounded.gravity = NearestVector(scene.gravity);
  rounded.mu = Nearest(scene.mu);
  rounded.gap = Nearest(scene.gap);
  rounded.rest = Nearest(scene.rest);
  for (const auto& body : scene.bodies) {
    RigidBody<double> copy;
    copy.name = body.name;
    copy.fixed = body.fixed;
    copy.mass = Nearest(body.mass);
    copy.inertia = Nearest(body.inertia);
    copy.position = NearestVector(body.position);
    copy.rotation = NearestVector(body.rotation);
    copy.velocity = NearestVector(body.velocity);
    copy.spin = Nearest(body.spin);
    copy.acceleration = NearestVector(body.acceleration);
    copy.force = NearestVector(body.force);
    copy.torque = Nearest(body.torque);
    copy.level = body.level;
    for (const auto& shape : body.shapes) {
      BodyShape<double> piece;
      for (const auto& corner : shape.polygon) piece.polygon.push_back(NearestVector(corner));
      piece.center = NearestVector(shape.center);
      piece.radius = Nearest(shape.radius);
      copy.shapes.push_back(std::move(piece));
    }
    rounded.bodies.push_back(std::move(copy));
  }
  for (const auto& joint : scene.joints) {
    rounded.joints.push_back({joint.kind, joint.a, joint.b, NearestVector(joint.at_a),
                              NearestVector(joint.at_b), NearestVector(joint.direction),
                              NearestVector(joint.relative_rotation)});
  }
  for (const auto& given : scene.contacts) {
    rounded.contacts.push_back(
        {given.a, given.b, NearestVector(given.at_a), NearestVector(given.at_b), NearestVector(given.normal)});
  }
  for (const auto& pair : scene.pairs) rounded.pairs.push_back(Round(pair));
  return rounded;
}

}  // namespace stiction
