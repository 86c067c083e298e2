// SPDX-License-Identifier: Apache-2.0
#include "scene/contacts.h"

#include <algorithm>
#include <array>
#include <optional>

#include "scene/pair_facts.h"

namespace stiction {
namespace {

// A shape where its body is.
template <class Scalar>
struct PlacedShape {
  std::vector<Vector2<Scalar>> corners;  // empty: a disc
  Vector2<Scalar> center;
  Scalar radius = Scalar(0);
  Vector2<Scalar> low, high;  // bounding box
};

template <class Scalar>
PlacedShape<Scalar> Place(const RigidBody<Scalar>& body, const BodyShape<Scalar>& shape) {
  PlacedShape<Scalar> placed;
  placed.radius = shape.radius;
  placed.center = body.At(shape.center);
  placed.corners.reserve(shape.polygon.size());
  for (const auto& corner : shape.polygon) placed.corners.push_back(body.At(corner));
  const bool disc = shape.IsDisc();
  placed.low = placed.high = disc ? placed.center : placed.corners[0];
  for (const auto& corner : placed.corners) {
    for (int i = 0; i < 2; ++i) {
      placed.low[i] = std::min<Scalar>(placed.low[i], corner[i]);
      placed.high[i] = std::max<Scalar>(placed.high[i], corner[i]);
    }
  }
  for (int i = 0; disc && i < 2; ++i) {
    placed.low[i] -= placed.radius;
    placed.high[i] += placed.radius;
  }
  return placed;
}

// An edge of a polygon: the line q + s t, and the distance of something on its outer side.
template <class Scalar>
struct CarryingEdge {
  Vector2<Scalar> start, tangent, normal;
  Scalar length = Scalar(0), distance = Scalar(0);
  std::size_t index = 0;

  Scalar Height(const Vector2<Scalar>& p) const { return Dot<Scalar>(normal, p - start); }
  Scalar Along(const Vector2<Scalar>& p) const { return Dot<Scalar>(tangent, p - start); }
  Vector2<Scalar> Point(const Scalar& s) const { return start + s * tangent; }
};

template <class Scalar>
CarryingEdge<Scalar> EdgeOf(const PlacedShape<Scalar>& polygon, std::size_t i) {
  CarryingEdge<Scalar> edge;
  edge.index = i;
  edge.start = polygon.corners[i];
  const Vector2<Scalar> along = polygon.corners[(i + 1) % polygon.corners.size()] - edge.start;
  edge.tangent = UnitVector<Scalar>(along);
  edge.normal = MakeVector2<Scalar>(edge.tangent[1], Scalar(-edge.tangent[0]));
  edge.length = Dot<Scalar>(edge.tangent, along);
  return edge;
}

// The edge of the polygon that `points`, less a radius, are farthest outside of.
template <class Scalar>
CarryingEdge<Scalar> FarthestEdge(const PlacedShape<Scalar>& polygon,
                                  const std::vector<Vector2<Scalar>>& points, const Scalar& radius) {
  std::optional<CarryingEdge<Scalar>> farthest;
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    CarryingEdge<Scalar> edge = EdgeOf(polygon, i);
    edge.distance = edge.Height(points[0]) - radius;
    for (const auto& point : points)
      edge.distance = std::min<Scalar>(edge.distance, edge.Height(point) - radius);
    if (!farthest || edge.distance > farthest->distance) farthest = edge;
  }
  return *farthest;
}

template <class Scalar>
class PairFinder {
 public:
  PairFinder(const Scalar& gap, const Scalar& margin, TouchPoint<Scalar> pattern,
             std::vector<TouchPoint<Scalar>>& found)
      : gap_(gap), reach_(gap + margin), pattern_(std::move(pattern)), found_(found) {}

  // P belongs to the pattern's a, Q to its b.
  void Find(const PlacedShape<Scalar>& P, const PlacedShape<Scalar>& Q) {
    for (int i = 0; i < 2; ++i) {
      if (P.low[i] - Q.high[i] > reach_ || Q.low[i] - P.high[i] > reach_) return;
    }
    const bool disc_p = P.corners.empty(), disc_q = Q.corners.empty();
    if (disc_p && disc_q) return Round(pattern_, P.center, P.radius, Q.center, Q.radius);
    if (disc_p) return PolygonDisc(pattern_, P, Q);
    if (disc_q) return PolygonDisc(Swapped(), Q, P);
    PolygonPolygon(P, Q);
  }

 private:
  TouchPoint<Scalar> Swapped() const {
    TouchPoint<Scalar> swapped = pattern_;
    std::swap(swapped.a, swapped.b);
    std::swap(swapped.shape_a, swapped.shape_b);
    return swapped;
  }

  void Round(TouchPoint<Scalar> contact, const Vector2<Scalar>& center_a, const Scalar& radius_a,
             const Vector2<Scalar>& center_b, const Scalar& radius_b) {
    Vector2<Scalar> apart = center_a - center_b;
    const bool concentric = Sign(apart[0]) == 0 && Sign(apart[1]) == 0;
    if (concentric) apart[1] = Scalar(1);  // any direction parts them
    contact.gap = (concentric ? Scalar(0) : Length<Scalar>(apart)) - radius_a - radius_b;
    if (contact.gap > reach_) return;
    contact.normal = UnitVector<Scalar>(apart);
    contact.point = center_b + radius_b * contact.normal;
    contact.radius_a = radius_a;
    contact.radius_b = radius_b;
    contact.flat_b = false;
    found_.push_back(contact);
  }

  void PolygonDisc(TouchPoint<Scalar> contact, const PlacedShape<Scalar>& disc,
                   const PlacedShape<Scalar>& polygon) {
    const CarryingEdge<Scalar> edge = FarthestEdge<Scalar>(polygon, {disc.center}, disc.radius);
    if (edge.distance > reach_) return;
    const Scalar s = edge.Along(disc.center);
    const std::size_t next = (edge.index + 1) % polygon.corners.size();
    if (s < 0) return Round(contact, disc.center, disc.radius, polygon.corners[edge.index], Scalar(0));
    if (s > edge.length) return Round(contact, disc.center, disc.radius, polygon.corners[next], Scalar(0));
    contact.radius_a = disc.radius;
    Add(contact, edge, s, edge.distance);
  }

  void PolygonPolygon(const PlacedShape<Scalar>& P, const PlacedShape<Scalar>& Q) {
    const CarryingEdge<Scalar> on_p = FarthestEdge<Scalar>(P, Q.corners, Scalar(0));
    const CarryingEdge<Scalar> on_q = FarthestEdge<Scalar>(Q, P.corners, Scalar(0));
    // Over doubles rounding must not choose from frame to frame.
    const Scalar preference = kIsExact<Scalar> ? Scalar(0) : Scalar(gap_ / 16);
    if (on_q.distance > on_p.distance + preference) {
      Clip(pattern_, on_q, P);
    } else {
      Clip(Swapped(), on_p, Q);
    }
  }

  // The edge of `other` that faces the carrying edge, as far as it is opposite to it.
  void Clip(const TouchPoint<Scalar>& contact, const CarryingEdge<Scalar>& edge,
            const PlacedShape<Scalar>& other) {
    if (edge.distance > reach_) return;
    std::size_t facing = 0;
    std::optional<Scalar> least;
    for (std::size_t i = 0; i < other.corners.size(); ++i) {
      const Scalar against = Dot<Scalar>(edge.normal, EdgeOf(other, i).normal);
      if (!least || against < *least) facing = i, least = against;
    }
    // Along the carrying edge the facing one runs backwards.
    const Vector2<Scalar>& p0 = other.corners[(facing + 1) % other.corners.size()];
    const Vector2<Scalar>& p1 = other.corners[facing];
    const Scalar s0 = edge.Along(p0), s1 = edge.Along(p1), h0 = edge.Height(p0), h1 = edge.Height(p1);
    const Scalar from = std::max<Scalar>(Scalar(0), s0), to = std::min<Scalar>(edge.length, s1);
    if (from > to) return AddCorner(contact, edge, s0, h0, s1, h1);
    const auto height = [&](const Scalar& s) {
      return s1 > s0 ? Scalar(h0 + (h1 - h0) * ((s - s0) / (s1 - s0))) : std::min<Scalar>(h0, h1);
    };
    Add(contact, edge, from, height(from));
    if (to > from) Add(contact, edge, to, height(to));
  }

  // Nothing is opposite: the nearer end, if it is beyond the edge by no more than the gap.
  void AddCorner(const TouchPoint<Scalar>& contact, const CarryingEdge<Scalar>& edge, const Scalar& s0,
                 const Scalar& h0, const Scalar& s1, const Scalar& h1) {
    if (s1 < 0 && -s1 <= gap_) Add(contact, edge, s1, h1);
    if (s0 > edge.length && s0 - edge.length <= gap_) Add(contact, edge, s0, h0);
  }

  void Add(TouchPoint<Scalar> contact, const CarryingEdge<Scalar>& edge, const Scalar& s,
           const Scalar& height) {
    if (height > reach_) return;
    contact.point = edge.Point(s);
    contact.normal = edge.normal;
    contact.gap = height;
    contact.flat_b = true;
    found_.push_back(contact);
  }

  Scalar gap_, reach_;
  TouchPoint<Scalar> pattern_;
  std::vector<TouchPoint<Scalar>>& found_;
};

template <class Scalar>
TouchPoint<Scalar> Given(const Scene<Scalar>& scene, const Scalar& mu, const GivenContact<Scalar>& given) {
  const RigidBody<Scalar>&a = scene.bodies[given.a], &b = scene.bodies[given.b];
  TouchPoint<Scalar> contact;
  contact.a = given.a;
  contact.b = given.b;
  contact.mu = mu;
  contact.normal = Rotate<Scalar>(b.rotation, given.normal);
  const Vector2<Scalar> p = a.At(given.at_a), q = b.At(given.at_b);
  contact.gap = Dot<Scalar>(contact.normal, p - q);
  contact.point = p - contact.gap * contact.normal;
  return contact;
}

}  // namespace

template <class Scalar>
std::vector<TouchPoint<Scalar>> FindContacts(const Scene<Scalar>& scene, const Scalar& margin) {
  std::vector<TouchPoint<Scalar>> found;
  const PairTable table(scene);
  for (const auto& given : scene.contacts)
    found.push_back(Given<Scalar>(scene, table.Of(given.a, given.b).mu, given));
  const int bodies = static_cast<int>(scene.bodies.size());
  std::vector<std::vector<PlacedShape<Scalar>>> placed(bodies);
  for (int a = 0; a < bodies; ++a) {
    placed[a].reserve(scene.bodies[a].shapes.size());
    for (const auto& shape : scene.bodies[a].shapes) placed[a].push_back(Place(scene.bodies[a], shape));
  }
  const auto find = [&](const auto& pattern, const auto& a, const auto& b) {
    PairFinder<Scalar>(scene.gap, margin, pattern, found).Find(a, b);
  };
  ForEachPair<TouchPoint<Scalar>>(table, placed, Scalar(scene.gap + margin), find);
  return found;
}

template std::vector<TouchPoint<double>> FindContacts(const Scene<double>&, const double&);
template std::vector<TouchPoint<mpq_class>> FindContacts(const Scene<mpq_class>&, const mpq_class&);

}  // namespace stiction
