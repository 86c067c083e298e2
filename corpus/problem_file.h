// SPDX-License-Identifier: Apache-2.0
// Problem files: `stiction-problem`, version 1, read and written exactly.
//
// Numbers: a string is exact ("-3/4", "2.5e-3"), a JSON number is taken at its IEEE double value; an
// integer literal that is no exact double is refused. Nothing is guessed or repaired: a wrong file is an
// InputError with file, JSON path, what was found and what was expected.

#ifndef STICTION_CORPUS_PROBLEM_FILE_H_
#define STICTION_CORPUS_PROBLEM_FILE_H_

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "corpus/input_error.h"
#include "corpus/rational.h"
#include "solver/problem.h"

namespace stiction {

using ExactProblem = ContactProblem<Rational>;
using Json = nlohmann::ordered_json;

struct ProblemFile {
  std::string name;
  ExactProblem problem;
  std::optional<Json> scene;
  std::optional<Json> origin;                 // generator, seed, parent, what was rounded or symmetrized
  std::map<std::string, std::string> expect;  // policy as written -> outcome
};

// `source` names the text in errors.
ProblemFile ParseProblem(std::string_view text, const std::string& source);
ProblemFile ReadProblem(const std::filesystem::path& file);

// Parses JSON and refuses what nlohmann lets pass: duplicate keys. Integers that no double holds survive
// as their text (see json_text.h).
// The problem alone, as certificates embed it: format, version, dimension, contacts, A, b; exact strings.
Json ProblemToJson(const ExactProblem& problem);
// Everything; A in dense rows.
Json ToJson(const ProblemFile& file);
// One row of A a line, so that a person can read it.
std::string Print(const ProblemFile& file);

// The problem at key path `path` of an already parsed document (certificates). `strict` allows exactly
// the keys that ProblemToJson writes, and strings only.
ExactProblem ProblemFromJson(const Json& json, const std::string& source, const std::string& path, bool strict);

}  // namespace stiction

#endif  // STICTION_CORPUS_PROBLEM_FILE_H_
