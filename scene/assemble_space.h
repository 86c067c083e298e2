// SPDX-License-Identifier: Apache-2.0
// Assemble in space: assemble.h with three rows for a static or sliding contact.
//
// Rows. With n the normal from b to a, t1 and t2 = n x t1 the tangents, p the point, r = p - centre of mass:
//
//   J_N = (n, r_a x n | -n, -(r_b x n))       J_F the same with t1, t2
//
// t1 is a function of n alone. Levels, b and what is left out are those of the plane; given forces include the
// gyroscopic moment -w x (I w). Problems are of dimension 3: their law is Coulomb's, with the round cone.
//
// bias is the second derivative of the gap g where no body accelerates. Seen from b, what is attached to a as y
// (a point, less a point of b, or a direction) has
//
//   y' = y' - w_b x y,   y'' = y'' - 2 w_b x y' + w_b x (w_b x y)          (right: derivatives in the world)
//
// and with c the corner or centre of a, q or d a point of b:
//
//   against a face of b               g = n.(c - q) - radius         g'' = n.y''
//   against a corner or ball at d     g = abs(c - d) - radii         g'' = n.y'' + abs(T y')^2 / abs(y)
//   a ball against an edge of b       the same, d the nearest point of the edge, T y' less its part along it
//   edge e_a across edge e_b          g = m.y / abs(m), m = e_a x e_b, y between any points of the two
//
// T takes the part orthogonal to n. For edges m' and m'' follow from those of e_a; at the nearest points,
// where y = g n,
//
//   L' = n.m',   L'' = (m'.m' + n.m'' L - L'^2) / L,   L = abs(m)
//   g' = n.y',   g'' = (g n.m'' + 2 m'.y' + L n.y'' - 2 g' L' - g L'') / L
//
// Tangential rows measure the velocity of a's material relative to b's at the contact point, which wanders over
// both where balls roll. With u the relative spin and 1 / R = 1 / radius_a + 1 / radius_b (faces: no
// curvature), the point runs ahead of the material by R (u x n), along an edge by its part along the edge, so
// that where the tangential velocity is zero its derivative is
//
//   bias = t.(w_a x (w_a x r_a) - w_b x (w_b x r_b) + u x (R (u x n)))
//
// (A ball that spins about the normal while it rolls needs the last term: it rolls straight on.)
//
// Joints. e1, e2, e3 are orthogonal unit vectors that turn with b, e3 the direction of a hinge, rail or slider;
// d1, d2, d3 turn with a, and are e1, e2, e3 at the relative rotation of the joint. y = p - q, p the point of a
// and q that of b.
//
//   point       g = e_k.y        J = (e_k, (p - x_a) x e_k | -e_k, -((p - x_b) x e_k))    bias = e_k.y''
//   direction   g = e_k.d_j      J = (0, d_j x e_k | 0, -(d_j x e_k))                     bias = e_k.d_j''
//
// b's material is taken at p, not at q: e_k turns with it, g' = e_k.y', y' = v_a(p) - v_b(q) - w_b x (p - q).
// Errors are m, or sines of angles.
//
//   ball     e1.y, e2.y, e3.y, with the axes of b
//   hinge    those of a ball, e1.d3, e2.d3
//   rail     e1.y, e2.y
//   slider   those of a rail, e2.d1, e3.d2, e1.d3
//
// Near the relative rotation the rows of directions are independent: those of a slider less than 60 degrees
// from it, those of a hinge less than 90.

#ifndef STICTION_SCENE_ASSEMBLE_SPACE_H_
#define STICTION_SCENE_ASSEMBLE_SPACE_H_

#include <vector>

#include "scene/assemble.h"
#include "scene/contacts_space.h"

namespace stiction {

template <class Number>
struct SceneTypes<SceneInSpace<Number>> {
  using Scalar = Number;
  using Touch = TouchPointInSpace<Number>;
  static constexpr int kDimension = 3, kDof = 6;
  using Model = SceneModel<Number, kDof>;
};

template <class Scalar>
std::vector<BodyDynamics<Scalar, 6>> DynamicsOf(const SceneInSpace<Scalar>& scene);

// The rows of each joint, in order: J, bias and error; b is not set.
template <class Scalar>
std::vector<Constraint<Scalar, 6>> JointConstraints(const SceneInSpace<Scalar>& scene);

// Normal and tangential rows of a contact likewise.
template <class Scalar>
Constraint<Scalar, 6> ContactConstraint(const SceneInSpace<Scalar>& scene,
                                        const TouchPointInSpace<Scalar>& contact);

}  // namespace stiction

#endif  // STICTION_SCENE_ASSEMBLE_SPACE_H_
