// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/bodies.h"

#include "certify/exact/inexact.h"
#include "solver/numeric/body_newton.h"
#include "solver/numeric/dense_factors.h"
#include "solver/numeric/interior_point.h"

namespace stiction {
namespace {

using Factored = FactoredProblem<double>;

template <class Engine>
Answer<double> AnswerBy(std::string_view name, Engine& engine, const Factored& problem) {
  engine.aim = std::min(engine.aim, engine.request().residual);
  auto answer = AnswerOf<double>(engine.Run(problem));
  answer.method = name;
  answer.law = FrictionLaw::kCoulomb;
  answer.f = engine.f();
  return answer;
}

Answer<double> RunBodies(const Factored& problem, const Request& request) {
  Request aiming = request;
  aiming.residual = ResidualOf<double>(request) / 2;  // the rest is for the rounding that the gate counts
  if (request.method == kInteriorPoint) {
    InteriorPoint engine(aiming);
    return AnswerBy(kInteriorPoint, engine, problem);
  }
  BodyNewton engine(aiming);
  return AnswerBy(kNewtonBodies, engine, problem);
}

template <const std::string_view& kName>
Answer<double> RunDense(const ContactProblem<double>& problem, const Request& request) {
  Request named = request;
  named.method = kName;
  Answer<double> answer;
  if (const auto factored = FactorsOf(problem)) return RunBodies(*factored, named);
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
  return Judged(problem, request, RunBodies(InDoubles(problem), request));
}

InexactAnswer Judged(const ExactFactors& problem, const Request& request, InexactAnswer answer) {
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
          .plane = {&RunDense<kNewtonBodies>, true},
          .space = {&RunDense<kNewtonBodies>, true}};
}

Method<double> InteriorPointRow() {
  return {
      .name = kInteriorPoint,
      .title = "an interior point method on Coulomb's law in the space of bodies, over factors J and M of A",
      .source = "solver/numeric/interior_point.h",
      .ends = "nothing; what is called solved has the residual that is asked for",
      .automatic = false,
      .plane = {&RunDense<kInteriorPoint>, true},
      .space = {&RunDense<kInteriorPoint>, true}};
}

}  // namespace stiction
