// SPDX-License-Identifier: Apache-2.0
#include "cli/bench_words.h"

#include <fmt/format.h>

#include <limits>

#include "corpus/named_rows.h"

namespace stiction {
namespace {

std::vector<AllowedValue> SuiteChoices() {
  std::vector<AllowedValue> choices;
  for (const Suite& suite : kSuites) choices.push_back({std::string(suite.name), std::string(suite.help)});
  return choices;
}

std::string MostContacts() {
  std::string most;
  for (const Suite& suite : kSuites)
    most += fmt::format("{}{} {}", most.empty() ? "" : ", ", suite.name, suite.most_contacts);
  return "At most: " + most;
}

std::string WhatProblemsCount() {
  std::string text;
  for (const Suite& suite : kSuites) {
    if (!suite.problems.empty())
      text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", suite.name, suite.problems);
  }
  return text;
}

}  // namespace

void AddBenchWords(Verb& verb, BenchOptions& o) {
  verb.Option("--suite", o.suite, "what is measured").Choices(SuiteChoices());
  verb.Option("-c,--contacts", o.contacts, "numbers of contacts; by default the suite's own")
      .Range(1, kMostOfAnySuite)
      .Details(MostContacts());
  verb.Option("-n,--problems", o.problems, "how many; by default the suite's own")
      .AtLeast(1)
      .Details(WhatProblemsCount());
  verb.Option("--repeat", o.repeat, "search, scenes: counted runs")
      .Range(1, 1000)
      .Details("peers, random, structure: 0.06 seconds each for a row and size");
  verb.Option("--seed", o.seed, "of the problems")
      .Range(0, static_cast<double>(std::numeric_limits<std::int64_t>::max()));
  verb.Option("-g,--generator", o.generator, "search: this one alone").OneOf(NamesOf(Generators()));
  verb.Option("--scenes", o.scenes, "scenes, frames, structure: the folder");
  verb.Option("--families", o.families,
              "structure, engines, problems, silent, gate: these alone; frames: levels");
  verb.Option("-t,--threads", o.threads,
              "scenes: above 1, so many threads beside one, minimal models both; silent: so many")
      .Range(1, 1024);
  verb.Prints(o.json, "the rows of a suite, each suite its own", "[any] | object");
}

}  // namespace stiction
