// SPDX-License-Identifier: Apache-2.0
// Solutions in space on friction polygons, exact: runs of complete driving and of Lemke's method, again on
// polygons with more corners, toward a law of the circle. space.h has the laws; here is (21), (22).

#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "certify/exact/properties.h"
#include "solver/complete/complete.h"
#include "solver/problem/answer.h"
#include "solver/solve.h"

namespace stiction {

using RationalPolygons = std::vector<FrictionPolygon<Rational>>;

// A run on polygons, and how they go on from it.
struct OnPolygons {
  Answer<Rational> answer;
  CellWord word;
  RationalPolygons polygons;
  int refinements = 0;  // before this run
};

// Complete driving; with `trace` over rationals, every linear piece recorded. Otherwise over balls where these
// tell every sign: the same word, forces and counters.
OnPolygons RunSpace(const ExactProblem& problem, RationalPolygons polygons, const Limits& limits,
                    Trace<Rational>* trace = nullptr);

enum class SpaceEngine { kComplete, kLemke };
inline constexpr int kMostRefinements = 20;  // runs with more corners, at most

// One step from a solution on polygons toward the law: whether it is the last. Otherwise the polygons have more
// corners after it. What the law accepts stands in the answer.
using Toward = std::function<bool(OnPolygons& run, Answer<Rational>& answer)>;

// Requires dimension 3. solved; ray, limit and undecided as the engine ends; undecided if no refinement helped.
// Word and trace are those of the last polygons, counters of all runs.
Answer<Rational> SolveOnPolygons(const ExactProblem& problem, const Request& request, SpaceEngine engine,
                                 const Toward& toward);

// Toward (21), (22), whatever request.law.
Answer<Rational> SolveWeakly(const ExactProblem& problem, const Request& request, SpaceEngine engine);

// f solves the problem.
void Accept(const ExactProblem& problem, const ExactVector& f, Answer<Rational>& answer);

// What one contact does; a direction where it slips.
struct SpaceMode {
  Law law = Law::kNone;  // kHold, kBreak, kFree, kInside (sticks) or kCorner (slips, fF = mu fN direction)
  Planar<Rational> direction;
};

// f with the linear equations of the modes: aN = 0 where there is contact, aF = 0 where it sticks. Unknowns
// that these leave free take their values from `guess`. Empty if the equations contradict each other.
std::optional<ExactVector> SolveModes(const ExactProblem& problem, const std::vector<SpaceMode>& modes,
                                      const ExactVector& guess);

// A point of the circle near x / abs(x), from the tangent of half its angle with `bits` binary places.
Planar<Rational> NearDirection(const Planar<Rational>& x, int bits);

// The friction, or its acceleration, of the contact whose normal is in that row.
inline Planar<Rational> TangentialOf(const ExactVector& values, int row) {
  return {values[row + 1], values[row + 2]};
}

}  // namespace stiction
