// SPDX-License-Identifier: Apache-2.0
// Linear equations over rationals.

#ifndef STICTION_CERTIFY_EXACT_LINEAR_EQUATIONS_H_
#define STICTION_CERTIFY_EXACT_LINEAR_EQUATIONS_H_

#include <optional>

#include "certify/exact/properties.h"

namespace stiction {

// x with M x = right; unknowns that the equations leave free (columns without a pivot) are as in `guess`. Empty
// if the equations contradict each other. M: square, right and guess: as many.
std::optional<ExactVector> SolveEquations(const ExactMatrix& M, const ExactVector& right,
                                          const ExactVector& guess);

}  // namespace stiction

#endif  // STICTION_CERTIFY_EXACT_LINEAR_EQUATIONS_H_
