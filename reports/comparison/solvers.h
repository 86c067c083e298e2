// SPDX-License-Identifier: Apache-2.0
// Solvers under test side by side: what their searches counted, by families of problems, and the smallest
// problem of each kind of failure. Searches of one seed and definition gave them the same problems.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "corpus/json_text.h"
#include "corpus/store/store.h"
#include "corpus/whole_folder.h"
#include "reports/told/told.h"

namespace stiction {

struct SolversCompared {
  std::vector<std::string> files;        // of the stores
  std::vector<std::string> differences;  // of the searches besides their solvers, one line each
  Table solvers;   // a row per solver: its law, the accuracy that it states, how often it passed
  Table failures;  // a row per family and solver: failures by kind; the first family is all problems
  Table smallest;  // a row per kind and solver: the group with the smallest problem, and this problem
};

// Requires at least one store, each of a search that tests a solver.
SolversCompared CompareSolvers(const std::vector<Store>& stores, const std::vector<std::string>& files);

// For `text` and `page` (told/told.h).
Told Tell(const SolversCompared& compared);
// The tables as columns and rows.
SharedJson SolversToJson(const SolversCompared& compared);
// index.html, solvers.txt, a CSV per table and SHA256SUMS, as a whole, as WriteComparison (comparison.h).
std::filesystem::path WriteSolvers(const SolversCompared& compared, const std::filesystem::path& directory,
                                   Occupied occupied = Occupied::kRefused);

}  // namespace stiction
