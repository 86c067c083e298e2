// SPDX-License-Identifier: Apache-2.0
// Traces of every generator, recorded under a version of the algorithms: runs that change without a new version
// make every number that a search ever counted doubtful.

#include "search/algorithm_version.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "certify/existence.h"
#include "corpus/rational.h"
#include "search/unit.h"

namespace stiction {
namespace {

struct RecordedTrace {
  std::string_view generator;
  std::uint64_t runs;  // hash of all that is counted
};

struct RecordedTraces {
  int version;
  std::vector<RecordedTrace> traces;
};

const RecordedTraces kRecorded = {1,
                                  {{"integers", 0x9c01ef2974f7a68d},
                                   {"psd", 0x8981c02d1d246330},
                                   {"small", 0x7d32ade19289f519},
                                   {"near-degenerate", 0x00d25e5c59d1f6c5},
                                   {"duplicates", 0x8d6a923acacbf3c6},
                                   {"conditioned", 0xbf771aa7d7961dec},
                                   {"bodies", 0xedf161dccdb04304},
                                   {"exponential", 0x3e740c1d0aeeab0d},
                                   {"scenes", 0xbcc821a4f1eb3a18},
                                   {"fine-scenes", 0x39a7273bb41d34a1},
                                   {"one-body", 0x35ac34f6f64cc45d},
                                   {"bilateral", 0xa38e206048dffc2e},
                                   {"sliding", 0xfa32f9f53235928a},
                                   {"space", 0x61d9ada2a2dc2d15}}};

// FNV-1a.
std::uint64_t TraceHash(const std::string& text) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash;
}

template <class Values>
std::string Numbers(const Values& values) {
  std::string text;
  for (const std::int64_t value : values) text += fmt::format("{} ", value);
  return text + "\n";
}

// What a unit counts of the runs over doubles and of those over rationals.
std::string CountedRuns(const Record& record) {
  std::string text;
  for (const auto& [key, tally] : record.tallies) {
    text += fmt::format("{} {} {}: {} {} {}\n", key.generator, key.contacts, key.policy, tally.problems,
                        tally.audited, tally.misjudged);
    text += Numbers(tally.outcomes) + Numbers(tally.steps);
    for (const auto& row : tally.verdicts) text += Numbers(row);
    ForEachField(tally.sums,
                 [&text](const char*, const char*, std::int64_t sum) { text += fmt::format("{} ", sum); });
  }
  for (const auto& [contacts, tally] : record.existence)
    ForEachCounter(tally, [&text](const char*, std::int64_t value) { text += fmt::format("{} ", value); });
  for (const auto& [signature, count] : record.signatures) text += fmt::format("{} {}\n", signature, count);
  return text;
}

// Forces and steps of one problem over rationals, by complete driving and by Lemke's method.
std::string ExactPaths(const ExactProblem& problem) {
  const CompleteRun complete = RunComplete(problem, Limits{});
  const LemkeRun lemke = RunLemke(problem, Limits{});
  std::string text =
      fmt::format("{} {}\n", complete.verdict.statistics.pieces, lemke.verdict.statistics.pivots);
  for (const auto* f : {&complete.f, &lemke.f}) {
    for (const Rational& force : *f) text += force.get_str() + " ";
  }
  return text;
}

std::string TraceOf(std::string_view generator) {
  Campaign campaign;
  campaign.seed = 7;
  campaign.generators = {*FindGenerator(generator)};
  campaign.contacts = {2, 3, 4};
  const bool in_space = Row(campaign.generators.front()).InSpace();
  campaign.policies = {
      Policy{}, ParsePolicy(in_space ? "admit=eager,slip=redirect" : "admit=eager,file=yes,apex=suspended")};
  campaign.unit_problems = 200;
  campaign.audit_every = 20;
  campaign.complete_every = 1;  // all that is suspected, over rationals
  std::string text;
  UnitRunner runner(campaign);
  for (std::int64_t unit = 0; unit < static_cast<std::int64_t>(Schedule(campaign).size()); ++unit) {
    text += CountedRuns(runner.Run(unit).record);
    for (const std::int64_t index : {0, 1, 2, 3})
      if (!in_space) text += ExactPaths(RegenerateExactly(campaign, unit, index));
  }
  return text;
}

}  // namespace

TEST_CASE("algorithm version: runs are those that were recorded under it") {
  REQUIRE(kRecorded.version == kAlgorithmVersion);
  CHECK(kRecorded.traces.size() == kGeneratorCount);
  for (const RecordedTrace& recorded : kRecorded.traces) {
    INFO(recorded.generator
         << ": its runs have changed; if they were meant to, raise kAlgorithmVersion and record "
         << "them again");
    CHECK(TraceHash(TraceOf(recorded.generator)) == recorded.runs);
  }
}

}  // namespace stiction
