// SPDX-License-Identifier: Apache-2.0
// Stepping in the plane.

#include "scene/simulate.ipp"

#include <limits>
#include <utility>

namespace stiction {
namespace {

constexpr double kProximal = 1e-9;  // of the largest A_ii; well above the tolerance of pivots, 1e-11
constexpr int kProximalPoints = 3;
constexpr double kWholeResidual = 1e-7;  // of a problem with the bilateral rows that reduction took out

void Turn(Vector2<double>& rotation, double angle) {
  if (angle == 0) return;
  rotation =
      UnitVector<double>(Rotate<double>(MakeVector2<double>(std::cos(angle), std::sin(angle)), rotation));
}

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
  for (int point = 0; point < kProximalPoints && residual > kProximalAim; ++point) {
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

bool SolveInTurn(SolverOf<Scene<double>>& solver, const ContactProblem<double>& problem,
                 ContactProblem<double>::Vector& f, SimulationStatistics& statistics) {
  const bool friction = problem.rows() > static_cast<int>(problem.contacts.size());
  if (friction && SolveQuickly(solver.fast, problem)) {
    f = solver.fast.f();
    return true;
  }
  if (friction && SolveProximally(solver.fast, problem, f)) return true;
  const auto complete = [&] {
    const FastVerdict verdict = solver.fast.Run(problem);
    statistics.fallbacks += verdict.statistics.fallbacks;
    f = solver.fast.f();
    return verdict.outcome == Outcome::kSolved;
  };
  const auto sparse = [&] {
    const bool solved = SolveSparse(solver, {2, problem.contacts, problem.A.sparseView(), problem.b}, f);
    statistics.sparse += solved;
    return solved;
  };
  return friction ? sparse() || complete() : complete() || sparse();
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

static void Advance(RigidBody<double>& body, const Eigen::Vector3d& acceleration, double k, double h) {
  AddVelocity(body, k * acceleration);
  body.position += h * body.velocity;
  Turn(body.rotation, h * body.spin);
}

bool SolveScene(SolverOf<Scene<double>>& solver, const ContactProblem<double>& problem,
                ContactProblem<double>::Vector& f, SimulationStatistics& statistics) {
  const auto run = [&](const ContactProblem<double>& p, ContactProblem<double>::Vector& x) {
    return SolveInTurn(solver, p, x, statistics);
  };
  const auto accept = [&](const auto& whole, const auto& a) {
    return NaturalResidual(problem, whole, a) <= kWholeResidual;
  };
  return SolveReduced(problem, solver.fast.options().tolerances, run, accept, f);
}

bool SolveSparse(SolverOf<Scene<double>>& solver, const SparseContactProblem<double>& problem,
                 ContactProblem<double>::Vector& f) {
  if (solver.proximal.Run(problem).outcome != Outcome::kSolved) return false;
  f = solver.proximal.f();
  return true;
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
