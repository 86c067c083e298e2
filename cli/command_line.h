// SPDX-License-Identifier: Apache-2.0
// The command line of the program: its verbs (cli/verb.h), and which of them is meant.

#pragma once

#include <deque>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "cli/verb.h"

namespace stiction {

class CommandLine {
 public:
  CommandLine(std::string purpose, std::string version, std::string footer)
      : purpose(std::move(purpose)), version(std::move(version)), footer(std::move(footer)) {}

  // A new verb, and the options that `run` is called with; both live as long as the command line.
  template <class Options>
  std::pair<Verb&, Options&> Add(std::string name, std::string help, int (*run)(const Options&)) {
    auto options = std::make_shared<Options>();
    Verb& verb = verbs.emplace_back(std::move(name), std::move(help));
    verb.group = group;
    verb.run = [options, run] { return run(*options); };
    return {verb, *options};
  }

  // Every listed verb, by these jobs and its place in them; no job may be missing.
  void AddListed(std::initializer_list<std::string_view> groups);

  // Reads the command line and runs the verb; its exit code, or 2 with what is wrong on standard error.
  int Run(int argc, char** argv) const;

  std::string purpose;  // one line
  std::string group;    // of the verbs that are added next
  std::string version;
  std::string footer;
  std::deque<Verb> verbs;  // a reference to a verb stays good

 private:
  // Help of the program, or of a verb.
  int Help(const std::string& verb) const;
};

// A verb in the list of the program, from before main: its job, its place there, and what adds
// it. The file of the verb has it, and nothing else names the verb.
struct ListedVerb {
  ListedVerb(std::string_view group, int place, void (*add)(CommandLine&));
};

}  // namespace stiction
