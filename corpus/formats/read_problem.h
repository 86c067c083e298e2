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

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "corpus/record/problem_file.h"
#include "corpus/store/store.h"

namespace stiction {

// In the form that it is read in; of a scene in factors, and `scene` is that scene. More than `most_rows` are
// refused, by default those of which no dense A is made.
ProblemFile ReadProblem(const std::filesystem::path& file, int most_rows = kMostDenseRows);

// Whether the file is a store, or at least a database.
bool IsStore(const std::filesystem::path& file);

// The problem in factors, where its file or the scene that it carries has some: of a scene if the problem is
// that of the scene. Otherwise as it is.
AnyProblem InFactors(const ProblemFile& file);

// What STORE:FINDING names; empty of anything else.
struct NamedFinding {
  std::string store;
  Finding finding;
};
std::optional<NamedFinding> FindNamed(const std::filesystem::path& file);

}  // namespace stiction
