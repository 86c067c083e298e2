// SPDX-License-Identifier: Apache-2.0
// Forces of a problem that is too large for a dense matrix: over doubles, A kept sparse.
//
// In the plane proximal points (solver/numeric/proximal.h), in space sweeps, Newton's method and proximal steps
// (solver/numeric/coulomb.h), both by Coulomb's law. Errors are those of the returned doubles, evaluated over
// rationals on the problem itself; `solved` means that they are at most `residual`, by default 1e-8.

#ifndef STICTION_CERTIFY_REQUEST_SOLVE_SPARSE_H_
#define STICTION_CERTIFY_REQUEST_SOLVE_SPARSE_H_

#include "certify/exact/solve.h"

namespace stiction {

struct SparseProblem;  // corpus/record/sparse_problem.h

// Of the options, residual and limits are read.
InexactAnswer SolveSparse(const SparseProblem& problem, const SolveOptions& options);

}  // namespace stiction

#endif  // STICTION_CERTIFY_REQUEST_SOLVE_SPARSE_H_
