// SPDX-License-Identifier: Apache-2.0
// The report of a solver under test: how often it fails and how, by what problems are like, and its smallest
// findings.

#pragma once

#include <string>

#include "corpus/json_text.h"
#include "corpus/store/store.h"

namespace stiction {

// Whether the store is of a search that tests a solver: what both below require.
bool TestsSolver(const Store& store, const std::string& file);

// What stands for the file of the solver, which stores do not name, in a command that is told.
inline constexpr const char* kAnySolverFile = "FILE";

// What finishes the findings that are not yet seen again and minimized, with the file of the solver.
std::string FinishTestedCommand(const std::string& file, const std::string& solver = kAnySolverFile);

std::string SolverText(const Store& store, const std::string& file, const std::string& solver = kAnySolverFile);
Json SolverToJson(const Store& store);
// Its groups alone, the smallest first: of a search with an objective, which has no rates.
std::string GroupsText(const Store& store);
Json GroupsToJson(const Store& store);
std::string ShapeOfSolver();  // of what it gives (cli/schema.h)

}  // namespace stiction
