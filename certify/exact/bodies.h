// SPDX-License-Identifier: Apache-2.0
// Methods in the space of bodies, for problems in factors and for dense ones:
//
//   newton-bodies   proximal points by Newton's method (solver/numeric/body_newton.h)
//   interior-point  an interior point method, and from where it ends the other
//   (solver/numeric/interior_point.h)
//
//   in factors   A and b are not formed. Errors are those of the returned doubles, evaluated over rationals on
//                the factors themselves.
//   dense        A = L D L' over doubles, with pivots along the diagonal: J = L, M = inv(D), w = 0, c = b, as
//                far as D > 0. For symmetric, positive semidefinite A; the gate is that of A itself.
//
// By Coulomb's law, for contacts of all kinds.

#pragma once

#include "certify/exact/solve.h"
#include "corpus/record/factors.h"

namespace stiction {

inline constexpr std::string_view kNewtonBodies = "newton-bodies", kInteriorPoint = "interior-point";

// Whether a method is one of the two.
inline bool IsOfBodies(std::string_view method) { return method == kNewtonBodies || method == kInteriorPoint; }

// Of the request, method (newton-bodies unless interior-point), residual and limits.stop are read. The best
// forces that were found, with their errors, however it ends; none if they are not finite.
InexactAnswer SolveByBodies(const ExactFactors& problem, const Request& request);
// Any forces over doubles, with accelerations and errors; a solution as far as the residual of the request
// goes.
InexactAnswer Judged(const ExactFactors& problem, const Request& request, InexactAnswer answer);

// The modes near the forces of the interior point method, unless newton-bodies is asked for, solved exactly: on
// equations as many as the bodies' velocities at most, by p-adic lifting (linear_equations.h). solved, or
// undecided; in space with `bound`, if any forces were found.
ExactAnswer SolveByBodiesExactly(const ExactFactors& problem, const Request& request);

// The rows of the table, for dense problems.
Method<double> NewtonBodiesRow();
Method<double> InteriorPointRow();

// Errors of f by Coulomb's law, and an answer that calls itself solved and misses the bound is undecided.
// Problem: of any form, over rationals; a = A f + b.
template <class Problem>
void JudgeExactly(const Problem& problem, const ExactProblem::Vector& f, const ExactProblem::Vector& a,
                  double bound, InexactAnswer& answer) {
  answer.errors = Converted<double>(MeasureErrors(problem, FrictionLaw::kCoulomb, f, a, bound), &ToDouble);
  if (!answer.Solved() || answer.residual() <= bound) return;
  answer.outcome = Outcome::kUndecided;
  answer.reason = "the errors, evaluated over rationals, are larger than called solved";
}

}  // namespace stiction
