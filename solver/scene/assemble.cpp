// SPDX-License-Identifier: Apache-2.0
// Assembling over doubles, for simulation, and over rationals; and the explanation.

#include "solver/scene/assemble.ipp"

#include <fmt/format.h>

namespace stiction {
namespace {

double Shown(double x) { return x; }
double Shown(const mpq_class& x) { return x.get_d(); }

template <class Scalar>
std::string ContactName(const Scene<Scalar>& scene, const std::vector<TouchPoint<Scalar>>& contacts, int i) {
  const auto& c = contacts[i];
  return fmt::format("contact {} ({} on {}, at ({:.6g}, {:.6g}))", i + 1, scene.bodies[c.a].name,
                     scene.bodies[c.b].name, Shown(c.point[0]), Shown(c.point[1]));
}

template <class Scalar>
std::string LawOf(const Contact<Scalar>& law) {
  switch (law.kind) {
    case ContactKind::kBilateral:
      return "bilateral, one row";
    case ContactKind::kFrictionless:
      return "frictionless, one row";
    case ContactKind::kStatic:
      return fmt::format("static, mu = {:.6g}, two rows", Shown(law.mu));
    case ContactKind::kSliding:
      return fmt::format("sliding, slip {:+.0f}, mu = {:.6g}, two rows", Shown(law.slip[0]), Shown(law.mu));
  }
  return "";
}

template <class Scalar>
std::string ConstraintName(const Scene<Scalar>& scene, const std::vector<TouchPoint<Scalar>>& contacts,
                           const Constraint<Scalar, 3>& constraint) {
  if (!constraint.from_joint) return ContactName(scene, contacts, constraint.source);
  const auto& joint = scene.joints[constraint.source];
  constexpr std::array kNames = {"pin", "rail", "slider"};
  return fmt::format("joint {}, row {} ({} of {} and {})", constraint.source + 1, constraint.part + 1,
                     kNames[static_cast<int>(joint.kind)], scene.bodies[joint.a].name,
                     scene.bodies[joint.b].name);
}

std::string ReasonFor(OmissionReason reason) {
  return reason == OmissionReason::kSeparating
             ? "left out: it parts, so it has no force at this instant, whatever its acceleration"
             : "left out: on a flat face between others of the same mu, any force of it is one of theirs and "
               "its "
               "acceleration a mean of theirs, so that no acceleration of any solution changes";
}

}  // namespace

template <class Scalar>
std::vector<std::string> Explain(const Scene<Scalar>& scene, const std::vector<TouchPoint<Scalar>>& contacts,
                                 const SceneModel<Scalar>& model, const AssembleOptions<Scalar>& options) {
  std::vector<std::string> lines;
  for (const auto& omission : model.omitted)
    lines.push_back(ContactName(scene, contacts, omission.contact) + ": " + ReasonFor(omission.reason));
  for (const int i : model.colliding) {
    lines.push_back(
        ContactName(scene, contacts, i) + ": approaches" +
        (options.level == Level::kForces ? "; taken as at rest, though a collision comes first" : ""));
  }
  for (std::size_t i = 0; i < model.islands.size(); ++i) {
    const auto& island = model.islands[i];
    lines.push_back(
        fmt::format("problem {} of {}: {} bodies that move, {} rows{}", i + 1, model.islands.size(),
                    island.bodies.size(), island.problem.rows(),
                    model.islands.size() > 1
                        ? "; it shares no moving body with the others, so A has only zeros between them"
                        : ""));
    for (const int k : island.constraints) {
      const auto& constraint = model.constraints[k];
      std::string line = "  " + ConstraintName(scene, contacts, constraint) + ": " + LawOf(constraint.law);
      if (constraint.law.kind == ContactKind::kFrictionless)
        line += options.level == Level::kPositions
                    ? ""
                    : ": mu = 0 allows no friction force, and asks nothing of aF";
      if (constraint.law.kind == ContactKind::kBilateral)
        line += "; methods eliminate it, which no step of theirs notices (solver/reduction.h)";
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
      "would give a row of zeros");
  return lines;
}

#define STICTION_INSTANTIATE(Scalar)                                                                      \
  template std::vector<BodyDynamics<Scalar, 3>> DynamicsOf(const Scene<Scalar>&);                         \
  template std::vector<Constraint<Scalar, 3>> JointConstraints(const Scene<Scalar>&);                     \
  template Constraint<Scalar, 3> ContactConstraint(const Scene<Scalar>&, const TouchPoint<Scalar>&);      \
  template SceneModel<Scalar> Assemble(const Scene<Scalar>&, const std::vector<TouchPoint<Scalar>>&,      \
                                       const AssembleOptions<Scalar>&);                                   \
  template std::vector<Eigen::Matrix<Scalar, 3, 1>> BodyAccelerations(                                    \
      const SceneModel<Scalar>&, const std::vector<typename ContactProblem<Scalar>::Vector>&);            \
  template typename ContactProblem<Scalar>::Vector ExtendForces(                                          \
      const SceneModel<Scalar>&, const std::vector<typename ContactProblem<Scalar>::Vector>&,             \
      const SceneModel<Scalar>&);                                                                         \
  template std::vector<std::string> Explain(const Scene<Scalar>&, const std::vector<TouchPoint<Scalar>>&, \
                                            const SceneModel<Scalar>&, const AssembleOptions<Scalar>&)

STICTION_INSTANTIATE(double);
STICTION_INSTANTIATE(mpq_class);

#undef STICTION_INSTANTIATE

}  // namespace stiction
