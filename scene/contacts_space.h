// SPDX-License-Identifier: Apache-2.0
// Contact finding in space: where the bodies of a scene touch, within its gap.
//
// polyhedron - polyhedron  the separating direction along which the two are farthest apart, among the normals
// of
//                          their faces and the cross products of their edges. A face carries a manifold: the
//                          facing face of the other, clipped to the carrying one, gives its corners. Two edges
//                          give the one point where they cross. A tie goes to a face, then to that of b.
// ball - polyhedron        the nearest point of the polyhedron: in a face, on an edge, or a corner
// ball - ball              on the line of the centres
//
// Normals point from b to a, and b carries the face, if there is one. The points of a manifold lie in its
// plane, with the rounded normal of the face: so they have the same tangents, and normal rows that are affine
// in the point.
//
// A corner that faces a corner or an edge lengthwise, with no face opposite, is no contact.
// Fixed bodies against each other, bodies of different levels and bodies that a joint connects are passed over.

#ifndef STICTION_SCENE_CONTACTS_SPACE_H_
#define STICTION_SCENE_CONTACTS_SPACE_H_

#include <vector>

#include "scene/scene_space.h"

namespace stiction {

// face    something of a against a face of b
// point   a ball or corner of a against a ball or corner of b
// edge    a ball of a against an edge of b
// edges   an edge of a across an edge of b
enum class Meeting : std::uint8_t { kFace, kPoint, kEdge, kEdges };

// One point of contact. The gap's second derivative needs what is round about it: the surfaces have radius_a
// and radius_b there, 0 being a corner, and edges have directions (not of length 1).
template <class Scalar>
struct TouchPointInSpace {
  int a = 0, b = 0;                // bodies
  int shape_a = -1, shape_b = -1;  // pieces of them; -1 for a given contact
  Meeting meeting = Meeting::kFace;
  // World.
  Vector3<Scalar> point = Zero3<Scalar>();   // on b's surface
  Vector3<Scalar> normal = Zero3<Scalar>();  // unit up to rounding, from b to a
  Vector3<Scalar> edge_a = Zero3<Scalar>(), edge_b = Zero3<Scalar>();
  Scalar gap = Scalar(0);  // m, negative for overlap
  Scalar mu = Scalar(0);
  Scalar radius_a = Scalar(0), radius_b = Scalar(0);
};

// Given contacts first, whatever their gap, then those found, by pairs of bodies in order. With a margin (m, >=
// 0) also those that are so much farther apart than the gap.
template <class Scalar>
std::vector<TouchPointInSpace<Scalar>> FindContacts(const SceneInSpace<Scalar>& scene,
                                                    const Scalar& margin = Scalar(0));

extern template std::vector<TouchPointInSpace<double>> FindContacts(const SceneInSpace<double>&, const double&);
extern template std::vector<TouchPointInSpace<mpq_class>> FindContacts(const SceneInSpace<mpq_class>&,
                                                                       const mpq_class&);

}  // namespace stiction

#endif  // STICTION_SCENE_CONTACTS_SPACE_H_
