// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/newton_bodies.h"

#include <Eigen/Cholesky>
#include <optional>

#include "certify/exact/inexact.h"
#include "solver/numeric/body_newton.h"

namespace stiction {
namespace {

using Factored = FactoredProblem<double>;

Answer<double> RunBodies(const Factored& problem, const SolveOptions& options) {
  BodyNewtonOptions bodies;
  bodies.residual = BoundOf<double>(options) / 2;  // the rest is for the rounding that the gate counts
  bodies.aim = std::min(bodies.aim, bodies.residual);
  bodies.limits = options.limits;
  BodyNewton<double> method(bodies);
  auto answer = AnswerOf<double>(method.Run(problem));
  answer.method = kNewtonBodies;
  answer.law = FrictionLaw::kCoulomb;
  answer.f = method.f();
  return answer;
}

// Empty for an A that is not symmetric, or not semidefinite but for rounding.
std::optional<Factored> Factor(const ContactProblem<double>& problem) {
  const int rows = problem.rows();
  if (problem.A != problem.A.transpose()) return std::nullopt;
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(problem.A);
  const Eigen::VectorXd D = ldlt.vectorD();
  const double rounding = rows * std::numeric_limits<double>::epsilon() * D.cwiseAbs().maxCoeff();
  if (ldlt.info() != Eigen::Success || !(D.minCoeff() >= -rounding)) return std::nullopt;
  const Eigen::MatrixXd L = ldlt.transpositionsP().transpose() * Eigen::MatrixXd(ldlt.matrixL());
  std::vector<int> kept;
  for (int k = 0; k < rows; ++k) {
    if (D[k] > rounding) kept.push_back(k);
  }
  const int velocities = static_cast<int>(kept.size());
  Factored factored;
  factored.dimension = problem.dimension;
  factored.contacts = problem.contacts;
  factored.M.resize(velocities, velocities);
  factored.M.setIdentity();
  factored.M.diagonal() = D(kept).cwiseInverse();
  Factored::Matrix::Matrix W = factored.M;
  W.diagonal() = D(kept);
  factored.A = {Eigen::MatrixXd(L(Eigen::all, kept)).sparseView(), std::move(W)};
  factored.w = Eigen::VectorXd::Zero(velocities);
  factored.c = factored.b = problem.b;
  return factored;
}

Answer<double> RunDense(const ContactProblem<double>& problem, const SolveOptions& options, Trace<double>*) {
  Answer<double> answer;
  if (const auto factored = problem.rows() > 0 ? Factor(problem) : std::nullopt)
    return RunBodies(*factored, options);
  answer.law = FrictionLaw::kCoulomb;
  answer.f = Eigen::VectorXd::Zero(problem.rows());
  answer.reason = "A is not symmetric and positive semidefinite";
  if (problem.rows() == 0) answer.outcome = Outcome::kSolved;
  return answer;
}

}  // namespace

InexactAnswer SolveByBodies(const ExactFactors& problem, const SolveOptions& options) {
  const Factored rounded = InDoubles(problem);
  InexactAnswer answer = RunBodies(rounded, options);
  if (answer.f.size() != problem.rows() || !answer.f.allFinite()) {
    answer.f.resize(0);
    answer.outcome = Outcome::kUndecided;
    return answer;
  }
  const ExactProblem::Vector f = answer.f.unaryExpr([](double x) { return Rational(x); });
  const ExactProblem::Vector a = problem.Accelerations(f);
  answer.a = a.unaryExpr(&ToDouble);
  JudgeExactly(problem, f, a, BoundOf<double>(options), answer);
  return answer;
}

Method<double> NewtonBodiesRow() {
  return {.name = kNewtonBodies,
          .title = "proximal points, each by Newton's method in the space of bodies, over factors J and M of A",
          .source = "solver/numeric/body_newton.h",
          .ends = "nothing; what is called solved has the residual that is asked for",
          .automatic = false,
          .plane = {&RunDense, true},
          .space = {&RunDense, true}};
}

}  // namespace stiction
