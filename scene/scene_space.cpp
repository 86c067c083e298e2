// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_space.h"

#include <CGAL/Cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/mpq_class.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "scene/rounding.h"

namespace stiction {
namespace {

using Exact = mpq_class;
using Kernel = CGAL::Cartesian<Exact>;
using Point = Kernel::Point_3;
using Vector = Vector3<Exact>;

Point ToPoint(const Vector& v) { return {v[0], v[1], v[2]}; }

Vector3<double> NearestVector(const Vector& v) { return {Nearest(v[0]), Nearest(v[1]), Nearest(v[2])}; }

// ---- Polyhedra -------------------------------------------------------------------------------

// Anticlockwise around `normal`, those between others on a line left out.
std::vector<int> Loop(const std::vector<Vector>& corners, const std::vector<int>& members,
                      const Vector& normal) {
  const auto turn = [&](int at, int to, int other) {
    return sgn(normal.dot(CrossProduct<Exact>(corners[to] - corners[at], corners[other] - corners[at])));
  };
  const auto reach = [&](int at, int to) { return Exact((corners[to] - corners[at]).squaredNorm()); };
  const int start = *std::min_element(members.begin(), members.end(), [&](int i, int j) {
    return CGAL::compare_lexicographically(ToPoint(corners[i]), ToPoint(corners[j])) == CGAL::SMALLER;
  });
  std::vector<int> loop;
  int at = start;
  do {
    loop.push_back(at);
    int next = -1;
    for (const int other : members) {
      if (other == at) continue;
      const int side = next < 0 ? -1 : turn(at, next, other);
      if (side < 0 || (side == 0 && reach(at, other) > reach(at, next))) next = other;
    }
    at = next;
  } while (at != start);
  return loop;
}

void AddFaces(ShapeInSpace<Exact>& shape) {
  std::vector<Point> points;
  for (const auto& corner : shape.corners) points.push_back(ToPoint(corner));
  CGAL::Surface_mesh<Point> hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull, Kernel());
  std::set<std::vector<int>> known;
  for (const auto facet : hull.faces()) {
    std::vector<Point> triangle;
    for (const auto v : CGAL::vertices_around_face(hull.halfedge(facet), hull))
      triangle.push_back(hull.point(v));
    std::vector<int> members;  // the hull's facets are triangles, a face may be several of them
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (CGAL::orientation(triangle[0], triangle[1], triangle[2], points[i]) == CGAL::COPLANAR)
        members.push_back(static_cast<int>(i));
    }
    if (!known.insert(members).second) continue;
    const auto across = CGAL::cross_product(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const auto normal = MakeVector3<Exact>(across.x(), across.y(), across.z());
    shape.faces.push_back(Loop(shape.corners, members, normal));
    shape.normals.push_back(UnitVector3<Exact>(normal));
  }
}

void AddEdges(ShapeInSpace<Exact>& shape) {
  std::map<std::pair<int, int>, int> face_of;
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    const auto& face = shape.faces[f];
    for (std::size_t i = 0; i < face.size(); ++i)
      face_of[{face[i], face[(i + 1) % face.size()]}] = static_cast<int>(f);
  }
  for (const auto& [ends, left] : face_of) {
    const auto [from, to] = ends;
    if (from < to) shape.edges.push_back({from, to, left, face_of.at({to, from})});
  }
}

bool AllInOnePlane(const std::vector<Vector>& corners) {
  std::vector<Point> points;
  for (const auto& corner : corners) points.push_back(ToPoint(corner));
  std::size_t j = 1, k = 2;
  while (j < points.size() && points[j] == points[0]) ++j;
  for (k = j + 1; k < points.size() && CGAL::collinear(points[0], points[j], points[k]);) ++k;
  for (std::size_t i = k + 1; i < points.size(); ++i) {
    if (!CGAL::coplanar(points[0], points[j], points[k], points[i])) return false;
  }
  return true;
}

// ---- Mass ------------------------------------------------------------------------------------

// Sums of volume, of first and of second moments, with a density of 1.
struct Moments {
  Exact volume = 0;
  Vector first = Zero3<Exact>();
  Matrix3<Exact> second = Matrix3<Exact>::Constant(Exact(0));
};

// Tetrahedra from the origin, with sign.
void AddPolyhedron(Moments& sum, const ShapeInSpace<Exact>& shape) {
  for (const auto& face : shape.faces) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      const Vector &p = shape.corners[face[0]], &q = shape.corners[face[i]], &r = shape.corners[face[i + 1]];
      const Exact six = p.dot(CrossProduct<Exact>(q, r));  // volumes
      const Vector all = p + q + r;
      sum.volume += six / 6;
      for (int k = 0; k < 3; ++k) {
        sum.first[k] += six * all[k] / 24;
        for (int l = 0; l < 3; ++l)
          sum.second(k, l) += six * (all[k] * all[l] + p[k] * p[l] + q[k] * q[l] + r[k] * r[l]) / 120;
      }
    }
  }
}

void AddBall(Moments& sum, const ShapeInSpace<Exact>& ball) {
  const Exact square = ball.radius * ball.radius;
  const Exact volume = Exact(std::numbers::pi) * square * ball.radius * 4 / 3;
  sum.volume += volume;
  for (int k = 0; k < 3; ++k) {
    sum.first[k] += volume * ball.center[k];
    sum.second(k, k) += volume * square / 5;
    for (int l = 0; l < 3; ++l) sum.second(k, l) += volume * ball.center[k] * ball.center[l];
  }
}

}  // namespace

template <>
Exact Length3(const Vector& v) {
  const Exact square = v.squaredNorm();
  if (const auto root = RationalRoot(square)) return *root;
  return Exact(std::sqrt(Nearest(square)));
}

template <>
Vector UnitVector3(const Vector& v) {
  if (const auto root = RationalRoot(Exact(v.squaredNorm())))
    return MakeVector3<Exact>(v[0] / *root, v[1] / *root, v[2] / *root);
  Exact scale(0);  // so that nothing overflows
  for (int i = 0; i < 3; ++i) scale = std::max<Exact>(scale, abs(v[i]));
  const Vector3<double> unit =
      UnitVector3<double>(NearestVector(MakeVector3<Exact>(v[0] / scale, v[1] / scale, v[2] / scale)));
  return MakeVector3<Exact>(unit[0], unit[1], unit[2]);
}

Polyhedron MakePolyhedron(std::vector<Vector> corners) {
  Polyhedron polyhedron;
  if (corners.size() < 4) {
    polyhedron.fault = "fewer than four corners";
  } else if (AllInOnePlane(corners)) {
    polyhedron.fault = "corners that are all in one plane";
  }
  if (!polyhedron.fault.empty()) return polyhedron;
  ShapeInSpace<Exact>& shape = polyhedron.shape;
  shape.corners = std::move(corners);
  AddFaces(shape);
  std::vector<bool> used(shape.corners.size(), false);
  for (const auto& face : shape.faces) {
    for (const int i : face) used[i] = true;
  }
  const auto unused = std::find(used.begin(), used.end(), false) - used.begin();
  if (unused < static_cast<std::ptrdiff_t>(used.size())) {
    polyhedron.fault = "corner " + std::to_string(unused) + " in the hull of the others";
    return polyhedron;
  }
  AddEdges(shape);
  return polyhedron;
}

MassPropertiesInSpace MassPropertiesOf(const std::vector<ShapeInSpace<Exact>>& shapes) {
  Moments sum;
  for (const auto& shape : shapes) {
    if (shape.IsBall()) {
      AddBall(sum, shape);
    } else {
      AddPolyhedron(sum, shape);
    }
  }
  MassPropertiesInSpace properties;
  properties.volume = sum.volume;
  const Exact trace = sum.second.trace();
  for (int k = 0; k < 3; ++k) {
    if (sum.volume != 0) properties.center[k] = sum.first[k] / sum.volume;
    for (int l = 0; l < 3; ++l) properties.inertia(k, l) = (k == l ? trace : Exact(0)) - sum.second(k, l);
  }
  return properties;
}

namespace {

ShapeInSpace<double> Round(const ShapeInSpace<Exact>& shape) {
  ShapeInSpace<double> rounded;
  for (const auto& corner : shape.corners) rounded.corners.push_back(NearestVector(corner));
  for (const auto& normal : shape.normals) rounded.normals.push_back(NearestVector(normal));
  rounded.faces = shape.faces;
  rounded.edges = shape.edges;
  rounded.center = NearestVector(shape.center);
  rounded.radius = Nearest(shape.radius);
  return rounded;
}

Quaternion<double> NearestRotation(const Quaternion<Exact>& rotation) {
  Quaternion<double> nearest;
  for (int i = 0; i < 4; ++i) nearest[i] = Nearest(rotation[i]);
  return nearest.normalized();
}

BodyInSpace<double> Round(const BodyInSpace<Exact>& body) {
  BodyInSpace<double> rounded;
  rounded.name = body.name;
  rounded.fixed = body.fixed;
  rounded.mass = Nearest(body.mass);
  for (int i = 0; i < 9; ++i) rounded.inertia(i % 3, i / 3) = Nearest(body.inertia(i % 3, i / 3));
  rounded.position = NearestVector(body.position);
  rounded.rotation = NearestRotation(body.rotation);
  rounded.velocity = NearestVector(body.velocity);
  rounded.spin = NearestVector(body.spin);
  rounded.acceleration = NearestVector(body.acceleration);
  rounded.force = NearestVector(body.force);
  rounded.torque = NearestVector(body.torque);
  rounded.level = body.level;
  for (const auto& shape : body.shapes) rounded.shapes.push_back(Round(shape));
  return rounded;
}

}  // namespace

SceneInSpace<double> Round(const SceneInSpace<Exact>& scene) {
  SceneInSpace<double> rounded;
  rounded.name = scene.name;
  rounded.gravity = NearestVector(scene.gravity);
  rounded.mu = Nearest(scene.mu);
  rounded.gap = Nearest(scene.gap);
  rounded.rest = Nearest(scene.rest);
  for (const auto& body : scene.bodies) rounded.bodies.push_back(Round(body));
  for (const auto& joint : scene.joints) {
    rounded.joints.push_back({joint.kind, joint.a, joint.b, NearestVector(joint.at_a),
                              NearestVector(joint.at_b), NearestVector(joint.direction),
                              NearestRotation(joint.relative_rotation)});
  }
  for (const auto& given : scene.contacts) {
    rounded.contacts.push_back(
        {given.a, given.b, NearestVector(given.at_a), NearestVector(given.at_b), NearestVector(given.normal)});
  }
  for (const auto& pair : scene.pairs) rounded.pairs.push_back(Round(pair));
  return rounded;
}

}  // namespace stiction
