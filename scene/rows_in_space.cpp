// SPDX-License-Identifier: Apache-2.0
// What rows.h says of space alone.
//
// Seen from b, what is attached to a as y
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

#include "scene/rows.h"

namespace stiction {
namespace {

// Something that moves with a, seen from b.
template <class Scalar>
struct SeenFromB {
  Vector3<Scalar> first, second;  // derivatives

  SeenFromB(const Vector3<Scalar>& w_b, const Vector3<Scalar>& y, const Vector3<Scalar>& world_first,
            const Vector3<Scalar>& world_second)
      : first(world_first - CrossProduct<Scalar>(w_b, y)),
        second(world_second - Scalar(2) * CrossProduct<Scalar>(w_b, world_first) + Centripetal(w_b, y)) {}
};

template <class Scalar>
Scalar EdgesBias(const TouchPointInSpace<Scalar>& contact, const Vector3<Scalar>& w_a,
                 const Vector3<Scalar>& w_b, const SeenFromB<Scalar>& y) {
  const Vector3<Scalar>&n = contact.normal, &e = contact.edge_a;
  const SeenFromB<Scalar> edge(w_b, e, CrossProduct<Scalar>(w_a, e), Centripetal(w_a, e));
  // The sign that makes m point along n.
  const Vector3<Scalar> across = CrossProduct<Scalar>(e, contact.edge_b);
  const Scalar sign = across.dot(n) < 0 ? Scalar(-1) : Scalar(1);
  const Vector3<Scalar> m1 = sign * CrossProduct<Scalar>(edge.first, contact.edge_b);
  const Vector3<Scalar> m2 = sign * CrossProduct<Scalar>(edge.second, contact.edge_b);
  const Scalar L = sign * across.dot(n), L1 = n.dot(m1);
  const Scalar L2 = (m1.dot(m1) + n.dot(m2) * L - L1 * L1) / L;
  const Scalar g = contact.gap, g1 = n.dot(y.first);
  return Scalar((g * n.dot(m2) + 2 * m1.dot(y.first) + L * n.dot(y.second) - 2 * g1 * L1 - g * L2) / L);
}

// Across the point p of a and q of b, along u.
template <class Scalar>
RowIn<Space, Scalar> PointRow(const BodyInSpace<Scalar>& a, const BodyInSpace<Scalar>& b,
                              const Vector3<Scalar>& p, const Vector3<Scalar>& q, const Vector3<Scalar>& u) {
  RowIn<Space, Scalar> row = RowAlong<Space, Scalar>(u, p - a.position, p - b.position);
  const SeenFromB<Scalar> y(b.spin, p - q, a.VelocityAt(p) - b.VelocityAt(q), ToCentre(a, p) - ToCentre(b, q));
  row.bias = u.dot(y.second);
  row.error = u.dot(p - q);
  return row;
}

// Between the directions y of a and s of b.
template <class Scalar>
RowIn<Space, Scalar> DirectionRow(const BodyInSpace<Scalar>& a, const BodyInSpace<Scalar>& b,
                                  const Vector3<Scalar>& y, const Vector3<Scalar>& s) {
  RowIn<Space, Scalar> row;
  const Vector3<Scalar> axis = CrossProduct<Scalar>(y, s);
  row.J[0] << Zero<Vector3<Scalar>>(), axis;
  row.J[1] << Zero<Vector3<Scalar>>(), -axis;
  const SeenFromB<Scalar> seen(b.spin, y, CrossProduct<Scalar>(a.spin, y), Centripetal(a.spin, y));
  row.bias = s.dot(seen.second);
  row.error = s.dot(y);
  return row;
}

// (e1, e2, e3) as columns, in the coordinates of b.
template <class Scalar>
Matrix3<Scalar> AxesOf(const JointInSpace<Scalar>& joint) {
  if (joint.kind == JointKindInSpace::kBall) return Matrix3<Scalar>::Identity();
  Matrix3<Scalar> axes;
  axes.col(0) = TangentsOf(joint.direction)[0];
  axes.col(1) = CrossProduct<Scalar>(joint.direction, axes.col(0));
  axes.col(2) = joint.direction;
  return axes;
}

}  // namespace

template <class Scalar>
Scalar NormalBias(const BodyInSpace<Scalar>& a, const BodyInSpace<Scalar>& b,
                  const TouchPointInSpace<Scalar>& contact) {
  const Vector3<Scalar>& n = contact.normal;
  const Vector3<Scalar> c = contact.point + (contact.gap + contact.radius_a) * n;
  const Vector3<Scalar> d = contact.point - contact.radius_b * n;
  const SeenFromB<Scalar> y(b.spin, c - d, a.VelocityAt(c) - b.VelocityAt(d), ToCentre(a, c) - ToCentre(b, d));
  const Scalar flat = n.dot(y.second), distance = n.dot(c - d);
  if (contact.meeting == Meeting::kEdges) return EdgesBias<Scalar>(contact, a.spin, b.spin, y);
  if (contact.meeting == Meeting::kFace || distance <= 0) return flat;
  Vector3<Scalar> across = y.first - n.dot(y.first) * n;
  if (contact.meeting == Meeting::kEdge) {
    const Vector3<Scalar>& e = contact.edge_b;
    across -= Scalar(e.dot(across) / e.squaredNorm()) * e;
  }
  return Scalar(flat + across.squaredNorm() / distance);
}

template <class Scalar>
Vector3<Scalar> Wandering(const TouchPointInSpace<Scalar>& contact, const Vector3<Scalar>& relative_spin) {
  const Scalar &r_a = contact.radius_a, &r_b = contact.radius_b;
  const Vector3<Scalar> rolling = CrossProduct<Scalar>(relative_spin, contact.normal);
  switch (contact.meeting) {
    case Meeting::kFace:
      return r_a * rolling;
    case Meeting::kPoint:
      if (Sign<Scalar>(r_a * r_b) == 0) break;
      return Scalar(r_a * r_b / (r_a + r_b)) * rolling;
    case Meeting::kEdge:
      return Scalar(r_a * contact.edge_b.dot(rolling) / contact.edge_b.squaredNorm()) * contact.edge_b;
    case Meeting::kEdges:
      break;
  }
  return Zero<Vector3<Scalar>>();
}

template <class Scalar>
std::vector<RowIn<Space, Scalar>> JointRows(const SceneInSpace<Scalar>& scene,
                                            const JointInSpace<Scalar>& joint) {
  const BodyInSpace<Scalar>&a = scene.bodies[joint.a], &b = scene.bodies[joint.b];
  const Vector3<Scalar> p = a.At(joint.at_a), q = b.At(joint.at_b);
  const Matrix3<Scalar> axes = AxesOf(joint), e = RotationMatrix<Scalar>(b.rotation) * axes;
  const Matrix3<Scalar> seen_from_a = RotationMatrix<Scalar>(joint.relative_rotation).transpose() * axes;
  const Matrix3<Scalar> d = RotationMatrix<Scalar>(a.rotation) * seen_from_a;
  const bool slides = joint.kind == JointKindInSpace::kRail || joint.kind == JointKindInSpace::kSlider;
  std::vector<RowIn<Space, Scalar>> rows;
  for (int k = 0; k < (slides ? 2 : 3); ++k) rows.push_back(PointRow<Scalar>(a, b, p, q, e.col(k)));
  if (joint.kind == JointKindInSpace::kHinge) {
    for (int k = 0; k < 2; ++k) rows.push_back(DirectionRow<Scalar>(a, b, d.col(2), e.col(k)));
  }
  if (joint.kind == JointKindInSpace::kSlider) {
    for (int k = 0; k < 3; ++k) rows.push_back(DirectionRow<Scalar>(a, b, d.col(k), e.col((k + 1) % 3)));
  }
  return rows;
}

#define STICTION_INSTANTIATE(Scalar)                                                            \
  template Scalar NormalBias(const BodyInSpace<Scalar>&, const BodyInSpace<Scalar>&,            \
                             const TouchPointInSpace<Scalar>&);                                 \
  template Vector3<Scalar> Wandering(const TouchPointInSpace<Scalar>&, const Vector3<Scalar>&); \
  template std::vector<RowIn<Space, Scalar>> JointRows(const SceneInSpace<Scalar>&, const JointInSpace<Scalar>&)

STICTION_INSTANTIATE(double);
STICTION_INSTANTIATE(mpq_class);

#undef STICTION_INSTANTIATE

}  // namespace stiction
