// SPDX-License-Identifier: Apache-2.0
// Verifies a solution exactly: short, and without a line of the pivoting code.

#ifndef STICTION_CERTIFY_VERIFY_SOLUTION_H_
#define STICTION_CERTIFY_VERIFY_SOLUTION_H_

#include <optional>
#include <string>

#include "corpus/problem_file.h"

namespace stiction {

// a = A f + b. f: rows x 1 in N.
ExactProblem::Vector Accelerations(const ExactProblem& problem, const ExactProblem::Vector& f);

// The first condition of (15), (16) that f breaks, with its numbers; empty if f is a solution. Planar
// problems of frictionless and static contacts.
std::optional<std::string> FindViolation(const ExactProblem& problem, const ExactProblem::Vector& f);

}  // namespace stiction

#endif  // STICTION_CERTIFY_VERIFY_SOLUTION_H_
