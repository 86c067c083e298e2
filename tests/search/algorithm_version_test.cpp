// SPDX-License-Identifier: Apache-2.0
// Traces of every generator, recorded under a version of the algorithms: runs that change without a new version
// make every number that a search ever counted doubtful. A generator whose test has a file of its own is
// recorded there.

#include "search/algorithm_version.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "certify/exact/exact.h"
#include "corpus/rational.h"
#include "search/units/regenerate.h"
#include "search/units/unit.h"
#include "solver/problem/reduction.h"
#include "tests/methods.h"
#include "tests/search/recorded.h"

namespace stiction {
namespace {

using namespace testing;

constexpr int kRecordedVersion = 1, kRecordedCounts = 6;

[[maybe_unused]] const bool kRecorded = AddRecorded({
    {"integers", 0xe9843a6c5c02462a, 0xe66e955f691617dc, 0x9ccd3f08e0166c16},
    {"psd", 0x9b7decbea7385274, 0x5ea1474f722a822d, 0x787214d5f634c671},
    {"small", 0x1f58d55260819c5d, 0x6429d7d654b5534d, 0x24e5948a1baf9d99},
    {"near-degenerate", 0x61552515ac86d439, 0xec877c091c976030, 0x10c3fe6e39f25067},
    {"duplicates", 0x0087249eeaa2bc61, 0xc36744741237643b, 0xfeedf11e15a075a8},
    {"conditioned", 0xa9098b9430b81db6, 0x6e21fb2c7e1eb716, 0x80971450b37fbe88},
    {"bodies", 0x47c17bf2f082462f, 0xd0cb0af9521133b4, 0xb10b21f2e09e10f2},
    {"exponential", 0x0bc20b168cbd5e1a, 0xb4eeea2e54221636, 0x6e5a713e55b9bf0a},
    {"scenes", 0x5c5b6d4ae415d167, 0x3132f6182f91e9cc, 0x195245489913837d},
    {"fine-scenes", 0xc24e4d6827d7e2b7, 0x6146ca2b7d49ef0e, 0x4b079e6b9c94faf1},
    {"one-body", 0x4b1653797c74102c, 0x7afebe7752735556, 0x3eac67a4e2cdd961},
    {"bilateral", 0x574cd16dd5e23573, 0x1827641e6d2cb556, 0xbde3f6d024edb5b1},
    {"sliding", 0x7a8606ec92c5b379, 0x594386b969df6896, 0xfa92d86b0b40538c},
    {"space", 0xbf9127b747b09375, 0xe7ac8e93d8809bc9, 0x9e5b6e1637dec356},
});

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

struct TraceText {
  std::string runs, rest;
};

// What a unit counts of the runs over doubles, and of those over rationals.
TraceText CountedRuns(const Record& record) {
  TraceText text;
  for (const auto& [key, tally] : record.tallies) {
    text.runs += fmt::format("{} {} {}: {}\n", key.generator, key.contacts, key.policy, tally.problems);
    text.runs += Numbers(tally.outcomes) + Numbers(tally.steps);
    ForEachField(tally.sums,
                 [&text](const char*, const char*, std::int64_t sum) { text.runs += fmt::format("{} ", sum); });
    text.rest += fmt::format("{} {}\n", tally.audited, tally.misjudged);
    for (const auto& row : tally.verdicts) text.rest += Numbers(row);
  }
  for (const auto& [contacts, tally] : record.existence)
    ForEachCounter(tally, [&text](const char*, std::int64_t value) { text.rest += fmt::format("{} ", value); });
  for (const auto& [signature, count] : record.signatures)
    text.rest += fmt::format("{} {}\n", signature, count);
  return text;
}

// Forces and steps of one problem over rationals, by complete driving and by Lemke's method.
std::string ExactPaths(const ExactProblem& problem) {
  ExactAnswer complete = RunComplete(problem, Limits{});
  const ExactAnswer lemke = RunLemke(problem, Limits{});
  std::string text =
      fmt::format("{} {}\n", complete.counters[Counter::kPieces], lemke.counters[Counter::kPivots]);
  // Where complete driving does not solve it, forces are those of what sliding contacts leave.
  const Reduction<Rational> reduction(problem);
  if (!complete.Solved() && reduction.end() == ReductionEnd::kReduced)
    complete.f = RunComplete(reduction.problem(), Limits{}).f;
  for (const ExactProblem::Vector* f : {&std::as_const(complete.f), &lemke.f}) {
    for (const Rational& force : *f) text += force.get_str() + " ";
  }
  return text;
}

TraceText TraceOf(std::string_view generator) {
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
  TraceText text;
  UnitRunner runner(campaign);
  for (std::int64_t unit = 0; unit < static_cast<std::int64_t>(Schedule(campaign).size()); ++unit) {
    const TraceText counted = CountedRuns(runner.Run(unit).record);
    text.runs += counted.runs;
    text.rest += counted.rest;
    for (const std::int64_t index : {0, 1, 2, 3})
      if (!in_space) text.runs += ExactPaths(Regenerate(campaign, unit, index).problem);
  }
  return text;
}

}  // namespace

TEST_CASE("algorithm version: runs are those that were recorded under it, and so is what is counted of them",
          "[slow]") {
  REQUIRE(kRecordedVersion == kAlgorithmVersion);
  REQUIRE(kRecordedCounts == kCountsVersion);
  CHECK(AllRecorded().size() == kGeneratorCount);
  for (const GeneratorRow& row : Generators()) {
    const TraceText text = TraceOf(row.name);
    const Recorded recorded = RecordedOf(row.name);
    INFO(
        fmt::format("{}: its runs, or what is counted of them, have changed; if that was meant, raise "
                    "kAlgorithmVersion and "
                    "kCountsVersion, or the second alone, and record them again: {:#018x}, {:#018x}",
                    row.name, TraceHash(text.runs), TraceHash(text.runs + text.rest)));
    CHECK(TraceHash(text.runs) == recorded.runs);
    CHECK(TraceHash(text.runs + text.rest) == recorded.counts);
  }
}

}  // namespace stiction
