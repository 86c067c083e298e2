// SPDX-License-Identifier: Apache-2.0
// Space over any scalar: vectors, rotations as quaternions, unit vectors rounded once. And space as a kind of
// scene, like the plane in plane.h.

#pragma once

#include <gmpxx.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "scene/plane.h"

namespace stiction {

template <class Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;
template <class Scalar>
using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;
// w, x, y, z. Of any length but zero: q and s q are one rotation.
template <class Scalar>
using Quaternion = Eigen::Matrix<Scalar, 4, 1>;

template <class Scalar>
Vector3<Scalar> MakeVector3(const Scalar& x, const Scalar& y, const Scalar& z) {
  Vector3<Scalar> v;
  v[0] = x;
  v[1] = y;
  v[2] = z;
  return v;
}

template <class Scalar>
Vector3<Scalar> CrossProduct(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
  return MakeVector3<Scalar>(Scalar(a[1] * b[2] - a[2] * b[1]), Scalar(a[2] * b[0] - a[0] * b[2]),
                             Scalar(a[0] * b[1] - a[1] * b[0]));
}

template <class Scalar>
Quaternion<Scalar> MakeQuaternion(const Scalar& w, const Vector3<Scalar>& v) {
  Quaternion<Scalar> q;
  q[0] = w;
  for (int i = 0; i < 3; ++i) q[i + 1] = v[i];
  return q;
}

// First q, then p.
template <class Scalar>
Quaternion<Scalar> Product(const Quaternion<Scalar>& p, const Quaternion<Scalar>& q) {
  const Vector3<Scalar> u = p.template tail<3>(), v = q.template tail<3>();
  const Vector3<Scalar> sum = p[0] * v + q[0] * u + CrossProduct<Scalar>(u, v);
  return MakeQuaternion<Scalar>(Scalar(p[0] * q[0] - u.dot(v)), sum);
}

// The rotation back.
template <class Scalar>
Quaternion<Scalar> Conjugate(const Quaternion<Scalar>& q) {
  return MakeQuaternion<Scalar>(q[0], Vector3<Scalar>(-q.template tail<3>()));
}

// Exactly orthogonal over rationals, whatever the length of q.
template <class Scalar>
Matrix3<Scalar> RotationMatrix(const Quaternion<Scalar>& q) {
  const Scalar scale = Scalar(2) / q.squaredNorm();
  Matrix3<Scalar> R;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    R(i, i) = Scalar(1) - scale * (q[j + 1] * q[j + 1] + q[k + 1] * q[k + 1]);
    R(i, j) = scale * (q[i + 1] * q[j + 1] - q[0] * q[k + 1]);
    R(i, k) = scale * (q[i + 1] * q[k + 1] + q[0] * q[j + 1]);
  }
  return R;
}

// By cofactors. Requires a determinant that is not zero.
template <class Scalar>
Matrix3<Scalar> Inverse3(const Matrix3<Scalar>& M) {
  const Vector3<Scalar> x = M.row(0), y = M.row(1), z = M.row(2);
  const Vector3<Scalar> yz = CrossProduct<Scalar>(y, z);
  const Scalar determinant = x.dot(yz);
  Matrix3<Scalar> inverse;
  inverse.col(0) = yz;
  inverse.col(1) = CrossProduct<Scalar>(z, x);
  inverse.col(2) = CrossProduct<Scalar>(x, y);
  for (int i = 0; i < 9; ++i) inverse(i % 3, i / 3) = inverse(i % 3, i / 3) / determinant;
  return inverse;
}

// abs(v), rounded where it must be.
template <class Scalar>
Scalar Length(const Vector3<Scalar>& v) {
  return v.stableNorm();
}
template <>
mpq_class Length(const Vector3<mpq_class>& v);

// v / abs(v). Over rationals exactly that where abs(v) is rational, otherwise doubles near it. Requires v /= 0.
template <class Scalar>
Vector3<Scalar> UnitVector(const Vector3<Scalar>& v) {
  return v / Length<Scalar>(v);
}
template <>
Vector3<mpq_class> UnitVector(const Vector3<mpq_class>& v);

// ---- A kind of scene -------------------------------------------------------------------------

// ball    the points at_a and at_b coincide (3 rows)
// hinge   a ball on which a turns relative to b about `direction` only (5 rows)
// rail    at_a stays on the line through at_b along `direction`, which turns with b (2 rows)
// slider  a rail on which a does not turn relative to b either (5 rows)
enum class JointKindInSpace : std::uint8_t { kBall, kHinge, kRail, kSlider };

// An edge of a polyhedron: from corner to corner, seen from outside with face `left` on its left.
struct PolyhedronEdge {
  int from = 0, to = 0;
  int left = 0, right = 0;
};

struct Space {
  static constexpr int kDimension = 3, kDof = 6;  // x, y, z, three spins
  template <class Scalar>
  using Vector = Vector3<Scalar>;
  template <class Scalar>
  using Rotation = Quaternion<Scalar>;
  template <class Scalar>
  using Spin = Vector3<Scalar>;  // and moments, vectors of the world
  template <class Scalar>
  using Inertia = Matrix3<Scalar>;
  template <class Scalar>
  struct Surface {
    std::vector<std::vector<int>> faces;   // their corners, anticlockwise from outside
    std::vector<Vector3<Scalar>> normals;  // of the faces, outward, of length 1 up to rounding
    std::vector<PolyhedronEdge> edges;
  };

  using JointKind = JointKindInSpace;
  static constexpr std::array<std::string_view, 4> kJointNames = {"ball", "hinge", "rail", "slider"};
};

template <class Scalar>
Matrix3<Scalar> TurnOf(const Quaternion<Scalar>& rotation) {
  return RotationMatrix<Scalar>(rotation);
}
template <class Scalar>
Vector3<Scalar> Rotate(const Matrix3<Scalar>& turn, const Vector3<Scalar>& v) {
  return turn * v;
}
template <class Scalar>
Vector3<Scalar> RotateBack(const Matrix3<Scalar>& turn, const Vector3<Scalar>& v) {
  return turn.transpose() * v;
}

template <class Scalar>
Vector3<Scalar> Moment(const Vector3<Scalar>& arm, const Vector3<Scalar>& d) {
  return CrossProduct<Scalar>(arm, d);
}
template <class Scalar>
Vector3<Scalar> SpinVelocity(const Vector3<Scalar>& spin, const Vector3<Scalar>& arm) {
  return CrossProduct<Scalar>(spin, arm);
}
template <class Scalar>
Vector3<Scalar> Centripetal(const Vector3<Scalar>& spin, const Vector3<Scalar>& arm) {
  return CrossProduct<Scalar>(spin, CrossProduct<Scalar>(spin, arm));
}

// Across the axis that the normal has least of, and across both: functions of the normal alone.
template <class Scalar>
std::array<Vector3<Scalar>, 2> TangentsOf(const Vector3<Scalar>& normal) {
  int least = 0;
  for (int i = 1; i < 3; ++i) {
    if (Abs<Scalar>(normal[i]) < Abs<Scalar>(normal[least])) least = i;
  }
  Vector3<Scalar> axis = Zero<Vector3<Scalar>>();
  axis[least] = Scalar(1);
  const Vector3<Scalar> across = CrossProduct<Scalar>(normal, axis), first = UnitVector(across);
  return {first, CrossProduct<Scalar>(normal, first)};
}

}  // namespace stiction
