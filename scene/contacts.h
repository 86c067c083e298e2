// SPDX-License-Identifier: Apache-2.0
// Contact finding: where the bodies of a scene touch, within its gap.
//
// polygon - polygon   the edge (of either) that is farthest from the other polygon carries the contacts: the
//                     facing edge of the other, clipped to the carrying edge, gives its two ends. A tie goes to
//                     the body of the lower number.
// polygon - disc      the nearest point of the polygon: on an edge, or a corner
// disc - disc         on the line of the centres
//
// Normals point from b to a, and b carries the edge, if there is one. Points lie on that edge's line
// q + s t, with the rounded t: so all contacts of one edge have exactly the same tangential row, and normal
// rows that are affine in s.
//
// Each pair of pieces gives at most two contacts, never two of them at one point. Two corners that face each
// other, with no edge opposite, count as a contact within the gap; its normal is that of the nearest edge.
// Fixed bodies against each other, bodies of different levels and bodies that a joint connects are passed over.

#ifndef STICTION_SCENE_CONTACTS_H_
#define STICTION_SCENE_CONTACTS_H_

#include <vector>

#include "scene/scene.h"

namespace stiction {

// One point of contact. The gap's second derivative needs what is round about it: the surfaces have radius_a
// and radius_b there, 0 being a corner, and flat_b says that b's is an edge.
template <class Scalar>
struct TouchPoint {
  int a = 0, b = 0;                // bodies
  int shape_a = -1, shape_b = -1;  // pieces of them; -1 for a given contact
  // World.
  Vector2<Scalar> point = MakeVector2<Scalar>(Scalar(0), Scalar(0));
  Vector2<Scalar> normal = MakeVector2<Scalar>(Scalar(0), Scalar(1));  // unit up to rounding, from b to a
  Scalar gap = Scalar(0);                                              // m, negative for overlap
  Scalar mu = Scalar(0);
  Scalar radius_a = Scalar(0), radius_b = Scalar(0);
  bool flat_b = true;
};

// Given contacts first, whatever their gap, then those found, by pairs of bodies in order. With a margin (m, >=
// 0) also those that are so much farther apart than the gap: which may touch soon.
template <class Scalar>
std::vector<TouchPoint<Scalar>> FindContacts(const Scene<Scalar>& scene, const Scalar& margin = Scalar(0));

extern template std::vector<TouchPoint<double>> FindContacts(const Scene<double>&, const double&);
extern template std::vector<TouchPoint<mpq_class>> FindContacts(const Scene<mpq_class>&, const mpq_class&);

}  // namespace stiction

#endif  // STICTION_SCENE_CONTACTS_H_
