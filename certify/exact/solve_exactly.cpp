// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "certify/exact/solve.h"
#include "certify/exact/verify_solution.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

// The first condition that an answer breaks which calls itself solved.
std::optional<std::string> ViolationOf(const ExactProblem& problem, const Answer<Rational>& answer) {
  if (problem.dimension == 2) return FindViolation(problem, answer.f);
  if (answer.law == FrictionLaw::kBaraff) return FindWeakViolation(problem, answer.f);
  return FindCoulombViolation(problem, answer.f, *answer.bound);
}

}  // namespace

ExactAnswer SolveExactly(const ExactProblem& problem, const Request& request) {
  ExactAnswer answer = Solve(problem, request);
  if (!answer.Solved()) return answer;
  const auto violation = ViolationOf(problem, answer);
  STICTION_CHECK(!violation, fmt::format("{} calls solved what is not: {}", answer.method, *violation));
  return answer;
}

}  // namespace stiction
