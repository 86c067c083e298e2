// SPDX-License-Identifier: Apache-2.0
#include "scene/contacts_space.h"

#include <algorithm>
#include <optional>

#include "scene/pair_facts.h"

namespace stiction {
namespace {

// A shape where its body is.
template <class Scalar>
struct PlacedShape {
  const ShapeInSpace<Scalar>* shape;
  std::vector<Vector3<Scalar>> corners, normals;
  Vector3<Scalar> center = Zero3<Scalar>();  // of a ball; of a polyhedron the mean of its corners
  Vector3<Scalar> low, high;                 // bounding box

  bool IsBall() const { return shape->IsBall(); }
  Vector3<Scalar> Along(const PolyhedronEdge& edge) const { return corners[edge.to] - corners[edge.from]; }
  // On the outer side of the plane of a face.
  Scalar Height(int face, const Vector3<Scalar>& p) const {
    return normals[face].dot(p - corners[shape->faces[face][0]]);
  }
};

template <class Scalar>
PlacedShape<Scalar> Place(const BodyInSpace<Scalar>& body, const Matrix3<Scalar>& R,
                          const ShapeInSpace<Scalar>& shape) {
  PlacedShape<Scalar> placed;
  placed.shape = &shape;
  placed.corners.reserve(shape.corners.size());
  placed.normals.reserve(shape.normals.size());
  for (const auto& corner : shape.corners) placed.corners.push_back(body.position + R * corner);
  for (const auto& normal : shape.normals) placed.normals.push_back(R * normal);
  if (shape.IsBall()) {
    placed.center = body.position + R * shape.center;
    placed.low = placed.center - Vector3<Scalar>::Constant(shape.radius);
    placed.high = placed.center + Vector3<Scalar>::Constant(shape.radius);
    return placed;
  }
  placed.low = placed.high = placed.corners[0];
  for (const auto& corner : placed.corners) {
    placed.center += corner;
    for (int i = 0; i < 3; ++i) {
      placed.low[i] = std::min<Scalar>(placed.low[i], corner[i]);
      placed.high[i] = std::max<Scalar>(placed.high[i], corner[i]);
    }
  }
  placed.center /= Scalar(static_cast<int>(placed.corners.size()));
  return placed;
}

// A face of a polyhedron, and how far another is outside of it.
template <class Scalar>
struct CarryingFace {
  int face = 0;
  Scalar distance = Scalar(0);
};

template <class Scalar>
CarryingFace<Scalar> FarthestFace(const PlacedShape<Scalar>& P, const PlacedShape<Scalar>& other) {
  std::optional<CarryingFace<Scalar>> farthest;
  for (int f = 0; f < static_cast<int>(P.normals.size()); ++f) {
    Scalar distance = P.Height(f, other.corners[0]);
    for (const auto& corner : other.corners) distance = std::min<Scalar>(distance, P.Height(f, corner));
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
bool CanCross(const PlacedShape<Scalar>& P, const PolyhedronEdge& p, const PlacedShape<Scalar>& Q,
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
FarthestEdges<Scalar> FindFarthestEdges(const PlacedShape<Scalar>& P, const PlacedShape<Scalar>& Q) {
  FarthestEdges<Scalar> farthest;
  for (const auto& p : P.shape->edges) {
    const Vector3<Scalar> along_p = P.Along(p);
    for (const auto& q : Q.shape->edges) {
      const Vector3<Scalar> along_q = Q.Along(q);
      if (!CanCross<Scalar>(P, p, Q, q, along_p, along_q)) continue;
      const Vector3<Scalar> across = CrossProduct<Scalar>(along_p, along_q);
      const Scalar square = across.squaredNorm();
      // Edges that are nearly parallel leave their normal to rounding; faces stand in for them.
      const Scalar least =
          kIsExact<Scalar> ? Scalar(0) : Scalar(1e-8 * along_p.squaredNorm() * along_q.squaredNorm());
      if (square <= least) continue;
      const Scalar outward = across.dot(P.normals[p.left]) + across.dot(P.normals[p.right]);
      Vector3<Scalar> normal = UnitVector3<Scalar>(across);
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

template <class Scalar>
class PairFinder {
 public:
  using Touch = TouchPointInSpace<Scalar>;
  using Shape = PlacedShape<Scalar>;

  PairFinder(const Scalar& gap, const Scalar& margin, Touch pattern, std::vector<Touch>& found)
      : gap_(gap), reach_(gap + margin), pattern_(std::move(pattern)), found_(found) {}

  // P belongs to the pattern's a, Q to its b.
  void Find(const Shape& P, const Shape& Q) {
    for (int i = 0; i < 3; ++i) {
      if (P.low[i] - Q.high[i] > reach_ || Q.low[i] - P.high[i] > reach_) return;
    }
    if (P.IsBall() && Q.IsBall()) return Round(pattern_, P, Q.center, Q.shape->radius);
    if (P.IsBall()) return BallPolyhedron(pattern_, P, Q);
    if (Q.IsBall()) return BallPolyhedron(Swapped(), Q, P);
    Polyhedra(P, Q);
  }

 private:
  Touch Swapped() const {
    Touch swapped = pattern_;
    std::swap(swapped.a, swapped.b);
    std::swap(swapped.shape_a, swapped.shape_b);
    return swapped;
  }

  // A ball against a ball or a corner.
  void Round(Touch contact, const Shape& ball, const Vector3<Scalar>& center_b, const Scalar& radius_b) {
    contact.meeting = Meeting::kPoint;
    contact.radius_b = radius_b;
    Across(contact, ball, center_b);
  }

  // The normal is from `origin` to the ball's centre.
  void Across(Touch contact, const Shape& ball, const Vector3<Scalar>& origin) {
    Vector3<Scalar> apart = ball.center - origin;
    const bool concentric = Sign<Scalar>(apart.squaredNorm()) == 0;
    if (concentric) apart[2] = Scalar(1);  // any direction parts them
    contact.radius_a = ball.shape->radius;
    contact.gap = (concentric ? Scalar(0) : Length3<Scalar>(apart)) - contact.radius_a - contact.radius_b;
    contact.normal = UnitVector3<Scalar>(apart);
    contact.point = origin + contact.radius_b * contact.normal;
    if (contact.gap <= reach_) found_.push_back(contact);
  }

  // The nearest point may be on any face, edge or corner: outside, the centre need not be over the face that it
  // is highest above.
  void BallPolyhedron(const Touch& contact, const Shape& ball, const Shape& polyhedron) {
    int highest = 0;
    const int faces = static_cast<int>(polyhedron.normals.size());
    const auto height = [&](int f) { return polyhedron.Height(f, ball.center); };
    for (int f = 1; f < faces; ++f) {
      if (height(f) > height(highest)) highest = f;
    }
    if (height(highest) - ball.shape->radius > reach_) return;
    if (height(highest) <= 0) return BallFace(contact, ball, polyhedron, highest);
    for (int f = 0; f < faces; ++f) {
      if (height(f) > 0 && IsOver(polyhedron, f, ball.center)) return BallFace(contact, ball, polyhedron, f);
    }
    BallEdges(contact, ball, polyhedron);
  }

  void BallFace(Touch contact, const Shape& ball, const Shape& polyhedron, int face) {
    const Scalar height = polyhedron.Height(face, ball.center);
    contact.radius_a = ball.shape->radius;
    contact.gap = height - contact.radius_a;
    contact.normal = polyhedron.normals[face];
    contact.point = ball.center - height * contact.normal;
    if (contact.gap <= reach_) found_.push_back(contact);
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
    Vector3<Scalar> nearest = Zero3<Scalar>();
    for (const auto& edge : polyhedron.shape->edges) {
      const Vector3<Scalar> along = polyhedron.Along(edge), &from = polyhedron.corners[edge.from];
      const Scalar at = along.dot(ball.center - from) / along.squaredNorm();
      const Vector3<Scalar> p = from + std::clamp<Scalar>(at, Scalar(0), Scalar(1)) * along;
      const Scalar square = (ball.center - p).squaredNorm();
      if (least && square >= *least) continue;
      least = square;
      nearest = p;
      contact.meeting = at > 0 && at < 1 ? Meeting::kEdge : Meeting::kPoint;
      contact.edge_b = along;
    }
    Across(contact, ball, nearest);
  }

  void Polyhedra(const Shape& P, const Shape& Q) {
    const CarryingFace<Scalar> on_p = FarthestFace<Scalar>(P, Q), on_q = FarthestFace<Scalar>(Q, P);
    if (on_p.distance > reach_ || on_q.distance > reach_) return;
    // Over doubles rounding must not choose from frame to frame.
    const Scalar preference = kIsExact<Scalar> ? Scalar(0) : Scalar(gap_ / 16);
    const FarthestEdges<Scalar> edges = FindFarthestEdges<Scalar>(Q, P);
    const Scalar face_distance = std::max<Scalar>(on_p.distance, on_q.distance);
    if (edges.apart && *edges.apart > reach_) return;
    if (edges.crossing && edges.crossing->distance > face_distance + preference)
      return Edges(*edges.crossing, P, Q);
    // Edges part them that do not cross: corners pass each other, and what faces say of an overlap is not so.
    if (edges.apart && *edges.apart > preference && face_distance < -preference) return;
    if (on_q.distance + preference >= on_p.distance) {
      Clip(pattern_, Q, on_q.face, P);
    } else {
      Clip(Swapped(), P, on_p.face, Q);
    }
  }

  void Edges(const CrossingEdges<Scalar>& edges, const Shape& P, const Shape& Q) {
    Touch contact = pattern_;
    contact.meeting = Meeting::kEdges;
    contact.edge_a = P.Along(edges.second);
    contact.edge_b = Q.Along(edges.first);
    contact.normal = edges.normal;
    contact.gap = edges.distance;
    contact.point = Q.corners[edges.first.from] + edges.at * contact.edge_b;
    found_.push_back(contact);
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
    const std::size_t first = found_.size();
    for (const auto& corner : polygon) {
      contact.gap = carrier.Height(face, corner);
      contact.point = corner - contact.gap * normal;
      if (contact.gap <= reach_ && IsNew(first, contact.point)) found_.push_back(contact);
    }
  }

  // Clipping can cut a corner off by no more than rounding.
  bool IsNew(std::size_t first, const Vector3<Scalar>& point) const {
    const Scalar near = kIsExact<Scalar> ? Scalar(0) : Scalar(gap_ / 1000);
    return std::none_of(found_.begin() + static_cast<std::ptrdiff_t>(first), found_.end(),
                        [&](const Touch& known) { return (known.point - point).squaredNorm() <= near * near; });
  }

  Scalar gap_, reach_;
  Touch pattern_;
  std::vector<Touch>& found_;
};

template <class Scalar>
TouchPointInSpace<Scalar> Given(const SceneInSpace<Scalar>& scene, const Scalar& mu,
                                const GivenContactInSpace<Scalar>& given) {
  const BodyInSpace<Scalar>&a = scene.bodies[given.a], &b = scene.bodies[given.b];
  TouchPointInSpace<Scalar> contact;
  contact.a = given.a;
  contact.b = given.b;
  contact.mu = mu;
  contact.normal = RotationMatrix<Scalar>(b.rotation) * given.normal;
  const Vector3<Scalar> p = a.At(given.at_a);
  contact.gap = contact.normal.dot(p - b.At(given.at_b));
  contact.point = p - contact.gap * contact.normal;
  return contact;
}

}  // namespace

template <class Scalar>
std::vector<TouchPointInSpace<Scalar>> FindContacts(const SceneInSpace<Scalar>& scene, const Scalar& margin) {
  std::vector<TouchPointInSpace<Scalar>> found;
  const PairTable table(scene);
  for (const auto& given : scene.contacts)
    found.push_back(Given<Scalar>(scene, table.Of(given.a, given.b).mu, given));
  const int bodies = static_cast<int>(scene.bodies.size());
  std::vector<std::vector<PlacedShape<Scalar>>> placed(bodies);
  for (int a = 0; a < bodies; ++a) {
    const Matrix3<Scalar> R = RotationMatrix<Scalar>(scene.bodies[a].rotation);
    placed[a].reserve(scene.bodies[a].shapes.size());
    for (const auto& shape : scene.bodies[a].shapes)
      placed[a].push_back(Place<Scalar>(scene.bodies[a], R, shape));
  }
  const auto find = [&](const auto& pattern, const auto& a, const auto& b) {
    PairFinder<Scalar>(scene.gap, margin, pattern, found).Find(a, b);
  };
  ForEachPair<TouchPointInSpace<Scalar>>(table, placed, Scalar(scene.gap + margin), find);
  return found;
}

template std::vector<TouchPointInSpace<double>> FindContacts(const SceneInSpace<double>&, const double&);
template std::vector<TouchPointInSpace<mpq_class>> FindContacts(const SceneInSpace<mpq_class>&,
                                                                const mpq_class&);

}  // namespace stiction
