// SPDX-License-Identifier: Apache-2.0
// One problem from whatever holds it: what FILE stands for in every verb, and in Python.
//
//   a problem file, in its short form too (problem_file.h)
//   a scene: the one problem of its forces at this instant
//   a Siconos .dat, an FCLIB .hdf5 (formats/)
//   STORE:FINDING, a finding of a search by its signature, or by how that begins where it is the only one: its
//   minimized form, otherwise as it was found
//   -, standard input, which may be any of these but a store
//
// Which it is the content decides. InputError: what cannot be read, with its place and the next step.

#ifndef STICTION_CORPUS_FORMATS_READ_PROBLEM_H_
#define STICTION_CORPUS_FORMATS_READ_PROBLEM_H_

#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "corpus/record/sparse_problem.h"
#include "corpus/store/store.h"

namespace stiction {

// Dense as long as that is no burden: SparseProblem if A is sparse or in factors, of more than kMostDenseRows
// rows; of factors A is not formed then (WithMatrix). `scene` of a scene's problem is that scene.
std::variant<ProblemFile, SparseProblem> ReadAnySize(const std::filesystem::path& file);

// Whether the file is a store, or at least a database.
bool IsStore(const std::filesystem::path& file);

// What was read as sparse, as that.
std::variant<ProblemFile, SparseProblem> Sized(SparseProblem problem);

// The same for what asks for a dense matrix, and refuses larger ones.
ProblemFile ReadProblem(const std::filesystem::path& file);
// The same for what takes any size, and asks for A.
SparseProblem ReadSparseProblem(const std::filesystem::path& file);

// The factors of a problem: those of its file, or those of the scene that it carries, if the problem is that of
// the scene.
std::optional<ExactFactors> FactorsBehind(const ProblemFile& file);

// What STORE:FINDING names; empty of anything else.
struct NamedFinding {
  std::string store;
  Finding finding;
};
std::optional<NamedFinding> FindNamed(const std::filesystem::path& file);

}  // namespace stiction

#endif  // STICTION_CORPUS_FORMATS_READ_PROBLEM_H_
