// SPDX-License-Identifier: Apache-2.0
// A problem over rationals, as files and certificates have it.

#ifndef STICTION_CORPUS_EXACT_PROBLEM_H_
#define STICTION_CORPUS_EXACT_PROBLEM_H_

#include <string_view>

#include "corpus/rational.h"
#include "solver/problem/problem.h"

namespace stiction {

using ExactProblem = ContactProblem<Rational>;

// "bilateral", "frictionless", "static", "sliding".
std::string_view Name(ContactKind kind);

}  // namespace stiction

#endif  // STICTION_CORPUS_EXACT_PROBLEM_H_
