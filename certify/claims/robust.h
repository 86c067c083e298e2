// SPDX-License-Identifier: Apache-2.0
// Robust loops: how far all numbers of a problem may move at once while the published algorithm still loops.
//
// The box of radius r about a problem holds all with entries of A within r max|A| of the given ones, symmetric
// or not, of b within r max|b|, and every mu within r mu.
//
// Theorem. Let the run of the problem itself come to the state with sets S after `start` drives, and again
// `period` drives later. If the run over intervals that enclose the box
//   - proves every decision of these drives, each being that of the problem itself, and that no earlier state
//     stood before,
//   - knows the forces of all variables outside C, CF, NC- and NC+ to be zero, at both times, and
//   - finds the equations of C and CF in S regular,
// then every problem of the box loops, with this start and period.
// Proof. All runs take the same steps, so all have the sets S at both times; under `resume=round` the contact
// driven last is the same too. The forces at each time are zero outside S, follow friction at a limit, and
// otherwise solve the equations, which have one solution: the state is the same. QED
//
// The box reaches beyond what the paper assumes: its A need not be symmetric, nor semidefinite.
//
// Units    r is a number without one. Requires static and frictionless contacts of the plane.

#pragma once

#include <functional>
#include <optional>

#include "certify/exact/exact.h"

namespace stiction {

// The largest radius that is proved, of m 2^-k with 8 <= m < 16 and radius >= 2^-40; zero where only the
// problem itself is. A lower bound of what the loop survives: intervals grow from step to step, and a tie is
// one word of several. Empty unless the run loops in the outer loop and intervals prove that.
std::optional<Rational> RadiusOfLoop(const ExactProblem& problem, const Request& request);

// The largest of these radii that holds; empty if not even zero does.
std::optional<Rational> LargestRadius(const std::function<bool(const Rational&)>& holds);

// Whether the theorem holds for this radius >= 0.
bool LoopsWithin(const ExactProblem& problem, const ExactRun& run, const Request& request,
                 const Rational& radius);

}  // namespace stiction
