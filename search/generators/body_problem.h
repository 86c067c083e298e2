// SPDX-License-Identifier: Apache-2.0
// Problems of planar rigid bodies at rest, which several generators share: A = J M^-1 J', b = J M^-1 F.

#pragma once

#include <algorithm>
#include <array>

#include "search/generators/drawing.h"
#include "search/generators/scenes.h"

namespace stiction::generators {

inline constexpr int kMaxBodies = kMostSceneBodies;

// A planar body; lengths in tenths of a metre, masses in kg, inertias in kg m^2.
template <class Scalar>
struct Body {
  int x = 0, y = 0;                         // centre of mass, in tenths
  std::array<Scalar, 3> inverse_mass;       // 1/m, 1/m, 1/I
  std::array<Scalar, 3> free_acceleration;  // of the centre along x and y, and angular
};

// Columns of J, three per body.
template <class Scalar, int Rows>
using BodyJacobian =
    Eigen::Matrix<Scalar, Rows, Rows == Eigen::Dynamic ? Eigen::Dynamic : 3 * std::min(kMaxBodies, Rows / 2)>;

template <class Scalar, int Rows>
BodyJacobian<Scalar, Rows> NoContacts(int rows, int bodies) {
  BodyJacobian<Scalar, Rows> J;
  if constexpr (Rows == Eigen::Dynamic) J.resize(rows, 3 * bodies);
  for (int k = 0; k < 3 * bodies; ++k) {
    for (int i = 0; i < rows; ++i) J(i, k) = Scalar(0);
  }
  return J;
}

// A = J M^-1 J', b = J M^-1 F for bodies at rest.
template <class Scalar, int Rows, class AnyBody>
void SetFromBodies(const BodyJacobian<Scalar, Rows>& J, int bodies, const std::array<AnyBody, kMaxBodies>& body,
                   ContactProblem<Scalar, Rows>& problem) {
  BodyJacobian<Scalar, Rows> weighted = J;
  for (int k = 0; k < 3 * bodies; ++k) {
    for (int i = 0; i < problem.rows(); ++i) weighted(i, k) *= body[k / 3].inverse_mass[k % 3];
  }
  SetProduct(weighted, J, 3 * bodies, problem);
  MirrorLowerTriangle(problem);
  SetImage(
      J, 3 * bodies, [&body](int k) { return body[k / 3].free_acceleration[k % 3]; }, problem);
}

// Unit normals 2pq : p^2 - q^2 over p^2 + q^2, all quadrants, p and q up to `most`; p = q = 0 counts as (1, 0):
// straight up.
template <class Scalar>
Vector2<Scalar> DrawNormal(int most, Choices& choices) {
  int p = static_cast<int>(choices.Integer(-most, most));
  const int q = static_cast<int>(choices.Integer(-most, most));
  if (p == 0 && q == 0) p = 1;
  const Scalar length = Scalar(p * p + q * q);
  return MakeVector2<Scalar>(Scalar(Scalar(2 * p * q) / length), Scalar(Scalar(p * p - q * q) / length));
}

// The rows of one contact in the columns of one body, sign * (n, r x n) and sign * (t, r x t).
template <class Scalar, class Columns>
void SetSceneRows(const Vector2<Scalar>& normal, const Vector2<Scalar>& arm, int contact, int index, int sign,
                  Columns& J) {
  const Vector2<Scalar> n = Scalar(sign) * normal, t = Quarter<Scalar>(n);
  for (int k = 0; k < 2; ++k) {
    J(2 * contact, 3 * index + k) = n[k];
    J(2 * contact + 1, 3 * index + k) = t[k];
  }
  J(2 * contact, 3 * index + 2) = Cross<Scalar>(arm, n);
  J(2 * contact + 1, 3 * index + 2) = Cross<Scalar>(arm, t);
}

}  // namespace stiction::generators
