// SPDX-License-Identifier: Apache-2.0
// Problem files: `stiction-problem`, version 1, read and written exactly.
//
// Numbers: a string is exact ("-3/4", "2.5e-3"), a JSON number is taken at its IEEE double value; an
// integer literal that is no exact double is refused. Nothing is guessed or repaired: a wrong file is an
// InputError with file and, of every key that is missing or wrong, JSON path, what was found and what was
// expected. formats/problems.md has what may be left out, and the short form.
//
// A may be {"size": n, "entries": [[i, j, "v"], ...]}, zero-based, each entry once; what is not listed is
// zero. An entry (i, j) below the diagonal stands for (j, i) too, unless (j, i) is listed as well: then each
// stands for itself. An entry above the diagonal without the one below is refused, since it could mean
// either a symmetric matrix or not. So a symmetric A is its lower triangle, and whatever is not symmetric
// is visible as a pair of entries. In place of A and b may stand `factors` (factors.h), of which both are
// formed.

#pragma once

#include <climits>
#include <map>
#include <string>
#include <string_view>

#include "corpus/exact_problem.h"
#include "corpus/json_text.h"
#include "corpus/record/factors.h"

namespace stiction {

struct ProblemFile {
  std::string name;
  AnyProblem problem;  // in the form that the file has it
  SharedJson scene;    // any value, kept as it is
  SharedJson origin;   // an object: generator, seed, parent, what was rounded or symmetrized
  std::map<std::string, std::string> expect;  // policy as written, or "*" for the grid -> outcome
};

// Whether all of A is a burden: then it stays as it is until somebody asks for it. Factors do so earlier: what
// they are for does not need A.
bool StaysSparse(const AnyProblem& problem);

inline constexpr int kAnyRows = INT_MAX;

// `source` names the text in errors. No policy may stand twice in `expect`, however it is written.
// Without a name it has that of the source, without its ending. More than `most_rows` are refused, by default
// those of which no dense A is made.
ProblemFile ParseProblem(std::string_view text, const std::string& source, int most_rows = kMostDenseRows);
// InputError, naming `source`, above kMostDenseRows.
void RequireFewRows(const AnyProblem& problem, const std::string& source);

// Writers write what the reader reads back to the same values; an invalid problem (sizes, mu, slip) is an
// InternalError. Every number of the problem is an exact string. A is in the form that the problem
// has; in entries, too, where a dense one is symmetric with more than 64 rows and at most a quarter of its
// entries are not zero.
//
// The problem alone, as certificates embed it: format, version, dimension, contacts, A, b.
SharedJson ProblemToJson(const ExactProblem& problem);
// Everything.
SharedJson ToJson(const ProblemFile& file);
// Everything as text. One contact and one row of A a line, so that a person can read it.
std::string Print(const ProblemFile& file);

// The problem at key path `path` of a document that ParseJson read (certificates). `strict` allows exactly
// the keys that ProblemToJson writes, and strings for numbers; otherwise the keys of a file may stand beside.
ExactProblem ProblemFromJson(const Json& json, const std::string& source, const std::string& path, bool strict);

}  // namespace stiction
