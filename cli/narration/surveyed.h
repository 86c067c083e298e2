// SPDX-License-Identifier: Apache-2.0
// What a survey finds of one problem: which of the paper's assumptions it meets, what solves it, and how well.

#pragma once

#include <string>

#include "corpus/exact_problem.h"
#include "corpus/json_text.h"
#include "solver/problem/options.h"

namespace stiction {

inline constexpr double kMostRounding = 1e-2;  // A - A' up to this part of A may be rounding, and is mended

struct SurveyScope {
  int rows = 1500;          // the most for methods that hold A as a dense matrix
  bool suspicions = false;  // bounds for the assumptions; in the plane, runs over rationals of suspicions only
  Limits limits = {};
};

// An entry of `survey --json` without its file. `symmetrized` has the same of (A + A')/2, where A - A' may be
// rounding.
Json Surveyed(const AnyProblem& problem, const SurveyScope& scope);

// "3e-16".
std::string ShortText(double x);
// What the facts of an entry say, or of `symmetrized`: "meets the paper's assumptions: ...".
std::string AssumptionsMetText(const Json& facts);
// The first run that says whether there is a solution, and what the published algorithm does.
std::string RunsText(const Json& facts);

}  // namespace stiction
