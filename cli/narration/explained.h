// SPDX-License-Identifier: Apache-2.0
// One problem in words: what it is, whether it has a solution, what the methods do on it, how sure its forces
// are, what can be certified, and what to type next.

#pragma once

#include <string>

#include "corpus/json_text.h"
#include "corpus/record/problem_file.h"
#include "solver/problem/options.h"

namespace stiction {

struct ExplainOptions {
  std::string file;  // as commands name it
  Limits limits = {};
};

// What `explain --json` prints.
SharedJson Explained(ProblemFile file, const ExplainOptions& o);

// The same in lines that fit the terminal, but for commands.
std::string ExplainedText(const Json& found);

}  // namespace stiction
