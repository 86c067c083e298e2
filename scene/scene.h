// SPDX-License-Identifier: Apache-2.0
// Scene: rigid bodies in the plane, what joins them and what acts on them. Plain data.
//
// A body's own coordinates have their origin at its centre of mass. A point p of them is at
// position + R(rotation) p. Units: m, s, kg, N; moments and spins anticlockwise.
//
// A fixed body is moved by nothing; it may have a velocity, an acceleration and a spin of its own (a driven
// crank, a conveyor, a floor that is pushed up). Spin and acceleration stay as they are.

#ifndef STICTION_SCENE_SCENE_H_
#define STICTION_SCENE_SCENE_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/plane.h"

namespace stiction {

// A convex piece of a body: a polygon, its corners anticlockwise and strictly convex, or a disc.
template <class Scalar>
struct BodyShape {
  std::vector<Vector2<Scalar>> polygon;  // empty: a disc
  Vector2<Scalar> center = MakeVector2<Scalar>(Scalar(0), Scalar(0));
  Scalar radius = Scalar(0);

  bool IsDisc() const { return polygon.empty(); }
};

template <class Scalar>
struct RigidBody {
  std::string name;
  bool fixed = false;
  Scalar mass = Scalar(1), inertia = Scalar(1);  // > 0; of no meaning if fixed
  Vector2<Scalar> position = MakeVector2<Scalar>(Scalar(0), Scalar(0));
  Vector2<Scalar> rotation = MakeVector2<Scalar>(Scalar(1), Scalar(0));  // (cos, sin)
  Vector2<Scalar> velocity = MakeVector2<Scalar>(Scalar(0), Scalar(0));
  Scalar spin = Scalar(0);
  Vector2<Scalar> acceleration = MakeVector2<Scalar>(Scalar(0), Scalar(0));  // of a fixed body; m/s^2
  Vector2<Scalar> force = MakeVector2<Scalar>(Scalar(0), Scalar(0));  // beside gravity, at the centre of mass
  Scalar torque = Scalar(0);
  std::vector<BodyShape<Scalar>> shapes;
  int level = 0;  // bodies of different levels do not touch

  Vector2<Scalar> At(const Vector2<Scalar>& local) const { return position + Rotate(rotation, local); }
  Vector2<Scalar> Local(const Vector2<Scalar>& point) const {
    return RotateBack<Scalar>(rotation, point - position);
  }
  // Velocity of the material point at `point`, in world coordinates.
  Vector2<Scalar> VelocityAt(const Vector2<Scalar>& point) const {
    return velocity + spin * Quarter<Scalar>(point - position);
  }
};

// pin     the points at_a and at_b coincide (2 rows)
// rail    at_a stays on the line through at_b along `direction`, which turns with b (1 row)
// slider  a rail on which a does not turn relative to b either (2 rows)
enum class JointKind : std::uint8_t { kPin, kRail, kSlider };

template <class Scalar>
struct Joint {
  JointKind kind = JointKind::kPin;
  int a = 0, b = 0;                   // bodies
  Vector2<Scalar> at_a, at_b;         // in the coordinates of a and of b
  Vector2<Scalar> direction;          // unit vector in the coordinates of b; rail and slider
  Vector2<Scalar> relative_rotation;  // of a, seen from b; slider
};

// A contact that is given rather than found: the point at_a of body a stays outside of the line through at_b of
// body b with the outer normal `normal`, both in the coordinates of b.
template <class Scalar>
struct GivenContact {
  int a = 0, b = 0;
  Vector2<Scalar> at_a, at_b, normal;
};

// What two bodies are to each other, where it is not the rule.
template <class Scalar>
struct PairRule {
  int a = 0, b = 0;
  std::optional<Scalar> mu;
  std::optional<bool> collide;  // by default bodies of one level that no joint connects
};

template <class Scalar>
struct Scene {
  std::string name;
  Vector2<Scalar> gravity = MakeVector2<Scalar>(Scalar(0), Scalar(0));  // m/s^2
  Scalar mu = Scalar(0);                                                // of all pairs without a rule
  Scalar gap = Scalar(0);   // shapes that are no farther apart count as touching
  Scalar rest = Scalar(0);  // a tangential speed up to which a contact counts as at rest
  std::vector<RigidBody<Scalar>> bodies;
  std::vector<Joint<Scalar>> joints;
  std::vector<GivenContact<Scalar>> contacts;
  std::vector<PairRule<Scalar>> pairs;
};

// What is wrong with a polygon, or nothing: three corners at least, anticlockwise, strictly convex. Decided
// exactly.
std::string PolygonFault(const std::vector<Vector2<mpq_class>>& polygon);

// Area (times a density of 1), centre and moment of inertia about the origin of the pieces together; pieces
// that overlap count twice. Discs: pi as a double.
template <class Scalar>
struct MassProperties {
  Scalar area = Scalar(0), inertia = Scalar(0);
  Vector2<Scalar> center = MakeVector2<Scalar>(Scalar(0), Scalar(0));
};
MassProperties<mpq_class> MassPropertiesOf(const std::vector<BodyShape<mpq_class>>& shapes);

PairRule<double> Round(const PairRule<mpq_class>& rule);
// The scene over doubles, each number rounded to the nearest.
Scene<double> Round(const Scene<mpq_class>& scene);

}  // namespace stiction

#endif  // STICTION_SCENE_SCENE_H_
