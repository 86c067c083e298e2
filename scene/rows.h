// SPDX-License-Identifier: Apache-2.0
// Rows: what contacts and joints ask of the motion of bodies, in the plane and in space.
//
// With n the normal from b to a, t = n turned by a quarter, p the point, r = p - centre of mass:
//
//   J_N = (n, r_a x n | -n, -(r_b x n))       J_F the same with t; in space with t1 and t2 = n x t1
//
// t and t1 are functions of n alone.
//
// bias, the velocity-dependent part, is the second derivative of what the row measures where no body
// accelerates; error is what it measures, m or the sine of an angle. Normal rows measure the gap g of the
// surfaces themselves. Tangential rows measure the velocity of a's material relative to b's at the contact
// point; their bias is the derivative of that where it is zero, as it is at static contacts. [Baraff94],
// section 3 takes such terms into b without writing them out. rows_in_plane.cpp and rows_in_space.cpp derive
// them, and those of joints.

#pragma once

#include <vector>

#include "scene/contacts.h"
#include "scene/mechanics.h"

namespace stiction {

template <class Kind, class Scalar>
std::vector<BodyDynamics<Scalar, Kind::kDof>> DynamicsOf(const SceneIn<Kind, Scalar>& scene);

// The rows of each joint, in order: J, bias and error; b is not set.
template <class Kind, class Scalar>
std::vector<ConstraintIn<Kind, Scalar>> JointConstraints(const SceneIn<Kind, Scalar>& scene);

// Normal and tangential rows of a contact likewise.
template <class Kind, class Scalar>
ConstraintIn<Kind, Scalar> ContactConstraint(const SceneIn<Kind, Scalar>& scene,
                                             const TouchPointIn<Kind, Scalar>& contact);

// ---- What they are made of --------------------------------------------------------------------

// The velocity along d of a's point at arm_a relative to b's at arm_b.
template <class Kind, class Scalar>
RowIn<Kind, Scalar> RowAlong(const typename Kind::template Vector<Scalar>& d,
                             const typename Kind::template Vector<Scalar>& arm_a,
                             const typename Kind::template Vector<Scalar>& arm_b) {
  RowIn<Kind, Scalar> row;
  row.J[0] << d, Moment(arm_a, d);
  row.J[1] << -d, -Moment(arm_b, d);
  return row;
}

// Second derivative of a point that turns with its body.
template <class Kind, class Scalar>
typename Kind::template Vector<Scalar> ToCentre(const BodyIn<Kind, Scalar>& body,
                                                const typename Kind::template Vector<Scalar>& point) {
  const typename Kind::template Vector<Scalar> arm = point - body.position;
  return Centripetal(body.spin, arm);
}

// The bias of the normal row.
template <class Scalar>
Scalar NormalBias(const RigidBody<Scalar>& a, const RigidBody<Scalar>& b, const TouchPoint<Scalar>& contact);
template <class Scalar>
Scalar NormalBias(const BodyInSpace<Scalar>& a, const BodyInSpace<Scalar>& b,
                  const TouchPointInSpace<Scalar>& contact);

// How fast the contact point runs ahead of the material. (In the plane: along the normal's derivative only, and
// no tangential row asks for it.)
template <class Scalar>
Vector3<Scalar> Wandering(const TouchPointInSpace<Scalar>& contact, const Vector3<Scalar>& relative_spin);

template <class Scalar>
std::vector<RowIn<Plane, Scalar>> JointRows(const Scene<Scalar>& scene, const Joint<Scalar>& joint);
template <class Scalar>
std::vector<RowIn<Space, Scalar>> JointRows(const SceneInSpace<Scalar>& scene,
                                            const JointInSpace<Scalar>& joint);

}  // namespace stiction
