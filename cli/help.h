// SPDX-License-Identifier: Apache-2.0
// What --help says, from the rows of the verbs.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/command_line.h"

namespace stiction {

// What the exit codes mean.
inline constexpr const char* kExitCodes =
    "Exit: 0 done; 1 not solved, rejected, or not as expected; 2 bad usage or input; 3 undecided or a limit; "
    "4 a search or merge holds a grave finding; 70 a bug; 74 the disk is full, or the output cannot be "
    "written.";

std::string HelpOf(const CommandLine& program);
std::string HelpOf(const Verb& verb);

// The parts of it, which the manual has, too. "-o, --output TEXT", "FILE ..."
std::string TermOf(const OptionRow& row);
// What it is, its range, unit and default; its choices where they need no explanation.
std::string MeaningOf(const OptionRow& row);
bool AreExplained(const std::vector<AllowedValue>& choices);
// "stiction export [OPTIONS] FILE"
std::string UsageLine(const Verb& verb);
// A term at the left, what it means beside it; lines.
std::string HelpEntry(const std::string& term, const std::string& meaning);

// The name that a mistyped word stands for; empty where none is near.
std::string Nearest(std::string_view word, const std::vector<std::string>& names);

}  // namespace stiction
