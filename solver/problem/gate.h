// SPDX-License-Identifier: Apache-2.0
// The gate: an upper bound of the relative residual of forces, by which alone they are called a solution.
//
// Accelerations are computed anew in long double, where no product of two doubles leaves the range. Their
// rounding is bounded entry by entry,
//
//   abs(error of a_i) <= (rows + 2) u (sum_j abs(A_ij f_j) + abs(b_i)),   u = 2^-64,
//
// and added to the residual (residual.h, weak_residual.h) times its slope: the residuals move by at most r = 1
// / max A_ii times the change of a; in space, where a normal's shift has mu abs(aF) in it, by at most 3 (1 +
// mu) r times the largest change of an entry. N. J. Higham, Accuracy and Stability of Numerical Algorithms,
// 2002, section 3.1. The measures themselves round by a few u of the largest force, which is nothing beside it;
// but Coulomb's residual in space is relative to b, beside which forces may be huge, and there 64 u of all that
// takes part, abs(f) + r (1 + mu) abs(a), is added.

#ifndef STICTION_SOLVER_PROBLEM_GATE_H_
#define STICTION_SOLVER_PROBLEM_GATE_H_

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/problem/answer.h"
#include "solver/problem/long_double.h"
#include "solver/problem/residual.h"
#include "solver/problem/weak_residual.h"

namespace stiction {

using LongVector = Eigen::Matrix<LongDouble, Eigen::Dynamic, 1>;

template <class Scalar>
LongDouble MostFriction(const ContactProblem<Scalar>& problem) {
  LongDouble most = 0;
  if (problem.dimension == 2) return most;
  for (const auto& contact : problem.contacts) most = std::max<LongDouble>(most, contact.mu);
  return most;
}

// Accelerations, and the largest bound of their errors.
struct CheckedAccelerations {
  LongVector a;
  LongDouble error = 0;
};

template <class Scalar>
CheckedAccelerations Recompute(const ContactProblem<Scalar>& problem, const LongVector& f) {
  const int rows = problem.rows();
  const LongDouble unit = (rows + 2) * std::numeric_limits<LongDouble>::epsilon() / 2;
  CheckedAccelerations checked{LongVector(rows), 0};
  for (int i = 0; i < rows; ++i) {
    LongDouble sum = problem.b[i], size = Abs(sum);
    for (int j = 0; j < rows; ++j) {
      const LongDouble product = static_cast<LongDouble>(problem.A(i, j)) * f[j];
      sum += product;
      size += Abs(product);
    }
    checked.a[i] = sum;
    checked.error = std::max(checked.error, unit * size);
  }
  return checked;
}

// The problem that is measured, of numbers wider than long double.
template <class Scalar>
ContactProblem<LongDouble> InLongDouble(const ContactProblem<Scalar>& problem) {
  const auto convert = [](const Scalar& x) { return static_cast<LongDouble>(x); };
  ContactProblem<LongDouble> rounded;
  rounded.dimension = problem.dimension;
  for (const auto& contact : problem.contacts)
    rounded.contacts.push_back(
        {contact.kind, convert(contact.mu), {convert(contact.slip[0]), convert(contact.slip[1])}});
  rounded.A = problem.A.unaryExpr(convert);
  rounded.b = problem.b.unaryExpr(convert);
  return rounded;
}

// Relative as residual.h and weak_residual.h say for the law; infinite if a number is not finite.
template <class Scalar>
LongDouble ResidualBound(const ContactProblem<Scalar>& problem, FrictionLaw law, const LongVector& f) {
  const CheckedAccelerations checked = Recompute(problem, f);
  const bool round = problem.dimension == 3 && law == FrictionLaw::kCoulomb;
  Residual<LongDouble> residual = problem.dimension == 2 ? MeasureResidual(problem, f, checked.a)
                                  : round                ? MeasureCoulomb(problem, f, checked.a)
                                                         : MeasureWeak(problem, f, checked.a);
  if (!residual.is_finite) return std::numeric_limits<LongDouble>::infinity();
  const LongDouble slope = residual.r * (1 + MostFriction(problem));
  residual.worst += 3 * slope * checked.error;
  if (round && problem.rows() > 0) {
    const LongDouble parts = residual.scale + slope * checked.a.cwiseAbs().maxCoeff();
    residual.worst += 32 * std::numeric_limits<LongDouble>::epsilon() * parts;
  }
  return round ? residual.RelativeToB() : residual.Relative();
}

}  // namespace stiction

#endif  // STICTION_SOLVER_PROBLEM_GATE_H_
