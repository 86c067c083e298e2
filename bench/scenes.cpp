// SPDX-License-Identifier: Apache-2.0
// bench --suite scenes: frames a second with the whole frame counted, and what the minimal model, or more
// threads, save.

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <utility>

#include "bench/measure.h"
#include "bench/progress.h"
#include "bench/suite.h"
#include "corpus/scene_file.h"
#include "corpus/stopwatch.h"
#include "scene/simulate.h"

namespace stiction {
namespace {

constexpr std::int64_t kFrames = 600;  // at most, of one run

// One side of the table.
struct Way {
  std::string name;
  bool minimal = true;
  int threads = 1;
};

struct Measured {
  std::vector<double> rates;      // frames a second, of each run
  double rows = 0, problems = 0;  // of a frame
  std::string failure;
};

template <class Kind>
void RunOnce(const SceneFileIn<Kind>& file, const Way& way, Measured& measured) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, way.threads);
  SimulationOptions options;
  options.step = ToDouble(file.step);
  options.minimal = way.minimal;
  const auto frames = std::clamp<std::int64_t>(std::llround(ToDouble(file.seconds) / options.step), 1, kFrames);
  SimulationIn<Kind> simulation(Round(file.scene), options);
  const Stopwatch watch(CLOCK_MONOTONIC);  // threads of their own
  try {
    for (std::int64_t k = 0; k < frames; ++k) simulation.Step();
  } catch (const SimulationError& error) {
    measured.failure = error.what();
    return;
  }
  measured.rates.push_back(static_cast<double>(frames) / watch.Seconds());
  measured.rows = static_cast<double>(simulation.statistics().rows) / static_cast<double>(frames);
  measured.problems = static_cast<double>(simulation.statistics().problems) / static_cast<double>(frames);
}

// Both ways by turns, so that what else the machine does meets both.
struct Pair {
  Measured first, second;
  Spread ratio;  // of the rates of a turn, first to second

  std::string failure() const { return first.failure.empty() ? second.failure : first.failure; }
};

template <class Kind>
Pair MeasureScene(const SceneFileIn<Kind>& file, const std::array<Way, 2>& ways, int repeat) {
  Pair pair;
  for (int run = 0; run < repeat; ++run) {
    RunOnce(file, ways[0], pair.first);
    RunOnce(file, ways[1], pair.second);
    progress::Done();
  }
  if (!pair.failure().empty()) return pair;
  std::vector<double> ratios;
  for (int run = 0; run < repeat; ++run) ratios.push_back(pair.first.rates[run] / pair.second.rates[run]);
  pair.ratio = SpreadOf(std::move(ratios));
  return pair;
}

Json ToJson(const Spread& s) { return {{"least", s.least}, {"median", s.median}, {"most", s.most}}; }

Json ToJson(const Measured& m) {
  if (!m.failure.empty()) return {{"failure", m.failure}};
  return {{"frames_a_second", ToJson(SpreadOf(m.rates))}, {"rows", m.rows}, {"problems", m.problems}};
}

void PrintHead(const std::array<Way, 2>& ways) {
  fmt::print(
      "frames a second, contacts, assembly and solving counted: median (least - most); rows and problems of a\n"
      "frame; ratio of the first to the second, run by turns\n");
  fmt::print("{:24} {:>32} {:>6} {:>6} | {:>32} {:>6} {:>6} | {}\n", "scene", ways[0].name, "rows", "prob.",
             ways[1].name, "rows", "prob.", "ratio");
}

void PrintRow(const std::string& name, const Pair& pair) {
  if (!pair.failure().empty()) {
    fmt::print("{:24} {}\n", name, pair.failure());
    return;
  }
  const auto rates = [](const Measured& m) {
    const Spread rate = SpreadOf(m.rates);
    return fmt::format("{:.0f} ({:.0f} - {:.0f})", rate.median, rate.least, rate.most);
  };
  fmt::print("{:24} {:>32} {:>6.1f} {:>6.2f} | {:>32} {:>6.1f} {:>6.2f} | {:.2f} ({:.2f} - {:.2f})\n", name,
             rates(pair.first), pair.first.rows, pair.first.problems, rates(pair.second), pair.second.rows,
             pair.second.problems, pair.ratio.median, pair.ratio.least, pair.ratio.most);
  std::fflush(stdout);
}

}  // namespace

int BenchScenes(const BenchOptions& o) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(o.scenes, error)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  if (error || files.empty())
    throw InputError(fmt::format("{}: found no scenes, expected a folder of stiction-scene files", o.scenes));
  std::sort(files.begin(), files.end());
  std::array<Way, 2> ways = {Way{"minimal", true, 1}, Way{"full", false, 1}};
  if (o.threads > 1)
    ways = {Way{fmt::format("{} threads", o.threads), true, o.threads}, Way{"1 thread", true, 1}};
  Json rows = Json::array();
  if (!o.json) PrintHead(ways);
  progress::Expect(files.size());
  for (const auto& path : files) {
    const auto file = ReadAnyScene(path);
    const auto name = std::visit([](const auto& of) { return of.scene.name; }, file);
    progress::Begin(name, o.repeat);
    const Pair pair = std::visit([&](const auto& of) { return MeasureScene(of, ways, o.repeat); }, file);
    progress::Clear();
    rows.push_back({{"scene", name},
                    {ways[0].name, ToJson(pair.first)},
                    {ways[1].name, ToJson(pair.second)},
                    {"ratio", ToJson(pair.ratio)}});
    if (!o.json) PrintRow(name, pair);
  }
  if (o.json) std::cout << JsonText(rows) << "\n";
  return 0;
}

}  // namespace stiction
