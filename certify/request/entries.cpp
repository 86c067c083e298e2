// SPDX-License-Identifier: Apache-2.0
#include "certify/request/entries.h"

#include "certify/exact/bodies.h"
#include "certify/exact/inexact.h"
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
InexactAnswer SolveListed(const ExactEntries& problem, const Request& request) {
  const double residual = ResidualOf<double>(request);
  const Sparse rounded = Converted<double>(problem, &ToDouble);
  InexactAnswer answer =
      problem.dimension == 2 ? InPlane(rounded, residual, request) : InSpace(rounded, residual, request);
  answer.law = FrictionLaw::kCoulomb;
  if (answer.f.size() != problem.rows() || !answer.f.allFinite()) {
    answer.f.resize(0);
    answer.outcome = Outcome::kUndecided;
    return answer;
  }
  answer.a = rounded.A * answer.f + rounded.b;
  const ExactProblem::Vector f = answer.f.unaryExpr([](double x) { return Rational(x); });
  JudgeExactly(problem, f, problem.A * f + problem.b, residual, answer);
  return answer;
}

}  // namespace

std::vector<std::string_view> MethodsOfEntries(const AnyProblem& problem) {
  const std::string_view listed = problem.dimension() == 2 ? "proximal" : "fast";
  if (problem.factors() != nullptr) return {kNewtonBodies, kInteriorPoint, listed};
  return {listed};
}

InexactAnswer SolveEntries(const AnyProblem& problem, const Request& request) {
  const bool in_factors = IsOfBodies(request.method) && problem.factors() != nullptr;
  return in_factors ? SolveByBodies(*problem.factors(), request) : SolveListed(problem.entries(), request);
}

}  // namespace stiction
