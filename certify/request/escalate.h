// SPDX-License-Identifier: Apache-2.0
// Escalation: what doubles leave undecided, over quad, within a counted budget and before slower methods.
//
//   space   fast without polygons; Newton's method over quad from where it ended; all methods over doubles
//   plane   all methods over doubles; proximal points where rows of bilateral contacts are singular; the fast
//           method over quad
//
// A step over quad costs about rows^3 / 3 operations, and kQuadOperations are spent at most. Where nothing
// solves, the forces of the smallest errors are told, undecided.

#ifndef STICTION_CERTIFY_REQUEST_ESCALATE_H_
#define STICTION_CERTIFY_REQUEST_ESCALATE_H_

#include "certify/exact/solve.h"

namespace stiction {

inline constexpr std::int64_t kQuadOperations = 40'000'000;

// The method `auto` over doubles. `suspected`: what doubles said, where quad answers.
Solution SolveEscalating(const ContactProblem<double>& problem, const Request& request);

}  // namespace stiction

#endif  // STICTION_CERTIFY_REQUEST_ESCALATE_H_
