// SPDX-License-Identifier: Apache-2.0
#include "cli/bench_words.h"

#include <fmt/format.h>

#include <limits>

namespace stiction {
namespace {

std::vector<AllowedValue> SuiteChoices() {
  std::vector<AllowedValue> choices;
  for (const Suite& suite : kSuites) choices.push_back({std::string(suite.name), std::string(suite.help)});
  return choices;
}

std::vector<std::string> GeneratorNames() {
  std::vector<std::string> names;
  for (const GeneratorRow& row : Generators()) names.emplace_back(row.name);
  return names;
}

std::string MostContacts() {
  std::string most;
  for (const Suite& suite : kSuites)
    most += fmt::format("{}{} {}", most.empty() ? "" : ", ", suite.name, suite.most_contacts);
  return fmt::format("At most: {}; {} with a generator", most, kMaxContacts);
}

constexpr const char* kProblemsOfSuites =
    "adversary: candidates of a row, at most its own 300 to 60000; search: problems per run at two contacts, a "
    "quarter for each contact more, and a twentieth for a unit of the default mix (default 200000); methods, "
    "peers, random: problems of each number of contacts (default 800, 400, 400); structure: at most so many of "
    "a "
    "family; frictionless: at most so many of each number (default 48); linear-algebra: systems of a row "
    "(default 200); trade, extremes: problems of a row (default 60, 25); silent: all (default 20000); gate: of "
    "a setting of a dial (default 25); ratios: "
    "of "
    "a family and size (default 200); space: problems of each family and number of contacts (default 2000); "
    "sliding: problems of each row (default 200000)";

}  // namespace

BenchOptions BenchWords::Options() const {
  BenchOptions result = options;
  result.seed = static_cast<std::uint64_t>(seed);
  result.generator = FindGenerator(generator);
  return result;
}

void AddBenchWords(Verb& verb, BenchWords& words) {
  BenchOptions& o = words.options;
  verb.Option("--suite", o.suite, "what is measured").Choices(SuiteChoices());
  verb.Option("-c,--contacts", o.contacts, "numbers of contacts; by default the suite's own")
      .Range(1, kMostOfAnySuite)
      .Details(MostContacts());
  verb.Option("-n,--problems", o.problems, "how many; by default the suite's own")
      .AtLeast(1)
      .Details(kProblemsOfSuites);
  verb.Option("--repeat", o.repeat, "search, linear-algebra, scenes: counted runs")
      .Range(1, 1000)
      .Details("peers, random, structure: 0.06 seconds each for a row and size");
  verb.Option("--seed", words.seed, "of the problems")
      .Range(0, static_cast<double>(std::numeric_limits<std::int64_t>::max()));
  verb.Option("-g,--generator", words.generator, "search, sliding, patches, linear-algebra: this one alone")
      .OneOf(GeneratorNames())
      .Details("methods: instead of the positive definite family");
  verb.Option("--scenes", o.scenes, "scenes, structure: the folder");
  verb.Option("--families", o.families, "structure, extremes, silent, gate: these alone");
  verb.Option("--csv", o.csv, "trade, extremes: a file for the lines, with intervals");
  verb.Option("-t,--threads", o.threads,
              "scenes: above 1, so many threads beside one, minimal models both; silent: so many")
      .Range(1, 1024);
  verb.Flag("--exact", o.exact, "smallest: every run over rationals, which makes the search exhaustive");
  verb.Option("--entries", o.entries, "smallest: the largest integer of A and b").Range(1, 9);
  verb.Flag("-j,--json", o.json, "machine output");
}

}  // namespace stiction
