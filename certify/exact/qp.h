// SPDX-License-Identifier: Apache-2.0
// Method `qp`: frictionless contacts as a quadratic program, solved exactly.
//
//   minimize  f'Af / 2 + b'f   subject to  f >= 0
//
// With A symmetric and positive semidefinite the program is convex, and f is least exactly where a = A f + b >=
// 0, f >= 0, f_i a_i = 0: equation (4) of [Baraff94]. The program (5) of the paper, f'(A f + b) with A f + b >=
// 0 as well, has the same solutions; it has no feasible point where this one has no least value.
//
// Unbounded  a direction v >= 0 with A v = 0 and b'v < 0: outcome `ray`, and no solution exists, since v'(A f +
// b)
//            = v'b < 0 for every f.
// Exact      A and b are scaled to integers each, f back; CGAL's QP_solver (linear_system.h). Whatever it says
//            is checked against the problem before it is returned.

#pragma once

#include "certify/exact/properties.h"
#include "solver/problem/answer.h"

namespace stiction {

// solved, or ray: v. InputError: a contact that is not frictionless; A not symmetric, or not positive
// semidefinite.
Answer<Rational> SolveQp(const ExactProblem& problem);

// InputError that names the first contact that is not frictionless.
void RequireFrictionless(const ExactProblem& problem);

}  // namespace stiction
