// SPDX-License-Identifier: Apache-2.0
// Existence: a solution with its certificate, a proof that there is none, or neither.
//
// The cheapest method first: complete driving, which ends in a solution whenever A is symmetric positive
// semidefinite and b in range(A) (solver/complete/complete_driving.md), by certified signs where they suffice
// (filtered.h: the end is solved for and verified over rationals, not the way), with many rows the cells in
// which a run over doubles ends, solved likewise; then Lemke's method, whose path is another; both after
// bilateral constraints and sliding contacts have left the problem (solver/problem/reduction.h); then all
// contact modes, which decide every planar problem that is small enough. In space complete driving and Lemke's
// method on polygons and the point of the fast method (space.h), which find solutions of Coulomb's law up to a
// bound, or of (21), (22); then words of touching and separated contacts, which may refute both laws
// (no_solution.cpp).

#pragma once

#include "certify/claims/claim_answer.h"
#include "certify/exact/enumerate.h"

namespace stiction {

// Any valid problem. Of the request limits are read, and the law, which is that of static contacts in space.
//
// The certificate is `solution-exists`, of Coulomb's law in space `coulomb-solution`, or `no-solution`; null if
// undecided, with how each method ended that was tried for a reason.
ClaimAnswer DecideExistence(const ExactProblem& problem, const Request& request,
                            const EnumerationWatch& watch = {});

// The claim `no-solution`: Farkas vectors (farkas.h) that refute every contact mode. Independent of the linear
// programs: it needs products and signs only.
//
// The certificate. Requires: enumeration.ProvesNoSolution(), of this problem; otherwise InternalError.
SharedJson NoSolutionCertificate(const ExactProblem& problem, const Enumeration& enumeration);
// A WitnessCheck (witness.h). Facts: words, prefixes.
Json CheckNoSolution(const ExactProblem& problem, const Json& witness);

}  // namespace stiction
