// SPDX-License-Identifier: Apache-2.0
// A run of a path method for people and for programs: a line for each step, or all of its numbers.

#pragma once

#include <string>
#include <vector>

#include "certify/exact/solve.h"
#include "cli/narration/outcome_text.h"
#include "corpus/json_text.h"

namespace stiction {

struct ProblemFile;  // corpus/record/problem_file.h

// `vectors`: whether the objects have them, too.
struct Telling {
  bool vectors = false;
  FractionText fractions = FractionText::kFull;  // of the text; objects have them in full
};

struct Narration {
  std::string table;               // a line for each step
  std::string steps;               // directions, forces, accelerations and sets as well
  std::vector<SharedJson> pivots;  // an object for each step
  std::string before;              // how things stand before the first step
  std::vector<SharedJson> told;    // an object for each step, what a page shows of it (reports/web/data.md)
};

// `file` must outlive the call. Scalar: Rational or double.
template <class Scalar>
Narration NarrateBaraff(const ProblemFile& file, const Answer<Scalar>& answer, const Telling& how);
// In the plane over rationals it is told, too, where the published algorithm gives up at a fold.
template <class Scalar>
Narration NarrateComplete(const ProblemFile& file, const Answer<Scalar>& answer, const Telling& how);
template <class Scalar>
Narration NarrateLemke(const ProblemFile& file, const Answer<Scalar>& answer, const Telling& how);

}  // namespace stiction
