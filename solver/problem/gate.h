// SPDX-License-Identifier: Apache-2.0
// The gate: upper bounds of the errors of forces (errors.h), by which alone they are called a solution.
//
// Accelerations are computed anew in long double, where no product of two doubles leaves the range, and their
// rounding,
//
//   abs(error of a_i) <= (rows + 2) u (sum_j abs(A_ij f_j) + abs(b_i)),   u = 2^-64,
//
// counts as an error of theirs: where it exceeds the bound that is asked for, as beside forces that are huge,
// nothing is called solved. The units round by a few u, too, which kSlack is more than.

#ifndef STICTION_SOLVER_PROBLEM_GATE_H_
#define STICTION_SOLVER_PROBLEM_GATE_H_

#include <limits>

#include "solver/problem/answer.h"
#include "solver/problem/errors.h"

namespace stiction {

using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

// A f + b.
template <class Problem>
LongVector Recompute(const Problem& problem, const LongVector& f) {
  LongVector a = problem.b.template cast<long double>();
  ForEachEntry(problem.A, [&](int i, int j, const auto& x) {
    if (f[j] != 0) a[i] += static_cast<long double>(x) * f[j];
  });
  return a;
}

// The problem that is measured, of numbers wider than long double.
template <class Scalar>
ContactProblem<long double> InLongDouble(const ContactProblem<Scalar>& problem) {
  const auto convert = [](const Scalar& x) { return static_cast<long double>(x); };
  ContactProblem<long double> rounded;
  rounded.dimension = problem.dimension;
  for (const auto& contact : problem.contacts)
    rounded.contacts.push_back(
        {contact.kind, convert(contact.mu), {convert(contact.slip[0]), convert(contact.slip[1])}});
  rounded.A = problem.A.unaryExpr(convert);
  rounded.b = problem.b.unaryExpr(convert);
  return rounded;
}

// Problem: of float, double or long double, dense or sparse. Infinite if a number is not finite.
template <class Problem>
Errors<double> BoundErrors(const Problem& problem, FrictionLaw law, const LongVector& f) {
  constexpr double kSlack = 1 + 1e-12;
  Units<long double> units;
  const auto errors = MeasureErrors(problem, law, f, Recompute(problem, f), units,
                                    Units<long double>::Rounding(problem.rows()));
  const auto above = [](const long double& x) { return static_cast<double>(x) * kSlack; };
  return {above(errors.acceleration),  above(errors.force), above(errors.backward),
          above(errors.amplification), errors.contact,      errors.is_finite};
}

}  // namespace stiction

#endif  // STICTION_SOLVER_PROBLEM_GATE_H_
