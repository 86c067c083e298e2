// SPDX-License-Identifier: Apache-2.0
// Forces of a problem of which all of A is a burden: over doubles, by its entries or in its factors.
//
// In factors the methods in the space of bodies (exact/bodies.h). Of entries in the plane proximal
// points (solver/numeric/proximal.h), in space sweeps, Newton's method and proximal steps
// (solver/numeric/coulomb.h); all by Coulomb's law. Errors are those of the returned doubles, evaluated over
// rationals on the problem itself; `solved` means that they are at most `residual`, by default 1e-8.

#pragma once

#include <string_view>
#include <vector>

#include "certify/exact/solve.h"

namespace stiction {

// Names of methods that do without all of A.
std::vector<std::string_view> MethodsOfEntries(const AnyProblem& problem);

// By one of these methods. Of the request, residual and limits are read.
InexactAnswer SolveEntries(const AnyProblem& problem, const Request& request);

}  // namespace stiction
