// SPDX-License-Identifier: Apache-2.0
// bench --suite search: problems a second of a search, what its time goes to, and how far the limit is.
//
// Rates     of one thread, a second of its processor time: generation, solving over doubles, classification,
//           exact runs of suspicions. By generator and number of contacts; of two contacts by instruction set;
//           of a campaign that names nothing, one round of its schedule, without finishing.
// Threads   one and two over the same units, in wall-clock time.
// Store     time that a thread keeps the store, which one at a time may have, beside that of a unit: how many
// cores
//           one store keeps busy.
// Roofline  operations of one problem, counted, beside the most that one core can do of them in the best
//           instruction set: each kind alone, as if all else were free.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <thread>

#include "bench/counted.h"
#include "bench/output.h"
#include "bench/peak.h"
#include "bench/suite.h"
#include "corpus/exit_code.h"
#include "corpus/json_text.h"
#include "corpus/order_statistics.h"
#include "corpus/record/work.h"
#include "corpus/stopwatch.h"
#include "search/generators/drawing.h"
#include "search/lanes/batch.h"
#include "search/units/unit.h"
#include "solver/problem/lenient.h"
#include "solver/published/published.ipp"

namespace stiction {
namespace {

constexpr std::int64_t kProblems = 200'000;  // of a run at two contacts

double OwnSeconds() { return ReadSeconds(CLOCK_THREAD_CPUTIME_ID); }

std::vector<double> ToJson(const Quartiles& s) { return {s.least, s.median, s.most}; }

// ---- Rates -----------------------------------------------------------------------------------

Quartiles SearchRate(GeneratorId generator, int contacts, InstructionSet lanes, const BenchOptions& o) {
  progress::Begin(fmt::format("{}, {} contacts, {}", Row(generator).name, contacts, Name(lanes)), o.repeat + 1);
  Campaign campaign;
  campaign.seed = o.seed;
  campaign.generators = {generator};
  campaign.contacts = {contacts};
  const std::int64_t problems =
      std::max<std::int64_t>(50, o.problems.value_or(kProblems) >> (2 * std::max(0, contacts - 2)));
  campaign.unit_problems = problems << std::max(0, contacts - 2);  // UnitProblems takes it back
  UnitRunner runner(campaign, {.lanes = lanes});
  std::vector<double> rates;
  for (int run = 0; run <= o.repeat; ++run) {
    const double start = OwnSeconds();
    runner.Run(run);
    const double seconds = OwnSeconds() - start;
    if (run > 0) rates.push_back(static_cast<double>(problems) / seconds);  // the first run warms up
    progress::Done();
  }
  return QuartilesOf(rates);
}

BenchTable MeasureRates(const BenchOptions& o) {
  const std::vector<int> sizes = o.contacts.empty() ? std::vector<int>{2, 3, 5} : o.contacts;
  BenchTable table{"rates", "Problems a second of processor time, one thread: median (least - most)"};
  for (const GeneratorRow& row : Generators()) {
    if (!o.generator.empty() && row.name != o.generator) continue;
    for (const int contacts : sizes)
      table.rows.push_back(
          {{"generator", row.name},
           {"contacts", contacts},
           {"problems a second", ToJson(SearchRate(row.id, contacts, BestInstructionSet(), o))}});
  }
  return table;
}

BenchTable MeasureLanes(const BenchOptions& o) {
  BenchTable table{"lanes", "The same by instruction set; none: one problem after the other"};
  for (const GeneratorRow& row : Generators()) {
    if (!row.IsPlain() || static_cast<int>(row.id) >= kOrdinaryGeneratorCount) continue;
    if (!o.generator.empty() && row.name != o.generator) continue;
    for (const int contacts : {2, 3, 4}) {
      SharedJson line = {{"generator", row.name}, {"contacts", contacts}};
      for (const InstructionSet set : InstructionSets())
        line.Add({{Name(set), ToJson(SearchRate(row.id, contacts, set, o))}});
      table.rows.push_back(std::move(line));
    }
  }
  return table;
}

// ---- The default mix, and threads ------------------------------------------------------------

Campaign DefaultMix(const BenchOptions& o) {
  Campaign campaign;
  campaign.seed = o.seed;
  campaign.unit_problems = std::max<std::int64_t>(50, o.problems.value_or(kProblems) / 20);
  return campaign;
}

struct Mix {
  std::int64_t problems = 0;
  Work work;
  double wall = 0, processor = 0;  // s
};

// One round of the schedule, whose units the threads share.
Mix RunMix(const Campaign& campaign, int threads) {
  const auto units = static_cast<std::int64_t>(Schedule(campaign).size());
  progress::Begin(fmt::format("a round of units, threads: {}", threads), 1);
  std::atomic<std::int64_t> next = 0;
  std::vector<Mix> parts(static_cast<std::size_t>(threads));
  const auto work = [&](Mix& part) {
    const double start = OwnSeconds();
    UnitRunner runner(campaign);
    for (std::int64_t unit = next++; unit < units; unit = next++) {
      const UnitResult result = runner.Run(unit);
      part.problems += result.problems;
      part.work.Add({{}, result.time});
    }
    part.processor = OwnSeconds() - start;
  };
  const double start = ReadSeconds(CLOCK_MONOTONIC);
  {
    std::vector<std::jthread> others;
    for (int k = 0; k < threads; ++k) others.emplace_back(work, std::ref(parts[static_cast<std::size_t>(k)]));
  }
  Mix all;
  all.wall = ReadSeconds(CLOCK_MONOTONIC) - start;
  for (const Mix& part : parts) {
    all.problems += part.problems;
    all.processor += part.processor;
    all.work.Add(part.work);
  }
  progress::Done();
  return all;
}

SharedJson MixRow(const char* generators, const Mix& run) {
  SharedJson row = {{"generators", generators},
                    {"problems", run.problems},
                    {"problems a second", static_cast<double>(run.problems) / run.processor}};
  const double all = static_cast<double>(std::max<std::int64_t>(1, run.work.time.Total()));
  ForEachPart(run.work.time, [&](const char* name, const char*, std::int64_t part) {
    row.Add({{name, static_cast<double>(part) / all}});
  });
  return row;
}

std::vector<BenchTable> MeasureMix(const BenchOptions& o) {
  const Campaign campaign = DefaultMix(o);
  const Mix one = RunMix(campaign, 1), two = RunMix(campaign, 2);
  BenchTable mix{"mix",
                 "A campaign that names nothing, without finishing, and integers at two contacts: shares of "
                 "the processor time"};
  Campaign integers = campaign;
  integers.generators = {GeneratorId::kIntegers};
  integers.contacts = {2};
  integers.unit_problems = o.problems.value_or(kProblems);
  mix.rows.push_back(MixRow("all", one));
  mix.rows.push_back(MixRow("integers", RunMix(integers, 1)));
  BenchTable threads{"threads", "Its units shared by threads, in wall-clock time"};
  for (const auto& [count, run] : {std::pair{1, one}, {2, two}})
    threads.rows.push_back(
        {{"threads", count},
         {"problems a second", static_cast<double>(run.problems) / run.wall},
         {"times one", one.wall / run.wall},
         {"processors busy", run.processor / run.wall},
         {"problems a processor second", static_cast<double>(run.problems) / run.processor}});
  return {mix, threads};
}

// ---- The store -------------------------------------------------------------------------------

// Units of a round of the schedule are added until two blocks have been closed.
BenchTable MeasureStore(const BenchOptions& o) {
  constexpr std::int64_t kUnits = 2 * Store::kUnitsPerBlock;
  const Campaign campaign = DefaultMix(o);
  const auto round = static_cast<std::int64_t>(Schedule(campaign).size());
  progress::Begin("the store", round);
  std::vector<UnitResult> results;
  UnitRunner runner(campaign);
  const double start = OwnSeconds();
  for (std::int64_t unit = 0; unit < round; ++unit) {
    results.push_back(runner.Run(unit));
    progress::Done();
  }
  const double a_unit = (OwnSeconds() - start) / static_cast<double>(round);

  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("stiction-bench-{}", getpid());
  std::filesystem::create_directory(folder);
  std::vector<double> kept;
  {
    Store store(folder / "store", IdentityOf(campaign));
    for (std::int64_t unit = 0; unit < kUnits; ++unit) {
      const UnitResult& result = results[static_cast<std::size_t>(unit % round)];
      const double before = ReadSeconds(CLOCK_MONOTONIC);
      store.AddUnit({}, unit, result.record, unit < round ? result.candidates : std::vector<Finding>(), "",
                    {{}, result.time});
      kept.push_back(ReadSeconds(CLOCK_MONOTONIC) - before);
    }
  }
  std::filesystem::remove_all(folder);
  const double mean = std::accumulate(kept.begin(), kept.end(), 0.0) / static_cast<double>(kUnits);
  const double most = *std::max_element(kept.begin(), kept.end());
  BenchTable table{"store", "Milliseconds of a unit of the default size, and of these with the store"};
  table.rows.push_back({{"a unit", 1e3 * a_unit},
                        {"with the store, mean", 1e3 * mean},
                        {"median", 1e3 * QuartilesOf(kept).median},
                        {"most, a block closed", 1e3 * most},
                        {"cores that it keeps busy", a_unit / mean}});
  return table;
}

// ---- Roofline --------------------------------------------------------------------------------

constexpr int kRows = 4;

// The operations of one problem of `integers` at two contacts: drawing it, the run, the errors of its forces.
OperationCounts CountOperations(const BenchOptions& o, std::int64_t problems, double& steps) {
  ContactProblem<Counted, kRows> problem;
  PublishedAlgorithm<Counted, kRows> algorithm;
  LenientUnits<Counted> units;
  Counted::counts() = {};
  for (std::int64_t index = 0; index < problems; ++index) {
    Choices choices(ProblemSeed(o.seed, 1, static_cast<std::uint64_t>(index)));
    generators::DrawFriction(kDefaultPalette, choices, problem);
    generators::FillIntegers(choices, problem);
    steps += static_cast<double>(algorithm.Run(problem).statistics.steps);
    const auto& f = algorithm.state().f;
    auto a = problem.b;
    for (int i = 0; i < kRows; ++i) {
      for (int j = 0; j < kRows; ++j) a[i] += problem.A(i, j) * f[j];
    }
    MeasureLeniently(problem, FrictionLaw::kCoulomb, f, a, units);
  }
  return Counted::counts();
}

BenchTable MeasureRoofline(const BenchOptions& o) {
  constexpr std::int64_t kCounted = 20'000;
  double steps = 0;
  const OperationCounts counts = CountOperations(o, kCounted, steps);
  const auto each = [](std::int64_t count) { return static_cast<double>(count) / kCounted; };
  // A block is written and read once.
  constexpr double kBytes = 2.0 * sizeof(Block<kRows>) / kBlockProblems;
  const Peak peak = MeasurePeak(BestInstructionSet());
  const double measured = SearchRate(GeneratorId::kIntegers, 2, BestInstructionSet(), o).median;
  BenchTable table{"roofline",
                   fmt::format("One problem of integers, two contacts: what {} allows, and what is reached",
                               Name(BestInstructionSet()))};
  const auto add = [&](const char* what, double of_one, double most) {
    table.rows.push_back({{"what", what},
                          {"steps", steps / kCounted},
                          {"of a problem", of_one},
                          {"most a second", most},
                          {"problems a second at most", most / of_one},
                          {"problems a second", measured},
                          {"reached, %", 100 * measured * of_one / most}});
  };
  add("sums, products, comparisons", each(counts.sums + counts.products + counts.comparisons), peak.operations);
  add("quotients", each(counts.quotients), peak.quotients);
  add("bytes of blocks", kBytes, peak.bytes);
  return table;
}

}  // namespace

int BenchSearch(const BenchOptions& o) {
  progress::Expect((o.generator.empty() ? Generators().size() : 1) *
                       (o.contacts.empty() ? 3 : o.contacts.size()) +
                   (o.generator.empty() ? kOrdinaryGeneratorCount : 1) * 3 * InstructionSets().size() +
                   (o.generator.empty() ? 5 : 0));
  std::vector<BenchTable> tables = {MeasureRates(o)};
  progress::Clear();
  if (!o.json) Print(tables.back());
  const auto take = [&](BenchTable table) {
    progress::Clear();
    if (!o.json) Print(table);
    std::fflush(stdout);
    tables.push_back(std::move(table));
  };
  take(MeasureLanes(o));
  if (o.generator.empty()) {
    for (BenchTable& table : MeasureMix(o)) take(std::move(table));
    take(MeasureStore(o));
    take(MeasureRoofline(o));
  }
  if (o.json) {
    SharedJson json;
    for (const BenchTable& table : tables) json.Add({{table.name, table.rows}});
    std::cout << JsonText(json) << "\n";
  }
  return kExitDone;
}

}  // namespace stiction
