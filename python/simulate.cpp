// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "corpus/record/scene_file.h"
#include "corpus/record/scene_problems.h"
#include "python/module.h"
#include "python/signals.h"
#include "reports/animation.h"
#include "reports/pictures/rounded_scene.h"
#include "scene/tables.h"

namespace stiction {
namespace {

namespace py = pybind11;

// A column as it grows. Texts are few: each stands once, and rows have its number.
struct GrowingColumn {
  std::vector<double> numbers;
  std::vector<std::int64_t> whole;
  std::vector<std::string> words;
  std::map<std::string, std::int64_t> word_numbers;

  void Add(double number) { numbers.push_back(number); }
  void Add(std::int64_t number) { whole.push_back(number); }
  void Add(const std::string& text) {
    const auto [at, is_new] = word_numbers.try_emplace(text, static_cast<std::int64_t>(words.size()));
    if (is_new) words.push_back(text);
    whole.push_back(at->second);
  }
};

// An array that has the memory of the vector.
template <class Number>
py::array Owned(std::vector<Number> numbers) {
  auto kept = std::make_unique<std::vector<Number>>(std::move(numbers));
  std::vector<Number>& memory = *kept;
  const py::capsule owner(kept.release(), [](void* of) { delete static_cast<std::vector<Number>*>(of); });
  return py::array_t<Number>(static_cast<py::ssize_t>(memory.size()), memory.data(), owner);
}

template <class Row>
class GrowingTable {
 public:
  explicit GrowingTable(const OutputTable<Row>& table) : table_(table), columns_(table.columns.size()) {}

  void Add(const Row& row) {
    for (std::size_t i = 0; i < columns_.size(); ++i)
      std::visit([&](const auto of) { columns_[i].Add(of(row)); }, table_.columns[i].value);
  }

  // Name -> (array, the texts that its numbers stand for, or None). Nothing is left here.
  py::dict Take() {
    py::dict dict;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      GrowingColumn& column = columns_[i];
      const auto& of = table_.columns[i];
      const auto take = [&](auto&& numbers, const py::object& words) {
        dict[py::str(of.name)] = py::make_tuple(Owned(std::move(numbers)), words);
      };
      if (std::holds_alternative<double (*)(const Row&)>(of.value)) {
        take(column.numbers, py::none());
      } else if (std::holds_alternative<std::string (*)(const Row&)>(of.value)) {
        take(column.whole, py::cast(column.words));
      } else {
        take(column.whole, py::none());
      }
    }
    return dict;
  }

 private:
  const OutputTable<Row>& table_;
  std::vector<GrowingColumn> columns_;
};

// What `stiction simulate` writes as tables.
template <class Kind>
struct ArraysOfRun {
  GrowingTable<BodyRow<Kind>> bodies{BodyTable<Kind>()};
  GrowingTable<ContactRow<Kind>> contacts{ContactTable<Kind>()};
  GrowingTable<StateRow> energy{EnergyTable()}, drift{DriftTable()};
  GrowingTable<MotionRow<Kind>> motion{MotionTable<Kind>()};
  MotionTrack<Kind> track;
  SimulationStatistics statistics;
  std::string reason;  // the first problem that was not solved; empty if there is none

  void AddState(const SimulationIn<Kind>& simulation) {
    const auto& scene = simulation.scene();
    const StateRow state{simulation.time(), EnergyOf(scene), DriftOf(scene)};
    ForEachBodyRow(simulation, [this](const BodyRow<Kind>& row) { bodies.Add(row); });
    energy.Add(state);
    drift.Add(state);
    track.Add(state.time, scene, SupportsOf(simulation));
  }
};

template <class Kind>
ArraysOfRun<Kind> RunArrays(SimulationIn<Kind>& simulation, std::int64_t steps, const std::atomic<bool>* stop) {
  ArraysOfRun<Kind> run;
  run.AddState(simulation);
  for (std::int64_t k = 0; k < steps && !*stop; ++k) {
    const double time = simulation.time();
    simulation.Step();
    if (run.reason.empty() && !simulation.undecided().empty())
      run.reason = TextOf(simulation.undecided().front());
    ForEachContactRow(simulation, time, [&run](const ContactRow<Kind>& row) { run.contacts.Add(row); });
    run.AddState(simulation);
  }
  for (const BodyMotion& motion : run.track.Motions()) run.motion.Add({simulation.scene(), motion});
  run.statistics = simulation.statistics();
  return run;
}

// What is asked of a scene; without a value, what the scene says.
struct AskedRun {
  std::optional<double> seconds, step;
  double rest = 0;
  bool full = false;

  template <class Kind>
  double StepFor(const SceneFileIn<Kind>& file, const std::string& source) const {
    return step ? *step : StepOf(file, source);
  }
  template <class Kind>
  SimulationIn<Kind> Begin(const SceneFileIn<Kind>& file, const std::string& source) const {
    const double h = StepFor(file, source);
    SimulationIn<Kind> simulation(RoundedScene(file, source), h, rest);
    simulation.minimal = !full;
    return simulation;
  }
  template <class Kind>
  std::int64_t StepsFor(const SceneFileIn<Kind>& file, const std::string& source) const {
    return std::llround((seconds ? *seconds : SecondsOf(file, source)) / StepFor(file, source));
  }
};

template <class Kind>
py::dict SimulateScene(const SceneFileIn<Kind>& file, const std::string& source, const AskedRun& asked) {
  SimulationIn<Kind> simulation = asked.Begin(file, source);
  const std::int64_t steps = asked.StepsFor(file, source);
  auto run =
      Interruptible(0, [&](const std::atomic<bool>* stop) { return RunArrays(simulation, steps, stop); });
  py::dict said, statistics;
  ForEachField(run.statistics,
               [&statistics](const char* name, const char*, std::int64_t value) { statistics[name] = value; });
  said["name"] = simulation.scene().name;
  said["dimension"] = Kind::kDimension;
  said["bodies"] = run.bodies.Take();
  said["contacts"] = run.contacts.Take();
  said["energy"] = run.energy.Take();
  said["drift"] = run.drift.Take();
  said["motion"] = run.motion.Take();
  said["statistics"] = statistics;
  said["reason"] = run.reason;
  return said;
}

AskedRun Asked(std::optional<double> seconds, std::optional<double> step, double rest, bool full) {
  const auto require = [](const char* name, std::optional<double> value, double least, double most) {
    if (!value || (*value >= least && *value <= most)) return;
    throw InputError(fmt::format("{}: found {}, expected {} to {}", name, *value, least, most));
  };
  require("seconds", seconds, kLeastTime, kMostSeconds);
  require("step", step, kLeastTime, kMostStep);
  require("rest", rest, 0, kMostRest);
  return {seconds, step, rest, full};
}

// Of the text of a scene file.
py::dict SimulateText(const std::string& text, const std::string& source, std::optional<double> seconds,
                      std::optional<double> step, double rest, bool full) {
  const AskedRun asked = Asked(seconds, step, rest, full);
  return std::visit([&](const auto& file) { return SimulateScene(file, source, asked); },
                    ParseAnyScene(text, source));
}

// The texts of the problem files that `stiction assemble` writes of the text of a scene file.
std::vector<std::string> AssembleText(const std::string& text, const std::string& source,
                                      const std::string& level, bool factors, bool full) {
  if (level != "forces" && level != "impulses")
    throw InputError(fmt::format("level: found {}, expected forces or impulses", level));
  const SceneProblemOptions options{level, factors, full};
  const auto assemble = [&](const auto& file) {
    const auto model = Assemble(file.scene, FindContacts(file.scene), options.AtLevel(), !options.full);
    std::vector<std::string> texts;
    for (const ProblemFile& problem : ProblemsOf(file, model, options)) texts.push_back(Print(problem));
    return texts;
  };
  const py::gil_scoped_release released;
  return std::visit(assemble, ParseAnyScene(text, source));
}

// The page that plays a run, thirty frames a second, as `stiction simulate` writes it; without the problems of
// its frames. Where a step has no answer, the run ends.
template <class Kind>
std::string PageOfRun(SimulationIn<Kind>& simulation, std::int64_t steps, const std::atomic<bool>* stop) {
  constexpr double kRate = 30;  // frames a second
  const SceneIn<Kind, double> scene = simulation.scene();
  MotionTrack<Kind> track;
  View view;
  std::vector<FrameIn<Kind>> frames;
  Drift worst;  // since the frame before
  const auto add = [&](const SceneIn<Kind, double>& shown, double time) {
    const Energy energy = EnergyOf(shown);
    frames.push_back(RecordFrame(shown, time, MarksOf(simulation)));
    frames.back().energy = {energy.kinetic, energy.potential};
    frames.back().drift = {worst.joints, worst.overlap};
    frames.back().remark = "without";
    worst = {};
    view.Include(shown);
  };
  const auto watch = [&] {
    const Drift drift = DriftOf(simulation.scene());
    worst = {std::max(worst.joints, drift.joints), std::max(worst.overlap, drift.overlap)};
    track.Add(simulation.time(), simulation.scene(), SupportsOf(simulation));
  };
  watch();
  double next = 0;  // frame, s
  for (std::int64_t k = 0; k < steps && !*stop; ++k) {
    const double time = simulation.time();
    const SceneIn<Kind, double> start = simulation.scene();
    simulation.Step();
    if (time >= next - 1e-9) {
      next += 1 / kRate;
      add(start, time);
      if (!simulation.undecided().empty()) frames.back().remark = "undecided";
    }
    watch();
  }
  add(simulation.scene(), simulation.time());
  frames.back().remark = "last";
  view.AddMargin();
  std::vector<double> largest;
  for (const auto& frame : frames) largest.push_back(LargestForce(frame.marks));
  return AnimationPage(scene, view, frames, ForceScale(view, std::move(largest)), kRate, track.Motions());
}

std::string SimulationPage(const std::string& text, const std::string& source, std::optional<double> seconds,
                           std::optional<double> step, double rest, bool full) {
  const AskedRun asked = Asked(seconds, step, rest, full);
  return std::visit(
      [&]<class Kind>(const SceneFileIn<Kind>& file) {
        SimulationIn<Kind> simulation = asked.Begin(file, source);
        const std::int64_t steps = asked.StepsFor(file, source);
        return Interruptible(0,
                             [&](const std::atomic<bool>* stop) { return PageOfRun(simulation, steps, stop); });
      },
      ParseAnyScene(text, source));
}

}  // namespace

void AddSimulate(py::module_& module) {
  module.def("simulate", &SimulateText);
  module.def("simulation_page", &SimulationPage);
  module.def("assemble", &AssembleText);
}

}  // namespace stiction
