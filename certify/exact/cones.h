// SPDX-License-Identifier: Apache-2.0
// Edges of friction cones, for exact linear programs, in which the circle of a contact in space is a polygon.
//
//   contact        v in K                       g in K*, the dual cone
//   bilateral      vN any                       gN = 0
//   frictionless   vN >= 0                      gN >= 0
//   static         abs(vF) <= mu vN             gN >= mu abs(gF)          (vN, gN >= 0)
//   sliding        vN >= 0, vF = -mu vN slip    gN >= mu slip.gF
//
// Let d_1, d_2, ... be the corners of a polygon in the unit circle, and w_k the point where the tangents at d_k
// and d_k+1 meet. Combinations >= 0 of these edges of a static contact lie
//
//   within K    (1, mu d_k)        within K*    (mu, d_k)        around K    (1, mu w_k),
//
// the last in a cone that contains K: so if g.v >= 0 for every edge around K, g is in K*. In the plane the
// corners are 1 and -1, and all of these are the cones themselves.

#pragma once

#include <vector>

#include "certify/exact/linear_system.h"
#include "certify/exact/polygons.h"

namespace stiction {

// A ray of one contact, or a line.
struct ConeEdge {
  int contact, row;              // row: that of its normal
  std::vector<Rational> values;  // in its rows
  bool free = false;
};

enum class EdgesOf { kWithinCone, kWithinDualCone, kAroundCone };

// One of eight sides per contact; none in the plane.
RationalPolygons FirstPolygons(const ExactProblem& problem);

// Contact by contact. Within the dual cone: in space, no sliding contact.
std::vector<ConeEdge> MakeEdges(const ExactProblem& problem, const RationalPolygons& polygons, EdgesOf which);

// The part of row i of A, and of a vector, along an edge.
Rational Along(const ConeEdge& edge, const ExactMatrix& A, int i);
Rational Along(const ConeEdge& edge, const ExactVector& values);

// The edges times x.
ExactVector Combined(const std::vector<ConeEdge>& edges, const Point& x, int rows);

// Sharpens polygons after a linear program, whose answer x is outside of the circular cone that it is meant
// for:
//
//   within K      x in K*, of its infeasibility: a corner along -xF
//   within K*     x in K, of its infeasibility:  a corner along -xF
//   around K      x in K, its solution:          a corner along xF
//
// at a point of the circle of as few digits as are new to the polygon: what only one direction decides is
// decided where that direction is simple. False if there was none to add.
bool AddCorners(const ExactProblem& problem, EdgesOf which, const ExactVector& x, RationalPolygons& polygons);

}  // namespace stiction
