// SPDX-License-Identifier: Apache-2.0
// Stepping in the plane.

#include "solver/scene/simulate.ipp"

namespace stiction {
namespace {

constexpr double kWholeResidual = 1e-7;  // of a problem with the bilateral rows that reduction took out

void Turn(Vector2<double>& rotation, double angle) {
  if (angle == 0) return;
  rotation =
      UnitVector<double>(Rotate<double>(MakeVector2<double>(std::cos(angle), std::sin(angle)), rotation));
}

}  // namespace

static double FastestPoint(const RigidBody<double>& body) {
  double radius = 0;
  for (const auto& shape : body.shapes) {
    radius = std::max(radius, Length<double>(shape.center) + shape.radius);
    for (const auto& corner : shape.polygon) radius = std::max(radius, Length<double>(corner));
  }
  return Length<double>(body.velocity) + std::abs(body.spin) * radius;
}

static void AddVelocity(RigidBody<double>& body, const Eigen::Vector3d& change) {
  body.velocity += change.head<2>();
  body.spin += change[2];
}

static void Displace(RigidBody<double>& body, const Eigen::Vector3d& change) {
  body.position += change.head<2>();
  Turn(body.rotation, change[2]);
}

static void Advance(RigidBody<double>& body, const Eigen::Vector3d& acceleration, double h) {
  AddVelocity(body, h * acceleration);
  body.position += h * body.velocity;
  Turn(body.rotation, h * body.spin);
}

bool SolveScene(SolverOf<Scene<double>>& solver, const ContactProblem<double>& problem,
                ContactProblem<double>::Vector& f, SimulationStatistics& statistics) {
  const auto run = [&](const ContactProblem<double>& p, ContactProblem<double>::Vector& x) {
    const FastVerdict verdict = solver.fast.Run(p);
    statistics.fallbacks += verdict.statistics.fallbacks;
    x = solver.fast.f();
    return verdict.outcome == Outcome::kSolved;
  };
  const auto accept = [&](const auto& whole, const auto& a) {
    return NaturalResidual(problem, whole, a) <= kWholeResidual;
  };
  return SolveReduced(problem, solver.fast.options().tolerances, run, accept, f);
}

template class SimulationOf<Scene<double>>;

Energy EnergyOf(const Scene<double>& scene) {
  Energy energy;
  for (const auto& body : scene.bodies) {
    if (body.fixed) continue;
    energy.kinetic += (body.mass * body.velocity.squaredNorm() + body.inertia * body.spin * body.spin) / 2;
    energy.potential -= body.mass * scene.gravity.dot(body.position);
  }
  return energy;
}

Drift DriftOf(const Scene<double>& scene) { return MeasureDrift(scene); }

}  // namespace stiction
