// SPDX-License-Identifier: Apache-2.0
// Nonlinear block Gauss-Seidel (NSGS; Jean and Moreau, cited from memory), as most engines have it.
//
// Every contact in turn takes the force that solves its own law while the others keep theirs (one_contact.h),
// from f = 0, until the errors are at most `residual`. It stays undecided when nothing moves, or after
// limits.pivots sweeps: how many it needs grows with the condition number of A, and with friction it may go
// round in circles.
//
// Frictionless and static contacts, in the plane and in space: a planar contact is one in space that nothing
// drives along its second tangent. Shapes  f, a: rows x 1; f in N, a in m/s^2. Floating-point scalars. Cost
// O(rows^2) a sweep.

#pragma once

#include "solver/numeric/one_contact.h"
#include "solver/problem/answer.h"
#include "solver/problem/errors.h"

namespace stiction {

// One sweep: f changes, and a = A f + b with it. Whether more than rounding moved.
template <class Scalar>
bool SweepOnce(const ContactProblem<Scalar>& problem, Answer<Scalar>& answer) {
  auto &f = answer.f, &a = answer.a;
  bool moved = false;
  int row = 0;
  for (const Contact<Scalar>& contact : problem.contacts) {
    const int size = contact.HasFrictionRows() ? problem.dimension : 1;
    Eigen::Matrix<Scalar, 3, 3> W = Eigen::Matrix<Scalar, 3, 3>::Identity() * problem.A(row, row);
    Eigen::Matrix<Scalar, 3, 1> q = Eigen::Matrix<Scalar, 3, 1>::Zero();
    W.topLeftCorner(size, size) = problem.A.block(row, row, size, size);
    q.head(size) = a.segment(row, size) - W.topLeftCorner(size, size) * f.segment(row, size);
    if (W(0, 0) > 0) {
      const auto to = SolveOneContact<Scalar>(W, q, contact.mu);
      for (int k = 0; k < size; ++k) {
        const Scalar change = to[k] - f[row + k];
        if (change == 0) continue;
        moved = moved || Abs(change) > 4 * std::numeric_limits<Scalar>::epsilon() * Abs(to[k]);
        f[row + k] = to[k];
        a += change * problem.A.col(row + k);
      }
    }
    row += size;
  }
  return moved;
}

template <class Scalar>
Answer<Scalar> RunGaussSeidel(const ContactProblem<Scalar>& problem, const Request& request) {
  Answer<Scalar> answer;
  answer.law = FrictionLaw::kCoulomb;
  answer.f = ContactProblem<Scalar>::Vector::Zero(problem.rows());
  answer.a = problem.b;
  std::int64_t& sweeps = answer.counters.Tell(Counter::kSweeps);
  const Scalar enough(ResidualOf<Scalar>(request));
  for (bool moves = true;; ++sweeps) {
    if (MeasureErrors(problem, answer.law, answer.f, answer.a).Largest() <= enough) {
      answer.outcome = Outcome::kSolved;
      return answer;
    }
    if (!moves) answer.reason = "sweeps move nothing";
    if (sweeps == request.limits.pivots) answer.reason = "too many sweeps";
    if (request.limits.Stopped()) answer.reason = kStopped;
    if (!answer.reason.empty()) return answer;
    moves = SweepOnce(problem, answer);
  }
}

}  // namespace stiction
