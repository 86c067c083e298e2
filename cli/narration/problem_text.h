// SPDX-License-Identifier: Apache-2.0
// A problem for people: what stands before a replay.

#ifndef STICTION_CLI_NARRATION_PROBLEM_TEXT_H_
#define STICTION_CLI_NARRATION_PROBLEM_TEXT_H_

#include <string>

#include "cli/narration/outcome_text.h"
#include "corpus/exact_problem.h"

namespace stiction {

// A and b as a table with the names of the variables, and mu of every contact. Of more than 24 rows only how
// many there are.
std::string ProblemText(const ExactProblem& problem, FractionText fractions);

}  // namespace stiction

#endif  // STICTION_CLI_NARRATION_PROBLEM_TEXT_H_
