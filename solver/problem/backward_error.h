// SPDX-License-Identifier: Apache-2.0
// Backward error: how far the nearest problem is that forces solve exactly.
//
// The forces stay; A, b and mu move. By the theorem of Oettli and Prager the least eps such that accelerations
// a + d are those of a problem with abs(A' - A) <= eps abs(A), abs(b' - b) <= eps abs(b), entry by entry, is
//
//   eps = max_i abs(d_i) / (abs(A) abs(f) + abs(b))_i,
//
// and each contact asks for the least d that makes its law hold: aN = 0 where it presses, aN >= 0 where it does
// not, and for friction, whichever is less, aF = 0, or abs(fF) / fN in the place of mu where aF opposes fF. A'
// is not symmetric as a rule. The same d is a change of b alone, with A' = A: of_b. Accelerations are computed
// in long double, and their rounding added (gate.h): upper bounds.
//
// W. Oettli and W. Prager, Numerische Mathematik 6, 1964. Shapes: f rows x 1, N. Static and frictionless
// contacts of the plane; bilateral rows ask for a = 0.

#ifndef STICTION_SOLVER_PROBLEM_BACKWARD_ERROR_H_
#define STICTION_SOLVER_PROBLEM_BACKWARD_ERROR_H_

#include <algorithm>
#include <cmath>
#include <optional>

#include "solver/problem/gate.h"

namespace stiction {

struct BackwardError {
  double of_data = 0;  // eps, where A and b move
  double of_b = 0;     // where b moves alone, relative to max abs(b)
  double of_mu = 0;    // largest relative change of a coefficient of friction
};

// Empty where no change of these numbers helps: a force pulls, friction stands without a normal force, or a
// number is not finite.
template <class Scalar>
std::optional<BackwardError> FindBackwardError(const ContactProblem<Scalar>& problem, const LongVector& f) {
  if (problem.dimension != 2 || f.size() != problem.rows() || !f.allFinite()) return std::nullopt;
  const CheckedAccelerations checked = Recompute(problem, f);
  if (!checked.a.allFinite()) return std::nullopt;
  const auto size = [&](int row) {  // (abs(A) abs(f) + abs(b))_row
    LongDouble sum = Abs(static_cast<LongDouble>(problem.b[row]));
    for (int j = 0; j < problem.rows(); ++j) sum += Abs(static_cast<LongDouble>(problem.A(row, j)) * f[j]);
    return sum;
  };
  LongDouble max_b = 0;
  for (int i = 0; i < problem.rows(); ++i) max_b = std::max(max_b, Abs(static_cast<LongDouble>(problem.b[i])));
  // What it costs to move an acceleration so far, its rounding included.
  const auto cost = [&](int row, LongDouble distance) {
    const LongDouble of = size(row);
    return of > 0 ? (distance + checked.error) / of : distance;
  };
  const LongDouble kRounding = 4 * std::numeric_limits<LongDouble>::epsilon();  // of mu fN
  BackwardError error;
  const auto include = [](double& most, LongDouble x) { most = std::max(most, static_cast<double>(x)); };
  const auto move = [&](int row, LongDouble distance) {
    include(error.of_data, cost(row, distance));
    if (max_b > 0) include(error.of_b, (distance + checked.error) / max_b);
  };
  int row = 0;
  for (const auto& contact : problem.contacts) {
    const bool bilateral = contact.kind == ContactKind::kBilateral, presses = f[row] > 0;
    if (contact.kind == ContactKind::kSliding || (!bilateral && f[row] < 0)) return std::nullopt;
    const LongDouble aN = checked.a[row];
    move(row, bilateral || presses ? Abs(aN) : std::max(-aN, LongDouble(0)));
    if (!contact.HasFrictionRows()) {
      ++row;
      continue;
    }
    const LongDouble fF = f[row + 1], aF = checked.a[row + 1], bound = contact.mu * f[row];
    if (fF != 0 && !(bound > 0)) return std::nullopt;
    if (presses) {
      const LongDouble at_rest = cost(row + 1, Abs(aF));
      const LongDouble change = bound > 0 ? Abs(Abs(fF) - bound) / bound + kRounding : LongDouble(0);
      const bool within = Abs(fF) < bound * (1 - kRounding) || bound == 0;
      const bool opposes = fF == 0 || (aF * fF < 0 && Abs(aF) > checked.error);
      if (!within) include(error.of_mu, change);
      if (within && opposes && change < at_rest) {
        include(error.of_mu, change);  // it slides at the limit of a mu nearby
      } else if (within || !opposes) {
        move(row + 1, Abs(aF));
      }
    }
    row += 2;
  }
  return error;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_PROBLEM_BACKWARD_ERROR_H_
