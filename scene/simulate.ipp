// SPDX-License-Identifier: Apache-2.0
// Definitions for simulate.h, in its order, in the plane and in space. A body brings, found by argument:
//
//   FastestPoint(body)          bound of the speed of its points, m/s
//   AddVelocity(body, change)   velocity and spin
//   Displace(body, change)      position and turn
//   Advance(body, acceleration, k, h)   velocities for the time k, then positions for h

#ifndef STICTION_SCENE_SIMULATE_IPP_
#define STICTION_SCENE_SIMULATE_IPP_

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "scene/simulate.h"
#include "solver/problem/reduction.ipp"
#include "solver/problem/residual.h"

namespace stiction {

inline constexpr int kHoldRounds = 8;
inline constexpr int kSparseRows = 400;   // from which on a sparse A costs less
inline constexpr double kDeep = 1e-3;     // m; where the scene has no gap
inline constexpr int kParallelRows = 20;  // of the largest island; below, threads cost more than they save

// The derivative of the gap: negative where the contact closes.
template <class SceneType, class Touch>
double ApproachOf(const SceneType& scene, const Touch& contact) {
  const auto &a = scene.bodies[contact.a], &b = scene.bodies[contact.b];
  return contact.normal.dot(a.VelocityAt(contact.point) - b.VelocityAt(contact.point));
}

// f of a problem of any kinds by `run`, which solves a problem without bilateral or sliding contacts into its
// second argument. False if there is none, or if it fails `accept` with the forces of the whole problem.
template <class Run, class Accept>
bool SolveReduced(const ContactProblem<double>& problem, const Tolerances& tolerances, const Run& run,
                  const Accept& accept, ContactProblem<double>::Vector& f) {
  if (!Reduction<double>::Concerns(problem)) return run(problem, f);
  const Reduction<double> reduction(problem, tolerances);
  if (reduction.end() != ReductionEnd::kReduced) return false;
  ContactProblem<double>::Vector x(0);
  if (reduction.problem().rows() > 0 && !run(reduction.problem(), x)) return false;
  f = reduction.Forces(x);
  const ContactProblem<double>::Vector a = problem.A * f + problem.b;
  return accept(f, a);
}

template <class SceneType>
SimulationOf<SceneType>::SimulationOf(SceneType scene, const SimulationOptions& options,
                                      std::function<void(const FrameProblem&)> observe)
    : scene_(std::move(scene)),
      options_(options),
      observe_(std::move(observe)),
      solvers_([options] { return SolverOf<SceneType>(options); }) {
  const double gravity = scene_.gravity.norm();
  scene_.rest = options_.rest > 0 ? options_.rest : gravity > 0 ? gravity * options_.step : 1e-3;
}

template <class Body>
auto MotionOf(const Body& body) {
  return std::tuple(body.position, body.rotation, body.velocity, body.spin);
}

template <class SceneType>
void SimulationOf<SceneType>::Step() {
  exhausted_ = false;
  StepBy(options_.step, options_.halvings);
  ++statistics_.frames;
  statistics_.contacts += static_cast<std::int64_t>(contacts_.size());
  statistics_.deep += exhausted_;
}

// At once or, where that ends too deep, from the same state in two halves.
template <class SceneType>
void SimulationOf<SceneType>::StepBy(double h, int halvings) {
  if (!is_near_known_) FindNear();
  const double allowed = std::max(scene_.gap > 0 ? scene_.gap : kDeep, Overlap());
  std::vector<decltype(MotionOf(scene_.bodies[0]))> before;
  before.reserve(scene_.bodies.size());
  for (const auto& body : scene_.bodies) before.push_back(MotionOf(body));
  const double step_before = before_;
  step_ = h;
  TakeStep();
  FindNear();
  if (exhausted_ || Overlap() <= allowed) return;
  exhausted_ = halvings == 0;
  if (exhausted_) return;
  ++statistics_.halved;
  for (std::size_t i = 0; i < before.size(); ++i) {
    auto& body = scene_.bodies[i];
    std::tie(body.position, body.rotation, body.velocity, body.spin) = before[i];
  }
  before_ = step_before;
  is_near_known_ = false;
  for (int half = 0; half < 2; ++half) StepBy(h / 2, halvings - 1);
}

template <class SceneType>
void SimulationOf<SceneType>::TakeStep() {
  FindStepContacts();
  if (HasDrifted()) {
    if (Collides()) ApplyImpulses();
    CorrectPositions();
  }
  Changes accelerations(scene_.bodies.size(), Eigen::Matrix<double, Types::kDof, 1>::Zero());
  do {
    if (Collides()) ApplyImpulses();
  } while (AddClosing(accelerations));
  do {
    accelerations = Accelerations();
  } while (AddClosing(accelerations));
  Move(accelerations);
}

template <class SceneType>
double SimulationOf<SceneType>::Overlap() const {
  double overlap = 0;
  for (const auto& contact : near_) overlap = std::max(overlap, -contact.gap);
  return overlap;
}

template <class SceneType>
auto SimulationOf<SceneType>::AssembleAt(Level level, const std::vector<bool>& held,
                                         const std::vector<bool>& closing) const -> Model {
  AssembleOptions<double> options;
  options.level = level;
  options.step = step_;
  options.before = before_;
  options.minimal = options_.minimal;
  options.held = held;
  options.closing = closing;
  return Assemble(scene_, contacts_, options);
}

template <class SceneType>
void SimulationOf<SceneType>::FindNear() {
  double fastest = scene_.gravity.norm() * options_.step;
  for (const auto& body : scene_.bodies) fastest = std::max(fastest, FastestPoint(body));
  near_ = FindContacts(scene_, 2 * options_.step * fastest);
  is_near_known_ = true;
}

template <class SceneType>
void SimulationOf<SceneType>::FindStepContacts() {
  if (!is_near_known_) FindNear();
  is_near_known_ = false;
  contacts_ = std::move(near_);
  const auto beyond = std::stable_partition(contacts_.begin(), contacts_.end(), [this](const Touch& contact) {
    return contact.gap + step_ * ApproachOf(scene_, contact) <= scene_.gap;
  });
  beyond_.assign(beyond, contacts_.end());
  contacts_.erase(beyond, contacts_.end());
}

// Whether the contact would overlap at the end of the step, to first order.
template <class SceneType>
bool SimulationOf<SceneType>::Closes(const Touch& contact, const Changes& accelerations) const {
  const double h = step_;
  const auto normal = ContactConstraint(scene_, contact).rows[0];
  const double change = normal.J[0].dot(accelerations[contact.a]) + normal.J[1].dot(accelerations[contact.b]);
  const double speed = ApproachOf(scene_, contact) + Kick() * change + h / 2 * normal.bias;
  return !(contact.gap + h * speed >= -kDrift);
}

// Moves from beyond_ to contacts_ what closes; whether there was anything.
template <class SceneType>
bool SimulationOf<SceneType>::AddClosing(const Changes& accelerations) {
  const auto closing = std::stable_partition(
      beyond_.begin(), beyond_.end(), [&](const Touch& contact) { return !Closes(contact, accelerations); });
  const bool found = closing != beyond_.end();
  contacts_.insert(contacts_.end(), closing, beyond_.end());
  beyond_.erase(closing, beyond_.end());
  return found;
}

// ---- Solving ---------------------------------------------------------------------------------

// Of a large island A stays sparse, if that gives an answer.
template <class SceneType>
bool SolveIsland(SolverOf<SceneType>& solver, const typename SceneTypes<SceneType>::Model& model,
                 std::size_t island, ContactProblem<double>::Vector& f, SimulationStatistics& statistics) {
  if (model.islands[island].rows >= kSparseRows && SolveSparse(solver, model.SparseProblem(island), f)) {
    ++statistics.sparse;
    return true;
  }
  return SolveScene(solver, model.Problem(island), f, statistics);
}

// Islands at the same time where there is work enough: every answer depends on its own problem alone. False
// with failed_ set to the first island that has no answer.
template <class SceneType>
bool SimulationOf<SceneType>::Solve(const Model& model, Level level, Forces& f) {
  const std::size_t count = model.islands.size();
  int rows = 0, largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    rows += model.islands[i].rows;
    largest = std::max(largest, model.islands[i].rows);
    if (observe_) observe_({statistics_.frames, level, static_cast<int>(i), model.Problem(i)});
  }
  statistics_.problems += static_cast<std::int64_t>(count);
  statistics_.rows += rows;

  f.resize(count);
  std::vector<SimulationStatistics> counted(count);
  std::vector<char> solved(count, 0);
  const auto solve = [&](std::size_t i) {
    solved[i] = SolveIsland(solvers_.local(), model, i, f[i], counted[i]);
  };
  if (count > 1 && largest >= kParallelRows) {
    tbb::parallel_for(std::size_t{0}, count, solve);
  } else {
    for (std::size_t i = 0; i < count; ++i) solve(i);
  }
  for (const SimulationStatistics& part : counted) {
    statistics_.fallbacks += part.fallbacks;
    statistics_.loose += part.loose;
    statistics_.sparse += part.sparse;
  }
  failed_ = std::find(solved.begin(), solved.end(), 0) - solved.begin();
  return failed_ == count;
}

template <class SceneType>
void SimulationOf<SceneType>::Fail(const Model& model, Level level, std::size_t island) const {
  throw SimulationError(
      fmt::format("frame {}, t = {:.6g} s: the problem of {} of island {} ({} rows) is undecided",
                  statistics_.frames, time(), kLevelNames[static_cast<int>(level)], island + 1,
                  model.islands[island].rows),
      model.Problem(island));
}

template <class SceneType>
auto SimulationOf<SceneType>::Response(const Model& model, const Forces& f) const -> Changes {
  Changes change(model.bodies.size(), Eigen::Matrix<double, Types::kDof, 1>::Zero());
  for (std::size_t i = 0; i < model.islands.size(); ++i)
    AddResponse(model.bodies, model.constraints, model.islands[i], f[i], change);
  return change;
}

// ---- Positions and impulses ------------------------------------------------------------------

template <class SceneType>
bool SimulationOf<SceneType>::HasDrifted() const {
  const auto overlaps = [](const Touch& contact) { return contact.gap < -kDrift; };
  if (std::any_of(contacts_.begin(), contacts_.end(), overlaps)) return true;
  if (scene_.joints.empty()) return false;
  const auto joints = JointConstraints(scene_);
  return std::any_of(joints.begin(), joints.end(),
                     [](const auto& joint) { return std::abs(joint.rows[0].error) > kDrift; });
}

template <class SceneType>
void SimulationOf<SceneType>::CorrectPositions() {
  ++statistics_.corrections;
  const Model model = AssembleAt(Level::kPositions);
  Forces f;
  if (!Solve(model, Level::kPositions, f)) Fail(model, Level::kPositions, failed_);
  const Changes change = Response(model, f);
  for (std::size_t i = 0; i < change.size(); ++i) Displace(scene_.bodies[i], change[i]);
  FindStepContacts();
}

template <class SceneType>
bool SimulationOf<SceneType>::Collides() const {
  return std::any_of(contacts_.begin(), contacts_.end(), [this](const Touch& contact) {
    const auto closes = [&](double speed) {
      return speed < -scene_.rest && std::max(contact.gap, 0.0) + step_ * speed < 0;
    };
    const double speed = ApproachOf(scene_, contact);
    return closes(speed) && closes(speed - before_ / 2 * ContactConstraint(scene_, contact).rows[0].bias);
  });
}

template <class SceneType>
void SimulationOf<SceneType>::ApplyImpulses() {
  ++statistics_.collisions;
  const Model model = AssembleAt(Level::kImpulses);
  Forces p;
  if (!Solve(model, Level::kImpulses, p)) Fail(model, Level::kImpulses, failed_);
  const Changes change = Response(model, p);
  for (std::size_t i = 0; i < change.size(); ++i) AddVelocity(scene_.bodies[i], change[i]);
}

// ---- Forces ----------------------------------------------------------------------------------

template <class SceneType>
auto SimulationOf<SceneType>::Accelerations() -> Changes {
  std::vector<bool> held(contacts_.size(), false), closing(contacts_.size(), false);
  for (int round = 0;; ++round) {
    const Model model = AssembleAt(Level::kForces, held, closing);
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
    const int back = KeepClosing(model, accelerations, closing);
    if ((reversing == 0 && back == 0) || round >= kHoldRounds) {
      KeepForces(model, f);
      return accelerations;
    }
  }
}

// Marks the sliding contacts whose tangential velocity would turn round within the step.
template <class SceneType>
int SimulationOf<SceneType>::HoldReversing(const Model& model, const Changes& accelerations,
                                           std::vector<bool>& held) const {
  int count = 0;
  for (const auto& constraint : model.constraints) {
    if (constraint.law.kind != ContactKind::kSliding) continue;
    double along = 0;  // the slip
    for (int row = 1; row < Types::kDimension; ++row) {
      double speed = Velocity(constraint, row, model.bodies) + step_ / 2 * constraint.rows[row].bias;
      for (int side = 0; side < 2; ++side)
        speed += Kick() * constraint.rows[row].J[side].dot(accelerations[constraint.bodies[side]]);
      along += speed * constraint.law.slip[row - 1];
    }
    if (along >= 0) continue;
    held[constraint.source] = true;
    ++count;
  }
  return count;
}

// Marks the contacts left out because they part that would be back, and overlap, at the end of the step.
template <class SceneType>
int SimulationOf<SceneType>::KeepClosing(const Model& model, const Changes& accelerations,
                                         std::vector<bool>& closing) const {
  int count = 0;
  for (const Omission& omission : model.omitted) {
    if (omission.reason != OmissionReason::kSeparating) continue;
    if (!Closes(contacts_[omission.contact], accelerations)) continue;
    closing[omission.contact] = true;
    ++count;
  }
  return count;
}

template <class SceneType>
void SimulationOf<SceneType>::KeepForces(const Model& model, const Forces& f) {
  forces_.clear();
  for (std::size_t i = 0; i < model.islands.size(); ++i) {
    int at = 0;
    for (const int k : model.islands[i].constraints) {
      const auto& constraint = model.constraints[k];
      Applied force;
      force.bodies = constraint.bodies;
      force.from_joint = constraint.from_joint;
      force.force.setZero();
      for (const auto& row : constraint.rows)
        force.force += row.J[0].template head<Types::kDimension>() * f[i][at++];
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

template <class SceneType>
void SimulationOf<SceneType>::Move(const Changes& accelerations) {
  for (std::size_t i = 0; i < accelerations.size(); ++i)
    Advance(scene_.bodies[i], accelerations[i], Kick(), step_);
  before_ = step_;
}
template <class SceneType>
Drift MeasureDrift(const SceneType& scene) {
  Drift drift;
  for (const auto& joint : JointConstraints(scene))
    drift.joints = std::max(drift.joints, std::abs(joint.rows[0].error));
  for (const auto& contact : FindContacts(scene)) drift.overlap = std::max(drift.overlap, -contact.gap);
  return drift;
}

}  // namespace stiction

#endif  // STICTION_SCENE_SIMULATE_IPP_
