// SPDX-License-Identifier: Apache-2.0
// Suites of the packages of others: they become the program stiction-peers, which stands beside this one.

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "bench/suite.h"
#include "corpus/input_error.h"

namespace stiction {

int BenchPeers(const BenchOptions& options, std::string_view tables) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "stiction-peers";
  std::vector<std::string> words = {program.string(), "--seed", std::to_string(options.seed)};
  words.insert(words.end(), {"--seconds", std::to_string(0.06 * options.repeat), "--scenes", options.scenes});
  words.push_back("--table");
  std::istringstream names{std::string(tables)};
  for (std::string name; names >> name;) words.push_back(name);
  if (options.json) words.push_back("--json");
  const char* count = tables == "engines" ? "--frames" : "--problems";
  if (options.problems) words.insert(words.end(), {count, std::to_string(*options.problems)});
  if (!options.contacts.empty()) words.push_back("--contacts");
  for (const int contacts : options.contacts) words.push_back(std::to_string(contacts));
  if (!options.families.empty()) words.push_back("--family");
  words.insert(words.end(), options.families.begin(), options.families.end());
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(program.c_str(), arguments.data());
  throw InputError(fmt::format("{}: cannot be run: {}; expected the program stiction-peers", program.string(),
                               std::strerror(errno)));
}

}  // namespace stiction
