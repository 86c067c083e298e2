// SPDX-License-Identifier: Apache-2.0
// Contact finding: where the bodies of a scene touch, within its gap.
//
// In the plane (polygon_contacts.cpp):
// polygon - polygon   the edge (of either) that is farthest from the other polygon carries the contacts: the
//                     facing edge of the other, clipped to the carrying edge, gives its two ends. A tie goes to
//                     the body of the lower number.
// polygon - disc      the nearest point of the polygon: on an edge, or a corner
// disc - disc         on the line of the centres
//
// In space (polyhedron_contacts.cpp):
// polyhedron - polyhedron  the separating direction along which the two are farthest apart, among the normals
//                          of their faces and the cross products of their edges. A face carries a manifold: the
//                          facing face of the other, clipped to the carrying one, gives its corners. Two edges
//                          give the one point where they cross. A tie goes to a face, then to that of b.
// ball - polyhedron        the nearest point of the polyhedron: in a face, on an edge, or a corner
// ball - ball              on the line of the centres
//
// Normals point from b to a, and b carries the edge of a polygon or the face, if there is one. Points lie on
// that edge's line q + s t, with the rounded t, or in the plane of the face, with its rounded normal: so all
// contacts of one edge have exactly the same tangential row, those of a face the same tangents, and normal rows
// are affine in the point.
//
// In the plane each pair of pieces gives at most two contacts, never two of them at one point. Two corners that
// face each other, with no edge opposite, count as a contact within the gap; its normal is that of the nearest
// edge. In space a corner that faces a corner or an edge lengthwise, with no face opposite, is no contact.
// Fixed bodies against each other, bodies of different levels and bodies that a joint connects are passed over.

#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace stiction {

// face    something of a against a face of b, in the plane against an edge
// point   a round piece or corner of a against a round piece or corner of b
// edge    a ball of a against an edge of b
// edges   an edge of a across an edge of b
enum class Meeting : std::uint8_t { kFace, kPoint, kEdge, kEdges };

// One point of contact. The gap's second derivative needs what is round about it: the surfaces have radius_a
// and radius_b there, 0 being a corner, and edges in space have directions (not of length 1).
template <class Kind, class Scalar>
struct TouchPointIn {
  using Vector = typename Kind::template Vector<Scalar>;

  int a = 0, b = 0;                // bodies
  int shape_a = -1, shape_b = -1;  // pieces of them; -1 for a given contact
  Meeting meeting = Meeting::kFace;
  // World.
  Vector point = Zero<Vector>();   // on b's surface
  Vector normal = Zero<Vector>();  // unit up to rounding, from b to a
  Vector edge_a = Zero<Vector>(), edge_b = Zero<Vector>();
  Scalar gap = Scalar(0);  // m, negative for overlap
  Scalar mu = Scalar(0);
  Scalar radius_a = Scalar(0), radius_b = Scalar(0);
  // In a step, at the level of forces (assemble.h): counts as static whatever its tangential speed; stays
  // although it parts.
  bool held = false, closing = false;
};
template <class Scalar>
using TouchPoint = TouchPointIn<Plane, Scalar>;
template <class Scalar>
using TouchPointInSpace = TouchPointIn<Space, Scalar>;

// Given contacts first, whatever their gap, then those found, by pairs of bodies in order. With a margin (m, >=
// 0) also those that are so much farther apart than the gap: which may touch soon.
template <class Kind, class Scalar>
std::vector<TouchPointIn<Kind, Scalar>> FindContacts(const SceneIn<Kind, Scalar>& scene,
                                                     const Scalar& margin = Scalar(0));

extern template std::vector<TouchPoint<double>> FindContacts(const Scene<double>&, const double&);
extern template std::vector<TouchPoint<mpq_class>> FindContacts(const Scene<mpq_class>&, const mpq_class&);
extern template std::vector<TouchPointInSpace<double>> FindContacts(const SceneInSpace<double>&, const double&);
extern template std::vector<TouchPointInSpace<mpq_class>> FindContacts(const SceneInSpace<mpq_class>&,
                                                                       const mpq_class&);

}  // namespace stiction
