// SPDX-License-Identifier: Apache-2.0
// Of several solutions `auto` prefers one whose contacts rest (exact/rest.h); in space, of solutions whose
// contacts slip, the one of Newton's method in the space of bodies if it moves less.

#pragma once

#include <functional>

#include "certify/exact/solve.h"

namespace stiction {

// The word is of the solution that was found first. `rounded`: null, or what may tell that nothing rests.
void PreferRest(const AnyProblem& problem, const ContactProblem<double>* rounded, const Request& request,
                ExactAnswer& answer);

// Whether forces of doubles leave accelerations, no rounding, of contacts so few that PreferRest does
// something.
bool MayRest(const FactoredProblem<double>& problem, const InexactAnswer& answer);

// The same of doubles: forces that rest are found exactly, and rounded. `rounded`: the problem that was solved;
// file(): that of which it is a rounding.
void PreferRest(const ContactProblem<double>& rounded, const std::function<const AnyProblem&()>& file,
                const Request& request, InexactAnswer& answer);

}  // namespace stiction
