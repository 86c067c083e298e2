// SPDX-License-Identifier: Apache-2.0
// Definitions for rows.h and assemble.h, in their order.

#pragma once

#include <array>
#include <map>
#include <utility>

#include "scene/assemble.h"
#include "scene/mechanics.ipp"
#include "scene/rows.h"

namespace stiction {

// ---- Bodies and rows -------------------------------------------------------------------------

template <class Scalar>
Scalar Inertia(const RigidBody<Scalar>& body) {
  return body.inertia;
}
template <class Scalar>
Matrix3<Scalar> Inertia(const BodyInSpace<Scalar>& body) {
  return WorldInertia(body);
}
template <class Scalar>
Scalar InverseInertia(const RigidBody<Scalar>& body) {
  return Scalar(1) / body.inertia;
}
template <class Scalar>
Matrix3<Scalar> InverseInertia(const BodyInSpace<Scalar>& body) {
  return Inverse3<Scalar>(WorldInertia(body));
}

// The given moment, in space with the gyroscopic one.
template <class Scalar>
Scalar MomentOn(const RigidBody<Scalar>& body) {
  return body.torque;
}
template <class Scalar>
Vector3<Scalar> MomentOn(const BodyInSpace<Scalar>& body) {
  const Vector3<Scalar> momentum = WorldInertia(body) * body.spin;
  return body.torque - CrossProduct<Scalar>(body.spin, momentum);
}

template <class Kind, class Scalar>
BodyDynamics<Scalar, Kind::kDof> DynamicsOf(const SceneIn<Kind, Scalar>& scene,
                                            const BodyIn<Kind, Scalar>& body) {
  using Dynamics = BodyDynamics<Scalar, Kind::kDof>;
  constexpr int kSpins = Kind::kDof - Kind::kDimension;
  Dynamics d;
  d.fixed = body.fixed;
  d.M = d.W = Zero<typename Dynamics::Matrix>();
  d.force = Zero<typename Dynamics::Vector>();
  d.velocity << body.velocity, body.spin;
  d.imposed.template head<Kind::kDimension>() = body.acceleration;
  if (body.fixed) return d;
  for (int i = 0; i < Kind::kDimension; ++i) {
    d.M(i, i) = body.mass;
    d.W(i, i) = Scalar(1) / body.mass;
  }
  d.M.template bottomRightCorner<kSpins, kSpins>() << Inertia(body);
  d.W.template bottomRightCorner<kSpins, kSpins>() << InverseInertia(body);
  d.force << body.mass * scene.gravity + body.force, MomentOn(body);
  return d;
}

template <class Kind, class Scalar>
std::vector<BodyDynamics<Scalar, Kind::kDof>> DynamicsOf(const SceneIn<Kind, Scalar>& scene) {
  std::vector<BodyDynamics<Scalar, Kind::kDof>> bodies;
  for (const auto& body : scene.bodies) bodies.push_back(DynamicsOf(scene, body));
  return bodies;
}

// Of a's material relative to b's at the contact point.
template <class Scalar>
Vector2<Scalar> SlipBias(const RigidBody<Scalar>& a, const RigidBody<Scalar>& b,
                         const TouchPoint<Scalar>& contact) {
  return ToCentre(a, contact.point) - ToCentre(b, contact.point);
}
template <class Scalar>
Vector3<Scalar> SlipBias(const BodyInSpace<Scalar>& a, const BodyInSpace<Scalar>& b,
                         const TouchPointInSpace<Scalar>& contact) {
  const Vector3<Scalar> spin = a.spin - b.spin, ahead = Wandering(contact, spin);
  return ToCentre(a, contact.point) - ToCentre(b, contact.point) + CrossProduct<Scalar>(spin, ahead);
}

template <class Kind, class Scalar>
ConstraintIn<Kind, Scalar> ContactConstraint(const SceneIn<Kind, Scalar>& scene,
                                             const TouchPointIn<Kind, Scalar>& contact) {
  using Vector = typename Kind::template Vector<Scalar>;
  const auto &a = scene.bodies[contact.a], &b = scene.bodies[contact.b];
  const Vector arm_a = contact.point - a.position, arm_b = contact.point - b.position;
  ConstraintIn<Kind, Scalar> constraint;
  constraint.bodies = {contact.a, contact.b};
  constraint.law.mu = contact.mu;
  constraint.rows.reserve(Kind::kDimension);
  constraint.rows.push_back(RowAlong<Kind, Scalar>(contact.normal, arm_a, arm_b));
  constraint.rows[0].error = contact.gap;
  constraint.rows[0].bias = NormalBias(a, b, contact);
  const Vector bias = SlipBias(a, b, contact);
  for (const Vector& tangent : TangentsOf(contact.normal)) {
    constraint.rows.push_back(RowAlong<Kind, Scalar>(tangent, arm_a, arm_b));
    constraint.rows.back().bias = tangent.dot(bias);
  }
  return constraint;
}

template <class Kind, class Scalar>
std::vector<ConstraintIn<Kind, Scalar>> JointConstraints(const SceneIn<Kind, Scalar>& scene) {
  std::vector<ConstraintIn<Kind, Scalar>> constraints;
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    int part = 0;
    for (auto& row : JointRows(scene, scene.joints[i])) {
      auto& constraint = constraints.emplace_back();
      constraint.bodies = {scene.joints[i].a, scene.joints[i].b};
      constraint.law.kind = ContactKind::kBilateral;
      constraint.rows.push_back(std::move(row));
      constraint.from_joint = true;
      constraint.source = static_cast<int>(i);
      constraint.part = part++;
    }
  }
  return constraints;
}

// ---- Laws and b ------------------------------------------------------------------------------

template <class Kind, class Scalar>
class Assembler {
 public:
  using Touch = TouchPointIn<Kind, Scalar>;
  using Model = ModelIn<Kind, Scalar>;
  static constexpr int kDof = Kind::kDof;

  Assembler(const SceneIn<Kind, Scalar>& scene, Level level, bool minimal, const Scalar& step,
            const Scalar& before)
      : scene_(scene), level_(level), minimal_(minimal), step_(step), before_(before) {
    model_.bodies = DynamicsOf(scene);
    for (const auto& body : model_.bodies) free_.push_back(body.FreeAcceleration());
  }

  Model Run(const std::vector<Touch>& contacts) {
    for (auto& constraint : JointConstraints(scene_)) {
      SetB(constraint);
      model_.constraints.push_back(std::move(constraint));
    }
    for (std::size_t i = 0; i < contacts.size(); ++i) AddContact(contacts[i], static_cast<int>(i));
    if (minimal_) DropRedundant();
    model_.islands = FindIslands(model_.bodies, model_.constraints, !minimal_);
    return std::move(model_);
  }

 private:
  void AddContact(const Touch& contact, int number) {
    ConstraintIn<Kind, Scalar> constraint = ContactConstraint(scene_, contact);
    constraint.source = number;
    const Scalar speed = Speed(constraint, 0);
    const bool stays = Sign(step_) != 0 && (!minimal_ || contact.closing);
    if (level_ == Level::kForces && speed > scene_.rest && !stays) {
      model_.parting.push_back(number);
      return;
    }
    if (speed < -scene_.rest) model_.colliding.push_back(number);
    SetLaw(contact.held, constraint);
    SetB(constraint);
    model_.constraints.push_back(std::move(constraint));
  }

  // At this instant, of what is kept: zero where a row is held at zero.
  Scalar Speed(const ConstraintIn<Kind, Scalar>& constraint, int row) const {
    return Scalar(Velocity(constraint, row, model_.bodies) - before_ / 2 * constraint.rows[row].bias);
  }

  void SetLaw(bool held, ConstraintIn<Kind, Scalar>& constraint) {
    Contact<Scalar>& law = constraint.law;
    const bool smooth = level_ == Level::kPositions || (minimal_ && Sign(law.mu) == 0);
    if (smooth) {
      law = {ContactKind::kFrictionless, Scalar(0), {Scalar(0), Scalar(0)}};
      constraint.rows.resize(1);
      return;
    }
    law.kind = ContactKind::kStatic;
    if (level_ != Level::kForces || Sign(law.mu) == 0 || held) return;
    const Scalar speed = Speed(constraint, 1);
    if constexpr (Kind::kDimension == 2) {
      if (Abs<Scalar>(speed) <= scene_.rest) return;
      law.slip = {Scalar(Sign(speed)), Scalar(0)};
    } else {
      const auto velocity = MakeVector2<Scalar>(speed, Speed(constraint, 2));
      if (Dot<Scalar>(velocity, velocity) <= scene_.rest * scene_.rest) return;
      law.slip = ExactDirection<Scalar>(velocity);
    }
    law.kind = ContactKind::kSliding;
  }

  void SetB(ConstraintIn<Kind, Scalar>& constraint) {
    for (int i = 0; i < static_cast<int>(constraint.rows.size()); ++i) SetB(constraint, i);
  }

  void SetB(ConstraintIn<Kind, Scalar>& constraint, int i) {
    RowIn<Kind, Scalar>& row = constraint.rows[i];
    const bool one_sided = constraint.law.kind != ContactKind::kBilateral && i == 0;
    const Scalar gap = one_sided ? std::max<Scalar>(row.error, Scalar(0)) : Scalar(0);
    const bool step = Sign(step_) != 0;
    row.b = Scalar(0);
    switch (level_) {
      case Level::kForces:
        for (int side = 0; side < 2; ++side) row.b += row.J[side].dot(free_[constraint.bodies[side]]);
        if (!step) {
          row.b += row.bias;
        } else {
          const Scalar velocity = Velocity(constraint, i, model_.bodies);
          row.b += (velocity + step_ * row.bias / 2 + gap / step_) / ((step_ + before_) / 2);
        }
        break;
      case Level::kImpulses:
        row.b = Speed(constraint, i);
        if (step) row.b += gap / step_;
        break;
      case Level::kPositions:
        row.b = row.error;
        break;
    }
  }

  void DropRedundant() {
    const std::vector<int> redundant = FindRedundant(model_.constraints);
    if (redundant.empty()) return;
    std::vector<ConstraintIn<Kind, Scalar>> kept;
    for (std::size_t i = 0, dropped = 0; i < model_.constraints.size(); ++i) {
      if (dropped < redundant.size() && redundant[dropped] == static_cast<int>(i)) {
        model_.redundant.push_back(model_.constraints[i].source);
        ++dropped;
      } else {
        kept.push_back(std::move(model_.constraints[i]));
      }
    }
    model_.constraints = std::move(kept);
  }

  const SceneIn<Kind, Scalar>& scene_;
  const Level level_;
  const bool minimal_;
  const Scalar step_, before_;
  Model model_;
  std::vector<Eigen::Matrix<Scalar, kDof, 1>> free_;
};

template <class Kind, class Scalar>
ModelIn<Kind, Scalar> Assemble(const SceneIn<Kind, Scalar>& scene,
                               const std::vector<TouchPointIn<Kind, Scalar>>& contacts, Level level,
                               bool minimal, const std::type_identity_t<Scalar>& step,
                               const std::type_identity_t<Scalar>& before) {
  return Assembler<Kind, Scalar>(scene, level, minimal, step, before).Run(contacts);
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
