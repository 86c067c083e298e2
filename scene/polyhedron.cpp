// SPDX-License-Identifier: Apache-2.0
#include "scene/polyhedron.h"

#include <CGAL/Cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/mpq_class.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

namespace stiction {
namespace {

using Exact = mpq_class;
using Kernel = CGAL::Cartesian<Exact>;
using Point = Kernel::Point_3;
using Vector = Vector3<Exact>;

Point ToPoint(const Vector& v) { return {v[0], v[1], v[2]}; }

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
    shape.normals.push_back(UnitVector(normal));
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
  Vector first = Zero<Vector>();
  Matrix3<Exact> second = Zero<Matrix3<Exact>>();
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

MassPropertiesIn<Space> MassPropertiesOf(const std::vector<ShapeInSpace<Exact>>& shapes) {
  Moments sum;
  for (const auto& shape : shapes) {
    if (shape.IsRound()) {
      AddBall(sum, shape);
    } else {
      AddPolyhedron(sum, shape);
    }
  }
  MassPropertiesIn<Space> properties;
  properties.mass = sum.volume;
  const Exact trace = sum.second.trace();
  for (int k = 0; k < 3; ++k) {
    if (sum.volume != 0) properties.center[k] = sum.first[k] / sum.volume;
    for (int l = 0; l < 3; ++l) properties.inertia(k, l) = (k == l ? trace : Exact(0)) - sum.second(k, l);
  }
  return properties;
}

}  // namespace stiction
