// SPDX-License-Identifier: Apache-2.0
// A finding of a solver under test as a program of at most 60 lines for its authors: it gives the solver the
// problem, and prints what goes wrong beside the right forces.

#pragma once

#include <array>
#include <string>
#include <string_view>

#include "corpus/store/store.h"
#include "search/under_test/solver.h"

namespace stiction {

// c       linked with the library under test (stiction_solver.h)
// python  the standard library alone; the library or program under test is its argument
// ode, bullet, dart, siconos   C++ over these packages alone
inline constexpr std::array<std::string_view, 6> kReproducerNames = {"c",      "python", "ode",
                                                                     "bullet", "dart",   "siconos"};

// Of the minimized problem, or of that as found. `file`: what the program will be called, for the command in
// its first comment. InputError where the finding is of no solver under test, or its law is none of the
// package.
//
// The program exits with 1 where it sees what was found, otherwise with 0. It measures as the judge does
// (judge_forces.h), in units of what acts at each row under the right forces.
std::string ReproducerOf(const Finding& finding, const SolverUnderTest& solver, std::string_view name,
                         const std::string& file);

}  // namespace stiction
