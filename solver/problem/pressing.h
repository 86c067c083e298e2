// SPDX-License-Identifier: Apache-2.0
// How hard bodies press against each other beside what acts on them.

#ifndef STICTION_SOLVER_PROBLEM_PRESSING_H_
#define STICTION_SOLVER_PROBLEM_PRESSING_H_

#include <algorithm>
#include <cmath>
#include <limits>

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

// What accelerations miss of the law, beside the largest free one, of every row as if its A_ii were 1: a
// contact that sinks, or is pressed and parts; friction below its limit that slips, or at it drives. Forces
// that are rounding beside the largest count as none. 0 where b = 0. Shapes: f, a = A f + b rows x 1.
template <class Problem, class Vector>
double MissedShare(const Problem& problem, const Vector& f, const Vector& a) {
  const auto own = [&problem](int i) {
    const double A_ii = std::abs(static_cast<double>(problem.A.coeff(i, i)));
    return A_ii > 0 ? std::sqrt(A_ii) : 1;
  };
  double forces = 0, free = 0, missed = 0;
  for (int i = 0; i < f.size(); ++i) {
    forces = std::max(forces, std::abs(static_cast<double>(f[i])) * own(i));
    free = std::max(free, std::abs(static_cast<double>(problem.b[i])) / own(i));
  }
  int row = 0;
  for (const auto& contact : problem.contacts) {
    const int count = RowsOf(contact, problem.dimension);
    const auto in_own = [&](int i) { return static_cast<double>(a[i]) / own(i); };
    const double fN = static_cast<double>(f[row]), unit = std::numeric_limits<double>::epsilon();
    const bool presses = contact.kind == ContactKind::kBilateral || fN * own(row) > 4 * unit * forces;
    missed = std::max(missed, presses ? std::abs(in_own(row)) : -in_own(row));
    double force = 0, power = 0, slip = 0;
    for (int k = row + 1; k < row + count; ++k) {
      force = std::hypot(force, static_cast<double>(f[k]));
      power += static_cast<double>(f[k]) * in_own(k);
      slip = std::hypot(slip, in_own(k));
    }
    if (presses && contact.kind == ContactKind::kStatic && contact.mu > 0) {
      const bool at_limit = force > 0 && force >= (1 - 1e-6) * static_cast<double>(contact.mu) * fN;
      missed = std::max(missed, at_limit ? power / force : slip);
    }
    row += count;
  }
  return free > 0 ? missed / free : 0;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_PROBLEM_PRESSING_H_
