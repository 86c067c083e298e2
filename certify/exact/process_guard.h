// SPDX-License-Identifier: Apache-2.0
// The guard of a program (line_process.h): a child of ours that starts the program, tells how it ended, and
// kills it with all its descendants once we close the line to it, or die.
//
// The program leads a session of its own, so that it has no terminal and a signal for our group is not for it.
// Orphans of its descendants become children of the guard (PR_SET_CHILD_SUBREAPER), whatever session they are
// in; the guard kills children until it has none. If the program kills the guard, PR_SET_PDEATHSIG kills the
// program, and we kill what bears its mark (KillMarked).

#pragma once

#include <sys/types.h>

#include <string_view>

namespace stiction {

// What the guard tells, in this order.
enum class GuardWord : int {
  kStarted,  // with the id of the program
  kFailed,   // it cannot be run: an errno. The last
  kEnded,    // as waitpid tells it
};
struct GuardMessage {
  GuardWord word;
  int value;
};

// Open files of the guard and of the program.
struct GuardFiles {
  int control;  // the guard's end of the line to us
  int socket;   // standard input and output of the program
  int errors;   // its standard error; -1: ours
};

// Runs in a process that was just forked, perhaps of several threads: allocates nothing. Never returns.
[[noreturn]] void Guard(const GuardFiles& files, char* const* arguments, char* const* environment);

// "STICTION_MARK=..." in the environment of processes, which are killed, until for a tenth of a second there
// are none.
void KillMarked(std::string_view mark);

}  // namespace stiction
