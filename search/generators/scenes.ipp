// SPDX-License-Identifier: Apache-2.0
// The bodies of a design (scenes.h) over any scalar.

#pragma once

#include <algorithm>

#include "search/generators/scenes.h"

namespace stiction {

template <class Scalar>
Scalar Value(const SmallFraction& ratio) {
  return Scalar(ratio.numerator) / Scalar(ratio.denominator);
}

// N / abs(N).
template <class Scalar>
Vector2<Scalar> NormalOf(const SceneLine& line) {
  const Scalar length(line.length);
  return MakeVector2<Scalar>(Scalar(line.nx) / length, Scalar(line.ny) / length);
}

// The point t of a line, in metres.
template <class Scalar>
Vector2<Scalar> PointOf(const SceneLine& line, const Scalar& t) {
  return MakeVector2<Scalar>(Scalar(Scalar(line.x) - t * Scalar(line.ny)) / Scalar(line.unit),
                             Scalar(Scalar(line.y) + t * Scalar(line.nx)) / Scalar(line.unit));
}

// The point after so many parts of an interface.
template <class Scalar>
Vector2<Scalar> PointAt(const SceneDesign& design, const SceneInterface& interface, int parts) {
  const Scalar from = Value<Scalar>(interface.piece.from), to = Value<Scalar>(interface.piece.to);
  const Scalar t = from + (to - from) * Scalar(parts) / Scalar(design.grain.places);
  return PointOf<Scalar>(design.lines[interface.line], t);
}

// Points of a body: corners of its cell, and two at each of at most five interfaces.
template <class Scalar>
struct PointList {
  std::array<Vector2<Scalar>, kSceneLines + 10> points;
  int size = 0;

  void Add(const Vector2<Scalar>& point) { points[size++] = point; }
};

// The convex hull, anticlockwise and strictly convex (Andrew's monotone chain).
template <class Scalar>
PointList<Scalar> ConvexHull(PointList<Scalar> all) {
  const auto before = [](const Vector2<Scalar>& p, const Vector2<Scalar>& q) {
    return p[0] < q[0] || (p[0] == q[0] && p[1] < q[1]);
  };
  std::sort(all.points.begin(), all.points.begin() + all.size, before);
  PointList<Scalar> hull;
  const auto extend = [&hull](const Vector2<Scalar>& point, int least) {
    while (hull.size >= least) {
      const Vector2<Scalar>&last = hull.points[hull.size - 1], &p = hull.points[hull.size - 2];
      if (Cross<Scalar>(last - p, point - last) > 0) break;
      --hull.size;
    }
    hull.Add(point);
  };
  for (int i = 0; i < all.size; ++i) extend(all.points[i], 2);
  const int lower = hull.size + 1;
  for (int i = all.size - 2; i >= 0; --i) extend(all.points[i], lower);
  --hull.size;  // the first point again
  return hull;
}

template <class Scalar>
struct SceneBody {
  PointList<Scalar> polygon;  // in the world
  Vector2<Scalar> center;     // of mass
  Scalar mass, inertia;
  std::array<Scalar, 3> inverse_mass;       // 1/m, 1/m, 1/I
  std::array<Scalar, 3> free_acceleration;  // of the centre along x and y, and angular
};

// Of uniform density.
template <class Scalar>
void SetMass(const Vector2<Scalar>& inside, const SceneCell& cell, SceneBody<Scalar>& body) {
  Scalar area(0), inertia(0);  // twice and twelve times, about `inside`
  Vector2<Scalar> first = MakeVector2<Scalar>(Scalar(0), Scalar(0));
  for (int i = 0; i < body.polygon.size; ++i) {
    const Vector2<Scalar> p = body.polygon.points[i] - inside;
    const Vector2<Scalar> q = body.polygon.points[(i + 1) % body.polygon.size] - inside;
    const Scalar cross = Cross<Scalar>(p, q);
    area += cross;
    for (int k = 0; k < 2; ++k) first[k] += cross * (p[k] + q[k]);
    inertia += cross * (Dot<Scalar>(p, p) + Dot<Scalar>(p, q) + Dot<Scalar>(q, q));
  }
  const Scalar three_areas = Scalar(3) * area;
  const Vector2<Scalar> offset =
      MakeVector2<Scalar>(Scalar(first[0] / three_areas), Scalar(first[1] / three_areas));
  body.center = inside + offset;
  body.mass = Value<Scalar>(cell.mass);
  body.inertia = body.mass * Scalar(inertia / (Scalar(6) * area) - Dot<Scalar>(offset, offset));
  const Scalar inverse = Scalar(1) / body.mass;
  body.inverse_mass = {inverse, inverse, Scalar(Scalar(1) / body.inertia)};
  for (int k = 0; k < 3; ++k) body.free_acceleration[k] = Scalar(cell.load[k]) * body.inverse_mass[k];
  body.free_acceleration[1] -= Scalar(10);
}

template <class Scalar>
SceneBody<Scalar> MakeSceneBody(const SceneDesign& design, int c) {
  const SceneCell& cell = design.cell[c];
  PointList<Scalar> all;
  Vector2<Scalar> mean = MakeVector2<Scalar>(Scalar(0), Scalar(0));
  for (int line = 0; line < kSceneLines; ++line) {
    const auto& edge = cell.edge[line];
    if (!edge) continue;
    // The end where the edge starts, anticlockwise: every corner of the cell once.
    all.Add(PointOf<Scalar>(design.lines[line], Value<Scalar>(cell.side[line] > 0 ? edge->to : edge->from)));
    mean += all.points[all.size - 1];
  }
  for (int k = 0; k < 2; ++k) mean[k] /= Scalar(all.size);
  const Scalar fill = Scalar(cell.fill) / Scalar(design.grain.fill);
  for (int i = 0; i < all.size; ++i) {
    for (int k = 0; k < 2; ++k) all.points[i][k] = Scalar(mean[k] + fill * Scalar(all.points[i][k] - mean[k]));
  }
  for (int i = 0; i < design.interfaces; ++i) {
    const SceneInterface& interface = design.interface[i];
    if (interface.lower != c && interface.upper != c) continue;
    const auto& [first, second] = interface.lower == c ? interface.of_lower : interface.of_upper;
    all.Add(PointAt<Scalar>(design, interface, first));
    if (second != first) all.Add(PointAt<Scalar>(design, interface, second));
  }
  SceneBody<Scalar> body;
  body.polygon = ConvexHull(std::move(all));
  SetMass(mean, cell, body);
  return body;
}

}  // namespace stiction
