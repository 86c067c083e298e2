// SPDX-License-Identifier: Apache-2.0
// stiction bench: becomes the program stiction-bench, which stands beside this one.

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "cli/bench_words.h"
#include "cli/command_line.h"
#include "corpus/input_error.h"

namespace stiction {
namespace {

struct BenchCommand {
  std::vector<std::string> words;
  BenchOptions meant;  // by them; the program reads them itself
};

int BecomeBench(const BenchCommand& o) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "stiction-bench";
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), o.words.begin(), o.words.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(program.c_str(), arguments.data());
  throw InputError(fmt::format("{}: cannot be run: {}; expected the program stiction-bench beside this one",
                               program.string(), std::strerror(errno)));
}

}  // namespace

const ListedVerb kBenchVerb("Solve", 50, [](CommandLine& program) {
  auto [verb, o] = program.Add("bench", kBenchPurpose, BecomeBench);
  verb.footer =
      "Its words are read by the program stiction-bench, which stands beside this one. Questions that are "
      "asked once are studies in Python, in the folder bench/studies of the sources: ./run bench --suite NAME.";
  verb.rest = &o.words;
  AddBenchWords(verb, o.meant);
});

}  // namespace stiction
