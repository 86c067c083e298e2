// SPDX-License-Identifier: Apache-2.0
// Solutions in space, exact: of the conditions (21), (22) of [Baraff94], or of Coulomb's law up to a bound.
//
// Both begin with an exact solution on friction polygons, of complete driving
// (solver/complete/complete.h) or of Lemke's method (lemke_space.h): the engine, which runs again on the
// polygons with more corners.
//
//   Baraff    Contacts in a corner, separating or sticking meet (21), (22) as they are. Of one on an edge,
//             where abs(fF) < mu fN, the edge is replaced by a point u of the circle near fF / abs(fF), and the
//             word with fF = mu fN u is solved as linear equations. If that breaks a condition, u becomes a
//             corner of the polygon, and the engine runs again.
//   Coulomb   The polygon's solution has -fF.aF >= c mu fN abs(aF), c the inner radius of the polygon. Newton's
//             method in doubles goes on from it (solver/numeric/coulomb.h); its word, with directions of slip
//             rounded to rational points of the circle, is solved as linear equations, and c measured. If that
//             fails, corners are added opposite to the accelerations, and the engine runs again.
//
// Whatever is returned as solved was verified by verify_solution.h.

#ifndef STICTION_CERTIFY_SPACE_H_
#define STICTION_CERTIFY_SPACE_H_

#include <optional>

#include "certify/polygons.h"

namespace stiction {

// Requires dimension 3. The trace is that of the last polygons.
SpaceSolution SolveInSpace(const ExactProblem& problem, const SpaceOptions& options,
                           Trace<Rational>* trace = nullptr);

// The largest bound c of FindCoulombViolation, rounded down: 1 - c to eight binary digits. Empty if f breaks a
// condition whatever c.
std::optional<Rational> CoulombBound(const ExactProblem& problem, const ExactVector& f);

// An upper bound of CoulombResidual (solver/problem/residual.h) of f with a = A f + b, evaluated over
// rationals, with square roots to 100 binary digits. Any kinds of contacts.
Rational CoulombResidualBound(const ExactProblem& problem, const ExactVector& f);

}  // namespace stiction

#endif  // STICTION_CERTIFY_SPACE_H_
