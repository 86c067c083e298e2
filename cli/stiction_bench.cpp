// SPDX-License-Identifier: GPL-3.0-or-later OR Apache-2.0
// The program `stiction-bench`, which `stiction bench` becomes: one suite of bench/ a run.

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "bench/one_thread.h"
#include "bench/suite.h"
#include "cli/bench_words.h"
#include "cli/command_line.h"
#include "cli/help.h"
#include "cli/program.h"
#include "cli/version.h"
#include "corpus/input_error.h"

namespace {

using namespace stiction;

auto FunctionOf(SuiteId id) -> int (*)(const BenchOptions&) {
  switch (id) {
    case SuiteId::kAdversary:
      return BenchAdversary;
    case SuiteId::kPatches:
      return BenchPatches;
    case SuiteId::kSearch:
      return BenchSearch;
    case SuiteId::kTrade:
      return BenchTrade;
    case SuiteId::kExtremes:
      return BenchExtremes;
    case SuiteId::kSilent:
      return BenchSilent;
    case SuiteId::kGate:
      return BenchGate;
    case SuiteId::kRatios:
      return BenchRatios;
    case SuiteId::kMethods:
      return BenchMethods;
    case SuiteId::kFrictionless:
      return BenchFrictionless;
    case SuiteId::kPeers:
      return BenchPeers;
    case SuiteId::kRandom:
      return BenchRandom;
    case SuiteId::kStructure:
      return BenchStructure;
    case SuiteId::kPeersExtremes:
      return BenchPeersExtremes;
    case SuiteId::kGrowth:
      return BenchGrowth;
    case SuiteId::kLinearAlgebra:
      return BenchLinearAlgebra;
    case SuiteId::kSpace:
      return BenchSpace;
    case SuiteId::kSliding:
      return BenchSliding;
    case SuiteId::kSmallest:
      return BenchSmallest;
    case SuiteId::kScenes:
      return BenchScenes;
  }
  return nullptr;
}

int RunBench(const BenchWords& words) {
  const BenchOptions o = words.Options();
  const auto suite = std::find_if(kSuites.begin(), kSuites.end(), [&o](auto& s) { return s.name == o.suite; });
  const int most = o.generator ? kMaxContacts : suite->most_contacts;
  for (const int contacts : o.contacts) {
    if (contacts > most) {
      throw InputError(fmt::format("bench: --contacts: found {}, expected 1 to {} for suite {}{}", contacts,
                                   most, o.suite, o.generator ? " with a generator" : ""));
    }
  }
  if (o.generator && !Row(*o.generator).IsPlain() && suite->id != SuiteId::kSearch) {
    throw InputError(
        fmt::format("bench: --generator: found {}, expected one of static contacts of the plane for suite {}",
                    Row(*o.generator).name, o.suite));
  }
  return FunctionOf(suite->id)(o);
}

// The words are those of the verb, which the program stands for.
int Main(int argc, char** argv) {
  RequireOneThread(argv);
  CommandLine program(kBenchPurpose, "stiction-bench " + BuildId(), kExitCodes);
  auto [verb, words] = program.Add("bench", kBenchPurpose, RunBench);
  AddBenchWords(verb, words);
  std::vector<char*> arguments(argv, argv + argc);
  char name[] = "bench";
  if (argc != 2 || std::string_view(argv[1]) != "--version") arguments.insert(arguments.begin() + 1, name);
  return program.Run(static_cast<int>(arguments.size()), arguments.data());
}

}  // namespace

int main(int argc, char** argv) { return stiction::RunProgram(argc, argv, Main); }
