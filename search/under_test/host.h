// SPDX-License-Identifier: Apache-2.0
// The process that holds a library under test (stiction_solver.h): it speaks on standard input and output as a
// program under test does (README.md), so that a search knows programs alone.

#pragma once

#include <optional>

namespace stiction {

// The first word of the command line that makes a program of this suite such a process; the library follows.
inline constexpr const char* kSolverHostWord = "--solver-host";

// The exit code, if the command line asks for it. Answers until standard input ends. What the library prints is
// thrown away.
std::optional<int> RunAsSolverHost(int argc, char** argv);

}  // namespace stiction
