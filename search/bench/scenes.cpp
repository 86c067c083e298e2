// SPDX-License-Identifier: Apache-2.0
// bench --suite scenes: frames a second with the whole frame counted, and what the minimal model saves.

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <utility>

#include "corpus/scene_file.h"
#include "search/bench/suite.h"
#include "solver/scene/simulate_space.h"

namespace stiction {
namespace {

constexpr std::int64_t kFrames = 600;  // at most, of one run

struct Measured {
  std::vector<double> rates;      // frames a second, of each run; sorted at the end
  double rows = 0, problems = 0;  // of a frame
  std::string failure;

  double least() const { return rates.empty() ? 0 : rates.front(); }
  double median() const { return rates.empty() ? 0 : rates[rates.size() / 2]; }
  double most() const { return rates.empty() ? 0 : rates.back(); }
};

template <class ExactScene>
void RunOnce(const SceneFileOf<ExactScene>& file, bool minimal, Measured& measured) {
  SimulationOptions options;
  options.step = ToDouble(file.step);
  options.minimal = minimal;
  const auto frames = std::clamp<std::int64_t>(std::llround(ToDouble(file.seconds) / options.step), 1, kFrames);
  const auto scene = Round(file.scene);
  SimulationOf<std::remove_const_t<decltype(scene)>> simulation(scene, options);
  const auto start = std::chrono::steady_clock::now();
  try {
    for (std::int64_t k = 0; k < frames; ++k) simulation.Step();
  } catch (const SimulationError& error) {
    measured.failure = error.what();
    return;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  measured.rates.push_back(static_cast<double>(frames) / seconds);
  measured.rows = static_cast<double>(simulation.statistics().rows) / static_cast<double>(frames);
  measured.problems = static_cast<double>(simulation.statistics().problems) / static_cast<double>(frames);
}

// Minimal and full models by turns, so that what else the machine does meets both.
template <class ExactScene>
std::pair<Measured, Measured> Measure(const SceneFileOf<ExactScene>& file, int repeat) {
  Measured minimal, full;
  for (int run = 0; run < repeat; ++run) {
    RunOnce(file, true, minimal);
    RunOnce(file, false, full);
  }
  std::sort(minimal.rates.begin(), minimal.rates.end());
  std::sort(full.rates.begin(), full.rates.end());
  return {minimal, full};
}

Json ToJson(const Measured& m) {
  if (!m.failure.empty()) return {{"failure", m.failure}};
  return {{"frames_a_second", {{"least", m.least()}, {"median", m.median()}, {"most", m.most()}}},
          {"rows", m.rows},
          {"problems", m.problems}};
}

}  // namespace

int BenchScenes(const BenchOptions& o) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(o.scenes, error)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  if (error || files.empty())
    throw InputError(fmt::format("{}: found no scenes, expected a folder of stiction-scene files", o.scenes));
  std::sort(files.begin(), files.end());
  Json rows = Json::array();
  if (!o.json) {
    fmt::print(
        "frames a second of one thread, contacts, assembly and solving counted; rows and problems of a frame\n"
        "{:24} {:>10} {:>24} {:>6} {:>6} | {:>10} {:>6} {:>6} | {:>8}\n",
        "scene", "minimal", "(least - most)", "rows", "prob.", "full", "rows", "prob.", "min/full");
  }
  for (const auto& path : files) {
    const auto file = ReadAnyScene(path);
    const auto name = std::visit([](const auto& of) { return of.scene.name; }, file);
    const auto [minimal, full] = std::visit([&o](const auto& of) { return Measure(of, o.repeat); }, file);
    rows.push_back({{"scene", name}, {"minimal", ToJson(minimal)}, {"full", ToJson(full)}});
    if (o.json) continue;
    if (!minimal.failure.empty() || !full.failure.empty()) {
      fmt::print("{:24} {}\n", name, minimal.failure.empty() ? full.failure : minimal.failure);
      continue;
    }
    fmt::print("{:24} {:>10.0f} {:>24} {:>6.1f} {:>6.2f} | {:>10.0f} {:>6.1f} {:>6.2f} | {:>8.2f}\n", name,
               minimal.median(), fmt::format("({:.0f} - {:.0f})", minimal.least(), minimal.most()),
               minimal.rows, minimal.problems, full.median(), full.rows, full.problems,
               minimal.median() / full.median());
    std::fflush(stdout);
  }
  if (o.json) std::cout << JsonText(rows) << "\n";
  return 0;
}

}  // namespace stiction
