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
// Where b is not in range(A) both engines may end in a ray although there is a solution; then SolveNearFast may
// find it. A solution of Coulomb's law up to a bound whose contacts slip with abs(fF) = mu fN is one of (21),
// (22), too.
//
// Whatever is returned as solved was verified by verify_solution.h.

#pragma once

#include "certify/exact/polygons.h"

namespace stiction {

// The cosine from which on an angle is at most that up to which forces are called solved.
const Rational& EnoughBound();
// Forces whose friction is further from the slip than a solution's may be are no solution: they are told, with
// their bound.
void CallBounded(Answer<Rational>& answer);

// Requires dimension 3. The path is that of the last polygons.
Answer<Rational> SolveInSpace(const ExactProblem& problem, const Request& request,
                              SpaceEngine engine = SpaceEngine::kComplete);

// The modes of the point in which the fast method ends over doubles (solver/numeric/fast.h), solved exactly:
// whether or not b is in range(A). undecided where they are no solution, or doubles do not hold the problem.
Answer<Rational> SolveNearFast(const ExactProblem& problem, const Request& request);

// The modes near forces over doubles, f rows x 1, solved exactly; undecided where they are no solution.
Answer<Rational> SolveNear(const ExactProblem& problem, const Request& request, const Eigen::VectorXd& f);

}  // namespace stiction
