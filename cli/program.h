// SPDX-License-Identifier: Apache-2.0
// The frame of a program: how what is thrown ends, in one line and with the exit code that it has, and how
// commands in its texts are called.

#pragma once

#include <string>

namespace stiction {

// A text whose commands, `stiction VERB`, are those of whoever reads it (corpus/program_name.h).
std::string AsTyped(std::string text);

// What main returns.
int RunProgram(int argc, char** argv, int (*run)(int argc, char** argv));

}  // namespace stiction
