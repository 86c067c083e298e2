// SPDX-License-Identifier: Apache-2.0
// Methods over rationals, by their rows of the table.

#ifndef STICTION_TESTS_METHODS_H_
#define STICTION_TESTS_METHODS_H_

#include "certify/exact/solve.h"

namespace stiction::testing {

inline ExactAnswer RunComplete(const ExactProblem& problem, const Limits& limits) {
  return Solve(problem, {.method = "complete", .limits = limits});
}
inline ExactAnswer RunLemke(const ExactProblem& problem, const Limits& limits) {
  return Solve(problem, {.method = "lemke", .limits = limits});
}

}  // namespace stiction::testing

#endif  // STICTION_TESTS_METHODS_H_
