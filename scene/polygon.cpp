// SPDX-License-Identifier: Apache-2.0
#include "scene/polygon.h"

#include <CGAL/Cartesian.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/mpq_class.h>

#include <numbers>

namespace stiction {
namespace {

using Exact = mpq_class;
using Kernel = CGAL::Cartesian<Exact>;

void AddPolygon(MassPropertiesIn<Plane>& sum, const std::vector<Vector2<Exact>>& polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2<Exact>&p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Exact cross = Cross<Exact>(p, q);
    sum.mass += cross / 2;
    for (int k = 0; k < 2; ++k) sum.center[k] += cross * (p[k] + q[k]) / 6;
    sum.inertia += cross * (Dot<Exact>(p, p) + Dot<Exact>(p, q) + Dot<Exact>(q, q)) / 12;
  }
}

void AddDisc(MassPropertiesIn<Plane>& sum, const BodyShape<Exact>& disc) {
  const Exact square = disc.radius * disc.radius;
  const Exact area = Exact(std::numbers::pi) * square;
  sum.mass += area;
  for (int k = 0; k < 2; ++k) sum.center[k] += area * disc.center[k];
  sum.inertia += area * (square / 2 + Dot<Exact>(disc.center, disc.center));
}

}  // namespace

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

MassPropertiesIn<Plane> MassPropertiesOf(const std::vector<BodyShape<Exact>>& shapes) {
  MassPropertiesIn<Plane> sum;
  for (const auto& shape : shapes) {
    if (shape.IsRound()) {
      AddDisc(sum, shape);
    } else {
      AddPolygon(sum, shape.corners);
    }
  }
  for (int k = 0; sum.mass != 0 && k < 2; ++k) sum.center[k] /= sum.mass;
  return sum;
}

}  // namespace stiction
