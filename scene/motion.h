// SPDX-License-Identifier: Apache-2.0
// How bodies move, over doubles. `change` and `acceleration` are of velocity and spin, or displacement and
// turn.
//
// In space the given forces of a step contain the gyroscopic moment -w x (I w). After the turn by h w the spin
// is the one that the angular momentum asks for, w = inverse of (the turned I) times (I w + h (moments)):
// nothing but moments changes an angular momentum, up to rounding. Energy is kept to first order in h.

#pragma once

#include <algorithm>
#include <cmath>

#include "scene/scene.h"

namespace stiction {

template <class Kind>
using ChangeIn = Eigen::Matrix<double, Kind::kDof, 1>;

inline void Turn(Vector2<double>& rotation, double angle) {
  if (angle == 0) return;
  const auto turn = MakeVector2<double>(std::cos(angle), std::sin(angle));
  rotation = UnitVector(Rotate(turn, rotation));
}
// By the rotation vector `turn`, rad.
inline void Turn(Quaternion<double>& rotation, const Vector3<double>& turn) {
  const double angle = turn.norm();
  if (angle == 0) return;
  const Vector3<double> sine = std::sin(angle / 2) / angle * turn;
  rotation = Product<double>(MakeQuaternion<double>(std::cos(angle / 2), sine), rotation);
  rotation.normalize();
}

inline double SpinOf(const ChangeIn<Plane>& change) { return change[2]; }
inline Vector3<double> SpinOf(const ChangeIn<Space>& change) { return change.tail<3>(); }

inline double RateOf(double spin) { return std::abs(spin); }
inline double RateOf(const Vector3<double>& spin) { return spin.norm(); }

// How far its pieces are from its centre, m.
template <class Kind>
double RadiusOf(const BodyIn<Kind, double>& body) {
  double radius = 0;
  for (const auto& shape : body.shapes) {
    radius = std::max(radius, shape.center.norm() + shape.radius);
    for (const auto& corner : shape.corners) radius = std::max(radius, corner.norm());
  }
  return radius;
}

// A bound of the speed of its points, m/s.
template <class Kind>
double FastestPoint(const BodyIn<Kind, double>& body) {
  return body.velocity.norm() + RateOf(body.spin) * RadiusOf(body);
}

template <class Kind>
void AddVelocity(BodyIn<Kind, double>& body, const ChangeIn<Kind>& change) {
  body.velocity += change.template head<Kind::kDimension>();
  body.spin += SpinOf(change);
}

template <class Kind>
void Displace(BodyIn<Kind, double>& body, const ChangeIn<Kind>& change) {
  body.position += change.template head<Kind::kDimension>();
  Turn(body.rotation, SpinOf(change));
}

template <class Kind>
void Coast(BodyIn<Kind, double>& body, double h) {
  body.position += h * body.velocity;
  Turn(body.rotation, h * body.spin);
}

// Velocities for the time k, then positions for h.
inline void Advance(RigidBody<double>& body, const ChangeIn<Plane>& acceleration, double k, double h) {
  const ChangeIn<Plane> change = k * acceleration;
  AddVelocity(body, change);
  Coast(body, h);
}
inline void Advance(BodyInSpace<double>& body, const ChangeIn<Space>& acceleration, double k, double h) {
  const Matrix3<double> inertia = WorldInertia(body);
  // `acceleration` has the gyroscopic moment, which changes no momentum.
  const Vector3<double> gyroscopic = -CrossProduct<double>(body.spin, inertia * body.spin);
  const ChangeIn<Space> change = k * acceleration;
  AddVelocity(body, change);
  const Vector3<double> momentum = inertia * body.spin - k * gyroscopic;
  Coast(body, h);
  if (!body.fixed && !body.spin.isZero(0)) body.spin = Inverse3<double>(WorldInertia(body)) * momentum;
}

// Twice the energy of its spin, J.
inline double SpinEnergy(const RigidBody<double>& body) { return body.inertia * body.spin * body.spin; }
inline double SpinEnergy(const BodyInSpace<double>& body) {
  return body.spin.dot(WorldInertia(body) * body.spin);
}

}  // namespace stiction
