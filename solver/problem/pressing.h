// SPDX-License-Identifier: Apache-2.0
// How hard bodies press against each other beside what acts on them.

#ifndef STICTION_SOLVER_PROBLEM_PRESSING_H_
#define STICTION_SOLVER_PROBLEM_PRESSING_H_

#include <algorithm>
#include <cmath>

#include "solver/problem/problem.h"

namespace stiction {

// The ratio of the largest force to the largest free acceleration, of every row as if its A_ii were 1; 0 where
// b = 0. Where there is no solution, forces that grow without end nearly are one: only the ratio tells. Shapes:
// f rows x 1.
template <class Problem, class Vector>
double Pressing(const Problem& problem, const Vector& f) {
  double forces = 0, free = 0;
  for (int i = 0; i < f.size(); ++i) {
    const double own = std::sqrt(std::abs(static_cast<double>(problem.A.coeff(i, i))));
    forces = std::max(forces, std::abs(static_cast<double>(f[i])) * own);
    if (own > 0) free = std::max(free, std::abs(static_cast<double>(problem.b[i])) / own);
  }
  return free > 0 ? forces / free : 0;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_PROBLEM_PRESSING_H_
