// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/newton_bodies.h"

#include "certify/exact/inexact.h"
#include "solver/numeric/body_newton.h"
#include "solver/numeric/dense_factors.h"

namespace stiction {
namespace {

using Factored = FactoredProblem<double>;

Answer<double> RunBodies(const Factored& problem, const Request& request) {
  Request aiming = request;
  aiming.residual = ResidualOf<double>(request) / 2;  // the rest is for the rounding that the gate counts
  BodyNewton<double> method(aiming);
  method.aim = std::min(method.aim, aiming.residual);
  auto answer = AnswerOf<double>(method.Run(problem));
  answer.method = kNewtonBodies;
  answer.law = FrictionLaw::kCoulomb;
  answer.f = method.f();
  return answer;
}

Answer<double> RunDense(const ContactProblem<double>& problem, const Request& request) {
  Answer<double> answer;
  if (const auto factored = FactorsOf(problem)) return RunBodies(*factored, request);
  answer.law = FrictionLaw::kCoulomb;
  if (problem.rows() == 0) {
    answer.outcome = Outcome::kSolved;
  } else {  // no forces, which the gate would refine
    answer.reason = "over doubles A is not symmetric and positive semidefinite, or too large for a dense J";
  }
  return answer;
}

}  // namespace

InexactAnswer SolveByBodies(const ExactFactors& problem, const Request& request) {
  const Factored rounded = InDoubles(problem);
  InexactAnswer answer = RunBodies(rounded, request);
  if (answer.f.size() != problem.rows() || !answer.f.allFinite()) {
    answer.f.resize(0);
    answer.outcome = Outcome::kUndecided;
    return answer;
  }
  const ExactProblem::Vector f = answer.f.unaryExpr([](double x) { return Rational(x); });
  const ExactProblem::Vector a = problem.Accelerations(f);
  answer.a = a.unaryExpr(&ToDouble);
  JudgeExactly(problem, f, a, ResidualOf<double>(request), answer);
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
