// SPDX-License-Identifier: Apache-2.0
// Rest: forces under which contacts keep still, where other forces that solve the problem accelerate them.
//
// Accelerations need not be unique with friction. Forces with
//
//   f in K,  A f + b = 0
//
// (K: cones.h) meet Coulomb's law exactly, whatever the dimension: aN = aF = 0. There are none if and only if,
// in space but for the edge of a cone,
//
//   A'y in K*,  y'b > 0        for some y: then 0 <= (A'y)'f = -y'b < 0 (Farkas)
//
// They are sought for every group of contacts that A couples by itself: doubles propose them, or a proof that
// there are none, which exact numbers then decide; where they do not, exact linear programs do, in space over
// polygons within K, whose corners are added where the programs say; there none may be found though there are
// some. A group with a sliding contact is left.

#pragma once

#include <optional>
#include <vector>

#include "certify/exact/properties.h"

namespace stiction {

// One of both, or neither where that stays open.
struct Rest {
  std::optional<ExactVector> f;  // in K, with A f + b = 0
  std::optional<ExactVector> y;  // A'y in K*, y'b > 0: there is no such f
};

// By linear programs over rationals. Requires no sliding contact.
Rest DecideRest(const ExactProblem& problem);

// Contacts that A couples, directly or through others, are a problem of their own.
struct UncoupledPart {
  ExactProblem problem;
  std::vector<int> rows;  // in the whole problem
};
// In the order of their first contacts; of no contacts the problem itself.
std::vector<UncoupledPart> UncoupledParts(const ExactProblem& problem);

// Forces of the groups that accelerate and can rest, by row; the others' are as they were.
struct RestingForces {
  ExactVector f;
  std::vector<bool> rests;  // by row: whether its group did not
};

// a: accelerations under f, zero where they are not known to be anything else. Empty if nothing accelerates
// that can rest.
std::optional<RestingForces> ForcesAtRest(const ExactProblem& problem, const ExactVector& f,
                                          const ExactVector& a);

}  // namespace stiction
