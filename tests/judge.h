// SPDX-License-Identifier: Apache-2.0
// A judge of solutions: forces that are called a solution are held against rationals, without a root and
// without a tolerance but the one that was promised.

#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "certify/exact/neighbour.h"
#include "certify/exact/solve.h"
#include "certify/exact/space.h"
#include "certify/exact/verify_solution.h"
#include "corpus/rounded.h"

namespace stiction::testing {

// What the arithmetic made of the problem.
inline ExactProblem AsRun(const ExactProblem& problem, Arithmetic arithmetic) {
  if (arithmetic == Arithmetic::kExact) return problem;
  if (arithmetic == Arithmetic::kFloat) return Unrounded(Rounded<float>(problem));
  return Unrounded(Rounded<double>(problem));
}

// What is wrong with an exact answer that is called solved; empty if nothing is.
inline std::string FaultOf(const ExactProblem& problem, const ExactAnswer& answer) {
  if (answer.f.size() != problem.rows()) return "solved without forces";
  if (answer.a != Accelerations(problem, answer.f)) return "accelerations of other forces";
  const auto violation = FindViolation(problem, answer.f, answer.law, answer.bound.value_or(1));
  return violation ? "called solved: " + *violation : "";
}

inline std::string FaultOf(const ExactProblem& problem, const InexactAnswer& answer, const Gate& gate) {
  if (answer.f.size() != problem.rows()) return "solved without forces";
  if (!answer.f.allFinite()) return "forces that are not finite";
  const ExactVector f = answer.f.unaryExpr([](double x) { return Rational(x); });
  const double slack = 1 + 1e-9;  // roots round
  const auto fault = FindMiss(problem, f, answer.law, Gate{gate.eps * slack, gate.tau * slack});
  return fault ? "called solved: " + *fault : "";
}

// What is wrong with a solution of the problem that calls itself solved; empty if nothing is, or if it does
// not.
inline std::string FaultOf(const ExactProblem& problem, const Request& request, const Solution& solution) {
  if (solution.outcome() != Outcome::kSolved) return "";
  const auto* exact = std::get_if<ExactAnswer>(&solution.answer);
  const bool filtered = request.arithmetic == Arithmetic::kFiltered;  // to the end, or with rounded forces
  const ExactProblem ran = filtered && exact ? problem : AsRun(problem, request.arithmetic);
  if (exact) return FaultOf(ran, *exact);
  const double residual = request.residual;
  const Gate gate =
      request.arithmetic == Arithmetic::kFloat ? GateOf<float>(residual) : GateOf<double>(residual);
  return FaultOf(ran, std::get<InexactAnswer>(solution.answer), gate);
}

}  // namespace stiction::testing
