// SPDX-License-Identifier: Apache-2.0
// The family on which the published algorithm takes 2^n - 1 pivots for n contacts without friction.
//
//   A = L' L, L lower triangular, 1 on the diagonal and 2 below:  A_ii = 1 + 4 (n - i), A_ij = 2 + 4 (n -
//   max(i, j)) b_i = 8^(i-n-1) - 1,  i = 1..n
//
// A is the matrix of Fathi (Mathematical Programming 17, 1979; cited from memory) in reverse order, positive
// definite. The count is proved in solver/published/readings.md, part 10.

#pragma once

#include "corpus/exact_problem.h"

namespace stiction {

// Member n = `contacts` >= 0. `scaled`: D A D and D b, D_ii = 4^(n-i), which is the same problem with the
// forces of contact i in units of 4^(n-i): the contact with the largest violation is then the first violated
// one.
ExactProblem ExponentialFamily(int contacts, bool scaled = false);

}  // namespace stiction
