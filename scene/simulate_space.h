// SPDX-License-Identifier: Apache-2.0
// Simulate in space: simulate.h with three dimensions, step for step.
//
// Problems with friction go to CoulombSolver, started afresh: a few Gauss-Seidel sweeps from f = 0, then
// Newton's method, on the law and on smoothed ones; complete driving on polygons behind it. Those without, to
// FastSolver. Bilateral and sliding contacts are taken out before (reduction.h).
//
// The given forces of a step contain the gyroscopic moment -w x (I w). After the turn by h w the spin is the
// one that the angular momentum asks for, w = inverse of (the turned I) times (I w + h (moments)): nothing but
// moments changes an angular momentum, up to rounding. Energy is kept to first order in h.

#ifndef STICTION_SCENE_SIMULATE_SPACE_H_
#define STICTION_SCENE_SIMULATE_SPACE_H_

#include "scene/assemble_space.h"
#include "scene/simulate.h"

namespace stiction {

template <>
struct SolverOf<SceneInSpace<double>> {
  explicit SolverOf(const SimulationOptions& options)
      : coulomb(options.coulomb),
        sparse(options.coulomb),
        fast(options.fast),
        proximal({.residual = options.fast.residual, .aim = kProximalAim}) {}
  CoulombSolver<double> coulomb;
  CoulombSolver<double, SparseContactProblem<double>> sparse;
  FastSolver<double> fast;
  ProximalNewton<double> proximal;
};

using SimulationInSpace = SimulationOf<SceneInSpace<double>>;
extern template class SimulationOf<SceneInSpace<double>>;

Energy EnergyOf(const SceneInSpace<double>& scene);
Drift DriftOf(const SceneInSpace<double>& scene);

bool SolveScene(SolverOf<SceneInSpace<double>>& solver, const ContactProblem<double>& problem,
                ContactProblem<double>::Vector& f, SimulationStatistics& statistics);

// The same with a sparse A, in which bilateral and sliding contacts stay; without complete driving.
bool SolveSparse(SolverOf<SceneInSpace<double>>& solver, const SparseContactProblem<double>& problem,
                 ContactProblem<double>::Vector& f);

}  // namespace stiction

#endif  // STICTION_SCENE_SIMULATE_SPACE_H_
