// SPDX-License-Identifier: Apache-2.0
#include "scene/assemble_space.h"

#include <array>
#include <utility>

#include "scene/assemble.ipp"
#include "scene/explain.ipp"

namespace stiction {

template <class Scalar>
std::vector<BodyDynamics<Scalar, 6>> DynamicsOf(const SceneInSpace<Scalar>& scene) {
  std::vector<BodyDynamics<Scalar, 6>> bodies;
  for (const auto& body : scene.bodies) {
    BodyDynamics<Scalar, 6> d;
    d.fixed = body.fixed;
    d.W = Eigen::Matrix<Scalar, 6, 6>::Constant(Scalar(0));
    d.force = Eigen::Matrix<Scalar, 6, 1>::Constant(Scalar(0));
    d.velocity << body.velocity, body.spin;
    d.imposed << body.acceleration, Zero3<Scalar>();
    if (!body.fixed) {
      const Matrix3<Scalar> inertia = body.WorldInertia();
      const Vector3<Scalar> momentum = inertia * body.spin;
      for (int i = 0; i < 3; ++i) d.W(i, i) = Scalar(1) / body.mass;
      d.W.template bottomRightCorner<3, 3>() = Inverse3<Scalar>(inertia);
      d.force << body.mass * scene.gravity + body.force,
          body.torque - CrossProduct<Scalar>(body.spin, momentum);
    }
    bodies.push_back(std::move(d));
  }
  return bodies;
}

namespace {

template <class Scalar>
Vector3<Scalar> FirstTangent(const Vector3<Scalar>& n) {
  int least = 0;
  for (int i = 1; i < 3; ++i) {
    if (Abs<Scalar>(n[i]) < Abs<Scalar>(n[least])) least = i;
  }
  Vector3<Scalar> axis = Zero3<Scalar>();
  axis[least] = Scalar(1);
  return UnitVector3<Scalar>(CrossProduct<Scalar>(n, axis));
}

// The velocity along d of a's point at arm_a relative to b's at arm_b.
template <class Scalar>
ConstraintRow<Scalar, 6> RowAlong(const Vector3<Scalar>& d, const Vector3<Scalar>& arm_a,
                                  const Vector3<Scalar>& arm_b) {
  ConstraintRow<Scalar, 6> row;
  row.J[0] << d, CrossProduct<Scalar>(arm_a, d);
  row.J[1] << -d, -CrossProduct<Scalar>(arm_b, d);
  return row;
}

template <class Scalar>
Vector3<Scalar> Twice(const Vector3<Scalar>& w, const Vector3<Scalar>& v) {
  return CrossProduct<Scalar>(w, CrossProduct<Scalar>(w, v));
}

// Something that moves with a, seen from b.
template <class Scalar>
struct SeenFromB {
  Vector3<Scalar> first, second;  // derivatives

  SeenFromB(const Vector3<Scalar>& w_b, const Vector3<Scalar>& y, const Vector3<Scalar>& world_first,
            const Vector3<Scalar>& world_second)
      : first(world_first - CrossProduct<Scalar>(w_b, y)),
        second(world_second - Scalar(2) * CrossProduct<Scalar>(w_b, world_first) + Twice<Scalar>(w_b, y)) {}
};

template <class Scalar>
Scalar EdgesBias(const TouchPointInSpace<Scalar>& contact, const Vector3<Scalar>& w_a,
                 const Vector3<Scalar>& w_b, const SeenFromB<Scalar>& y) {
  const Vector3<Scalar>&n = contact.normal, &e = contact.edge_a;
  const SeenFromB<Scalar> edge(w_b, e, CrossProduct<Scalar>(w_a, e), Twice<Scalar>(w_a, e));
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

template <class Scalar>
Scalar NormalBias(const BodyInSpace<Scalar>& a, const BodyInSpace<Scalar>& b,
                  const TouchPointInSpace<Scalar>& contact) {
  const Vector3<Scalar>& n = contact.normal;
  const Vector3<Scalar> c = contact.point + (contact.gap + contact.radius_a) * n;
  const Vector3<Scalar> d = contact.point - contact.radius_b * n;
  const SeenFromB<Scalar> y(b.spin, c - d, a.VelocityAt(c) - b.VelocityAt(d),
                            Twice<Scalar>(a.spin, c - a.position) - Twice<Scalar>(b.spin, d - b.position));
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

// How fast the contact point runs ahead of the material.
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
  return Zero3<Scalar>();
}

}  // namespace

template <class Scalar>
Constraint<Scalar, 6> ContactConstraint(const SceneInSpace<Scalar>& scene,
                                        const TouchPointInSpace<Scalar>& contact) {
  const BodyInSpace<Scalar>&a = scene.bodies[contact.a], &b = scene.bodies[contact.b];
  const Vector3<Scalar>&n = contact.normal, &p = contact.point;
  const Vector3<Scalar> arm_a = p - a.position, arm_b = p - b.position, spin = a.spin - b.spin;
  const Vector3<Scalar> t1 = FirstTangent<Scalar>(n), t2 = CrossProduct<Scalar>(n, t1);
  Constraint<Scalar, 6> constraint;
  constraint.bodies = {contact.a, contact.b};
  constraint.law.mu = contact.mu;
  for (const auto& d : {n, t1, t2}) constraint.rows.push_back(RowAlong<Scalar>(d, arm_a, arm_b));
  constraint.rows[0].error = contact.gap;
  constraint.rows[0].bias = NormalBias<Scalar>(a, b, contact);
  const Vector3<Scalar> bias = Twice<Scalar>(a.spin, arm_a) - Twice<Scalar>(b.spin, arm_b) +
                               CrossProduct<Scalar>(spin, Wandering<Scalar>(contact, spin));
  constraint.rows[1].bias = t1.dot(bias);
  constraint.rows[2].bias = t2.dot(bias);
  return constraint;
}

namespace {

// Across the point p of a and q of b, along u.
template <class Scalar>
ConstraintRow<Scalar, 6> PointRow(const BodyInSpace<Scalar>& a, const BodyInSpace<Scalar>& b,
                                  const Vector3<Scalar>& p, const Vector3<Scalar>& q,
                                  const Vector3<Scalar>& u) {
  ConstraintRow<Scalar, 6> row = RowAlong<Scalar>(u, p - a.position, p - b.position);
  const SeenFromB<Scalar> y(b.spin, p - q, a.VelocityAt(p) - b.VelocityAt(q),
                            Twice<Scalar>(a.spin, p - a.position) - Twice<Scalar>(b.spin, q - b.position));
  row.bias = u.dot(y.second);
  row.error = u.dot(p - q);
  return row;
}

// Between the directions y of a and s of b.
template <class Scalar>
ConstraintRow<Scalar, 6> DirectionRow(const BodyInSpace<Scalar>& a, const BodyInSpace<Scalar>& b,
                                      const Vector3<Scalar>& y, const Vector3<Scalar>& s) {
  ConstraintRow<Scalar, 6> row;
  const Vector3<Scalar> axis = CrossProduct<Scalar>(y, s);
  row.J[0] << Zero3<Scalar>(), axis;
  row.J[1] << Zero3<Scalar>(), -axis;
  const SeenFromB<Scalar> seen(b.spin, y, CrossProduct<Scalar>(a.spin, y), Twice<Scalar>(a.spin, y));
  row.bias = s.dot(seen.second);
  row.error = s.dot(y);
  return row;
}

// (e1, e2, e3) as columns, in the coordinates of b.
template <class Scalar>
Matrix3<Scalar> AxesOf(const JointInSpace<Scalar>& joint) {
  if (joint.kind == JointKindInSpace::kBall) return Matrix3<Scalar>::Identity();
  Matrix3<Scalar> axes;
  axes.col(0) = FirstTangent<Scalar>(joint.direction);
  axes.col(1) = CrossProduct<Scalar>(joint.direction, axes.col(0));
  axes.col(2) = joint.direction;
  return axes;
}

template <class Scalar>
std::vector<ConstraintRow<Scalar, 6>> RowsOf(const SceneInSpace<Scalar>& scene,
                                             const JointInSpace<Scalar>& joint) {
  const BodyInSpace<Scalar>&a = scene.bodies[joint.a], &b = scene.bodies[joint.b];
  const Vector3<Scalar> p = a.At(joint.at_a), q = b.At(joint.at_b);
  const Matrix3<Scalar> axes = AxesOf(joint), e = RotationMatrix<Scalar>(b.rotation) * axes;
  const Matrix3<Scalar> seen_from_a = RotationMatrix<Scalar>(joint.relative_rotation).transpose() * axes;
  const Matrix3<Scalar> d = RotationMatrix<Scalar>(a.rotation) * seen_from_a;
  const bool slides = joint.kind == JointKindInSpace::kRail || joint.kind == JointKindInSpace::kSlider;
  std::vector<ConstraintRow<Scalar, 6>> rows;
  for (int k = 0; k < (slides ? 2 : 3); ++k) rows.push_back(PointRow<Scalar>(a, b, p, q, e.col(k)));
  if (joint.kind == JointKindInSpace::kHinge) {
    for (int k = 0; k < 2; ++k) rows.push_back(DirectionRow<Scalar>(a, b, d.col(2), e.col(k)));
  }
  if (joint.kind == JointKindInSpace::kSlider) {
    for (int k = 0; k < 3; ++k) rows.push_back(DirectionRow<Scalar>(a, b, d.col(k), e.col((k + 1) % 3)));
  }
  return rows;
}

}  // namespace

template <class Scalar>
std::vector<Constraint<Scalar, 6>> JointConstraints(const SceneInSpace<Scalar>& scene) {
  std::vector<Constraint<Scalar, 6>> constraints;
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    int part = 0;
    for (auto& row : RowsOf(scene, scene.joints[i])) {
      Constraint<Scalar, 6> constraint;
      constraint.bodies = {scene.joints[i].a, scene.joints[i].b};
      constraint.law.kind = ContactKind::kBilateral;
      constraint.rows.push_back(std::move(row));
      constraint.from_joint = true;
      constraint.source = static_cast<int>(i);
      constraint.part = part++;
      constraints.push_back(std::move(constraint));
    }
  }
  return constraints;
}

template <class Scalar>
const char* KindName(const JointInSpace<Scalar>& joint) {
  constexpr std::array kNames = {"ball", "hinge", "rail", "slider"};
  return kNames[static_cast<int>(joint.kind)];
}

#define STICTION_INSTANTIATE(Scalar)                                                                          \
  template std::vector<BodyDynamics<Scalar, 6>> DynamicsOf(const SceneInSpace<Scalar>&);                      \
  template std::vector<Constraint<Scalar, 6>> JointConstraints(const SceneInSpace<Scalar>&);                  \
  template Constraint<Scalar, 6> ContactConstraint(const SceneInSpace<Scalar>&,                               \
                                                   const TouchPointInSpace<Scalar>&);                         \
  template SceneModel<Scalar, 6> Assemble(const SceneInSpace<Scalar>&,                                        \
                                          const std::vector<TouchPointInSpace<Scalar>>&,                      \
                                          const AssembleOptions<Scalar>&);                                    \
  template ContactProblem<Scalar> DenseProblemOf(const std::vector<BodyDynamics<Scalar, 6>>&,                 \
                                                 const std::vector<Constraint<Scalar, 6>>&, const Island&);   \
  template SparseContactProblem<Scalar> SparseProblemOf(                                                      \
      const std::vector<BodyDynamics<Scalar, 6>>&, const std::vector<Constraint<Scalar, 6>>&, const Island&); \
  template std::vector<Eigen::Matrix<Scalar, 6, 1>> BodyAccelerations(                                        \
      const SceneModel<Scalar, 6>&, const std::vector<typename ContactProblem<Scalar>::Vector>&);             \
  template typename ContactProblem<Scalar>::Vector ExtendForces(                                              \
      const SceneModel<Scalar, 6>&, const std::vector<typename ContactProblem<Scalar>::Vector>&,              \
      const SceneModel<Scalar, 6>&);                                                                          \
  template std::vector<std::string> Explain(const SceneInSpace<Scalar>&,                                      \
                                            const std::vector<TouchPointInSpace<Scalar>>&,                    \
                                            const SceneModel<Scalar, 6>&, const AssembleOptions<Scalar>&)

STICTION_INSTANTIATE(double);
STICTION_INSTANTIATE(mpq_class);

#undef STICTION_INSTANTIATE

}  // namespace stiction
