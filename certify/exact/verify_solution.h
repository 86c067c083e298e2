// SPDX-License-Identifier: Apache-2.0
// The judge of exact forces: short, and without a line of the pivoting code. Whatever asks over rationals
// whether forces are a solution, or how far from Coulomb's law they are, asks here.
//
//   aN = 0                                                    bilateral
//   fN >= 0, aN >= 0, fN aN = 0                               all others (15)
//   fF = -mu fN slip                                          sliding, too (24)
//   abs(fF) <= mu fN, fF.aF <= 0, aF = 0 or abs(fF) = mu fN   static, too (16), in space (21), (22)
//
// In space (21), (22) leave the direction of slip free. Coulomb's law up to a bound c, 0 < c <= 1, on the
// cosine between fF and -aF has in place of the last of them
//
//   -fF.aF >= c mu fN abs(aF)
//
// and is the law itself with c = 1. In the plane both laws are one. Lengths in space are compared by their
// squares.

#pragma once

#include <optional>
#include <string>

#include "corpus/exact_problem.h"
#include "solver/problem/options.h"

namespace stiction {

// a = A f + b. f: rows x 1 in N.
ExactProblem::Vector Accelerations(const ExactProblem& problem, const ExactProblem::Vector& f);

// The first condition that f breaks, with its numbers; empty if f is a solution.
std::optional<std::string> FindViolation(const ExactProblem& problem, const ExactProblem::Vector& f,
                                         FrictionLaw law = FrictionLaw::kBaraff, const Rational& bound = 1);
// The same with a = A f + b at hand.
std::optional<std::string> FindViolation(const ExactProblem& problem, const ExactProblem::Vector& f,
                                         const ExactProblem::Vector& a, FrictionLaw law = FrictionLaw::kBaraff,
                                         const Rational& bound = 1);

// The same of f and a apart: the conditions on one of them alone. They are what all modes of a contact imply
// (modes.h), and of f those of its friction cones.
std::optional<std::string> FindViolationApart(const ExactProblem& problem, const ExactProblem::Vector& f,
                                              const ExactProblem::Vector& a);

// The largest bound c of Coulomb's law that f meets, in space, rounded down: 1 - c to eight binary digits.
// Empty if f breaks a condition whatever c. In the plane 1, or empty.
std::optional<Rational> CoulombBound(const ExactProblem& problem, const ExactProblem::Vector& f);
// The same with a = A f + b at hand, of which A and b are not read.
std::optional<Rational> CoulombBound(const ExactProblem& problem, const ExactProblem::Vector& f,
                                     const ExactProblem::Vector& a);

}  // namespace stiction
