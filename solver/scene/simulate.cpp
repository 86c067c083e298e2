// SPDX-License-Identifier: Apache-2.0
#include "solver/scene/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/reduction.ipp"
#include "solver/residual.h"

namespace stiction {
namespace {

constexpr std::array kLevelNames = {"forces", "impulses", "positions"};
constexpr double kWholeResidual = 1e-7;  // of a problem with the bilateral rows that reduction took out
constexpr int kHoldRounds = 8;
constexpr double kProximal = 1e-9;  // of the largest A_ii; well above the tolerance of pivots, 1e-11
constexpr int kProximalPoints = 3;
constexpr double kProximalResidual = 1e-13;  // at which more points gain nothing

// The derivative of the gap: negative where the contact closes.
double ApproachOf(const Scene<double>& scene, const TouchPoint<double>& contact) {
  const auto &a = scene.bodies[contact.a], &b = scene.bodies[contact.b];
  return Dot<double>(contact.normal, a.VelocityAt(contact.point) - b.VelocityAt(contact.point));
}

void Turn(Vector2<double>& rotation, double angle) {
  if (angle == 0) return;
  rotation =
      UnitVector<double>(Rotate<double>(MakeVector2<double>(std::cos(angle), std::sin(angle)), rotation));
}

}  // namespace

namespace {

// Without complete driving: limits.pivots bounds it. (Without friction it would bound the active set as well.)
bool SolveQuickly(FastSolver<double>& solver, const ContactProblem<double>& problem,
                  std::span<const Cell> guess = {}) {
  const Limits limits = std::exchange(solver.options().limits, {.pivots = 0});
  const bool solved = solver.Run(problem, guess).outcome == Outcome::kSolved;
  solver.options().limits = limits;
  return solved;
}

bool SolveProximally(FastSolver<double>& solver, const ContactProblem<double>& problem,
                     ContactProblem<double>::Vector& f) {
  const double eps = kProximal * problem.A.diagonal().maxCoeff();
  ContactProblem<double> near = problem;
  near.A.diagonal().array() += eps;
  double residual = std::numeric_limits<double>::infinity();
  std::vector<Cell> cells;
  f.setZero(problem.rows());
  for (int point = 0; point < kProximalPoints && residual > kProximalResidual; ++point) {
    near.b = problem.b - eps * f;
    if (!SolveQuickly(solver, near, cells)) return false;
    f = solver.f();
    cells = solver.cells();
    const ContactProblem<double>::Vector a = problem.A * f + problem.b;
    const Residual<double> measured = MeasureResidual(problem, f, a);
    // Relative to b: where there is no solution forces grow like 1 / eps, and any violation is small beside
    // them.
    residual = measured.worst / measured.b_scale;
  }
  return residual <= solver.options().residual;
}

bool SolveReduced(FastSolver<double>& solver, const ContactProblem<double>& problem,
                  ContactProblem<double>::Vector& f, std::int64_t& fallbacks) {
  const bool friction = problem.rows() > static_cast<int>(problem.contacts.size());
  if (friction && SolveQuickly(solver, problem)) {
    f = solver.f();
    return true;
  }
  if (friction && SolveProximally(solver, problem, f)) return true;
  const FastVerdict verdict = solver.Run(problem);
  fallbacks += verdict.statistics.fallbacks;
  f = solver.f();
  return verdict.outcome == Outcome::kSolved;
}

}  // namespace

bool SolveScene(FastSolver<double>& solver, const ContactProblem<double>& problem,
                ContactProblem<double>::Vector& f, std::int64_t& fallbacks) {
  if (!Reduction<double>::Concerns(problem)) return SolveReduced(solver, problem, f, fallbacks);
  const Reduction<double> reduction(problem, solver.options().tolerances);
  if (reduction.end() != ReductionEnd::kReduced) return false;
  ContactProblem<double>::Vector x(0);
  if (reduction.problem().rows() > 0 && !SolveReduced(solver, reduction.problem(), x, fallbacks)) return false;
  f = reduction.Forces(x);
  const ContactProblem<double>::Vector a = problem.A * f + problem.b;
  return NaturalResidual(problem, f, a) <= kWholeResidual;
}

Simulation::Simulation(Scene<double> scene, const SimulationOptions& options,
                       std::function<void(const FrameProblem&)> observe)
    : scene_(std::move(scene)), options_(options), observe_(std::move(observe)), solver_(options.fast) {
  const double gravity = Length<double>(scene_.gravity);
  scene_.rest = options_.rest > 0 ? options_.rest : gravity > 0 ? gravity * options_.step : 1e-3;
}

void Simulation::Step() {
  FindStepContacts();
  if (HasDrifted()) CorrectPositions();
  Changes accelerations(scene_.bodies.size(), Eigen::Matrix<double, 3, 1>::Zero());
  do {
    if (Collides()) ApplyImpulses();
  } while (AddClosing(accelerations));
  do {
    accelerations = Accelerations();
  } while (AddClosing(accelerations));
  Move(accelerations);
  ++statistics_.frames;
  statistics_.contacts += static_cast<std::int64_t>(contacts_.size());
}

Simulation::Model Simulation::AssembleAt(Level level, const std::vector<bool>& held) const {
  AssembleOptions<double> options;
  options.level = level;
  options.step = options_.step;
  options.minimal = options_.minimal;
  options.held = held;
  return Assemble(scene_, contacts_, options);
}

void Simulation::FindStepContacts() {
  double fastest = Length<double>(scene_.gravity) * options_.step;
  for (const auto& body : scene_.bodies) {
    double radius = 0;
    for (const auto& shape : body.shapes) {
      radius = std::max(radius, Length<double>(shape.center) + shape.radius);
      for (const auto& corner : shape.polygon) radius = std::max(radius, Length<double>(corner));
    }
    fastest = std::max(fastest, Length<double>(body.velocity) + std::abs(body.spin) * radius);
  }
  contacts_ = FindContacts<double>(scene_, 2 * options_.step * fastest);
  const auto beyond = std::stable_partition(contacts_.begin(), contacts_.end(), [this](const auto& contact) {
    return contact.gap + options_.step * ApproachOf(scene_, contact) <= scene_.gap;
  });
  beyond_.assign(beyond, contacts_.end());
  contacts_.erase(beyond, contacts_.end());
}

// Moves from beyond_ to contacts_ what would overlap at the end of the step; whether there was anything.
bool Simulation::AddClosing(const Changes& accelerations) {
  const double h = options_.step;
  const auto approach = [&](const TouchPoint<double>& contact) {
    double speed = ApproachOf(scene_, contact);
    const ConstraintRow<double, 3> normal = ContactConstraint(scene_, contact).rows[0];
    speed += h * (normal.J[0].dot(accelerations[contact.a]) + normal.J[1].dot(accelerations[contact.b]));
    return speed;
  };
  const auto closing = std::stable_partition(beyond_.begin(), beyond_.end(), [&](const auto& contact) {
    return contact.gap + h * approach(contact) >= -kDrift;
  });
  const bool found = closing != beyond_.end();
  contacts_.insert(contacts_.end(), closing, beyond_.end());
  beyond_.erase(closing, beyond_.end());
  return found;
}

// ---- Solving ---------------------------------------------------------------------------------

// False with failed_ set if an island has no answer.
bool Simulation::Solve(const Model& model, Level level, Forces& f) {
  f.resize(model.islands.size());
  for (std::size_t i = 0; i < model.islands.size(); ++i) {
    const auto& problem = model.islands[i].problem;
    ++statistics_.problems;
    statistics_.rows += problem.rows();
    if (observe_) observe_({statistics_.frames, level, static_cast<int>(i), problem});
    if (!SolveScene(solver_, problem, f[i], statistics_.fallbacks)) {
      failed_ = i;
      return false;
    }
  }
  return true;
}

void Simulation::Fail(const Model& model, Level level, std::size_t island) const {
  throw SimulationError(
      fmt::format("frame {}, t = {:.6g} s: the problem of {} of island {} ({} rows) is undecided",
                  statistics_.frames, time(), kLevelNames[static_cast<int>(level)], island + 1,
                  model.islands[island].problem.rows()),
      model.islands[island].problem);
}

Simulation::Changes Simulation::Response(const Model& model, const Forces& f) const {
  Changes change(model.bodies.size(), Eigen::Matrix<double, 3, 1>::Zero());
  for (std::size_t i = 0; i < model.islands.size(); ++i)
    AddResponse(model.bodies, model.constraints, model.islands[i], f[i], change);
  return change;
}

// ---- Positions and impulses ------------------------------------------------------------------

bool Simulation::HasDrifted() const {
  const auto overlaps = [](const TouchPoint<double>& contact) { return contact.gap < -kDrift; };
  if (std::any_of(contacts_.begin(), contacts_.end(), overlaps)) return true;
  if (scene_.joints.empty()) return false;
  const auto joints = JointConstraints(scene_);
  return std::any_of(joints.begin(), joints.end(),
                     [](const auto& joint) { return std::abs(joint.rows[0].error) > kDrift; });
}

void Simulation::CorrectPositions() {
  ++statistics_.corrections;
  const Model model = AssembleAt(Level::kPositions);
  Forces f;
  if (!Solve(model, Level::kPositions, f)) Fail(model, Level::kPositions, failed_);
  const Changes change = Response(model, f);
  for (std::size_t i = 0; i < change.size(); ++i) {
    scene_.bodies[i].position += change[i].head<2>();
    Turn(scene_.bodies[i].rotation, change[i][2]);
  }
  FindStepContacts();
}

bool Simulation::Collides() const {
  return std::any_of(contacts_.begin(), contacts_.end(), [this](const TouchPoint<double>& contact) {
    const double speed = ApproachOf(scene_, contact);
    return speed < -scene_.rest && std::max(contact.gap, 0.0) + options_.step * speed < 0;
  });
}

void Simulation::ApplyImpulses() {
  ++statistics_.collisions;
  const Model model = AssembleAt(Level::kImpulses);
  Forces p;
  if (!Solve(model, Level::kImpulses, p)) Fail(model, Level::kImpulses, failed_);
  const Changes change = Response(model, p);
  for (std::size_t i = 0; i < change.size(); ++i) {
    scene_.bodies[i].velocity += change[i].head<2>();
    scene_.bodies[i].spin += change[i][2];
  }
}

// ---- Forces ----------------------------------------------------------------------------------

Simulation::Changes Simulation::Accelerations() {
  std::vector<bool> held(contacts_.size(), false);
  for (int round = 0;; ++round) {
    const Model model = AssembleAt(Level::kForces, held);
    const bool all_held = std::find(held.begin(), held.end(), false) == held.end();
    Forces f;
    if (!Solve(model, Level::kForces, f)) {
      if (all_held) Fail(model, Level::kForces, failed_);
      ++statistics_.impulsive;
      held.assign(contacts_.size(), true);
      continue;
    }
    Changes accelerations = BodyAccelerations(model, f);
    const int reversing = all_held ? 0 : HoldReversing(model, accelerations, held);
    statistics_.stopped += reversing;
    if (reversing == 0 || round >= kHoldRounds) {
      KeepForces(model, f);
      return accelerations;
    }
  }
}

// Marks the sliding contacts whose tangential velocity would turn round within the step.
int Simulation::HoldReversing(const Model& model, const Changes& accelerations, std::vector<bool>& held) const {
  int count = 0;
  for (const auto& constraint : model.constraints) {
    if (constraint.law.kind != ContactKind::kSliding) continue;
    double speed = Velocity(constraint, 1, model.bodies);
    for (int side = 0; side < 2; ++side)
      speed += options_.step * constraint.rows[1].J[side].dot(accelerations[constraint.bodies[side]]);
    if (speed * constraint.law.slip[0] >= 0) continue;
    held[constraint.source] = true;
    ++count;
  }
  return count;
}

void Simulation::KeepForces(const Model& model, const Forces& f) {
  forces_.clear();
  for (std::size_t i = 0; i < model.islands.size(); ++i) {
    int at = 0;
    for (const int k : model.islands[i].constraints) {
      const auto& constraint = model.constraints[k];
      AppliedForce force;
      force.from_joint = constraint.from_joint;
      force.force.setZero();
      for (const auto& row : constraint.rows) force.force += row.J[0].head<2>() * f[i][at++];
      if (constraint.from_joint) {
        const auto& joint = scene_.joints[constraint.source];
        force.point = scene_.bodies[joint.a].At(joint.at_a);
      } else {
        force.point = contacts_[constraint.source].point;
      }
      forces_.push_back(force);
    }
  }
}

void Simulation::Move(const Changes& accelerations) {
  const double h = options_.step;
  for (std::size_t i = 0; i < accelerations.size(); ++i) {
    RigidBody<double>& body = scene_.bodies[i];
    body.velocity += h * accelerations[i].head<2>();
    body.spin += h * accelerations[i][2];
    body.position += h * body.velocity;
    Turn(body.rotation, h * body.spin);
  }
}

// ---- Measures --------------------------------------------------------------------------------

Energy EnergyOf(const Scene<double>& scene) {
  Energy energy;
  for (const auto& body : scene.bodies) {
    if (body.fixed) continue;
    energy.kinetic += (body.mass * body.velocity.squaredNorm() + body.inertia * body.spin * body.spin) / 2;
    energy.potential -= body.mass * scene.gravity.dot(body.position);
  }
  return energy;
}

Drift DriftOf(const Scene<double>& scene) {
  Drift drift;
  for (const auto& joint : JointConstraints(scene))
    drift.joints = std::max(drift.joints, std::abs(joint.rows[0].error));
  for (const auto& contact : FindContacts(scene)) drift.overlap = std::max(drift.overlap, -contact.gap);
  return drift;
}

}  // namespace stiction
