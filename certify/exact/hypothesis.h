// SPDX-License-Identifier: Apache-2.0
// (H): b'v >= 0 for all v in K with A v = 0. It is what existence needs of b where A is positive semidefinite.
//
// K is the product of the friction cones of the contacts, K* its dual cone:
//
//   contact        v in K                    g in K*
//   bilateral      vN any                    gN = 0
//   frictionless   vN >= 0                   gN >= 0
//   static         abs(vF) <= mu vN          gN >= mu abs(gF)        (vN, gN >= 0)
//
// (H) holds if b = A'y + g for a y and a g in K*: then b'v = y'Av + g'v >= 0. In the plane, where K is
// polyhedral, only if, too. For a symmetric A, b in range(A) is the case g = 0. Sliding contacts have no such
// cone: problems that have them are refused.

#pragma once

#include <optional>
#include <string>
#include <variant>

#include "certify/exact/properties.h"

namespace stiction {

// The first condition that a vector breaks, with its numbers; empty if it is in the cone.
// Requires: no sliding contact.
std::optional<std::string> FindConeViolation(const ExactProblem& problem, const ExactVector& v);      // K
std::optional<std::string> FindDualConeViolation(const ExactProblem& problem, const ExactVector& g);  // K*

// b - A'y.
ExactVector DualRest(const ExactProblem& problem, const ExactVector& y);

bool HasSlidingContact(const ExactProblem& problem);

// y with b - A'y in K*, or v in K with A v = 0 and b'v < 0: by exact linear programs, verified here. In space K
// and K* are cones on polygons within (cones.h), whose corners are added where the answers of the programs
// point; then it may be neither: where (H) hangs on a point of the circle that is not rational, or all that is
// found is at the edge of K. Requires a problem without sliding contacts (otherwise InputError).
std::variant<std::monostate, ExactVector, Obstacle> DecideHypothesis(const ExactProblem& problem);

}  // namespace stiction
