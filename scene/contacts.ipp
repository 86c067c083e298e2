// SPDX-License-Identifier: Apache-2.0
// Contact finding in the plane and in space: pieces where their bodies are, given contacts, round pieces,
// pairs. The kind brings PairFinder<Kind, Scalar>, derived from PairFinderOf:
//
//   AgainstRound(contact, P, Q)   a round piece P of the contact's a against one with corners, Q of b
//   Cornered(P, Q)                two pieces with corners

#pragma once

#include <algorithm>
#include <utility>

#include "scene/contacts.h"
#include "scene/pair_facts.h"

namespace stiction {

// A shape where its body is.
template <class Kind, class Scalar>
struct PlacedShape {
  using Vector = typename Kind::template Vector<Scalar>;

  const ShapeIn<Kind, Scalar>* shape = nullptr;
  std::vector<Vector> corners;
  std::vector<Vector> normals;  // of its faces, in space
  Vector center;                // of a disc or ball
  Vector low, high;             // bounding box

  bool IsRound() const { return corners.empty(); }
  const Scalar& radius() const { return shape->radius; }
};

template <class Kind, class Scalar>
void SetBox(PlacedShape<Kind, Scalar>& placed) {
  placed.low = placed.high = placed.IsRound() ? placed.center : placed.corners[0];
  for (int i = 0; i < Kind::kDimension; ++i) {
    for (const auto& corner : placed.corners) {
      placed.low[i] = std::min<Scalar>(placed.low[i], corner[i]);
      placed.high[i] = std::max<Scalar>(placed.high[i], corner[i]);
    }
    if (!placed.IsRound()) continue;
    placed.low[i] -= placed.radius();
    placed.high[i] += placed.radius();
  }
}

template <class Kind, class Scalar>
std::vector<PlacedShape<Kind, Scalar>> PlacedShapesOf(const BodyIn<Kind, Scalar>& body) {
  std::vector<PlacedShape<Kind, Scalar>> shapes;
  shapes.reserve(body.shapes.size());
  const auto turn = TurnOf(body.rotation);
  for (const auto& shape : body.shapes) {
    PlacedShape<Kind, Scalar>& placed = shapes.emplace_back();
    placed.shape = &shape;
    placed.center = body.position + Rotate(turn, shape.center);
    placed.corners.reserve(shape.corners.size());
    for (const auto& corner : shape.corners) placed.corners.push_back(body.position + Rotate(turn, corner));
    if constexpr (Kind::kDimension == 3) {
      placed.normals.reserve(shape.normals.size());
      for (const auto& normal : shape.normals) placed.normals.push_back(Rotate(turn, normal));
    }
    SetBox(placed);
  }
  return shapes;
}

template <class Kind, class Scalar>
TouchPointIn<Kind, Scalar> TouchOf(const SceneIn<Kind, Scalar>& scene, const Scalar& mu,
                                   const GivenContactIn<Kind, Scalar>& given) {
  using Vector = typename Kind::template Vector<Scalar>;
  const auto &a = scene.bodies[given.a], &b = scene.bodies[given.b];
  TouchPointIn<Kind, Scalar> contact;
  contact.a = given.a;
  contact.b = given.b;
  contact.mu = mu;
  contact.normal = Rotate(TurnOf(b.rotation), given.normal);
  const Vector p = a.At(given.at_a), apart = p - b.At(given.at_b);
  contact.gap = contact.normal.dot(apart);
  contact.point = p - contact.gap * contact.normal;
  return contact;
}

// What touches of two pieces. The pattern names bodies and pieces, and has their friction.
template <class Finder, class Kind, class Scalar>
class PairFinderOf {
 public:
  using Vector = typename Kind::template Vector<Scalar>;
  using Touch = TouchPointIn<Kind, Scalar>;
  using Shape = PlacedShape<Kind, Scalar>;

  PairFinderOf(const Scalar& gap, const Scalar& margin, const Touch& pattern, std::vector<Touch>& found)
      : gap_(gap), reach_(gap + margin), pattern_(pattern), found_(found) {}

  // P belongs to the pattern's a, Q to its b.
  void Find(const Shape& P, const Shape& Q) {
    if (AreFar(P, Q)) return;
    Finder& finder = static_cast<Finder&>(*this);
    if (P.IsRound() && Q.IsRound()) return Across(pattern_, Meeting::kPoint, P, Q.center, Q.radius());
    if (P.IsRound()) return finder.AgainstRound(pattern_, P, Q);
    if (Q.IsRound()) return finder.AgainstRound(Swapped(), Q, P);
    finder.Cornered(P, Q);
  }

 protected:
  bool AreFar(const Shape& P, const Shape& Q) const {
    for (int i = 0; i < Kind::kDimension; ++i) {
      if (P.low[i] - Q.high[i] > reach_ || Q.low[i] - P.high[i] > reach_) return true;
    }
    return false;
  }

  Touch Swapped() const {
    Touch swapped = pattern_;
    std::swap(swapped.a, swapped.b);
    std::swap(swapped.shape_a, swapped.shape_b);
    return swapped;
  }

  void Keep(const Touch& contact) {
    if (contact.gap <= reach_) found_.push_back(contact);
  }

  // A round piece of a against the point `origin` of b, or what is round about it.
  void Across(Touch contact, Meeting meeting, const Shape& round, const Vector& origin,
              const Scalar& radius_b) {
    contact.meeting = meeting;
    Vector apart = round.center - origin;
    bool concentric = true;
    for (const Scalar& x : apart) concentric = concentric && Sign(x) == 0;
    if (concentric) apart[Kind::kDimension - 1] = Scalar(1);  // any direction parts them
    contact.radius_a = round.radius();
    contact.radius_b = radius_b;
    contact.gap = (concentric ? Scalar(0) : Length(apart)) - contact.radius_a - radius_b;
    if (contact.gap > reach_) return;
    contact.normal = UnitVector(apart);
    contact.point = origin + radius_b * contact.normal;
    found_.push_back(contact);
  }

  // Over doubles rounding must not choose from frame to frame.
  Scalar Preference() const { return kIsExact<Scalar> ? Scalar(0) : Scalar(gap_ / 16); }

  Scalar gap_, reach_;
  const Touch& pattern_;
  std::vector<Touch>& found_;
};

template <class Kind, class Scalar>
class PairFinder;

template <class Kind, class Scalar>
std::vector<TouchPointIn<Kind, Scalar>> FindContacts(const SceneIn<Kind, Scalar>& scene, const Scalar& margin) {
  using Touch = TouchPointIn<Kind, Scalar>;
  std::vector<Touch> found;
  const PairTable table(scene);
  for (const auto& given : scene.contacts)
    found.push_back(TouchOf<Kind, Scalar>(scene, table.Of(given.a, given.b).mu, given));
  std::vector<std::vector<PlacedShape<Kind, Scalar>>> placed;
  placed.reserve(scene.bodies.size());
  for (const auto& body : scene.bodies) placed.push_back(PlacedShapesOf(body));
  const auto find = [&](const auto& pattern, const auto& a, const auto& b) {
    PairFinder<Kind, Scalar>(scene.gap, margin, pattern, found).Find(a, b);
  };
  ForEachPair<Touch>(table, placed, Scalar(scene.gap + margin), find);
  return found;
}

}  // namespace stiction
