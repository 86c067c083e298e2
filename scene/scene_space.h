// SPDX-License-Identifier: Apache-2.0
// Scene in space: scene.h with three dimensions. Plain data.
//
// A body's own coordinates have their origin at its centre of mass. A point p of them is at
// position + R(rotation) p. Velocities, spins, forces and moments are vectors of the world; the inertia is of
// the body's coordinates. Units: m, s, kg, N.

#ifndef STICTION_SCENE_SCENE_SPACE_H_
#define STICTION_SCENE_SCENE_SPACE_H_

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/space.h"

namespace stiction {

// An edge of a polyhedron: from corner to corner, seen from outside with face `left` on its left.
struct PolyhedronEdge {
  int from = 0, to = 0;
  int left = 0, right = 0;
};

// A convex piece of a body: a polyhedron or a ball.
template <class Scalar>
struct ShapeInSpace {
  std::vector<Vector3<Scalar>> corners;  // empty: a ball
  std::vector<std::vector<int>> faces;   // their corners, anticlockwise from outside
  std::vector<Vector3<Scalar>> normals;  // of the faces, outward, of length 1 up to rounding
  std::vector<PolyhedronEdge> edges;
  Vector3<Scalar> center = Zero3<Scalar>();  // of a ball
  Scalar radius = Scalar(0);

  bool IsBall() const { return corners.empty(); }
};

template <class Scalar>
struct BodyInSpace {
  std::string name;
  bool fixed = false;
  Scalar mass = Scalar(1);                                // > 0; of no meaning if fixed
  Matrix3<Scalar> inertia = Matrix3<Scalar>::Identity();  // positive definite, likewise
  Vector3<Scalar> position = Zero3<Scalar>();
  Quaternion<Scalar> rotation = MakeQuaternion<Scalar>(Scalar(1), Zero3<Scalar>());
  Vector3<Scalar> velocity = Zero3<Scalar>(), spin = Zero3<Scalar>();
  Vector3<Scalar> acceleration = Zero3<Scalar>();                     // of a fixed body; m/s^2
  Vector3<Scalar> force = Zero3<Scalar>(), torque = Zero3<Scalar>();  // beside gravity, at the centre of mass
  std::vector<ShapeInSpace<Scalar>> shapes;
  int level = 0;  // bodies of different levels do not touch

  Vector3<Scalar> At(const Vector3<Scalar>& local) const {
    return position + RotationMatrix<Scalar>(rotation) * local;
  }
  Vector3<Scalar> Local(const Vector3<Scalar>& point) const {
    return RotationMatrix<Scalar>(rotation).transpose() * (point - position);
  }
  // Velocity of the material point at `point`, in world coordinates.
  Vector3<Scalar> VelocityAt(const Vector3<Scalar>& point) const {
    return velocity + CrossProduct<Scalar>(spin, point - position);
  }
  // Moment of inertia in world coordinates.
  Matrix3<Scalar> WorldInertia() const {
    const Matrix3<Scalar> R = RotationMatrix<Scalar>(rotation), half = R * inertia;
    return half * R.transpose();
  }
};

// ball    the points at_a and at_b coincide (3 rows)
// hinge   a ball on which a turns relative to b about `direction` only (5 rows)
// rail    at_a stays on the line through at_b along `direction`, which turns with b (2 rows)
// slider  a rail on which a does not turn relative to b either (5 rows)
enum class JointKindInSpace : std::uint8_t { kBall, kHinge, kRail, kSlider };

template <class Scalar>
struct JointInSpace {
  JointKindInSpace kind = JointKindInSpace::kBall;
  int a = 0, b = 0;                             // bodies
  Vector3<Scalar> at_a, at_b;                   // in the coordinates of a and of b
  Vector3<Scalar> direction = Zero3<Scalar>();  // unit vector in the coordinates of b; not of a ball
  // Of a, seen from b. Slider, and hinge: there any turn about its axis may follow.
  Quaternion<Scalar> relative_rotation = MakeQuaternion<Scalar>(Scalar(1), Zero3<Scalar>());
};

// The point at_a of body a stays outside of the plane through at_b of body b with the outer normal `normal`,
// both in the coordinates of b.
template <class Scalar>
struct GivenContactInSpace {
  int a = 0, b = 0;
  Vector3<Scalar> at_a, at_b, normal;
};

template <class Scalar>
struct SceneInSpace {
  std::string name;
  Vector3<Scalar> gravity = Zero3<Scalar>();  // m/s^2
  Scalar mu = Scalar(0);                      // of all pairs without a rule
  Scalar gap = Scalar(0);                     // shapes that are no farther apart count as touching
  Scalar rest = Scalar(0);                    // a tangential speed up to which a contact counts as at rest
  std::vector<BodyInSpace<Scalar>> bodies;
  std::vector<JointInSpace<Scalar>> joints;
  std::vector<GivenContactInSpace<Scalar>> contacts;
  std::vector<PairRule<Scalar>> pairs;
};

// The convex hull of the corners. `fault` is what keeps them from being the corners of a convex polyhedron
// (fewer than four, all in one plane, one that is none of the hull), or empty. Decided exactly.
struct Polyhedron {
  ShapeInSpace<mpq_class> shape;
  std::string fault;
};
Polyhedron MakePolyhedron(std::vector<Vector3<mpq_class>> corners);

// Volume (times a density of 1), centre and inertia about the origin of the pieces together; pieces that
// overlap count twice. Balls: pi as a double.
struct MassPropertiesInSpace {
  mpq_class volume = 0;
  Vector3<mpq_class> center = Zero3<mpq_class>();
  Matrix3<mpq_class> inertia = Matrix3<mpq_class>::Constant(mpq_class(0));
};
MassPropertiesInSpace MassPropertiesOf(const std::vector<ShapeInSpace<mpq_class>>& shapes);

// The scene over doubles, each number rounded to the nearest.
SceneInSpace<double> Round(const SceneInSpace<mpq_class>& scene);

}  // namespace stiction

#endif  // STICTION_SCENE_SCENE_SPACE_H_
