// SPDX-License-Identifier: Apache-2.0
#include "certify/request/solve_sparse.h"

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

// The errors of f, over rationals.
Errors<double> ExactErrors(const SparseProblem& problem, const Eigen::VectorXd& f) {
  const auto rational = OverRationals(problem);
  const ExactProblem::Vector exact_f = f.unaryExpr([](double x) { return Rational(x); });
  const ExactProblem::Vector a = rational.A * exact_f + rational.b;
  const Errors<Rational> exact = MeasureErrors(rational, FrictionLaw::kCoulomb, exact_f, a);
  Errors<double> errors;
  errors.acceleration = ToDouble(exact.acceleration);
  errors.force = ToDouble(exact.force);
  errors.backward = ToDouble(exact.backward);
  errors.amplification = ToDouble(exact.amplification);
  errors.contact = exact.contact;
  errors.is_finite = exact.is_finite;
  return errors;
}

}  // namespace

InexactAnswer SolveSparse(const SparseProblem& problem, const SolveOptions& options) {
  constexpr double kUsualResidual = 1e-8;
  const double residual = options.residual > 0 ? options.residual : kUsualResidual;
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
  answer.errors = ExactErrors(problem, answer.f);
  if (answer.Solved() && !(answer.residual() <= residual)) {
    answer.outcome = Outcome::kUndecided;
    answer.reason = "the errors, evaluated over rationals, are larger than called solved";
  }
  return answer;
}

}  // namespace stiction
