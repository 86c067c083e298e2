// SPDX-License-Identifier: Apache-2.0
// How far A is from symmetric, and A made symmetric.

#pragma once

#include "corpus/exact_problem.h"
#include "corpus/record/problem_file.h"

namespace stiction {

// The largest abs(A_ij - A_ji), i < j, and where it is first found; zero at (0, 0) if A is symmetric.
struct Asymmetry {
  Rational difference = 0;
  int i = 0, j = 0;
};
Asymmetry LargestAsymmetry(const AnyProblem& problem);

// With (A + A')/2 in place of A, exactly; the problem itself where A is symmetric, as that of factors is.
AnyProblem Symmetrized(const AnyProblem& problem);
// The same of a file, whose `origin` says what the largest difference was.
void Symmetrize(ProblemFile& file);

}  // namespace stiction
