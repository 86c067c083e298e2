// SPDX-License-Identifier: Apache-2.0
// Suites `peers`, `random`, `structure` and `growth`: they become the program stiction-peers, which stands
// beside this one.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <filesystem>

#include "bench/suite.h"
#include "corpus/problem_file.h"

namespace stiction {
namespace {

std::filesystem::path PeersProgram() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "stiction-peers";
}

// `tables`: options that name them.
int BecomePeers(const BenchOptions& options, const std::vector<std::string>& tables) {
  const auto program = PeersProgram();
  std::vector<std::string> words = {program.string(),
                                    "--seed",
                                    std::to_string(options.seed),
                                    "--seconds",
                                    std::to_string(0.06 * options.repeat),
                                    "--scenes",
                                    options.scenes};
  words.insert(words.end(), tables.begin(), tables.end());
  if (options.json) words.push_back("--json");
  if (options.problems) words.insert(words.end(), {"--problems", std::to_string(*options.problems)});
  if (!options.contacts.empty()) words.push_back("--contacts");
  for (const int contacts : options.contacts) words.push_back(std::to_string(contacts));
  if (!options.families.empty()) words.push_back("--family");
  words.insert(words.end(), options.families.begin(), options.families.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(program.c_str(), arguments.data());
  throw InputError(fmt::format("{}: cannot be run: {}; expected the program stiction-peers", program.string(),
                               std::strerror(errno)));
}

}  // namespace

Json AskPeers(const BenchOptions& options, const std::string& table) {
  const auto program = PeersProgram();
  std::string command = fmt::format("'{}' --json --table {} --seed {}", program.string(), table, options.seed);
  if (!options.contacts.empty()) command += fmt::format(" --contacts {}", fmt::join(options.contacts, " "));
  const auto refuse = [&](const std::string& found) {
    throw InputError(
        fmt::format("{}: found {}, expected tables of the program stiction-peers", command, found));
  };
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) refuse(std::strerror(errno));
  std::string text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  const int status = pclose(pipe);
  if (status != 0) refuse(fmt::format("status {}", status));
  return Json::parse(text).at("tables").at(0);
}

int BenchPeers(const BenchOptions& options) { return BecomePeers(options, {}); }

int BenchRandom(const BenchOptions& options) {
  return BecomePeers(options, {"--table", "full", "half", "planar", "planar-half", "space", "space-half"});
}

int BenchStructure(const BenchOptions& options) { return BecomePeers(options, {"--table", "structure"}); }

int BenchPeersExtremes(const BenchOptions& options) {
  return BecomePeers(options, {"--table", "extremes-frictionless", "extremes"});
}

int BenchGrowth(const BenchOptions& options) {
  return BecomePeers(options, {"--table", "growth-frictionless", "growth-planar"});
}

}  // namespace stiction
