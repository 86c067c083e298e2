// SPDX-License-Identifier: Apache-2.0
// The man page and the completion of bash, from the rows of the verbs (cli/verb.h) and the table of words.

#ifndef STICTION_CLI_MANUAL_H_
#define STICTION_CLI_MANUAL_H_

#include <string>

#include "cli/command_line.h"
#include "corpus/json_text.h"

namespace stiction {

// In the language of man(7), section 1.
std::string ManPage(const CommandLine& program);
// Of the program stiction-bench, which reads the words of the verb bench.
std::string ManPageOfBench(const CommandLine& program);

// A script for bash: verbs, their options, and the values of those that have a list; files elsewhere.
std::string BashCompletion(const CommandLine& program);

// Verbs with their rows, as a program reads them.
Json TablesInJson(const CommandLine& program);

}  // namespace stiction

#endif  // STICTION_CLI_MANUAL_H_
