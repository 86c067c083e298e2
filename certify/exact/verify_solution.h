// SPDX-License-Identifier: Apache-2.0
// Verifies a solution exactly: short, and without a line of the pivoting code.

#ifndef STICTION_CERTIFY_EXACT_VERIFY_SOLUTION_H_
#define STICTION_CERTIFY_EXACT_VERIFY_SOLUTION_H_

#include <optional>
#include <string>

#include "corpus/exact_problem.h"

namespace stiction {

// a = A f + b. f: rows x 1 in N.
ExactProblem::Vector Accelerations(const ExactProblem& problem, const ExactProblem::Vector& f);

// The first condition that f breaks, with its numbers; empty if f is a solution. Planar problems of all kinds
// of contacts: (15); (16) for static, (24) for sliding ones; aN = 0 for bilateral ones.
std::optional<std::string> FindViolation(const ExactProblem& problem, const ExactProblem::Vector& f);
// The same with a = A f + b at hand.
std::optional<std::string> FindViolation(const ExactProblem& problem, const ExactProblem::Vector& f,
                                         const ExactProblem::Vector& a);

// The same in space, for all kinds of contacts: the conditions (21), (22) for static ones, which leave the
// direction of slip free,
//
//   abs(fF) <= mu fN,  fF.aF <= 0,  aF = 0 or abs(fF) = mu fN,
//
// aN = 0 for bilateral and fF = -mu fN slip for sliding ones. Lengths are compared by their squares.
std::optional<std::string> FindWeakViolation(const ExactProblem& problem, const ExactProblem::Vector& f);

// Coulomb's law in space up to a bound c, 0 < c <= 1, on the cosine between fF and -aF: for static contacts
//
//   abs(fF) <= mu fN,  -fF.aF >= c mu fN abs(aF).
//
// With c = 1 that is the law itself.
std::optional<std::string> FindCoulombViolation(const ExactProblem& problem, const ExactProblem::Vector& f,
                                                const Rational& bound);

}  // namespace stiction

#endif  // STICTION_CERTIFY_EXACT_VERIFY_SOLUTION_H_
