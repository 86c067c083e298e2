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

InexactAnswer InPlane(const Sparse& problem, double residual, const Request& request) {
  ProximalNewton<double> solver({.limits = request.limits, .residual = residual}, residual / 2);
  auto answer = AnswerOf<double>(solver.Run(problem));
  answer.method = "proximal";
  answer.f = solver.f();
  return answer;
}

InexactAnswer InSpace(const Sparse& problem, double residual, const Request& request) {
  CoulombSolver<double, Sparse> solver(
      {.tolerances = request.tolerances, .limits = request.limits, .residual = residual / 2});
  auto answer = AnswerOf<double>(solver.Run(problem));
  answer.method = "fast";
  answer.f = solver.f();
  return answer;
}

// A as it is listed.
InexactAnswer SolveListed(const SparseProblem& problem, const Request& request) {
  const double residual = ResidualOf<double>(request);
  const Sparse rounded = InDoubles(problem);
  InexactAnswer answer =
      problem.dimension == 2 ? InPlane(rounded, residual, request) : InSpace(rounded, residual, request);
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

InexactAnswer SolveSparse(const SparseProblem& problem, const Request& request, std::string_view method) {
  const bool any = method == kAutomatic;
  if (!problem.factors || (!any && method != kNewtonBodies)) return SolveListed(WithMatrix(problem), request);
  InexactAnswer answer = SolveByBodies(*problem.factors, request);
  if (answer.Solved() || !any || request.limits.Stopped()) return answer;
  InexactAnswer other = SolveListed(WithMatrix(problem), request);
  const bool is_better = other.errors && (!answer.errors || other.residual() < answer.residual());
  return other.Solved() || is_better ? other : answer;
}

}  // namespace stiction
