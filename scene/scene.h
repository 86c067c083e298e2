// SPDX-License-Identifier: Apache-2.0
// Scene: rigid bodies in the plane or in space, what joins them and what acts on them. Plain data, templates
// over the kind of scene (Plane, Space) and the scalar. The plane's have the plain names, those of space end in
// InSpace.
//
// A body's own coordinates have their origin at its centre of mass. A point p of them is at
// position + R(rotation) p. Velocities, forces and moments are those of the world, the inertia of a body in
// space is of its own coordinates. Units: m, s, kg, N.
//
// A fixed body is moved by nothing; it may have a velocity, an acceleration and a spin of its own (a driven
// crank, a conveyor, a floor that is pushed up). Spin and acceleration stay as they are.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/space.h"

namespace stiction {

// A convex piece of a body: a disc or ball, or a polygon (polygon.h) or polyhedron (polyhedron.h).
template <class Kind, class Scalar>
struct ShapeIn : Kind::template Surface<Scalar> {
  using Vector = typename Kind::template Vector<Scalar>;

  std::vector<Vector> corners;     // empty: a disc or ball
  Vector center = Zero<Vector>();  // of a disc or ball
  Scalar radius = Scalar(0);

  bool IsRound() const { return corners.empty(); }
};

template <class Kind, class Scalar>
struct BodyIn {
  using Vector = typename Kind::template Vector<Scalar>;
  using Rotation = typename Kind::template Rotation<Scalar>;
  using Spin = typename Kind::template Spin<Scalar>;
  using Inertia = typename Kind::template Inertia<Scalar>;

  std::string name;
  bool fixed = false;
  Scalar mass = Scalar(1);  // > 0; of no meaning if fixed
  Inertia inertia = One();  // positive definite, likewise
  Vector position = Zero<Vector>();
  Rotation rotation = NoRotation<Rotation>();
  Vector velocity = Zero<Vector>();
  Spin spin = Zero<Spin>();
  Vector acceleration = Zero<Vector>();  // of a fixed body; m/s^2
  Vector force = Zero<Vector>();         // beside gravity, at the centre of mass
  Spin torque = Zero<Spin>();
  std::vector<ShapeIn<Kind, Scalar>> shapes;
  int level = 0;  // bodies of different levels do not touch

  Vector At(const Vector& local) const { return position + Rotate(TurnOf(rotation), local); }
  Vector Local(const Vector& point) const {
    const Vector arm = point - position;
    return RotateBack(TurnOf(rotation), arm);
  }
  // Velocity of the material point at `point`, in world coordinates.
  Vector VelocityAt(const Vector& point) const {
    const Vector arm = point - position;
    return velocity + SpinVelocity(spin, arm);
  }

 private:
  static Inertia One() {
    if constexpr (Kind::kDimension == 2) {
      return Scalar(1);
    } else {
      return Inertia::Identity();
    }
  }
};

// Moment of inertia in world coordinates.
template <class Scalar>
Scalar WorldInertia(const BodyIn<Plane, Scalar>& body) {
  return body.inertia;
}
template <class Scalar>
Matrix3<Scalar> WorldInertia(const BodyIn<Space, Scalar>& body) {
  const Matrix3<Scalar> R = RotationMatrix<Scalar>(body.rotation), half = R * body.inertia;
  return half * R.transpose();
}

template <class Kind, class Scalar>
struct JointIn {
  using Vector = typename Kind::template Vector<Scalar>;
  using Rotation = typename Kind::template Rotation<Scalar>;

  typename Kind::JointKind kind = {};
  int a = 0, b = 0;                                     // bodies
  Vector at_a = Zero<Vector>(), at_b = Zero<Vector>();  // in the coordinates of a and of b
  Vector direction = Zero<Vector>();                    // unit vector in the coordinates of b; not of a point
  // Of a, seen from b. Slider, and hinge: there any turn about its axis may follow.
  Rotation relative_rotation = NoRotation<Rotation>();
};

// Whether a joint has an axis (not that of a point), and whether it keeps its bodies from turning about others.
template <class Kind, class Scalar>
bool HasDirection(const JointIn<Kind, Scalar>& joint) {
  return joint.kind != typename Kind::JointKind{};
}
template <class Kind, class Scalar>
bool HasTurn(const JointIn<Kind, Scalar>& joint) {
  return HasDirection(joint) && joint.kind != Kind::JointKind::kRail;
}

// A contact that is given rather than found: the point at_a of body a stays outside of the line or plane
// through at_b of body b with the outer normal `normal`, both in the coordinates of b.
template <class Kind, class Scalar>
struct GivenContactIn {
  int a = 0, b = 0;
  typename Kind::template Vector<Scalar> at_a, at_b, normal;
};

// What two bodies are to each other, where it is not the rule.
template <class Scalar>
struct PairRule {
  int a = 0, b = 0;
  std::optional<Scalar> mu;
  std::optional<bool> collide;  // by default bodies of one level that no joint connects
};

template <class Kind, class Scalar>
struct SceneIn {
  using Vector = typename Kind::template Vector<Scalar>;

  std::string name;
  Vector gravity = Zero<Vector>();  // m/s^2
  Scalar mu = Scalar(0);            // of all pairs without a rule
  Scalar gap = Scalar(0);           // shapes that are no farther apart count as touching
  Scalar rest = Scalar(0);          // a tangential speed up to which a contact counts as at rest
  std::vector<BodyIn<Kind, Scalar>> bodies;
  std::vector<JointIn<Kind, Scalar>> joints;
  std::vector<GivenContactIn<Kind, Scalar>> contacts;
  std::vector<PairRule<Scalar>> pairs;
};

template <class Scalar>
using BodyShape = ShapeIn<Plane, Scalar>;
template <class Scalar>
using RigidBody = BodyIn<Plane, Scalar>;
template <class Scalar>
using Joint = JointIn<Plane, Scalar>;
template <class Scalar>
using Scene = SceneIn<Plane, Scalar>;

template <class Scalar>
using ShapeInSpace = ShapeIn<Space, Scalar>;
template <class Scalar>
using BodyInSpace = BodyIn<Space, Scalar>;
template <class Scalar>
using JointInSpace = JointIn<Space, Scalar>;
template <class Scalar>
using SceneInSpace = SceneIn<Space, Scalar>;

// The scene over doubles, each number rounded to the nearest.
template <class Kind>
SceneIn<Kind, double> Round(const SceneIn<Kind, mpq_class>& scene);

// Of pieces together, at a density of 1: mass (an area or volume), centre, and inertia about the origin. Pieces
// that overlap count twice. Discs and balls: pi as a double.
template <class Kind>
struct MassPropertiesIn {
  using Vector = typename Kind::template Vector<mpq_class>;
  using Inertia = typename Kind::template Inertia<mpq_class>;

  mpq_class mass = 0;
  Vector center = Zero<Vector>();
  Inertia inertia = Zero<Inertia>();
};

}  // namespace stiction
