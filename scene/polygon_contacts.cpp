// SPDX-License-Identifier: Apache-2.0
// Contacts of polygons and discs, as contacts.h says.

#include <algorithm>
#include <optional>

#include "scene/contacts.ipp"

namespace stiction {
namespace {

template <class Scalar>
using Polygon = PlacedShape<Plane, Scalar>;

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
CarryingEdge<Scalar> EdgeOf(const Polygon<Scalar>& polygon, std::size_t i) {
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
CarryingEdge<Scalar> FarthestEdge(const Polygon<Scalar>& polygon, const std::vector<Vector2<Scalar>>& points,
                                  const Scalar& radius) {
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

}  // namespace

template <class Scalar>
class PairFinder<Plane, Scalar> : public PairFinderOf<PairFinder<Plane, Scalar>, Plane, Scalar> {
 public:
  using Base = PairFinderOf<PairFinder<Plane, Scalar>, Plane, Scalar>;
  using Base::Base;
  using typename Base::Shape;
  using typename Base::Touch;

  void AgainstRound(Touch contact, const Shape& disc, const Shape& polygon) {
    const CarryingEdge<Scalar> edge = FarthestEdge<Scalar>(polygon, {disc.center}, disc.radius());
    if (edge.distance > this->reach_) return;
    const Scalar s = edge.Along(disc.center);
    const std::size_t next = (edge.index + 1) % polygon.corners.size();
    const auto corner = [&](std::size_t i) {
      this->Across(contact, Meeting::kPoint, disc, polygon.corners[i], Scalar(0));
    };
    if (s < 0) return corner(edge.index);
    if (s > edge.length) return corner(next);
    contact.radius_a = disc.radius();
    Add(contact, edge, s, edge.distance);
  }

  void Cornered(const Shape& P, const Shape& Q) {
    const CarryingEdge<Scalar> on_p = FarthestEdge<Scalar>(P, Q.corners, Scalar(0));
    const CarryingEdge<Scalar> on_q = FarthestEdge<Scalar>(Q, P.corners, Scalar(0));
    if (on_q.distance > on_p.distance + this->Preference()) {
      Clip(this->pattern_, on_q, P);
    } else {
      Clip(this->Swapped(), on_p, Q);
    }
  }

 private:
  // The edge of `other` that faces the carrying edge, as far as it is opposite to it.
  void Clip(const Touch& contact, const CarryingEdge<Scalar>& edge, const Shape& other) {
    if (edge.distance > this->reach_) return;
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
  void AddCorner(const Touch& contact, const CarryingEdge<Scalar>& edge, const Scalar& s0, const Scalar& h0,
                 const Scalar& s1, const Scalar& h1) {
    if (s1 < 0 && -s1 <= this->gap_) Add(contact, edge, s1, h1);
    if (s0 > edge.length && s0 - edge.length <= this->gap_) Add(contact, edge, s0, h0);
  }

  void Add(Touch contact, const CarryingEdge<Scalar>& edge, const Scalar& s, const Scalar& height) {
    contact.point = edge.Point(s);
    contact.normal = edge.normal;
    contact.gap = height;
    this->Keep(contact);
  }
};

template std::vector<TouchPoint<double>> FindContacts(const Scene<double>&, const double&);
template std::vector<TouchPoint<mpq_class>> FindContacts(const Scene<mpq_class>&, const mpq_class&);

}  // namespace stiction
