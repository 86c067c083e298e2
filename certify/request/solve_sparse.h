// SPDX-License-Identifier: Apache-2.0
// Forces of a problem that is too large for a dense matrix: over doubles, A kept sparse or in its factors.
//
// In factors Newton's method in the space of bodies (exact/newton_bodies.h). Of entries, and where that solves
// nothing, in the plane proximal points (solver/numeric/proximal.h), in space sweeps, Newton's method and
// proximal steps (solver/numeric/coulomb.h); all by Coulomb's law. Errors are those of the returned doubles,
// evaluated over rationals on the problem itself; `solved` means that they are at most `residual`, by default
// 1e-8. The answer with the least errors is returned, however it ends.

#ifndef STICTION_CERTIFY_REQUEST_SOLVE_SPARSE_H_
#define STICTION_CERTIFY_REQUEST_SOLVE_SPARSE_H_

#include <string_view>
#include <vector>

#include "certify/exact/solve.h"

namespace stiction {

struct SparseProblem;  // corpus/record/sparse_problem.h

// Names of methods that take the problem, those that `auto` tries first in front.
std::vector<std::string_view> SparseMethods(const SparseProblem& problem);

// By one of these methods, or `auto`. Of the request, residual and limits are read.
InexactAnswer SolveSparse(const SparseProblem& problem, const Request& request,
                          std::string_view method = kAutomatic);

}  // namespace stiction

#endif  // STICTION_CERTIFY_REQUEST_SOLVE_SPARSE_H_
