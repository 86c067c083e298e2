// SPDX-License-Identifier: Apache-2.0
// A problem over rationals, as files and certificates have it: of any form, and of each.

#pragma once

#include <string_view>

#include "corpus/rational.h"
#include "solver/problem/forms.h"

namespace stiction {

using AnyProblem = Problem<Rational>;
using ExactProblem = AnyProblem::Dense;
using ExactEntries = AnyProblem::Entries;
using ExactFactors = AnyProblem::Factored;

// "bilateral", "frictionless", "static", "sliding".
std::string_view Name(ContactKind kind);

}  // namespace stiction
