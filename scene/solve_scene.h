// SPDX-License-Identifier: Apache-2.0
// Solving the problems of scenes, in the plane and in space, over doubles: a list of methods, each of which has
// its turn until one ends in a solution.
//
//   of A with all its entries, after reduction.h, in the plane with friction
//     cells       FastSolver's guesses alone
//     near cells  the same at two or three proximal points, f -> the solution for (A + eps I, b - eps f), from
//                 f = 0: two contacts of one face give A dependent rows of friction, so that a choice of cells
//                 need not determine its forces; these it does determine, and their accelerations agree with
//                 the problem's to rounding
//     proximal    more proximal points, from large eps to small, with A sparse: counted
//     complete    FastSolver, with the published algorithm and complete driving behind guesses: the latter
//     counted
//   in space with friction
//     Coulomb     CoulombSolver: a few Gauss-Seidel sweeps from f = 0, then Newton's method, on the law and on
//                 smoothed ones; complete driving on polygons behind it, counted
//   without friction, where plane and space have the same rows
//     complete, proximal
//
//   in factors, in which joints and sliding contacts stay: counted
//     bodies      with a start: Newton's method in the space of bodies, from forces near a solution, which is
//                 counted; f = 0 where that is a solution
//     interior    without: the interior point method in the space of bodies, several attempts
//
// Where none ends in a solution, the forces of the smallest errors are taken up to kLooseResidual, and counted.
// Beyond that a problem is undecided, and its answer has the best forces that were found.
// A and b are scaled first (problem/row_scale.h). Forces of a reduced problem are checked by the errors of the
// whole one.

#pragma once

#include <limits>
#include <memory>

#include "solver/problem/answer.h"
#include "solver/problem/forms.h"

namespace stiction {

// A problem need not be solved as far as rounding allows, and in space cannot always be. Where contacts are
// more than bodies can tell apart, b is in range(A) only as far as contacts at rest have no velocities left,
// and equal gaps: what is left of them, squared or over h^2, asks for accelerations of 1e-8 to 1e-5 m/s^2 that
// no forces take away. The solution is then one of contacts that creep or part by so much, and the forces that
// tell them from contacts at rest differ by their whole size. What is not solved to the residual of the options
// is accepted to this one, and counted.
inline constexpr double kLooseResidual = 1e-5;

// Counters: fallbacks, runs of complete driving; loose, solved to kLooseResidual only; sparse, solved in the
// space of bodies; warm, from given forces.
struct SceneAnswer : Answer<double> {
  // Where it is undecided: lenient (lenient.h), of f, the best that was found; infinite from a start.
  double error = std::numeric_limits<double>::infinity();
};

// Reusable. Memory is kept between runs; answers do not depend on earlier ones.
class SceneSolver {
 public:
  SceneSolver();
  ~SceneSolver();

  // Of contacts of any kinds.
  SceneAnswer Solve(const ContactProblem<double>& problem);
  // With `start` (rows x 1, N) from these forces.
  SceneAnswer Solve(const FactoredProblem<double>& problem, const Eigen::VectorXd* start = nullptr);

 private:
  class Methods;
  std::unique_ptr<Methods> methods_;
};

}  // namespace stiction
