// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "certify/exact/solve.h"
#include "certify/exact/verify_solution.h"
#include "solver/problem/check.h"

namespace stiction {

ExactAnswer SolveExactly(const ExactProblem& problem, const Request& request) {
  ExactAnswer answer = Solve(problem, request);
  if (!answer.Solved()) return answer;
  const auto violation = FindViolation(problem, answer.f, answer.law, answer.bound.value_or(1));
  STICTION_CHECK(!violation, fmt::format("{} calls solved what is not: {}", answer.method, *violation));
  return answer;
}

}  // namespace stiction
