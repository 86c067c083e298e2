// SPDX-License-Identifier: Apache-2.0
// Lemke's method over rationals in space: the law on polygons, with every kind of contact.
//
// Bilateral and sliding contacts leave the problem first (solver/problem/reduction.h). What is returned is told
// in the terms of the whole problem, as complete driving tells it: the word names a cell that the solution lies
// in, and `pieces` counts pivots, the linear pieces of this path. Without sliding contacts, A symmetric
// positive semidefinite and b in range(A), it ends in `solved` (solver/lemke/lemke.h).

#pragma once

#include "certify/exact/polygons.h"

namespace stiction {

// Requires dimension 3 and a polygon per contact. Outcome: solved, ray, limit; singular where bilateral
// contacts cannot leave. With `trace`, every pivot is recorded.
OnPolygons RunLemkeInSpace(const ExactProblem& problem, RationalPolygons polygons, const Limits& limits,
                           Trace<Rational>* trace = nullptr);

}  // namespace stiction
