// SPDX-License-Identifier: Apache-2.0
// stiction bench: becomes the program stiction-bench, which stands beside this one.

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "cli/verbs.h"

namespace stiction {
namespace {

int BecomeBench(std::vector<std::string> words) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "stiction-bench";
  words.insert(words.begin(), program.string());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(program.c_str(), arguments.data());
  throw InputError(
      fmt::format("{}: cannot be run: {}; expected the program stiction-bench, which `./run bench` builds",
                  program.string(), std::strerror(errno)));
}

}  // namespace

void AddBench(CLI::App& program, Action& action) {
  CLI::App& verb = *program.add_subcommand("bench", "Benchmark tables");
  verb.set_help_flag();
  verb.prefix_command();
  verb.callback([&verb, &action] { action = [&verb] { return BecomeBench(verb.remaining()); }; });
}

}  // namespace stiction
