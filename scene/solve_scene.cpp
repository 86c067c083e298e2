// SPDX-License-Identifier: Apache-2.0
#include "scene/solve_scene.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "solver/problem/reduction.ipp"
#include "solver/problem/residual.h"

namespace stiction {
namespace {

constexpr double kProximal = 1e-9;  // of the largest A_ii; well above the tolerance of pivots, 1e-11
constexpr int kProximalPoints = 3;

// Residuals of a problem with the rows that reduction took out.
constexpr double kWholeResidual = 1e-7, kWholeResidualInSpace = 10 * kLooseResidual;

template <class Problem>
bool HasFriction(const Problem& problem) {
  return std::any_of(problem.contacts.begin(), problem.contacts.end(),
                     [](const auto& contact) { return contact.HasFrictionRows(); });
}

// Joints that repeat each other, as two hinges of a door do, contradict each other by rounding, which may be
// much beside a small drift; the residual of the whole problem has the last word.
Tolerances ForReduction(Tolerances tolerances, int dimension) {
  if (dimension == 3) tolerances.acceleration = kWholeResidualInSpace;
  return tolerances;
}

}  // namespace

// The order is that of the turns.
const SceneSolver::Step<ContactProblem<double>> SceneSolver::kDenseSteps[] = {
    {2, true, &SceneSolver::Cells},     {2, true, &SceneSolver::NearCells}, {2, true, &SceneSolver::Proximal},
    {2, true, &SceneSolver::Complete},  {3, true, &SceneSolver::Coulomb},   {2, false, &SceneSolver::Complete},
    {2, false, &SceneSolver::Proximal},
};
const SceneSolver::Step<SparseContactProblem<double>> SceneSolver::kSparseSteps[] = {
    {2, true, &SceneSolver::SparseProximal},
    {3, true, &SceneSolver::SparseCoulomb},
    {2, false, &SceneSolver::SparseProximal},
};

SceneSolver::SceneSolver(const SceneSolverOptions& options)
    : fast_(options.fast),
      proximal_({.residual = options.fast.residual, .aim = kProximalAim}),
      coulomb_(options.coulomb),
      sparse_coulomb_(options.coulomb) {}

SceneAnswer SceneSolver::Solve(const Dense& problem) {
  SceneAnswer answer;
  if (!Reduction<double>::Concerns(problem)) {
    answer.solved = TryInTurn(kDenseSteps, problem, answer);
    return answer;
  }
  const Reduction<double> reduction(problem, ForReduction(fast_.options().tolerances, problem.dimension));
  if (reduction.end() != ReductionEnd::kReduced) return answer;
  answer.f.resize(0);
  if (reduction.problem().rows() > 0 && !TryInTurn(kDenseSteps, reduction.problem(), answer)) return answer;
  answer.f = reduction.Forces(answer.f);
  answer.solved = IsAccepted(problem, answer.f);
  return answer;
}

SceneAnswer SceneSolver::Solve(const Sparse& problem) {
  SceneAnswer answer;
  answer.solved = TryInTurn(kSparseSteps, problem, answer);
  return answer;
}

template <class Problem, std::size_t Count>
bool SceneSolver::TryInTurn(const Step<Problem> (&steps)[Count], const Problem& problem, SceneAnswer& answer) {
  const bool friction = HasFriction(problem);
  if (!friction && problem.dimension == 3) {
    Problem planar = problem;  // one row each, as in the plane
    planar.dimension = 2;
    return TryInTurn(steps, planar, answer);
  }
  return std::any_of(std::begin(steps), std::end(steps), [&](const Step<Problem>& step) {
    return step.friction == friction && step.dimension == problem.dimension &&
           (this->*step.run)(problem, answer);
  });
}

bool SceneSolver::IsAccepted(const Dense& problem, const Dense::Vector& f) const {
  const Dense::Vector a = problem.A * f + problem.b;
  if (problem.dimension == 2) return NaturalResidual(problem, f, a) <= kWholeResidual;
  return CoulombResidual(problem, f, a) <= kWholeResidualInSpace;
}

// ---- Methods ---------------------------------------------------------------------------------

// Without complete driving: limits.pivots bounds it. (Without friction it would bound the active set as well.)
bool SceneSolver::GuessCells(const Dense& problem, const std::vector<Cell>& guess) {
  const Limits limits = std::exchange(fast_.options().limits, {.pivots = 0});
  const bool solved = fast_.Run(problem, guess).outcome == Outcome::kSolved;
  fast_.options().limits = limits;
  return solved;
}

bool SceneSolver::Cells(const Dense& problem, SceneAnswer& answer) {
  if (!GuessCells(problem, {})) return false;
  answer.f = fast_.f();
  return true;
}

bool SceneSolver::NearCells(const Dense& problem, SceneAnswer& answer) {
  const double eps = kProximal * problem.A.diagonal().maxCoeff();
  Dense near = problem;
  near.A.diagonal().array() += eps;
  double residual = std::numeric_limits<double>::infinity();
  std::vector<Cell> cells;
  Dense::Vector& f = answer.f;
  f.setZero(problem.rows());
  for (int point = 0; point < kProximalPoints && residual > kProximalAim; ++point) {
    near.b = problem.b - eps * f;
    if (!GuessCells(near, cells)) return false;
    f = fast_.f();
    cells = fast_.cells();
    const Dense::Vector a = problem.A * f + problem.b;
    const Residual<double> measured = MeasureResidual(problem, f, a);
    // Relative to b: where there is no solution forces grow like 1 / eps, and any violation is small beside
    // them.
    residual = measured.worst / measured.b_scale;
  }
  return residual <= fast_.options().residual;
}

bool SceneSolver::Proximal(const Dense& problem, SceneAnswer& answer) {
  return SparseProximal({2, problem.contacts, problem.A.sparseView(), problem.b}, answer);
}

bool SceneSolver::Complete(const Dense& problem, SceneAnswer& answer) {
  const FastVerdict verdict = fast_.Run(problem);
  answer.fallbacks += verdict.statistics.fallbacks;
  answer.f = fast_.f();
  return verdict.outcome == Outcome::kSolved;
}

bool SceneSolver::Coulomb(const Dense& problem, SceneAnswer& answer) {
  const CoulombVerdict verdict = coulomb_.Run(problem);
  answer.fallbacks += verdict.statistics.polygons > 0;
  answer.f = coulomb_.f();
  if (verdict.outcome == Outcome::kSolved) return true;
  answer.loose += verdict.residual <= kLooseResidual;
  return verdict.residual <= kLooseResidual;
}

bool SceneSolver::SparseProximal(const Sparse& problem, SceneAnswer& answer) {
  if (proximal_.Run(problem).outcome != Outcome::kSolved) return false;
  answer.f = proximal_.f();
  ++answer.sparse;
  return true;
}

bool SceneSolver::SparseCoulomb(const Sparse& problem, SceneAnswer& answer) {
  if (sparse_coulomb_.Run(problem).outcome != Outcome::kSolved) return false;
  answer.f = sparse_coulomb_.f();
  ++answer.sparse;
  return true;
}

}  // namespace stiction
