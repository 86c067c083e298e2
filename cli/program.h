// SPDX-License-Identifier: Apache-2.0
// The frame of a program: how what is thrown ends, in one line and with the exit code that it has.

#ifndef STICTION_CLI_PROGRAM_H_
#define STICTION_CLI_PROGRAM_H_

namespace stiction {

// What main returns.
int RunProgram(int argc, char** argv, int (*run)(int argc, char** argv));

}  // namespace stiction

#endif  // STICTION_CLI_PROGRAM_H_
