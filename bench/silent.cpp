// SPDX-License-Identifier: Apache-2.0
// bench --suite silent: wrong answers that say nothing of it, counted over all generators and dials.
//
// Problems come in rounds, one from each source; large ones in one round of kLargeEvery. Each is given to one
// method, the methods in turn, over all rungs. A problem is a function of seed, source and round: threads take
// the rounds as they come, and the counts do not depend on them.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <iostream>
#include <map>
#include <thread>

#include "bench/progress.h"
#include "bench/rungs.h"
#include "bench/sources.h"
#include "bench/suite.h"
#include "bench/table.h"
#include "corpus/exit_code.h"
#include "corpus/intervals.h"

namespace stiction {
namespace {

constexpr std::int64_t kLargeEvery = 100;
constexpr std::size_t kExamples = 20;

// Rows of one method.
using RowsByMethod = std::vector<std::vector<RungRow>>;

RowsByMethod AllRows() {
  RowsByMethod methods;
  for (RungRow& row : RungRows(/*remedies=*/false)) {
    if (methods.empty() || methods.back().front().method != row.method) methods.emplace_back();
    methods.back().push_back(std::move(row));
  }
  return methods;
}

// What answers came to.
struct SilentCounts {
  std::map<std::string, RungTally> rows;                       // by method and rung
  std::vector<std::pair<std::int64_t, std::string>> examples;  // by place among all problems

  void Add(const Source& source, std::int64_t place, std::int64_t round, std::uint64_t seed,
           const std::vector<RungRow>& method) {
    const RungProblem problem(source.make(seed, round));
    for (const RungRow& row : method) {
      RungTally& tally = rows[row.method + " " + row.Name()];
      if (tally.Count(row, problem, row.Run(problem), source.has_solution))
        examples.emplace_back(place, fmt::format("{} at {}, problem {}: {} over {}", source.family,
                                                 source.setting, round, row.method, row.Name()));
      tally.seconds.clear();
      tally.residuals.clear();
    }
  }

  void Merge(const SilentCounts& other) {
    for (const auto& [name, tally] : other.rows) rows[name].Merge(tally);
    examples.insert(examples.end(), other.examples.begin(), other.examples.end());
    std::sort(examples.begin(), examples.end());
  }
};

// The rounds that `next` gives, of the first `problems` problems.
SilentCounts CountRounds(const std::vector<Source>& sources, const RowsByMethod& methods, std::int64_t problems,
                         std::uint64_t seed, std::atomic<std::int64_t>& next) {
  const std::int64_t large = std::count_if(sources.begin(), sources.end(), std::mem_fn(&Source::is_large));
  const std::int64_t others = static_cast<std::int64_t>(sources.size()) - large;
  SilentCounts counts;
  for (;;) {
    const std::int64_t round = next++;
    std::int64_t place = round * others + (round + kLargeEvery - 1) / kLargeEvery * large;
    if (place >= problems) return counts;
    for (const Source& source : sources) {
      const std::int64_t every = source.is_large ? kLargeEvery : 1;
      if (round % every != 0 || place >= problems) continue;
      const std::size_t turn = static_cast<std::size_t>(round / every) % methods.size();
      counts.Add(source, place++, round, seed, methods[turn]);
      progress::Done();
    }
  }
}

SilentCounts CountSilent(const std::vector<Source>& sources, std::int64_t problems, std::uint64_t seed,
                         int threads) {
  const RowsByMethod methods = AllRows();
  std::vector<SilentCounts> parts(threads);
  std::atomic<std::int64_t> next{0};
  progress::Expect(1);
  progress::Begin("problems", problems);
  {
    std::vector<std::jthread> running;
    for (SilentCounts& part : parts)
      running.emplace_back([&] { part = CountRounds(sources, methods, problems, seed, next); });
  }
  for (int thread = 1; thread < threads; ++thread) parts[0].Merge(parts[thread]);
  return std::move(parts[0]);
}

}  // namespace

int BenchSilent(const BenchOptions& o) {
  std::vector<Source> sources = DialSources(o.families);
  if (o.families.empty()) {
    for (Source& source : GeneratorSources({1, 2, 3, 4})) sources.push_back(std::move(source));
  }
  const std::int64_t problems = o.problems.value_or(20000);
  SilentCounts counts = CountSilent(sources, problems, o.seed, o.threads);
  progress::Clear();
  BenchTable table{"silent",
                   fmt::format("{} problems, seed {}, of {} sources", problems, o.seed, sources.size()),
                   Json::array()};
  std::int64_t silent = 0;
  for (const auto& [name, tally] : counts.rows) {
    silent += tally.silent;
    const std::int64_t asked = tally.problems - tally.refused;
    table.rows.push_back(
        {{"row", name},
         {"problems", asked},
         {"solved", tally.solved},
         {"undecided", tally.undecided},
         {"other", tally.other},
         {"silent", tally.silent},
         {"at most in a million",
          CountInterval(tally.silent).high / static_cast<double>(std::max<std::int64_t>(asked, 1)) * 1e6}});
  }
  Json examples = Json::array();
  for (std::size_t i = 0; i < std::min(kExamples, counts.examples.size()); ++i)
    examples.push_back(counts.examples[i].second);
  if (o.json) {
    std::cout << JsonText({{"rows", table.rows}, {"examples", examples}}) << "\n";
  } else {
    Print(table);
    for (const Json& example : examples) fmt::print("{}\n", example.get<std::string>());
    fmt::print("silently wrong: {}\n", silent);
  }
  return silent == 0 ? kExitDone : kExitNotSo;
}

}  // namespace stiction
