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
#include <string_view>
#include <vector>

#include "certify/properties.h"
#include "solver/complete/complete.h"
#include "solver/problem/answer.h"

namespace stiction {

using RationalPolygons = std::vector<FrictionPolygon<Rational>>;

struct SpaceRun {
  CompleteVerdict verdict;
  ExactVector f, a;
  ExactVector ray;  // of a ray, otherwise empty
  CellWord word;
};

// Complete driving over rationals; with `trace`, every linear piece is recorded.
SpaceRun RunSpace(const ExactProblem& problem, const RationalPolygons& polygons, const Limits& limits,
                  Trace<Rational>* trace = nullptr);

enum class SpaceEngine { kComplete, kLemke };

struct SpaceOptions {
  FrictionLaw law = FrictionLaw::kBaraff;
  SpaceEngine engine = SpaceEngine::kComplete;
  int sides = 8;         // of every polygon at the start
  int refinements = 20;  // runs with more corners, at most
  Limits limits;
};

struct SpaceSolution {
  // solved; ray, limit and undecided as the engine ends; undecided if no refinement helped
  Outcome outcome = Outcome::kUndecided;
  std::string_view reason;
  ExactVector f, a;  // where solved
  ExactVector ray;
  CellWord word;       // of the last polygons
  Rational bound = 0;  // Coulomb: c of FindCoulombViolation
  int refinements = 0;
  CompleteStatistics statistics;  // of all runs
};

// Requires dimension 3. The trace is that of the last polygons.
SpaceSolution SolveInSpace(const ExactProblem& problem, const SpaceOptions& options,
                           Trace<Rational>* trace = nullptr);

// The largest bound c of FindCoulombViolation, rounded down: 1 - c to eight binary digits. Empty if f breaks a
// condition whatever c.
std::optional<Rational> CoulombBound(const ExactProblem& problem, const ExactVector& f);

// An upper bound of CoulombResidual (solver/problem/residual.h) of f with a = A f + b, evaluated over
// rationals, with square roots to 100 binary digits. Any kinds of contacts.
Rational CoulombResidualBound(const ExactProblem& problem, const ExactVector& f);

// What one contact does; a direction where it slips.
struct SpaceMode {
  Law law = Law::kNone;  // kHold, kBreak, kFree, kInside (sticks) or kCorner (slips, fF = mu fN direction)
  Planar<Rational> direction;
};

// f with the linear equations of the modes: aN = 0 where there is contact, aF = 0 where it sticks. Unknowns
// that these leave free take their values from `guess`. Empty if the equations contradict each other.
std::optional<ExactVector> SolveModes(const ExactProblem& problem, const std::vector<SpaceMode>& modes,
                                      const ExactVector& guess);

}  // namespace stiction

#endif  // STICTION_CERTIFY_SPACE_H_
