// SPDX-License-Identifier: Apache-2.0
// The paper's assumptions on problems too large for exact elimination: bounds from doubles that hold all the
// same.
//
//   semidefinite   x'Ax >= least x'x for all x      a Cholesky factorization that ran to its end,
//                                                   and a bound for its rounding
//                  x'Ax = value < 0 for this x      value over rationals
//   range          abs(A x - b) <= distance abs(b)  the residual of an x, over rationals
//
// What doubles propose is checked exactly, or comes with a bound for all rounding. `least`: for the symmetric
// part S of A in doubles and a shift s, let Cholesky's method factor S + s I. Then S + s I + E = R'R with
// abs(E) <= g abs(R')abs(R), g = k u / (1 - k u), k - 1 the largest number of terms of an entry of R'R, u =
// 2^-53 (N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2002, theorem 10.3, number to be
// checked). The spectral norm of E is at most g / (1 - g) trace(S + s I). Rounding A to doubles and adding s
// change eigenvalues by less than u (largest row sum + largest diagonal entry). So for A itself least = -s
// minus all that, taken twice for the rounding of these few sums. Cost: that of sparse Cholesky factorizations,
// and of sparse products of rationals.

#pragma once

#include <optional>

#include "certify/exact/properties.h"
#include "corpus/exact_problem.h"

namespace stiction {

struct CurvatureBounds {
  double scale = 0;                  // largest A_ii
  std::optional<double> least;       // x'Ax >= least x'x for all x; >= 0: A is positive semidefinite
  std::optional<Obstacle> negative;  // x'Ax < 0
  double most = 0;                   // x'Ax / x'x of `negative`, rounded: what there is to see of it
};
CurvatureBounds BoundCurvature(const AnyProblem& problem);

struct RangeDistance {
  ExactVector x;
  double distance = 0;  // abs(A x - b) / abs(b), rounded up by a bit; an upper bound of the distance of b
  // The same of another x, for which eigenvalues of A below about 1e-9 of the largest row sum were left out:
  // how far b is from the range if those are zeros that rounding has changed. A finding, no bound.
  double rough = 0;
};
RangeDistance BoundRangeDistance(const AnyProblem& problem);

// Whether A is regular modulo a prime: then it is regular, and every b is in its range. False says nothing.
bool IsRegularModuloPrime(const AnyProblem& problem);

}  // namespace stiction
