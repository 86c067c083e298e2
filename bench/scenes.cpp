// SPDX-License-Identifier: Apache-2.0
// bench --suite scenes: frames a second with the whole frame counted, and what the minimal model, or more
// threads, save. bench --suite frames: the seconds of each, and problems with their answers.

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
#include "corpus/exact_problem.h"
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

// A line: a problem that a frame met, as a file in factors, which has b in c, to the bit; and its forces.
template <class Kind>
Json ToJson(const FrameProblemIn<Kind>& met) {
  const auto problem = met.model.InFactors(met.island);
  const auto& J = problem.A.J();
  Json contacts = Json::array(), entries = Json::array(), M = Json::array();
  for (const auto& contact : problem.contacts) {
    Json& json = contacts.emplace_back(Json{{"kind", Name(contact.kind)}});
    if (contact.HasFrictionRows()) json["mu"] = contact.mu;
    if (contact.kind == ContactKind::kSliding)
      json["slip"] = Kind::kDimension == 2 ? Json(contact.slip[0]) : Json{contact.slip[0], contact.slip[1]};
  }
  for (int i = 0; i < J.rows(); ++i) {
    for (typename FactoredMatrix<double>::Rows::InnerIterator entry(J, i); entry; ++entry)
      entries.push_back({i, entry.col(), entry.value()});
  }
  for (int first = 0; first < problem.M.rows(); first += Kind::kDof)
    M.push_back(RowsJson(Eigen::MatrixXd(problem.M.block(first, first, Kind::kDof, Kind::kDof))));
  return {{"frame", met.frame},
          {"level", kLevelNames[static_cast<int>(met.level)]},
          {"f", ListJson(met.f)},
          {"problem",
           {{"format", "stiction-problem"},
            {"version", 1},
            {"dimension", Kind::kDimension},
            {"contacts", std::move(contacts)},
            {"factors",
             {{"J", {{"size", {J.rows(), J.cols()}}, {"entries", std::move(entries)}}},
              {"M", std::move(M)},
              {"w", ListJson(Eigen::VectorXd::Zero(J.cols()))},
              {"c", ListJson(problem.b)}}}}}};
}

// A line for each problem of these levels, and one of the scene: the processor seconds of its frames.
template <class Kind>
void WriteFrames(const SceneFileIn<Kind>& file, const std::vector<std::string>& levels) {
  double telling = 0;
  const auto observe = [&](const FrameProblemIn<Kind>& met) {
    if (!met.is_taken || !std::ranges::count(levels, kLevelNames[static_cast<int>(met.level)])) return;
    const Stopwatch watch;
    std::cout << JsonText(ToJson(met)) << "\n";
    telling += watch.Seconds();
  };
  const double step = ToDouble(file.step);
  const auto frames = std::max<std::int64_t>(std::llround(ToDouble(file.seconds) / step), 1);
  SimulationIn<Kind> simulation(Round(file.scene), step, 0, observe);
  std::vector<double> seconds;
  progress::Begin(file.scene.name, frames);
  for (std::int64_t k = 0; k < frames; ++k) {
    telling = 0;
    const Stopwatch watch;
    simulation.Step();
    seconds.push_back(watch.Seconds() - telling);
    progress::Done();
  }
  Json statistics;
  ForEachField(simulation.statistics(),
               [&](const char* name, const char*, std::int64_t value) { statistics[name] = value; });
  std::cout << JsonText(
                   Json{{"scene", file.scene.name}, {"seconds", ListJson(seconds)}, {"statistics", statistics}})
            << "\n";
}

// Each scene of the folder, by name.
std::vector<std::filesystem::path> ScenesIn(const std::string& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  if (error || files.empty())
    throw InputError(fmt::format("{}: found no scenes, expected a folder of stiction-scene files", folder));
  std::sort(files.begin(), files.end());
  progress::Expect(files.size());
  return files;
}

}  // namespace

int BenchScenes(const BenchOptions& o) {
  Ways ways = {Way{"minimal", true, 1}, Way{"full", false, 1}};
  if (o.threads > 1)
    ways = {Way{fmt::format("{} threads", o.threads), true, o.threads}, Way{"1 thread", true, 1}};
  Json rows = Json::array();
  BenchTable table{"scenes",
                   "frames a second, contacts, assembly and solving counted: median (least - most); rows and "
                   "problems of a frame; ratio of the first to the second, run by turns"};
  for (const auto& path : ScenesIn(o.scenes)) {
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

int BenchFrames(const BenchOptions& o) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 1);
  for (const auto& path : ScenesIn(o.scenes))
    std::visit([&o](const auto& file) { WriteFrames(file, o.families); }, ReadAnyScene(path));
  progress::Clear();
  return kExitDone;
}

}  // namespace stiction
