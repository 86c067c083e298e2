// SPDX-License-Identifier: Apache-2.0
// Contacts of polyhedra and balls, as contacts.h says.

#include <algorithm>
#include <optional>

#include "scene/contacts.ipp"

namespace stiction {
namespace {

template <class Scalar>
using Placed = PlacedShape<Space, Scalar>;

template <class Scalar>
Vector3<Scalar> Along(const Placed<Scalar>& P, const PolyhedronEdge& edge) {
  return P.corners[edge.to] - P.corners[edge.from];
}

// Of p, on the outer side of the plane of a face.
template <class Scalar>
Scalar Height(const Placed<Scalar>& P, int face, const Vector3<Scalar>& p) {
  return P.normals[face].dot(p - P.corners[P.shape->faces[face][0]]);
}

// A face of a polyhedron, and how far another is outside of it.
template <class Scalar>
struct CarryingFace {
  int face = 0;
  Scalar distance = Scalar(0);
};

template <class Scalar>
CarryingFace<Scalar> FarthestFace(const Placed<Scalar>& P, const Placed<Scalar>& other) {
  std::optional<CarryingFace<Scalar>> farthest;
  for (int f = 0; f < static_cast<int>(P.normals.size()); ++f) {
    Scalar distance = Height(P, f, other.corners[0]);
    for (const auto& corner : other.corners) distance = std::min<Scalar>(distance, Height(P, f, corner));
    if (!farthest || distance > farthest->distance) farthest = CarryingFace<Scalar>{f, distance};
  }
  return *farthest;
}

// Two edges, and their distance along the normal, which points out of the first's polyhedron.
template <class Scalar>
struct CrossingEdges {
  PolyhedronEdge first, second;
  Vector3<Scalar> normal;
  Scalar distance = Scalar(0);
  Scalar at = Scalar(0);  // where they are nearest: at this part of the first
};

// Whether the edges can touch: the arc between the normals of one's faces, and the opposite of that between the
// other's, cross on the unit sphere.
template <class Scalar>
bool CanCross(const Placed<Scalar>& P, const PolyhedronEdge& p, const Placed<Scalar>& Q,
              const PolyhedronEdge& q, const Vector3<Scalar>& along_p, const Vector3<Scalar>& along_q) {
  const Scalar left_q = along_p.dot(Q.normals[q.left]), right_q = along_p.dot(Q.normals[q.right]);
  if (Sign(left_q) * Sign(right_q) >= 0) return false;
  const Scalar left_p = along_q.dot(P.normals[p.left]), right_p = along_q.dot(P.normals[p.right]);
  if (Sign(left_p) * Sign(right_p) >= 0) return false;
  // Each arc has one of +-(along_p x along_q), the sign of which is that of `left`, as left x right is along
  // the edge: it must be the same.
  return Sign(left_q) == Sign(left_p);
}

template <class Scalar>
struct FarthestEdges {
  std::optional<CrossingEdges<Scalar>> crossing;  // of those that are nearest between their ends
  std::optional<Scalar> apart;                    // the distance of all
};

template <class Scalar>
FarthestEdges<Scalar> FindFarthestEdges(const Placed<Scalar>& P, const Placed<Scalar>& Q) {
  FarthestEdges<Scalar> farthest;
  for (const auto& p : P.shape->edges) {
    const Vector3<Scalar> along_p = Along(P, p);
    for (const auto& q : Q.shape->edges) {
      const Vector3<Scalar> along_q = Along(Q, q);
      if (!CanCross<Scalar>(P, p, Q, q, along_p, along_q)) continue;
      const Vector3<Scalar> across = CrossProduct<Scalar>(along_p, along_q);
      const Scalar square = across.squaredNorm();
      // Edges that are nearly parallel leave their normal to rounding; faces stand in for them.
      const Scalar least =
          kIsExact<Scalar> ? Scalar(0) : Scalar(1e-8 * along_p.squaredNorm() * along_q.squaredNorm());
      if (square <= least) continue;
      const Scalar outward = across.dot(P.normals[p.left]) + across.dot(P.normals[p.right]);
      Vector3<Scalar> normal = UnitVector(across);
      if (outward < 0) normal = -normal;
      const Vector3<Scalar> between = Q.corners[q.from] - P.corners[p.from];
      const Scalar distance = normal.dot(between);
      if (!farthest.apart || distance > *farthest.apart) farthest.apart = distance;
      if (farthest.crossing && distance <= farthest.crossing->distance) continue;
      const Scalar at_p = CrossProduct<Scalar>(between, along_q).dot(across) / square;
      const Scalar at_q = CrossProduct<Scalar>(between, along_p).dot(across) / square;
      if (at_p < 0 || at_p > 1 || at_q < 0 || at_q > 1) continue;
      farthest.crossing = CrossingEdges<Scalar>{p, q, normal, distance, at_p};
    }
  }
  return farthest;
}

// The part of a polygon on the inner side of the plane through q.
template <class Scalar>
std::vector<Vector3<Scalar>> Clipped(const std::vector<Vector3<Scalar>>& polygon, const Vector3<Scalar>& q,
                                     const Vector3<Scalar>& inward) {
  std::vector<Vector3<Scalar>> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3<Scalar>&from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const Scalar s0 = inward.dot(from - q), s1 = inward.dot(to - q);
    if (s0 >= 0) kept.push_back(from);
    if (Sign(s0) * Sign(s1) < 0) kept.push_back(from + Scalar(s0 / (s0 - s1)) * (to - from));
  }
  return kept;
}

}  // namespace

template <class Scalar>
class PairFinder<Space, Scalar> : public PairFinderOf<PairFinder<Space, Scalar>, Space, Scalar> {
 public:
  using Base = PairFinderOf<PairFinder<Space, Scalar>, Space, Scalar>;
  using Base::Base;
  using typename Base::Shape;
  using typename Base::Touch;

  // The nearest point may be on any face, edge or corner: outside, the centre need not be over the face that it
  // is highest above.
  void AgainstRound(const Touch& contact, const Shape& ball, const Shape& polyhedron) {
    int highest = 0;
    const int faces = static_cast<int>(polyhedron.normals.size());
    const auto height = [&](int f) { return Height(polyhedron, f, ball.center); };
    for (int f = 1; f < faces; ++f) {
      if (height(f) > height(highest)) highest = f;
    }
    if (height(highest) - ball.radius() > this->reach_) return;
    if (height(highest) <= 0) return BallFace(contact, ball, polyhedron, highest);
    for (int f = 0; f < faces; ++f) {
      if (height(f) > 0 && IsOver(polyhedron, f, ball.center)) return BallFace(contact, ball, polyhedron, f);
    }
    BallEdges(contact, ball, polyhedron);
  }

  void BallFace(Touch contact, const Shape& ball, const Shape& polyhedron, int face) {
    const Scalar height = Height(polyhedron, face, ball.center);
    contact.radius_a = ball.radius();
    contact.gap = height - contact.radius_a;
    contact.normal = polyhedron.normals[face];
    contact.point = ball.center - height * contact.normal;
    this->Keep(contact);
  }

  // Whether p is within the sides of a face, along its normal.
  static bool IsOver(const Shape& polyhedron, int face, const Vector3<Scalar>& p) {
    const auto& loop = polyhedron.shape->faces[face];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector3<Scalar>&from = polyhedron.corners[loop[i]],
            &to = polyhedron.corners[loop[(i + 1) % loop.size()]];
      if (CrossProduct<Scalar>(polyhedron.normals[face], to - from).dot(p - from) < 0) return false;
    }
    return true;
  }

  void BallEdges(Touch contact, const Shape& ball, const Shape& polyhedron) {
    std::optional<Scalar> least;
    Meeting meeting = Meeting::kPoint;
    Vector3<Scalar> nearest = Zero<Vector3<Scalar>>();
    for (const auto& edge : polyhedron.shape->edges) {
      const Vector3<Scalar> along = Along(polyhedron, edge), &from = polyhedron.corners[edge.from];
      const Scalar at = along.dot(ball.center - from) / along.squaredNorm();
      const Vector3<Scalar> p = from + std::clamp<Scalar>(at, Scalar(0), Scalar(1)) * along;
      const Scalar square = (ball.center - p).squaredNorm();
      if (least && square >= *least) continue;
      least = square;
      nearest = p;
      meeting = at > 0 && at < 1 ? Meeting::kEdge : Meeting::kPoint;
      contact.edge_b = along;
    }
    this->Across(contact, meeting, ball, nearest, Scalar(0));
  }

  void Cornered(const Shape& P, const Shape& Q) {
    const CarryingFace<Scalar> on_p = FarthestFace<Scalar>(P, Q), on_q = FarthestFace<Scalar>(Q, P);
    if (on_p.distance > this->reach_ || on_q.distance > this->reach_) return;
    const Scalar preference = this->Preference();
    const FarthestEdges<Scalar> edges = FindFarthestEdges<Scalar>(Q, P);
    const Scalar face_distance = std::max<Scalar>(on_p.distance, on_q.distance);
    if (edges.apart && *edges.apart > this->reach_) return;
    if (edges.crossing && edges.crossing->distance > face_distance + preference)
      return Edges(*edges.crossing, P, Q);
    // Edges part them that do not cross: corners pass each other, and what faces say of an overlap is not so.
    if (edges.apart && *edges.apart > preference && face_distance < -preference) return;
    if (on_q.distance + preference >= on_p.distance) {
      Clip(this->pattern_, Q, on_q.face, P);
    } else {
      Clip(this->Swapped(), P, on_p.face, Q);
    }
  }

  void Edges(const CrossingEdges<Scalar>& edges, const Shape& P, const Shape& Q) {
    Touch contact = this->pattern_;
    contact.meeting = Meeting::kEdges;
    contact.edge_a = Along(P, edges.second);
    contact.edge_b = Along(Q, edges.first);
    contact.normal = edges.normal;
    contact.gap = edges.distance;
    contact.point = Q.corners[edges.first.from] + edges.at * contact.edge_b;
    this->found_.push_back(contact);
  }

  // The face of `other` that faces the carrying one, as far as it is opposite to it.
  void Clip(Touch contact, const Shape& carrier, int face, const Shape& other) {
    const Vector3<Scalar>& normal = carrier.normals[face];
    int facing = 0;
    for (int f = 1; f < static_cast<int>(other.normals.size()); ++f) {
      if (normal.dot(other.normals[f]) < normal.dot(other.normals[facing])) facing = f;
    }
    std::vector<Vector3<Scalar>> polygon;
    for (const int i : other.shape->faces[facing]) polygon.push_back(other.corners[i]);
    const auto& loop = carrier.shape->faces[face];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector3<Scalar>&from = carrier.corners[loop[i]], &to = carrier.corners[loop[(i + 1) % loop.size()]];
      polygon = Clipped<Scalar>(polygon, from, CrossProduct<Scalar>(normal, to - from));
    }
    contact.normal = normal;
    const std::size_t first = this->found_.size();
    for (const auto& corner : polygon) {
      contact.gap = Height(carrier, face, corner);
      contact.point = corner - contact.gap * normal;
      if (contact.gap <= this->reach_ && IsNew(first, contact.point)) this->found_.push_back(contact);
    }
  }

  // Clipping can cut a corner off by no more than rounding.
  bool IsNew(std::size_t first, const Vector3<Scalar>& point) const {
    const Scalar near = kIsExact<Scalar> ? Scalar(0) : Scalar(this->gap_ / 1000);
    return std::none_of(this->found_.begin() + static_cast<std::ptrdiff_t>(first), this->found_.end(),
                        [&](const Touch& known) { return (known.point - point).squaredNorm() <= near * near; });
  }
};

template std::vector<TouchPointInSpace<double>> FindContacts(const SceneInSpace<double>&, const double&);
template std::vector<TouchPointInSpace<mpq_class>> FindContacts(const SceneInSpace<mpq_class>&,
                                                                const mpq_class&);

}  // namespace stiction
