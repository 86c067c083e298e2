// SPDX-License-Identifier: Apache-2.0
#include "certify/request/solve_sparse.h"

#include "certify/exact/inexact.h"
#include "certify/exact/newton_bodies.h"
#include "corpus/record/sparse_problem.h"
#include "solver/numeric/coulomb.h"
#include "solver/numeric/proximal.h"
#include "solver/problem/errors.h"

namespace stiction {
namespace {

using Sparse = SparseContactProblem<double>;

InexactAnswer InPlane(const Sparse& problem, double residual, const SolveOptions& options) {
  ProximalOptions proximal;
  proximal.residual = residual;
  proximal.aim = residual / 2;
  proximal.limits = options.limits;
  ProximalNewton<double> solver(proximal);
  auto answer = AnswerOf<double>(solver.Run(problem));
  answer.method = "proximal";
  answer.f = solver.f();
  return answer;
}

InexactAnswer InSpace(const Sparse& problem, double residual, const SolveOptions& options) {
  CoulombOptions coulomb;
  coulomb.tolerances = options.tolerances;
  coulomb.limits = options.limits;
  coulomb.residual = residual / 2;
  CoulombSolver<double, Sparse> solver(coulomb);
  auto answer = AnswerOf<double>(solver.Run(problem));
  answer.method = "fast";
  answer.f = solver.f();
  return answer;
}

// A as it is listed.
InexactAnswer SolveListed(const SparseProblem& problem, const SolveOptions& options) {
  const double residual = BoundOf<double>(options);
  const Sparse rounded = InDoubles(problem);
  InexactAnswer answer =
      problem.dimension == 2 ? InPlane(rounded, residual, options) : InSpace(rounded, residual, options);
  answer.law = FrictionLaw::kCoulomb;
  if (answer.f.size() != problem.rows() || !answer.f.allFinite()) {
    answer.f.resize(0);
    answer.outcome = Outcome::kUndecided;
    return answer;
  }
  answer.a = rounded.A * answer.f + rounded.b;
  const auto rational = OverRationals(problem);
  const ExactProblem::Vector f = answer.f.unaryExpr([](double x) { return Rational(x); });
  JudgeExactly(rational, f, rational.A * f + rational.b, residual, answer);
  return answer;
}

}  // namespace

std::vector<std::string_view> SparseMethods(const SparseProblem& problem) {
  const std::string_view listed = problem.dimension == 2 ? "proximal" : "fast";
  if (problem.factors) return {kNewtonBodies, listed};
  return {listed};
}

InexactAnswer SolveSparse(const SparseProblem& problem, const SolveOptions& options, std::string_view method) {
  const bool any = method == kAutomatic;
  if (!problem.factors || (!any && method != kNewtonBodies)) return SolveListed(WithMatrix(problem), options);
  InexactAnswer answer = SolveByBodies(*problem.factors, options);
  if (answer.Solved() || !any || options.limits.Stopped()) return answer;
  InexactAnswer other = SolveListed(WithMatrix(problem), options);
  const bool is_better = other.errors && (!answer.errors || other.residual() < answer.residual());
  return other.Solved() || is_better ? other : answer;
}

}  // namespace stiction
