// SPDX-License-Identifier: Apache-2.0
// The explanation of a model, in the plane and in space.

#pragma once

#include <fmt/format.h>

#include "scene/assemble.h"

namespace stiction {

inline double Shown(double x) { return x; }
inline double Shown(const mpq_class& x) { return x.get_d(); }

template <class Scalar, int Dimension>
std::string PointText(const Eigen::Matrix<Scalar, Dimension, 1>& point) {
  std::string text;
  for (const Scalar& x : point) text += fmt::format("{}{:.6g}", text.empty() ? "" : ", ", Shown(x));
  return text;
}

template <class Kind, class Scalar>
std::string ContactName(const SceneIn<Kind, Scalar>& scene,
                        const std::vector<TouchPointIn<Kind, Scalar>>& contacts, int i) {
  const auto& c = contacts[i];
  return fmt::format("contact {} ({} on {}, at ({}))", i + 1, scene.bodies[c.a].name, scene.bodies[c.b].name,
                     PointText(c.point));
}

template <class Scalar>
std::string LawOf(const Contact<Scalar>& law, int dimension) {
  const char* rows = dimension == 2 ? "two" : "three";
  switch (law.kind) {
    case ContactKind::kBilateral:
      return "bilateral, one row";
    case ContactKind::kFrictionless:
      return "frictionless, one row";
    case ContactKind::kStatic:
      return fmt::format("static, mu = {:.6g}, {} rows", Shown(law.mu), rows);
    case ContactKind::kSliding:
      if (dimension == 2)
        return fmt::format("sliding, slip {:+.0f}, mu = {:.6g}, two rows", Shown(law.slip[0]), Shown(law.mu));
      return fmt::format("sliding, slip ({:.4g}, {:.4g}), mu = {:.6g}, three rows", Shown(law.slip[0]),
                         Shown(law.slip[1]), Shown(law.mu));
  }
  return "";
}

template <class Kind, class Scalar>
std::string ConstraintName(const SceneIn<Kind, Scalar>& scene,
                           const std::vector<TouchPointIn<Kind, Scalar>>& contacts,
                           const ConstraintIn<Kind, Scalar>& constraint) {
  if (!constraint.from_joint) return ContactName(scene, contacts, constraint.source);
  const auto& joint = scene.joints[constraint.source];
  return fmt::format("joint {}, row {} ({} of {} and {})", constraint.source + 1, constraint.part + 1,
                     Kind::kJointNames[static_cast<std::size_t>(joint.kind)], scene.bodies[joint.a].name,
                     scene.bodies[joint.b].name);
}

template <class Kind, class Scalar>
std::vector<std::string> Explain(const SceneIn<Kind, Scalar>& scene,
                                 const std::vector<TouchPointIn<Kind, Scalar>>& contacts,
                                 const ModelIn<Kind, Scalar>& model, Level level) {
  std::vector<std::string> lines;
  for (const int i : model.parting)
    lines.push_back(ContactName(scene, contacts, i) +
                    ": left out: it parts, so it has no force at this instant, whatever its acceleration");
  for (const int i : model.redundant)
    lines.push_back(
        ContactName(scene, contacts, i) +
        ": left out: on a flat face between others of the same mu, any force of it is one of theirs "
        "and its acceleration a mean of theirs, so that no acceleration of any solution changes");
  for (const int i : model.colliding) {
    lines.push_back(ContactName(scene, contacts, i) + ": approaches" +
                    (level == Level::kForces ? "; taken as at rest, though a collision comes first" : ""));
  }
  for (std::size_t i = 0; i < model.islands.size(); ++i) {
    const auto& island = model.islands[i];
    lines.push_back(
        fmt::format("problem {} of {}: {} bodies that move, {} rows{}", i + 1, model.islands.size(),
                    island.bodies.size(), island.rows,
                    model.islands.size() > 1
                        ? "; it shares no moving body with the others, so A has only zeros between them"
                        : ""));
    for (const int k : island.constraints) {
      const auto& constraint = model.constraints[k];
      std::string line = "  " + ConstraintName<Kind, Scalar>(scene, contacts, constraint) + ": " +
                         LawOf(constraint.law, Kind::kDimension);
      if (constraint.law.kind == ContactKind::kFrictionless)
        line += level == Level::kPositions ? "" : ": mu = 0 allows no friction force, and asks nothing of aF";
      if (constraint.law.kind == ContactKind::kBilateral)
        line += "; methods eliminate it, which no step of theirs notices (solver/problem/reduction.h)";
      lines.push_back(std::move(line));
    }
  }
  int still = 0;
  for (std::size_t body = 0; body < model.bodies.size(); ++body) {
    bool constrained = model.bodies[body].fixed;
    for (const auto& constraint : model.constraints)
      constrained |=
          constraint.bodies[0] == static_cast<int>(body) || constraint.bodies[1] == static_cast<int>(body);
    still += !constrained;
  }
  if (still > 0) lines.push_back(fmt::format("{} bodies move freely: in no problem", still));
  lines.push_back(
      "pairs of fixed bodies, of different levels and of one joint: never contacts; two fixed bodies "
      "would give a row of zeros, joined ones too");
  return lines;
}

}  // namespace stiction
