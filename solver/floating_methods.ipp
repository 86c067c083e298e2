// SPDX-License-Identifier: Apache-2.0
// The rows of the table of methods over floating-point scalars (solve.h).

#ifndef STICTION_SOLVER_FLOATING_METHODS_IPP_
#define STICTION_SOLVER_FLOATING_METHODS_IPP_

#include <array>

#include "solver/numeric/admm.h"
#include "solver/numeric/coulomb.h"
#include "solver/numeric/fast.h"
#include "solver/numeric/proximal.h"
#include "solver/published/published_space.h"
#include "solver/solve.ipp"

namespace stiction {

// What a method aims at, so that the gate, which adds what rounding may hide, lets it pass.
template <class Scalar>
double AimOf(const SolveOptions& options) {
  return (options.residual > 0 ? options.residual : kSolvedResidual<Scalar>) / 2;
}

// ---- Runs over floating-point scalars alone ------------------------------------------------------

template <class Scalar>
Answer<Scalar> RunBaraffInSpace(const ContactProblem<Scalar>& problem, const SolveOptions& options,
                                Trace<Scalar>* trace) {
  PublishedInSpace<Scalar> algorithm({options.policy, options.tolerances, options.limits});
  const PublishedSpaceVerdict verdict = algorithm.Run(problem, trace == nullptr ? nullptr : &trace->pivots);
  auto answer = AnswerOf<Scalar>(verdict);
  answer.f = algorithm.f();
  if (verdict.outcome == Outcome::kRay) answer.ray = algorithm.ray();
  return answer;
}

template <class Scalar>
Answer<Scalar> RunProximal(const ContactProblem<Scalar>& problem, const SolveOptions& options, Trace<Scalar>*) {
  ProximalOptions proximal;
  proximal.residual = proximal.aim = AimOf<Scalar>(options);
  proximal.limits = options.limits;
  ProximalNewton<Scalar> solver(proximal);
  SparseContactProblem<Scalar> sparse{problem.dimension, problem.contacts, problem.A.sparseView(), problem.b};
  auto answer = AnswerOf<Scalar>(solver.Run(sparse));
  answer.f = solver.f();
  return answer;
}

// Where masses or jams are beyond what pivots of this scalar tell apart, proximal points may still be found.
template <class Scalar>
Answer<Scalar> RunFast(const ContactProblem<Scalar>& problem, const SolveOptions& options,
                       Trace<Scalar>* trace) {
  FastSolver<Scalar> solver({options.tolerances, options.limits, AimOf<Scalar>(options)});
  auto answer = AnswerOf<Scalar>(solver.Run(problem));
  answer.f = solver.f();
  if (answer.Solved()) {
    answer.word = solver.Word();
    return answer;
  }
  if (options.limits.Stopped()) return answer;
  Answer<Scalar> other = RunProximal(problem, options, trace);
  if (!other.Solved()) return answer;
  other.counters.insert(other.counters.begin(), answer.counters.begin(), answer.counters.end());
  return other;
}

template <class Scalar>
Answer<Scalar> RunAdmm(const ContactProblem<Scalar>& problem, const SolveOptions& options, Trace<Scalar>*) {
  Admm<Scalar> solver({.limits = options.limits, .residual = AimOf<Scalar>(options)});
  auto answer = AnswerOf<Scalar>(solver.Run(problem));
  answer.law = FrictionLaw::kCoulomb;
  answer.f = solver.f();
  return answer;
}

template <class Scalar, CoulombStart kStart>
Answer<Scalar> RunCoulomb(const ContactProblem<Scalar>& problem, const SolveOptions& options, Trace<Scalar>*) {
  CoulombOptions coulomb;
  coulomb.tolerances = options.tolerances;
  coulomb.limits = options.limits;
  coulomb.sides = options.sides;
  coulomb.start = kStart;
  coulomb.residual = AimOf<Scalar>(options);
  CoulombSolver<Scalar> solver(coulomb);
  auto answer = AnswerOf<Scalar>(solver.Run(problem));
  answer.law = FrictionLaw::kCoulomb;
  answer.f = solver.f();
  return answer;
}

// The solution on polygons is where sweeps and Newton's method begin.
template <class Scalar>
Answer<Scalar> RunLemkeInSpace(const ContactProblem<Scalar>& problem, const SolveOptions& options,
                               Trace<Scalar>* trace) {
  LemkeAlgorithm<Scalar> lemke(LemkeOptionsOf<Scalar>(options));
  const std::vector<FrictionPolygon<Scalar>> polygons(problem.contacts.size(),
                                                      FrictionPolygon<Scalar>(options.sides));
  const Verdict verdict = lemke.Run(problem, polygons, trace);
  if (verdict.outcome != Outcome::kSolved) {
    auto answer = AnswerOf<Scalar>(verdict);
    if (verdict.outcome == Outcome::kRay) answer.ray = lemke.ray();
    return answer;
  }
  CoulombOptions coulomb;
  coulomb.limits = options.limits;
  coulomb.sides = 0;
  coulomb.residual = AimOf<Scalar>(options);
  CoulombSolver<Scalar> solver(coulomb);
  auto answer = AnswerOf<Scalar>(solver.Run(problem, &lemke.f()));
  answer.counters.push_back({"pivots", verdict.statistics.pivots});
  answer.law = FrictionLaw::kCoulomb;
  answer.f = solver.f();
  return answer;
}

// ---- The table ---------------------------------------------------------------------------------

template <class Scalar>
Method<Scalar> FastRow() {
  return {.name = "fast",
          .title =
              "projected Gauss-Seidel, then block pivoting; in space semismooth Newton; the published "
              "algorithm, complete driving and proximal points behind them",
          .source = "solver/numeric/fast.h, solver/numeric/coulomb.h",
          .ends = "nothing; what is called solved has the residual that is asked for",
          .automatic = true,
          .plane = {&RunFast<Scalar>},
          .space = {&RunCoulomb<Scalar, CoulombStart::kSweeps>, true}};
}

template <class Scalar>
Method<Scalar> ProximalRow() {
  return {.name = "proximal",
          .title = "proximal points, each by Newton's method over a sparse A",
          .source = "solver/numeric/proximal.h",
          .ends = "nothing; what is called solved has the residual that is asked for",
          .plane = {&RunProximal<Scalar>, true},
          .space = {}};
}

template <class Scalar>
Method<Scalar> AdmmRow() {
  return {.name = "admm",
          .title = "alternating directions of multipliers on the cone of friction, over-relaxed and balanced",
          .source = "solver/numeric/admm.h",
          .ends = "nothing; what is called solved has the residual that is asked for",
          .plane = {&RunAdmm<Scalar>},
          .space = {&RunAdmm<Scalar>}};
}

template <class Scalar>
std::span<const Method<Scalar>> FloatingMethods() {
  static const std::array rows = {
      FastRow<Scalar>(),
      ProximalRow<Scalar>(),
      CompleteRow<Scalar>({&RunCoulomb<Scalar, CoulombStart::kComplete>, true}),
      LemkeRow<Scalar>({&RunLemkeInSpace<Scalar>}),
      BaraffRow<Scalar>({&RunBaraffInSpace<Scalar>}),
      AdmmRow<Scalar>(),
  };
  return rows;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_FLOATING_METHODS_IPP_
