// SPDX-License-Identifier: Apache-2.0
// Definitions for assemble.h, in its order.

#ifndef STICTION_SCENE_ASSEMBLE_IPP_
#define STICTION_SCENE_ASSEMBLE_IPP_

#include <array>
#include <map>

#include "scene/assemble.h"
#include "scene/mechanics.ipp"

namespace stiction {

template <class Scalar>
std::vector<BodyDynamics<Scalar, 3>> DynamicsOf(const Scene<Scalar>& scene) {
  std::vector<BodyDynamics<Scalar, 3>> bodies;
  for (const auto& body : scene.bodies) {
    BodyDynamics<Scalar, 3> d;
    d.fixed = body.fixed;
    d.W = Eigen::Matrix<Scalar, 3, 3>::Constant(Scalar(0));
    d.force = Eigen::Matrix<Scalar, 3, 1>::Constant(Scalar(0));
    for (int i = 0; i < 2; ++i) d.velocity[i] = body.velocity[i];
    d.velocity[2] = body.spin;
    for (int i = 0; i < 2; ++i) d.imposed[i] = body.acceleration[i];
    if (!body.fixed) {
      for (int i = 0; i < 2; ++i) {
        d.W(i, i) = Scalar(1) / body.mass;
        d.force[i] = body.mass * scene.gravity[i] + body.force[i];
      }
      d.W(2, 2) = Scalar(1) / body.inertia;
      d.force[2] = body.torque;
    }
    bodies.push_back(std::move(d));
  }
  return bodies;
}

// ---- Rows ------------------------------------------------------------------------------------

// The velocity along d of a's point at arm_a relative to b's at arm_b.
template <class Scalar>
ConstraintRow<Scalar, 3> RowAlong(const Vector2<Scalar>& d, const Vector2<Scalar>& arm_a,
                                  const Vector2<Scalar>& arm_b) {
  ConstraintRow<Scalar, 3> row;
  row.J[0] << d[0], d[1], Cross<Scalar>(arm_a, d);
  row.J[1] << Scalar(-d[0]), Scalar(-d[1]), Scalar(-Cross<Scalar>(arm_b, d));
  return row;
}

// Second derivative of a point that turns with its body.
template <class Scalar>
Vector2<Scalar> Centripetal(const RigidBody<Scalar>& body, const Vector2<Scalar>& point) {
  const Scalar factor = -body.spin * body.spin;
  return factor * (point - body.position);
}

// Of n.(c - q): c a point of a, q one of b, n turning with b.
template <class Scalar>
Scalar EdgeBias(const RigidBody<Scalar>& a, const RigidBody<Scalar>& b, const Vector2<Scalar>& c,
                const Vector2<Scalar>& q, const Vector2<Scalar>& n) {
  const Vector2<Scalar> relative = Centripetal<Scalar>(a, c) - Centripetal<Scalar>(b, q);
  const Vector2<Scalar> velocity = a.VelocityAt(c) - b.VelocityAt(q);
  return Scalar(Dot<Scalar>(n, relative) + 2 * b.spin * Dot<Scalar>(Quarter<Scalar>(n), velocity) -
                b.spin * b.spin * Dot<Scalar>(n, c - q));
}

// Of abs(c - d).
template <class Scalar>
Scalar RoundBias(const RigidBody<Scalar>& a, const RigidBody<Scalar>& b, const Vector2<Scalar>& c,
                 const Vector2<Scalar>& d, const Vector2<Scalar>& n) {
  const Vector2<Scalar> relative = Centripetal<Scalar>(a, c) - Centripetal<Scalar>(b, d);
  const Scalar across = Dot<Scalar>(Quarter<Scalar>(n), a.VelocityAt(c) - b.VelocityAt(d));
  const Scalar distance = Dot<Scalar>(n, c - d);
  return Scalar(Dot<Scalar>(n, relative) + (distance > 0 ? Scalar(across * across / distance) : Scalar(0)));
}

template <class Scalar>
Constraint<Scalar, 3> ContactConstraint(const Scene<Scalar>& scene, const TouchPoint<Scalar>& contact) {
  const RigidBody<Scalar>&a = scene.bodies[contact.a], &b = scene.bodies[contact.b];
  const Vector2<Scalar>&n = contact.normal, &p = contact.point;
  const Vector2<Scalar> t = Quarter<Scalar>(n);
  Constraint<Scalar, 3> constraint;
  constraint.bodies = {contact.a, contact.b};
  constraint.law.mu = contact.mu;
  const Vector2<Scalar> arm_a = p - a.position, arm_b = p - b.position;
  constraint.rows = {RowAlong<Scalar>(n, arm_a, arm_b), RowAlong<Scalar>(t, arm_a, arm_b)};
  ConstraintRow<Scalar, 3>&normal = constraint.rows[0], &tangential = constraint.rows[1];
  normal.error = contact.gap;
  const Vector2<Scalar> c = p + (contact.gap + contact.radius_a) * n;
  if (contact.flat_b) {
    normal.bias = EdgeBias<Scalar>(a, b, c, p, n);
  } else {
    normal.bias = RoundBias<Scalar>(a, b, c, p - contact.radius_b * n, n);
  }
  tangential.bias = Dot<Scalar>(t, Centripetal<Scalar>(a, p) - Centripetal<Scalar>(b, p));
  return constraint;
}

template <class Scalar>
Constraint<Scalar, 3> BilateralRow(const Joint<Scalar>& joint, int source, int part,
                                   ConstraintRow<Scalar, 3> row) {
  Constraint<Scalar, 3> constraint;
  constraint.bodies = {joint.a, joint.b};
  constraint.law.kind = ContactKind::kBilateral;
  constraint.rows.push_back(std::move(row));
  constraint.from_joint = true;
  constraint.source = source;
  constraint.part = part;
  return constraint;
}

template <class Scalar>
void AddPin(const Scene<Scalar>& scene, int source, std::vector<Constraint<Scalar, 3>>& constraints) {
  const Joint<Scalar>& joint = scene.joints[source];
  const RigidBody<Scalar>&a = scene.bodies[joint.a], &b = scene.bodies[joint.b];
  const Vector2<Scalar> p = a.At(joint.at_a), q = b.At(joint.at_b);
  const Vector2<Scalar> bias = Centripetal<Scalar>(a, p) - Centripetal<Scalar>(b, q);
  for (int i = 0; i < 2; ++i) {
    const auto axis = MakeVector2<Scalar>(Scalar(1 - i), Scalar(i));
    ConstraintRow<Scalar, 3> row = RowAlong<Scalar>(axis, p - a.position, q - b.position);
    row.bias = bias[i];
    row.error = p[i] - q[i];
    constraints.push_back(BilateralRow(joint, source, i, std::move(row)));
  }
}

template <class Scalar>
void AddRail(const Scene<Scalar>& scene, int source, std::vector<Constraint<Scalar, 3>>& constraints) {
  const Joint<Scalar>& joint = scene.joints[source];
  const RigidBody<Scalar>&a = scene.bodies[joint.a], &b = scene.bodies[joint.b];
  const Vector2<Scalar> p = a.At(joint.at_a), q = b.At(joint.at_b);
  const Vector2<Scalar> n = Quarter<Scalar>(Rotate<Scalar>(b.rotation, joint.direction));
  ConstraintRow<Scalar, 3> row = RowAlong<Scalar>(n, p - a.position, p - b.position);
  row.bias = EdgeBias<Scalar>(a, b, p, q, n);
  row.error = Dot<Scalar>(n, p - q);
  constraints.push_back(BilateralRow(joint, source, 0, std::move(row)));
  if (joint.kind != JointKind::kSlider) return;
  ConstraintRow<Scalar, 3> lock;
  lock.J[0] << Scalar(0), Scalar(0), Scalar(1);
  lock.J[1] << Scalar(0), Scalar(0), Scalar(-1);
  lock.error =
      Cross<Scalar>(Rotate<Scalar>(b.rotation, joint.relative_rotation), a.rotation);  // sine of the turn
  constraints.push_back(BilateralRow(joint, source, 1, std::move(lock)));
}

template <class Scalar>
std::vector<Constraint<Scalar, 3>> JointConstraints(const Scene<Scalar>& scene) {
  std::vector<Constraint<Scalar, 3>> constraints;
  for (int i = 0; i < static_cast<int>(scene.joints.size()); ++i) {
    if (scene.joints[i].kind == JointKind::kPin) {
      AddPin(scene, i, constraints);
    } else {
      AddRail(scene, i, constraints);
    }
  }
  return constraints;
}

// ---- Laws and b ------------------------------------------------------------------------------

template <class SceneType>
class Assembler {
 public:
  using Types = SceneTypes<SceneType>;
  using Scalar = typename Types::Scalar;
  using Touch = typename Types::Touch;
  using Model = typename Types::Model;
  static constexpr int kDof = Types::kDof;

  Assembler(const SceneType& scene, const AssembleOptions<Scalar>& options) : scene_(scene), options_(options) {
    model_.bodies = DynamicsOf(scene);
    for (const auto& body : model_.bodies) free_.push_back(body.FreeAcceleration());
  }

  Model Run(const std::vector<Touch>& contacts) {
    for (auto& constraint : JointConstraints(scene_)) {
      SetB(constraint);
      model_.constraints.push_back(std::move(constraint));
    }
    for (std::size_t i = 0; i < contacts.size(); ++i) AddContact(contacts[i], static_cast<int>(i));
    if (options_.minimal) DropRedundant();
    model_.islands = FindIslands(model_.bodies, model_.constraints, !options_.minimal);
    return std::move(model_);
  }

 private:
  void AddContact(const Touch& contact, int number) {
    Constraint<Scalar, kDof> constraint = ContactConstraint(scene_, contact);
    constraint.source = number;
    const Scalar speed = Speed(constraint, 0);
    const bool stays = Sign(options_.step) != 0 && (!options_.minimal || IsIn(options_.closing, number));
    if (options_.level == Level::kForces && speed > scene_.rest && !stays) {
      model_.omitted.push_back({number, OmissionReason::kSeparating});
      return;
    }
    if (speed < -scene_.rest) model_.colliding.push_back(number);
    SetLaw(constraint);
    SetB(constraint);
    model_.constraints.push_back(std::move(constraint));
  }

  // At this instant, of what is kept: zero where a row is held at zero.
  Scalar Speed(const Constraint<Scalar, kDof>& constraint, int row) const {
    return Scalar(Velocity(constraint, row, model_.bodies) - options_.before / 2 * constraint.rows[row].bias);
  }

  static bool IsIn(const std::vector<bool>& contacts, int number) {
    return number < static_cast<int>(contacts.size()) && contacts[number];
  }

  void SetLaw(Constraint<Scalar, kDof>& constraint) {
    Contact<Scalar>& law = constraint.law;
    const bool smooth = options_.level == Level::kPositions || (options_.minimal && Sign(law.mu) == 0);
    if (smooth) {
      law = {ContactKind::kFrictionless, Scalar(0), {Scalar(0), Scalar(0)}};
      constraint.rows.resize(1);
      return;
    }
    law.kind = ContactKind::kStatic;
    if (options_.level != Level::kForces || Sign(law.mu) == 0 || IsIn(options_.held, constraint.source)) return;
    const Scalar speed = Speed(constraint, 1);
    if constexpr (Types::kDimension == 2) {
      if (Abs<Scalar>(speed) <= scene_.rest) return;
      law.slip = {Scalar(Sign(speed)), Scalar(0)};
    } else {
      const auto velocity = MakeVector2<Scalar>(speed, Speed(constraint, 2));
      if (Dot<Scalar>(velocity, velocity) <= scene_.rest * scene_.rest) return;
      law.slip = ExactDirection<Scalar>(velocity);
    }
    law.kind = ContactKind::kSliding;
  }

  void SetB(Constraint<Scalar, kDof>& constraint) {
    for (int i = 0; i < static_cast<int>(constraint.rows.size()); ++i) SetB(constraint, i);
  }

  void SetB(Constraint<Scalar, kDof>& constraint, int i) {
    ConstraintRow<Scalar, kDof>& row = constraint.rows[i];
    const bool one_sided = constraint.law.kind != ContactKind::kBilateral && i == 0;
    const Scalar gap = one_sided ? std::max<Scalar>(row.error, Scalar(0)) : Scalar(0);
    const bool step = Sign(options_.step) != 0;
    row.b = Scalar(0);
    switch (options_.level) {
      case Level::kForces:
        for (int side = 0; side < 2; ++side) row.b += row.J[side].dot(free_[constraint.bodies[side]]);
        if (!step) {
          row.b += row.bias;
        } else {
          const Scalar velocity = Velocity(constraint, i, model_.bodies);
          row.b += (velocity + options_.step * row.bias / 2 + gap / options_.step) /
                   ((options_.step + options_.before) / 2);
        }
        break;
      case Level::kImpulses:
        row.b = Speed(constraint, i);
        if (step) row.b += gap / options_.step;
        break;
      case Level::kPositions:
        row.b = row.error;
        break;
    }
  }

  void DropRedundant() {
    const std::vector<int> redundant = FindRedundant(model_.constraints);
    if (redundant.empty()) return;
    std::vector<Constraint<Scalar, kDof>> kept;
    for (std::size_t i = 0, dropped = 0; i < model_.constraints.size(); ++i) {
      if (dropped < redundant.size() && redundant[dropped] == static_cast<int>(i)) {
        model_.omitted.push_back({model_.constraints[i].source, OmissionReason::kRedundant});
        ++dropped;
      } else {
        kept.push_back(std::move(model_.constraints[i]));
      }
    }
    model_.constraints = std::move(kept);
  }

  const SceneType& scene_;
  const AssembleOptions<Scalar>& options_;
  Model model_;
  std::vector<Eigen::Matrix<Scalar, kDof, 1>> free_;
};

template <class SceneType, class Types>
typename Types::Model Assemble(const SceneType& scene, const std::vector<typename Types::Touch>& contacts,
                               const AssembleOptions<typename Types::Scalar>& options) {
  return Assembler<SceneType>(scene, options).Run(contacts);
}

// ---- What follows from forces ----------------------------------------------------------------

template <class Scalar, int Dof>
std::vector<Eigen::Matrix<Scalar, Dof, 1>> BodyAccelerations(
    const SceneModel<Scalar, Dof>& model, const std::vector<typename ContactProblem<Scalar>::Vector>& f) {
  std::vector<Eigen::Matrix<Scalar, Dof, 1>> accelerations;
  for (const auto& body : model.bodies) accelerations.push_back(body.FreeAcceleration());
  for (std::size_t i = 0; i < model.islands.size(); ++i)
    AddResponse(model.bodies, model.constraints, model.islands[i], f[i], accelerations);
  return accelerations;
}

template <class Scalar, int Dof>
typename ContactProblem<Scalar>::Vector ExtendForces(
    const SceneModel<Scalar, Dof>& minimal, const std::vector<typename ContactProblem<Scalar>::Vector>& f,
    const SceneModel<Scalar, Dof>& full) {
  std::map<std::array<int, 4>, Scalar> forces;  // by source and row
  const auto key = [](const Constraint<Scalar, Dof>& c, int row) {
    return std::array<int, 4>{c.from_joint, c.source, c.part, row};
  };
  for (std::size_t i = 0; i < minimal.islands.size(); ++i) {
    int at = 0;
    for (const int k : minimal.islands[i].constraints) {
      const auto& constraint = minimal.constraints[k];
      for (int row = 0; row < static_cast<int>(constraint.rows.size()); ++row)
        forces[key(constraint, row)] = f[i][at++];
    }
  }
  typename ContactProblem<Scalar>::Vector extended;
  if (full.islands.empty()) return extended;
  extended = ContactProblem<Scalar>::Vector::Constant(full.islands[0].rows, Scalar(0));
  int at = 0;
  for (const int k : full.islands[0].constraints) {
    for (int row = 0; row < static_cast<int>(full.constraints[k].rows.size()); ++row, ++at) {
      const auto found = forces.find(key(full.constraints[k], row));
      if (found != forces.end()) extended[at] = found->second;
    }
  }
  return extended;
}

}  // namespace stiction

#endif  // STICTION_SCENE_ASSEMBLE_IPP_
