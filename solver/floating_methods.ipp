// SPDX-License-Identifier: Apache-2.0
// The rows of the table of methods over floating-point scalars (solve.h).

#pragma once

#include <array>

#include "solver/in_turn.h"
#include "solver/numeric/coulomb.h"
#include "solver/numeric/fast.h"
#include "solver/numeric/gauss_seidel.h"
#include "solver/numeric/proximal.h"
#include "solver/published/published_space.h"
#include "solver/solve.ipp"

namespace stiction {

// What a method aims at, so that the gate, which adds what rounding may hide, lets it pass.
template <class Scalar>
Request Aiming(Request request) {
  request.residual = ResidualOf<Scalar>(request) / 2;
  return request;
}

// ---- Runs over floating-point scalars alone ------------------------------------------------------

template <class Scalar>
Answer<Scalar> RunBaraffInSpace(const ContactProblem<Scalar>& problem, const Request& request) {
  PublishedInSpace<Scalar> algorithm(request);
  SpaceTrace<Scalar> trace;
  auto answer = AnswerOf<Scalar>(algorithm.Run(problem, request.trace ? &trace : nullptr));
  answer.counters = algorithm.counters();
  answer.f = algorithm.f();
  if (answer.outcome == Outcome::kRay) answer.ray = algorithm.ray();
  answer.pivots = std::move(trace);
  return answer;
}

template <class Scalar>
Answer<Scalar> RunProximal(const ContactProblem<Scalar>& problem, const Request& request) {
  ProximalNewton<Scalar> solver(Aiming<Scalar>(request));
  SparseContactProblem<Scalar> sparse{problem.dimension, problem.contacts, problem.A.sparseView(), problem.b};
  auto answer = AnswerOf<Scalar>(solver.Run(sparse));
  answer.f = solver.f();
  return answer;
}

template <class Scalar>
Answer<Scalar> RunCells(const ContactProblem<Scalar>& problem, const Request& request) {
  FastSolver<Scalar> solver(Aiming<Scalar>(request));
  auto answer = AnswerOf<Scalar>(solver.Run(problem));
  answer.f = solver.f();
  if (answer.Solved()) answer.word = solver.Word();
  return answer;
}

// Where masses or jams are beyond what pivots of this scalar tell apart, proximal points may still be found.
template <class Scalar>
Answer<Scalar> RunFast(const ContactProblem<Scalar>& problem, const Request& request) {
  Counters of_cells;
  const auto run_cells = [&] {
    Answer<Scalar> answer = RunCells(problem, request);
    of_cells = answer.counters;
    return answer;
  };
  const auto run_proximal = [&] {
    Answer<Scalar> answer = request.limits.Stopped() ? Answer<Scalar>() : RunProximal(problem, request);
    answer.counters += of_cells;
    return answer;
  };
  return InTurn<Answer<Scalar>>({run_cells, run_proximal});
}

template <class Scalar, CoulombStart kStart>
Answer<Scalar> RunCoulomb(const ContactProblem<Scalar>& problem, const Request& request) {
  CoulombSolver<Scalar> solver(Aiming<Scalar>(request), kStart);
  auto answer = AnswerOf<Scalar>(solver.Run(problem));
  answer.law = FrictionLaw::kCoulomb;
  answer.f = solver.f();
  return answer;
}

// The solution on polygons is where sweeps and Newton's method begin.
template <class Scalar>
Answer<Scalar> RunLemkeInSpace(const ContactProblem<Scalar>& problem, const Request& request) {
  LemkeAlgorithm<Scalar> lemke(request, kUsualCover<Scalar>);
  const std::vector<FrictionPolygon<Scalar>> polygons(problem.contacts.size(),
                                                      FrictionPolygon<Scalar>(request.sides));
  Trace<Scalar> trace;
  auto pivoted = AnswerOf<Scalar>(lemke.Run(problem, polygons, Kept(request, trace)));
  pivoted.pivots = std::move(trace.pivots);
  if (!pivoted.Solved()) {
    if (pivoted.outcome == Outcome::kRay) pivoted.ray = lemke.ray();
    return pivoted;
  }
  Request from_point = Aiming<Scalar>(request);
  from_point.sides = 0;
  CoulombSolver<Scalar> solver(from_point);
  auto answer = AnswerOf<Scalar>(solver.Run(problem, &lemke.f()));
  answer.counters += pivoted.counters;
  answer.pivots = std::move(pivoted.pivots);
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
Answer<Scalar> RunSweeps(const ContactProblem<Scalar>& problem, const Request& request) {
  return RunGaussSeidel(problem, Aiming<Scalar>(request));
}

template <class Scalar>
Method<Scalar> GaussSeidelRow() {
  return {.name = "gauss-seidel",
          .title = "nonlinear block Gauss-Seidel: every contact in turn by its own law, as in most engines",
          .source = "solver/numeric/gauss_seidel.h",
          .ends = "nothing; what is called solved has the residual that is asked for",
          .plane = {&RunSweeps<Scalar>},
          .space = {&RunSweeps<Scalar>}};
}

template <class Scalar>
std::span<const Method<Scalar>> FloatingMethods() {
  static const std::array rows = {
      FastRow<Scalar>(),
      ProximalRow<Scalar>(),
      GaussSeidelRow<Scalar>(),
      CompleteRow<Scalar>({&RunCoulomb<Scalar, CoulombStart::kComplete>, true}),
      LemkeRow<Scalar>({&RunLemkeInSpace<Scalar>}),
      BaraffRow<Scalar>({&RunBaraffInSpace<Scalar>}),
  };
  return rows;
}

}  // namespace stiction
