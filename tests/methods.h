// SPDX-License-Identifier: Apache-2.0
// Methods over rationals, by their rows of the table.

#pragma once

#include "certify/exact/solve.h"

namespace stiction::testing {

inline ExactAnswer RunComplete(const ExactProblem& problem, const Limits& limits) {
  return Solve(problem, {.method = "complete", .limits = limits});
}
inline ExactAnswer RunLemke(const ExactProblem& problem, const Limits& limits) {
  return Solve(problem, {.method = "lemke", .limits = limits});
}

}  // namespace stiction::testing
