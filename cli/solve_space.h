// SPDX-License-Identifier: Apache-2.0
// stiction solve, in space.

#ifndef STICTION_CLI_SOLVE_SPACE_H_
#define STICTION_CLI_SOLVE_SPACE_H_

#include <string>

#include "corpus/problem_file.h"
#include "solver/problem/solution.h"

namespace stiction {

struct SolveSpaceOptions {
  std::string file;  // named in errors
  std::string method;
  std::string arithmetic;
  std::string law = "baraff";
  int sides = 8;
  Limits limits;
  Tolerances tolerances;
};

struct SolvedInSpace {
  Outcome outcome = Outcome::kUndecided;
  Json result;  // without the assumptions
};

// InputError for a method or an arithmetic that is not built for space.
SolvedInSpace SolveSpace(const ExactProblem& problem, const SolveSpaceOptions& options);

}  // namespace stiction

#endif  // STICTION_CLI_SOLVE_SPACE_H_
