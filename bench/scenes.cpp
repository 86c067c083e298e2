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
#include <vector>

#include "bench/output.h"
#include "bench/suite.h"
#include "corpus/exit_code.h"
#include "corpus/input_error.h"
#include "corpus/json.h"
#include "corpus/order_statistics.h"
#include "corpus/record/scene_file.h"
#include "corpus/stopwatch.h"
#include "scene/simulate.h"

namespace stiction {
namespace {

// One side of the table.
struct Way {
  std::string name;
  bool minimal = true;
  int threads = 1;
  std::vector<double> rates = {};  // frames a second, of each run
  double rows = 0, problems = 0;   // of a frame
  std::string failure = {};
};
using Ways = std::array<Way, 2>;

template <class Kind>
void RunOnce(const SceneFileIn<Kind>& file, Way& way) {
  constexpr std::int64_t kFrames = 600;  // at most
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, way.threads);
  const double step = ToDouble(file.step);
  const auto frames = std::clamp<std::int64_t>(std::llround(ToDouble(file.seconds) / step), 1, kFrames);
  SimulationIn<Kind> simulation(Round(file.scene), step);
  simulation.minimal = way.minimal;
  const Stopwatch watch(CLOCK_MONOTONIC);  // threads of their own
  for (std::int64_t k = 0; k < frames; ++k) {
    simulation.Step();
    if (simulation.undecided().empty()) continue;
    way.failure = TextOf(simulation.undecided().front());
    return;
  }
  way.rates.push_back(static_cast<double>(frames) / watch.Seconds());
  way.rows = static_cast<double>(simulation.statistics().rows) / static_cast<double>(frames);
  way.problems = static_cast<double>(simulation.statistics().problems) / static_cast<double>(frames);
}

Json ToJson(std::vector<double> values) {
  const Quartiles s = QuartilesOf(std::move(values));
  return {{"least", s.least}, {"median", s.median}, {"most", s.most}};
}

Json ToJson(const Way& way) {
  if (!way.failure.empty()) return {{"failure", way.failure}};
  return {{"frames_a_second", ToJson(way.rates)}, {"rows", way.rows}, {"problems", way.problems}};
}

// Both ways by turns, so that what else the machine does meets both; ratios are of the rates of a turn.
template <class Kind>
Json MeasureScene(const SceneFileIn<Kind>& file, Ways ways, int repeat) {
  for (int run = 0; run < repeat; ++run) {
    for (Way& way : ways) RunOnce(file, way);
    progress::Done();
  }
  std::vector<double> ratios;
  for (std::size_t run = 0; run < std::min(ways[0].rates.size(), ways[1].rates.size()); ++run)
    ratios.push_back(ways[0].rates[run] / ways[1].rates[run]);
  return {{"scene", file.scene.name},
          {ways[0].name, ToJson(ways[0])},
          {ways[1].name, ToJson(ways[1])},
          {"ratio", ToJson(ratios)}};
}

// The same for people.
Json ShownRow(const Json& row, const Ways& ways) {
  const auto spread = [](const Json& of) { return Json{of["least"], of["median"], of["most"]}; };
  Json shown = {{"scene", row["scene"]}};
  for (const Way& way : ways) {
    const Json& measured = row[way.name];
    const bool failed = measured.contains("failure");
    shown[way.name] = failed ? Json("-") : spread(measured["frames_a_second"]);
    for (const char* name : {"rows", "problems"})
      shown[fmt::format("{}, {}", name, way.name)] = failed ? Json("-") : measured[name];
  }
  shown["ratio"] = spread(row["ratio"]);
  return shown;
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
  Ways ways = {Way{"minimal", true, 1}, Way{"full", false, 1}};
  if (o.threads > 1)
    ways = {Way{fmt::format("{} threads", o.threads), true, o.threads}, Way{"1 thread", true, 1}};
  Json rows = Json::array();
  BenchTable table{"scenes",
                   "frames a second, contacts, assembly and solving counted: median (least - most); rows and "
                   "problems of a frame; ratio of the first to the second, run by turns"};
  progress::Expect(files.size());
  for (const auto& path : files) {
    const auto file = ReadAnyScene(path);
    progress::Begin(std::visit([](const auto& of) { return of.scene.name; }, file), o.repeat);
    rows.push_back(std::visit([&](const auto& of) { return MeasureScene(of, ways, o.repeat); }, file));
    table.rows.push_back(ShownRow(rows.back(), ways));
  }
  progress::Clear();
  if (o.json) {
    std::cout << JsonText(rows) << "\n";
    return kExitDone;
  }
  Print(table);
  for (const Json& row : rows) {
    if (row[ways[0].name].contains("failure"))
      fmt::print("{}: {}\n", row["scene"].get<std::string>(), row[ways[0].name]["failure"].get<std::string>());
  }
  return kExitDone;
}

}  // namespace stiction
