// SPDX-License-Identifier: Apache-2.0
// Rest: solutions under which contacts keep still, where another solution accelerates them.
//
// Accelerations need not be unique with friction. Forces with
//
//   f in K,  A f + b = 0
//
// (K: cones.h) meet Coulomb's law exactly, whatever the dimension: aN = aF = 0. They are sought for every group
// of contacts that A couples by itself: doubles propose them, or a proof that there are none, which exact
// numbers then decide; where they do not, an exact linear program does, in space over polygons within K, whose
// corners are added where the programs say; there none may be found though there are some. A group with a
// sliding contact is left.

#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "certify/exact/properties.h"
#include "certify/exact/solve.h"

namespace stiction {

// Forces of the groups that accelerate and can rest, by row; the others' are as they were.
struct RestingForces {
  ExactVector f;
  std::vector<bool> rests;  // by row: whether its group did not
};

// a: accelerations under f, zero where they are not known to be anything else. Empty if nothing accelerates
// that can rest.
std::optional<RestingForces> ForcesAtRest(const ExactProblem& problem, const ExactVector& f,
                                          const ExactVector& a);

// `auto` prefers, of several solutions, one whose contacts rest; in space, of solutions whose contacts slip,
// the one of Newton's method in the space of bodies if it moves less. The word is of the one that was found
// first.
void PreferRest(const AnyProblem& problem, const Request& request, ExactAnswer& answer);

// The same of doubles: forces that rest are found exactly, and rounded. `rounded`: the problem that was solved;
// file(): that of which it is a rounding.
void PreferRest(const ContactProblem<double>& rounded, const std::function<const AnyProblem&()>& file,
                const Request& request, InexactAnswer& answer);

}  // namespace stiction
