// SPDX-License-Identifier: Apache-2.0
// What rows.h says of the plane alone. The gap is that of a corner or disc at c of a:
//
//   against an edge of b with a point q   g = n.(c - q) - radius, dn/dt = w_b t:
//       bias = n.(c'' - q'') + 2 w_b t.(c' - q') - w_b^2 n.(c - q)
//   against a corner or disc at d of b    g = abs(c - d) - radii:
//       bias = n.(c'' - d'') + (t.(c' - d'))^2 / abs(c - d)
//
// with c'' = -w_a^2 (c - x_a) of a point that turns with its body, likewise q'', d''. Tangential rows:
//
//       bias = t.(-w_a^2 r_a + w_b^2 r_b)

#include "scene/rows.h"

namespace stiction {
namespace {

// Of n.(c - q): c a point of a, q one of b, n turning with b.
template <class Scalar>
Scalar EdgeBias(const RigidBody<Scalar>& a, const RigidBody<Scalar>& b, const Vector2<Scalar>& c,
                const Vector2<Scalar>& q, const Vector2<Scalar>& n) {
  const Vector2<Scalar> relative = ToCentre(a, c) - ToCentre(b, q);
  const Vector2<Scalar> velocity = a.VelocityAt(c) - b.VelocityAt(q);
  return Scalar(Dot<Scalar>(n, relative) + 2 * b.spin * Dot<Scalar>(Quarter<Scalar>(n), velocity) -
                b.spin * b.spin * Dot<Scalar>(n, c - q));
}

// Of abs(c - d).
template <class Scalar>
Scalar RoundBias(const RigidBody<Scalar>& a, const RigidBody<Scalar>& b, const Vector2<Scalar>& c,
                 const Vector2<Scalar>& d, const Vector2<Scalar>& n) {
  const Vector2<Scalar> relative = ToCentre(a, c) - ToCentre(b, d);
  const Scalar across = Dot<Scalar>(Quarter<Scalar>(n), a.VelocityAt(c) - b.VelocityAt(d));
  const Scalar distance = Dot<Scalar>(n, c - d);
  return Scalar(Dot<Scalar>(n, relative) + (distance > 0 ? Scalar(across * across / distance) : Scalar(0)));
}

template <class Scalar>
std::vector<RowIn<Plane, Scalar>> PinRows(const RigidBody<Scalar>& a, const RigidBody<Scalar>& b,
                                          const Vector2<Scalar>& p, const Vector2<Scalar>& q) {
  const Vector2<Scalar> bias = ToCentre(a, p) - ToCentre(b, q);
  const Vector2<Scalar> arm_a = p - a.position, arm_b = q - b.position;
  std::vector<RowIn<Plane, Scalar>> rows;
  for (int i = 0; i < 2; ++i) {
    const auto axis = MakeVector2<Scalar>(Scalar(1 - i), Scalar(i));
    rows.push_back(RowAlong<Plane, Scalar>(axis, arm_a, arm_b));
    rows[i].bias = bias[i];
    rows[i].error = p[i] - q[i];
  }
  return rows;
}

template <class Scalar>
RowIn<Plane, Scalar> RailRow(const RigidBody<Scalar>& a, const RigidBody<Scalar>& b, const Vector2<Scalar>& p,
                             const Vector2<Scalar>& q, const Vector2<Scalar>& along) {
  const Vector2<Scalar> n = Quarter<Scalar>(along), arm_a = p - a.position, arm_b = p - b.position;
  RowIn<Plane, Scalar> row = RowAlong<Plane, Scalar>(n, arm_a, arm_b);
  row.bias = EdgeBias<Scalar>(a, b, p, q, n);
  row.error = Dot<Scalar>(n, p - q);
  return row;
}

// Keeps a from turning relative to b.
template <class Scalar>
RowIn<Plane, Scalar> LockRow(const RigidBody<Scalar>& a, const Vector2<Scalar>& demanded) {
  RowIn<Plane, Scalar> lock;
  lock.J[0] << Scalar(0), Scalar(0), Scalar(1);
  lock.J[1] << Scalar(0), Scalar(0), Scalar(-1);
  lock.error = Cross<Scalar>(demanded, a.rotation);  // sine of the turn
  return lock;
}

}  // namespace

template <class Scalar>
Scalar NormalBias(const RigidBody<Scalar>& a, const RigidBody<Scalar>& b, const TouchPoint<Scalar>& contact) {
  const Vector2<Scalar>&n = contact.normal, &p = contact.point;
  const Vector2<Scalar> c = p + (contact.gap + contact.radius_a) * n;
  if (contact.meeting == Meeting::kFace) return EdgeBias<Scalar>(a, b, c, p, n);
  return RoundBias<Scalar>(a, b, c, p - contact.radius_b * n, n);
}

template <class Scalar>
std::vector<RowIn<Plane, Scalar>> JointRows(const Scene<Scalar>& scene, const Joint<Scalar>& joint) {
  const RigidBody<Scalar>&a = scene.bodies[joint.a], &b = scene.bodies[joint.b];
  const Vector2<Scalar> p = a.At(joint.at_a), q = b.At(joint.at_b);
  if (joint.kind == JointKind::kPin) return PinRows(a, b, p, q);
  std::vector<RowIn<Plane, Scalar>> rows = {RailRow(a, b, p, q, Rotate(b.rotation, joint.direction))};
  if (joint.kind == JointKind::kSlider) rows.push_back(LockRow(a, Rotate(b.rotation, joint.relative_rotation)));
  return rows;
}

#define STICTION_INSTANTIATE(Scalar)                                                                         \
  template Scalar NormalBias(const RigidBody<Scalar>&, const RigidBody<Scalar>&, const TouchPoint<Scalar>&); \
  template std::vector<RowIn<Plane, Scalar>> JointRows(const Scene<Scalar>&, const Joint<Scalar>&)

STICTION_INSTANTIATE(double);
STICTION_INSTANTIATE(mpq_class);

#undef STICTION_INSTANTIATE

}  // namespace stiction
