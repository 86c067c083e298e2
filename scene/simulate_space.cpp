// SPDX-License-Identifier: Apache-2.0
#include "scene/simulate_space.h"

#include "scene/simulate.ipp"

namespace stiction {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double kWholeResidual = 10 * kLooseResidual;  // of a problem with the rows that reduction took out

// By the rotation vector `turn`, rad.
void Turn(Quaternion<double>& rotation, const Vector3<double>& turn) {
  const double angle = turn.norm();
  if (angle == 0) return;
  const Vector3<double> sine = std::sin(angle / 2) / angle * turn;
  rotation = Product<double>(MakeQuaternion<double>(std::cos(angle / 2), sine), rotation);
  rotation.normalize();
}

bool IsFrictionless(const ContactProblem<double>& problem) {
  return std::all_of(problem.contacts.begin(), problem.contacts.end(),
                     [](const auto& contact) { return contact.kind == ContactKind::kFrictionless; });
}

}  // namespace

static double FastestPoint(const BodyInSpace<double>& body) {
  double radius = 0;
  for (const auto& shape : body.shapes) {
    radius = std::max(radius, shape.center.norm() + shape.radius);
    for (const auto& corner : shape.corners) radius = std::max(radius, corner.norm());
  }
  return body.velocity.norm() + body.spin.norm() * radius;
}

static void AddVelocity(BodyInSpace<double>& body, const Vector6& change) {
  body.velocity += change.head<3>();
  body.spin += change.tail<3>();
}

static void Displace(BodyInSpace<double>& body, const Vector6& change) {
  body.position += change.head<3>();
  Turn(body.rotation, change.tail<3>());
}

static void Advance(BodyInSpace<double>& body, const Vector6& acceleration, double k, double h) {
  const Matrix3<double> inertia = body.WorldInertia();
  // `acceleration` has the gyroscopic moment, which changes no momentum.
  const Vector3<double> gyroscopic = -CrossProduct<double>(body.spin, inertia * body.spin);
  AddVelocity(body, k * acceleration);
  const Vector3<double> momentum = inertia * body.spin - k * gyroscopic;
  body.position += h * body.velocity;
  Turn(body.rotation, h * body.spin);
  if (!body.fixed && !body.spin.isZero(0)) body.spin = Inverse3<double>(body.WorldInertia()) * momentum;
}

bool SolveScene(SolverOf<SceneInSpace<double>>& solver, const ContactProblem<double>& problem,
                ContactProblem<double>::Vector& f, SimulationStatistics& statistics) {
  const auto run = [&](const ContactProblem<double>& p, ContactProblem<double>::Vector& x) {
    if (IsFrictionless(p)) {
      ContactProblem<double> planar = p;  // one row each, as in the plane
      planar.dimension = 2;
      const FastVerdict verdict = solver.fast.Run(planar);
      statistics.fallbacks += verdict.statistics.fallbacks;
      x = solver.fast.f();
      return verdict.outcome == Outcome::kSolved;
    }
    const CoulombVerdict verdict = solver.coulomb.Run(p);
    statistics.fallbacks += verdict.statistics.polygons > 0;
    x = solver.coulomb.f();
    if (verdict.outcome == Outcome::kSolved) return true;
    if (!(verdict.residual <= kLooseResidual)) return false;
    ++statistics.loose;
    return true;
  };
  const auto accept = [&](const auto& whole, const auto& a) {
    return CoulombResidual(problem, whole, a) <= kWholeResidual;
  };
  // Joints that repeat each other, as two hinges of a door do, contradict each other by rounding, which may be
  // much beside a small drift; `accept` has the last word.
  Tolerances tolerances = solver.fast.options().tolerances;
  tolerances.acceleration = kWholeResidual;
  return SolveReduced(problem, tolerances, run, accept, f);
}

bool SolveSparse(SolverOf<SceneInSpace<double>>& solver, const SparseContactProblem<double>& problem,
                 ContactProblem<double>::Vector& f) {
  const auto has_friction = [](const auto& contact) { return contact.HasFrictionRows(); };
  if (std::any_of(problem.contacts.begin(), problem.contacts.end(), has_friction)) {
    if (solver.sparse.Run(problem).outcome != Outcome::kSolved) return false;
    f = solver.sparse.f();
    return true;
  }
  SparseContactProblem<double> planar = problem;  // one row each, as in the plane
  planar.dimension = 2;
  if (solver.proximal.Run(planar).outcome != Outcome::kSolved) return false;
  f = solver.proximal.f();
  return true;
}

template class SimulationOf<SceneInSpace<double>>;

Energy EnergyOf(const SceneInSpace<double>& scene) {
  Energy energy;
  for (const auto& body : scene.bodies) {
    if (body.fixed) continue;
    energy.kinetic +=
        (body.mass * body.velocity.squaredNorm() + body.spin.dot(body.WorldInertia() * body.spin)) / 2;
    energy.potential -= body.mass * scene.gravity.dot(body.position);
  }
  return energy;
}

Drift DriftOf(const SceneInSpace<double>& scene) { return MeasureDrift(scene); }

}  // namespace stiction
