// SPDX-License-Identifier: Apache-2.0
// Facts of one problem, found here for all who tell of them: which of the paper's assumptions it meets, what
// solves it, and how well.
//
// What is dear is bounded by these numbers alone.

#pragma once

#include "corpus/exact_problem.h"
#include "corpus/json_text.h"
#include "solver/problem/options.h"

namespace stiction {

// Up to so many rows or contacts,
inline constexpr int kExactContacts = 50;         // if A couples them: all is decided over rationals
inline constexpr int kExactContactsInSpace = 10;  // in space: forces are found over rationals
inline constexpr int kPublishedContacts = 32;     // the published algorithm runs over rationals
inline constexpr int kDenseRows = 1500;           // methods hold A as a dense matrix, unless asked
inline constexpr int kExplainedRows = 24;         // explained: every method runs, every claim is tried
inline constexpr int kExplainedContacts = 8;      // the same: every policy runs, every contact mode is tried
inline constexpr int kExplainedWords = 1 << 10;   // mode words: mu is sought below which A is safe
// Linear programs of an enumeration, of one problem of many and of one alone.
inline constexpr std::int64_t kProgramsOfSurvey = 10000, kProgramsOfOne = 20000;

inline constexpr double kMostRounding = 1e-2;  // A - A' up to this part of A may be rounding, and is mended

// An entry of `survey --json` without its file. `symmetrized` has the same of (A + A')/2, where A - A' may be
// rounding. `suspicions`: bounds for the assumptions; in the plane, runs over rationals of suspicions only.
Json Surveyed(const AnyProblem& problem, const Limits& limits, int dense_rows = kDenseRows,
              bool suspicions = false);

// What an answer says of it: the assumptions of the paper that fail, each with its exact witness; of a large
// problem as far as bounds decide. In place of a vector of more than 50 contacts stand a number, and the verb
// that writes the vector. Of factors A is symmetric and semidefinite as it is made, and b in its range where c
// = 0.
Json FailedAssumptions(const AnyProblem& problem);

}  // namespace stiction
