// SPDX-License-Identifier: Apache-2.0
// stiction-bench: timings, by hand and never as a test. `stiction bench` becomes it.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iostream>
#include <limits>
#include <memory>

#include "bench/one_thread.h"
#include "bench/suite.h"
#include "corpus/exit_code.h"
#include "corpus/input_error.h"

namespace stiction {
namespace {

struct Suite {
  std::string_view name, help;
  int most_contacts;  // that --contacts may ask for
  int (*run)(const BenchOptions&);
};

constexpr int kMostOfMethods = 30;  // 4^n - 1 pieces are counted in 64 bits

constexpr std::array kSuites = {
    Suite{"adversary", "the optimizers of a search beside random problems, by objective", kMaxContacts,
          BenchAdversary},
    Suite{"patches", "ways to change the published algorithm, and how often each still fails", kMaxContacts,
          BenchPatches},
    Suite{"search",
          "problems a second of a search, the split of its time, threads, a roofline, Siconos's Lemke",
          kMaxContacts, BenchSearch},
    Suite{"trade", "speed against accuracy: every method over every arithmetic, on the generators",
          kMaxContacts, BenchTrade},
    Suite{"extremes", "the same along dials: masses, levers, units, conditioning, friction, ...", kMaxContacts,
          BenchExtremes},
    Suite{"silent", "wrong answers that say nothing of it, counted over generators and dials", kMaxContacts,
          BenchSilent},
    Suite{"ratios", "certified outcomes beside doubles, staged searches beside exact ones", kMaxContacts,
          BenchRatios},
    Suite{"methods", "the methods side by side: counts, outcomes, times", kMostOfMethods, BenchMethods},
    Suite{"frictionless", "section 4 beside elimination and quadratic programs, to 150 contacts", 2000,
          BenchFrictionless},
    Suite{"peers", "stiction beside other packages, by the program stiction-peers", 2000, BenchPeers},
    Suite{"random", "of it, random problems by the number of contacts", 2000, BenchRandom},
    Suite{"structure", "of it, stacks, walls, scenes, nearly dependent rows", 2000, BenchStructure},
    Suite{"peers-extremes", "of it, the dials of extremes, judged over rationals", 2000, BenchPeersExtremes},
    Suite{"growth", "of it, time and memory at up to 2000 contacts", 2000, BenchGrowth},
    Suite{"linear-algebra", "ways to solve a linear system exactly, side by side", kMaxContacts,
          BenchLinearAlgebra},
    Suite{"space", "readings of section 5.6 in space: counts and outcomes", 12, BenchSpace},
    Suite{"sliding", "section 6, contacts that slide: counts and outcomes", kMaxContacts, BenchSliding},
    Suite{"smallest", "loops of two contacts with small integers, A definite, mu = 1", kMaxContacts,
          BenchSmallest},
    Suite{"scenes",
          "frames a second of the scenes of a folder, minimal and full models, or one thread and more",
          kMaxContacts, BenchScenes},
};

int RunBench(const BenchOptions& o) {
  const auto suite = std::find_if(kSuites.begin(), kSuites.end(), [&o](auto& s) { return s.name == o.suite; });
  const int most = o.generator ? kMaxContacts : suite->most_contacts;
  for (const int contacts : o.contacts) {
    if (contacts > most) {
      throw InputError(fmt::format("--contacts: found {}, expected 1 to {} for suite {}{}", contacts, most,
                                   o.suite, o.generator ? " with a generator" : ""));
    }
  }
  if (o.generator && !Row(*o.generator).IsPlain() && suite->name != "search") {
    throw InputError(
        fmt::format("--generator: found {}, expected one of static contacts of the plane for suite {}",
                    Row(*o.generator).name, o.suite));
  }
  return suite->run(o);
}

void AddOptions(CLI::App& verb, const std::shared_ptr<BenchOptions>& o) {
  std::vector<std::string> suites, generators;
  std::string help;
  for (const Suite& suite : kSuites) {
    suites.emplace_back(suite.name);
    help += fmt::format("{}{}: {}", help.empty() ? "" : "; ", suite.name, suite.help);
  }
  for (const GeneratorRow& row : Generators()) generators.emplace_back(row.name);
  verb.add_option("--suite", o->suite, help)->capture_default_str()->check(CLI::IsMember(suites));
  std::string limits;
  for (const Suite& suite : kSuites)
    limits += fmt::format("{}{} {}", limits.empty() ? "" : ", ", suite.name, suite.most_contacts);
  verb.add_option("--contacts", o->contacts,
                  fmt::format("numbers of contacts; at most: {}; {} with a generator", limits, kMaxContacts))
      ->check(CLI::PositiveNumber);
  verb.add_option(
          "--problems", o->problems,
          "adversary: candidates of a row, at most its own 300 to 60000; search: problems per run at two "
          "contacts, a "
          "quarter for each contact more, and a twentieth for a unit of the default mix (default 200000); "
          "methods, peers, random: problems of each number of contacts (default 800, 400, 400); structure: at "
          "most "
          "so many of a family; frictionless: at most so many of each number (default 48); linear-algebra: "
          "systems of a row (default 200); trade, extremes: problems of a row (default 60, 25); silent: all "
          "(default 20000); ratios: of a family and size (default 200); space: problems of each family and "
          "number of contacts "
          "(default 2000); sliding: problems of each row (default 200000)")
      ->check(CLI::PositiveNumber);
  verb.add_option("--repeat", o->repeat,
                  "search, linear-algebra, scenes: counted runs; peers, random, structure: 0.06 seconds each "
                  "for a row and "
                  "size")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  verb.add_option("--seed", o->seed, "of the problems")
      ->capture_default_str()
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()));
  verb.add_option_function<std::string>(
          "--generator", [o](const std::string& name) { o->generator = FindGenerator(name); },
          "search, sliding: this one alone; methods: instead of the positive definite family")
      ->check(CLI::IsMember(generators));
  verb.add_option("--scenes", o->scenes, "scenes, structure: the folder")->capture_default_str();
  verb.add_option("--families", o->families, "structure, extremes, silent: these alone");
  verb.add_option("--csv", o->csv, "trade, extremes: a file for the lines, with intervals");
  verb.add_option("--threads", o->threads,
                  "scenes: above 1, so many threads beside one, minimal models both; silent: so many")
      ->capture_default_str()
      ->check(CLI::Range(1, 1024));
  verb.add_flag("--exact", o->exact, "smallest: every run over rationals, which makes the search exhaustive");
  verb.add_option("--entries", o->entries, "smallest: the largest integer of A and b")
      ->capture_default_str()
      ->check(CLI::Range(1, 9));
  verb.add_flag("--json", o->json, "machine output");
}

int Main(int argc, char** argv) {
  RequireOneThread(argv);
  CLI::App program{"stiction bench: timings, by hand and never as a test", "stiction bench"};
  const auto o = std::make_shared<BenchOptions>();
  AddOptions(program, o);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? kExitDone : kExitBadInput;
  }
  return RunBench(*o);
}

}  // namespace
}  // namespace stiction

int main(int argc, char** argv) {
  try {
    return stiction::Main(argc, argv);
  } catch (const stiction::InputError& error) {
    std::cerr << "stiction: " << error.what() << "\n";
    return stiction::kExitBadInput;
  } catch (const std::exception& error) {
    std::cerr << "stiction: internal error: " << error.what() << "\n";
    return stiction::kExitInternal;
  }
}
