// SPDX-License-Identifier: GPL-3.0-or-later OR Apache-2.0
// The program `stiction-bench`, which `stiction bench` becomes: one suite of bench/ a run.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "bench/suite.h"
#include "cli/bench_words.h"
#include "cli/command_line.h"
#include "cli/help.h"
#include "cli/program.h"
#include "cli/version.h"
#include "corpus/input_error.h"

namespace {

using namespace stiction;

// By the name of a suite that stiction-bench measures itself.
const std::map<std::string_view, int (*)(const BenchOptions&)> kFunctions = {
    {"search", BenchSearch},      {"problems", BenchProblems}, {"silent", BenchSilent}, {"gate", BenchGate},
    {"gate-cost", BenchGateCost}, {"scenes", BenchScenes},     {"frames", BenchFrames}};

int RunBench(const BenchOptions& o) {
  const auto suite = std::find_if(kSuites.begin(), kSuites.end(), [&o](auto& s) { return s.name == o.suite; });
  for (const int contacts : o.contacts) {
    if (contacts > suite->most_contacts)
      throw InputError(fmt::format("bench: --contacts: found {}, expected 1 to {} for suite {}", contacts,
                                   suite->most_contacts, o.suite));
  }
  return suite->tables.empty() ? kFunctions.at(suite->name)(o) : BenchPeers(o, suite->tables);
}

// The words are those of the verb, which the program stands for.
int Main(int argc, char** argv) {
  CommandLine program(kBenchPurpose, "stiction-bench " + BuildId(), kExitCodes);
  auto [verb, o] = program.Add("bench", kBenchPurpose, RunBench);
  AddBenchWords(verb, o);
  std::vector<char*> arguments(argv, argv + argc);
  char name[] = "bench";
  if (argc != 2 || std::string_view(argv[1]) != "--version") arguments.insert(arguments.begin() + 1, name);
  return program.Run(static_cast<int>(arguments.size()), arguments.data());
}

}  // namespace

int main(int argc, char** argv) { return stiction::RunProgram(argc, argv, Main); }
