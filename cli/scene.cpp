// SPDX-License-Identifier: Apache-2.0
// stiction assemble, simulate, draw: scenes.

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>

#include "cli/shared.h"
#include "cli/verbs.h"
#include "corpus/grouped.h"
#include "corpus/output_error.h"
#include "corpus/record/scene_file.h"
#include "reports/animation.h"
#include "reports/pictures/draw.h"
#include "reports/pictures/rounded_scene.h"
#include "scene/simulate.h"

namespace stiction {
namespace {

namespace fs = std::filesystem;

// ---- assemble --------------------------------------------------------------------------------

struct AssembleCommand {
  std::string scene, output, given, level = "forces";
  bool explain = false, full = false, json = false;
};

// FILE.json of one problem; FILE-1.json, FILE-2.json, ... of several.
std::string NumberedFile(const std::string& file, std::size_t number, std::size_t count) {
  if (count == 1 || file == "-") return file;
  const fs::path path(file);
  fs::path numbered = path.parent_path() / path.stem();
  numbered += fmt::format("-{}", number + 1);
  numbered += path.extension();
  return numbered.string();
}

// The file with these contacts given, and found no more.
template <class Kind>
SceneFileIn<Kind> WithGivenContacts(SceneFileIn<Kind> file,
                                    const std::vector<TouchPointIn<Kind, Rational>>& contacts) {
  auto& scene = file.scene;
  scene.contacts.clear();
  for (const auto& contact : contacts) {
    const auto &a = scene.bodies[contact.a], &b = scene.bodies[contact.b];
    const typename Kind::template Vector<Rational> above = contact.point + contact.gap * contact.normal;
    scene.contacts.push_back({contact.a, contact.b, a.Local(above), b.Local(contact.point),
                              RotateBack(TurnOf(b.rotation), contact.normal)});
  }
  std::set<std::pair<int, int>> ruled;
  for (auto& rule : scene.pairs) {
    rule.collide = false;
    ruled.insert(std::minmax(rule.a, rule.b));
  }
  for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b) {
    for (int a = 0; a < b; ++a) {
      if (!ruled.contains({a, b})) scene.pairs.push_back({a, b, std::nullopt, false});
    }
  }
  return file;
}

template <class Kind>
int RunAssemble(const AssembleCommand& o, const SceneFileIn<Kind>& file) {
  const auto contacts = FindContacts(file.scene);
  AssembleOptions<Rational> options;
  options.level = o.level == "impulses" ? Level::kImpulses : Level::kForces;
  options.minimal = !o.full;
  const auto model = Assemble(file.scene, contacts, options);
  if (!o.given.empty()) WriteText(o.given, Print(WithGivenContacts(file, contacts)));
  std::string text;
  Json written = Json::array(), explained = Json::array();
  for (const int i : model.colliding) {
    if (options.level == Level::kForces) {
      std::cerr << fmt::format(
          "stiction: {}: contact {} approaches; a collision (--level impulses) comes first\n", o.scene, i + 1);
    }
  }
  if (o.output == "-" && model.islands.size() > 1) {
    throw InputError(
        fmt::format("{}: found {} independent problems, expected one to write to standard output "
                    "(--full keeps them together)",
                    o.scene, model.islands.size()));
  }
  for (std::size_t i = 0; i < model.islands.size(); ++i) {
    ProblemFile problem;
    problem.problem = model.Problem(i);
    problem.name = file.scene.name;
    if (model.islands.size() > 1) problem.name += fmt::format("-{}", i + 1);
    problem.origin = {{"scene", file.scene.name}, {"level", o.level}, {"model", o.full ? "full" : "minimal"}};
    if (o.full) problem.scene = ToJson(file);
    const std::string name = NumberedFile(o.output, i, model.islands.size());
    WriteText(name, Print(problem));
    const auto many = problem.problem.contacts.size();
    text += fmt::format("{}: {} contacts, {} rows\n", name, many, problem.problem.rows());
    written.push_back({{"file", name}, {"contacts", many}, {"rows", problem.problem.rows()}});
  }
  if (model.islands.empty()) text += "no contacts and no joints: nothing to solve\n";
  if (o.explain) {
    for (const std::string& line : Explain(file.scene, contacts, model, options)) {
      text += line + "\n";
      explained.push_back(line);
    }
  }
  SayWhatWasDone(o.output, o.json, text, {{"problems", written}, {"explained", explained}});
  return kExitDone;
}

// ---- simulate --------------------------------------------------------------------------------

struct SimulateCommand {
  std::string scene, output, problems;
  std::optional<double> seconds, step;
  double rest = 0;
  int frames_a_second = 30, threads = 0;
  bool full = false, svg = true, replace = false, json = false;
};

ProblemFile ExactFile(const ContactProblem<double>& problem, const std::string& name, const Json& origin) {
  ProblemFile file;
  file.name = name;
  file.origin = origin;
  file.problem.dimension = problem.dimension;
  for (const auto& contact : problem.contacts) {
    Contact<Rational> exact;
    exact.kind = contact.kind;
    exact.mu = Rational(contact.mu);
    if (contact.kind == ContactKind::kSliding)
      exact.slip = ExactDirection<Rational>(MakeVector2<Rational>(contact.slip[0], contact.slip[1]));
    file.problem.contacts.push_back(exact);
  }
  const int rows = problem.rows();
  file.problem.A.resize(rows, rows);
  file.problem.b.resize(rows);
  for (int i = 0; i < rows; ++i) {
    file.problem.b[i] = Rational(problem.b[i]);
    for (int j = 0; j < rows; ++j) file.problem.A(i, j) = Rational(problem.A(i, j));
  }
  return file;
}

void WriteProblem(const fs::path& file, const std::string& scene, std::int64_t frame, const char* level,
                  const ContactProblem<double>& problem) {
  const Json origin = {
      {"scene", scene}, {"frame", frame}, {"level", level}, {"rounded", "J, A and b to doubles"}};
  WriteText(file.string(), Print(ExactFile(problem, file.stem().string(), origin)));
}

// A number of a file that is within what the option of its name takes.
double Within(const Rational& x, double least, double most, const std::string& place) {
  const double value = x > Rational(most) ? std::numeric_limits<double>::infinity() : ToDouble(x);
  if (value >= least && value <= most) return value;
  throw InputError(fmt::format("{}: found {}, expected {:g} to {:g} s", place, value, least, most));
}
template <class Kind>
double StepOf(const SceneFileIn<Kind>& file, const std::string& source) {
  return Within(file.step, 1e-9, 1, source + ": step");
}

// The folder with what a run writes: tables as the run goes, pictures, which share a view, at its end.
template <class Kind>
class SimulationWriter {
 public:
  using SceneType = SceneIn<Kind, double>;
  using Picture = FrameIn<Kind>;

  explicit SimulationWriter(const SimulateCommand& o)
      : o_(o), folder_(o.output, "simulate", OccupiedIf(o.replace)) {
    if (!o.problems.empty()) MakeFolder(Place(o.problems));
    energy_.open(Place(fs::path(o.output) / "energy.csv"));
    drift_.open(Place(fs::path(o.output) / "drift.csv"));
    energy_ << "time_s,kinetic_J,potential_J,total_J\n";
    drift_ << "time_s,joints_m,overlap_m\n";
    Flush();
  }

  void AddState(const SimulationIn<Kind>& simulation) {
    const Energy energy = EnergyOf(simulation.scene());
    const Drift drift = DriftOf(simulation.scene());
    energy_ << fmt::format("{:.9g},{:.12g},{:.12g},{:.12g}\n", simulation.time(), energy.kinetic,
                           energy.potential, energy.total());
    drift_ << fmt::format("{:.9g},{:.6g},{:.6g}\n", simulation.time(), drift.joints, drift.overlap);
    worst_.joints = std::max(worst_.joints, drift.joints);
    worst_.overlap = std::max(worst_.overlap, drift.overlap);
  }

  // What has been added reaches the files, up to this picture.
  void AddPicture(const SceneType& scene, Picture picture) {
    view_.Include(scene);
    pictures_.push_back(std::move(picture));
    Flush();
  }

  // The problems of forces of the step that a frame, the number of it in the run, shows, while there is room.
  void AddProblems(const SimulationIn<Kind>& simulation, std::int64_t frame, Picture& picture) {
    const auto& islands = simulation.model().islands;
    std::size_t entries = 0;
    for (const auto& island : islands) entries += static_cast<std::size_t>(island.rows) * island.rows;
    if (!has_room_ || entries > kMostEntries) {
      picture.remark = entries > kMostEntries ? "large" : "room";
      return;
    }
    for (std::size_t i = 0; i < islands.size(); ++i) {
      const std::string name = fmt::format("{}-{:05}-{}", simulation.scene().name, frame, i + 1);
      const Json origin = {{"scene", simulation.scene().name},
                           {"frame", frame},
                           {"level", "forces"},
                           {"rounded", "J, A and b to doubles"}};
      picture.problems.push_back(Print(ExactFile(simulation.model().Problem(i), name, origin)));
      room_ -= std::min(room_, picture.problems.back().size());
    }
    has_room_ = room_ > 0;
  }

  // Where a file is while the folder of the output is not whole.
  fs::path Place(const fs::path& path) const { return folder_.Place(path); }

  void WritePictures(const SceneType& scene) {
    view_.AddMargin();
    std::vector<double> largest;
    for (const Picture& picture : pictures_) largest.push_back(LargestForce(picture.marks));
    const double newton = ForceScale(view_, std::move(largest));
    folder_.Write("animation.html",
                  AnimationPage(scene, view_, pictures_, newton, static_cast<double>(o_.frames_a_second)));
    SceneType moved = scene;
    for (std::size_t k = 0; o_.svg && k < pictures_.size(); ++k) {
      SetPoses(moved, pictures_[k]);
      folder_.Write(fmt::format("frames/{:05}.svg", k), DrawSvg(moved, view_, pictures_[k].marks, newton));
    }
  }

  void Commit() {
    energy_.close();
    drift_.close();
    Flush();
    TellAside(folder_.Commit());
  }

  const Drift& worst() const { return worst_; }

 private:
  // What problems a page holds: of a frame with at most so many entries of A, and about so many characters.
  static constexpr std::size_t kMostEntries = 10'000, kMostText = 4'000'000;

  static void MakeFolder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) RefuseOutput(folder, error.value());
  }

  void Flush() {
    for (std::ofstream* table : {&energy_, &drift_}) {
      if (!table->flush()) throw OutputError(o_.output + ": its tables cannot be written");
    }
  }

  const SimulateCommand& o_;
  WholeFolder folder_;
  std::ofstream energy_, drift_;
  Drift worst_;
  View view_;
  std::vector<Picture> pictures_;
  std::size_t room_ = kMostText;
  bool has_room_ = true;
};

// About twice a second, of runs that take more than that.
class SimulationProgress {
 public:
  void Show(std::int64_t done, std::int64_t steps, double time) {
    const auto now = Clock::now();
    if (now - shown_ < std::chrono::milliseconds(500)) return;
    shown_ = now;
    const double fraction = static_cast<double>(done) / static_cast<double>(steps);
    const double left = std::chrono::duration<double>(now - start_).count() * (1 - fraction) / fraction;
    bar_.Show(fraction, fmt::format("t = {:.6g} s, {} of {} steps, {:.0f} s left", time, Grouped(done),
                                    Grouped(steps), left));
  }
  ~SimulationProgress() { bar_.Clear(); }

 private:
  using Clock = std::chrono::steady_clock;
  ProgressBar bar_;
  Clock::time_point start_ = Clock::now(), shown_ = start_;
};

// All steps, or as many as there are before an interruption or a SimulationError. A picture shows a state with
// the contacts and forces that the step from there finds; the last one, where the run ended, those of the step
// before it.
template <class Kind>
void Run(SimulationIn<Kind>& simulation, std::int64_t steps, int pictures_a_second,
         const std::atomic<bool>& interrupted, SimulationWriter<Kind>& writer) {
  SimulationProgress progress;
  double next = 0;  // picture, s
  writer.AddState(simulation);
  for (std::int64_t k = 0; k < steps && !interrupted; ++k) {
    const bool shown = simulation.time() >= next - 1e-9;
    if (shown) next += 1.0 / pictures_a_second;
    const double time = simulation.time();
    const auto start = shown ? std::optional(simulation.scene()) : std::nullopt;
    simulation.Step();
    if (start) {
      auto picture = RecordFrame(*start, time, MarksOf(simulation));
      writer.AddProblems(simulation, k, picture);
      writer.AddPicture(*start, std::move(picture));
    }
    writer.AddState(simulation);
    progress.Show(k + 1, steps, simulation.time());
  }
  auto picture = RecordFrame(simulation.scene(), simulation.time(), MarksOf(simulation));
  picture.remark = "last";
  writer.AddPicture(simulation.scene(), std::move(picture));
}

void WriteSummary(const SimulationStatistics& statistics, const Drift& worst, const SimulateCommand& o) {
  std::string text;
  ForEachField(statistics, [&text](const char* name, const char* help, std::int64_t value) {
    text += fmt::format("{:12} {:>10}   {}\n", name, value, help);
  });
  const std::string animation = (fs::path(o.output) / "animation.html").string();
  text += fmt::format("worst drift of joints {:.3g}, overlap {:.3g} m\n{}\n", worst.joints, worst.overlap,
                      animation);
  SayWhatWasDone(o.output, o.json, text,
                 {{"written", Json::array({o.output})},
                  {"animation", animation},
                  {"statistics", StatisticsToJson(statistics)},
                  {"worst_drift",
                   {{"joints_m", NumberToJson(worst.joints)}, {"overlap_m", NumberToJson(worst.overlap)}}}});
}

template <class Kind>
int RunSimulate(const SimulateCommand& o, const SceneFileIn<Kind>& file) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    o.threads > 0 ? o.threads : tbb::info::default_concurrency());
  SimulationOptions options;
  options.step = o.step ? *o.step : StepOf(file, o.scene);
  options.rest = o.rest;
  options.minimal = !o.full;
  const double seconds = o.seconds ? *o.seconds : Within(file.seconds, 1e-9, 1e6, o.scene + ": seconds");
  const SceneIn<Kind, double> scene = RoundedScene(file, o.scene);
  SimulationWriter<Kind> writer(o);
  std::function<void(const FrameProblem&)> observe;
  if (!o.problems.empty()) {
    const std::string scene_name = fs::path(file.scene.name).filename().string();  // may hold anything
    observe = [&o, &file, &writer, scene_name, frame = std::int64_t{-1},
               number = 0](const FrameProblem& met) mutable {
      const char* level = kLevelNames[static_cast<int>(met.level)];
      number = met.frame == frame ? number + 1 : 1;  // a frame can ask for several of one level and island
      frame = met.frame;
      const std::string name = fmt::format("{}-{:05}-{:02}-{}.json", scene_name, frame, number, level);
      WriteProblem(writer.Place(fs::path(o.problems) / name), file.scene.name, met.frame, level, met.problem);
    };
  }
  const std::atomic<bool>& interrupted = Interruption();
  SimulationIn<Kind> simulation(scene, options, observe);
  const auto steps = static_cast<std::int64_t>(std::llround(seconds / options.step));
  try {
    Run(simulation, steps, o.frames_a_second, interrupted, writer);
  } catch (const SimulationError& error) {
    const fs::path at = fs::path(o.output) / "undecided.json";
    WriteProblem(writer.Place(at), file.scene.name, simulation.statistics().frames, "undecided", error.problem);
    auto marks = MarksOf(simulation);
    marks.forces.clear();  // they are of the step before
    auto picture = RecordFrame(simulation.scene(), simulation.time(), std::move(marks));
    picture.remark = "undecided";
    writer.AddPicture(simulation.scene(), std::move(picture));
    writer.WritePictures(scene);
    writer.Commit();
    std::cerr << "stiction: " << error.what() << "; written to " << at.string() << "\n";
    return kExitUndecided;
  }
  writer.WritePictures(scene);
  writer.Commit();
  WriteSummary(simulation.statistics(), writer.worst(), o);
  if (interrupted) {
    fmt::print(stderr, "Interrupted at t = {:.6g} s of {:.6g} s; everything up to there is written.\n",
               simulation.time(), seconds);
  }
  return kExitDone;
}

// ---- draw ------------------------------------------------------------------------------------

struct DrawCommand {
  std::string scene, output;
  bool json = false;
};

template <class Kind>
int RunDraw(const DrawCommand& o, const SceneFileIn<Kind>& file) {
  const SceneIn<Kind, double> scene = RoundedScene(file, o.scene);
  SimulationOptions options;
  options.step = StepOf(file, o.scene);
  SimulationIn<Kind> simulation(scene, options);
  MarksIn<Kind> marks;
  try {
    simulation.Step();
    marks = MarksOf(simulation);
  } catch (const SimulationError& error) {
    std::cerr << "stiction: " << error.what() << "; drawn without forces\n";
    for (const auto& contact : FindContacts(scene)) marks.contacts.push_back(contact.point);
  }
  View view;
  view.Include(scene);
  view.AddMargin();
  WriteText(o.output, DrawSvg(scene, view, marks, ForceScale(view, {LargestForce(marks)})));
  const Json done = {{"written", Json::array({o.output})},
                     {"contacts", marks.contacts.size()},
                     {"forces", marks.forces.size()}};
  if (o.json) SayWhatWasDone(o.output, o.json, "", done);
  return kExitDone;
}

constexpr const char* kSceneHelp = "stiction-scene file, or a stiction-problem file with a scene";

int RunAssembleVerb(const AssembleCommand& o) {
  return std::visit([&o](const auto& file) { return RunAssemble(o, file); }, ReadAnyScene(o.scene));
}
int RunSimulateVerb(const SimulateCommand& o) {
  return std::visit([&o](const auto& file) { return RunSimulate(o, file); }, ReadAnyScene(o.scene));
}
int RunDrawVerb(const DrawCommand& o) {
  return std::visit([&o](const auto& file) { return RunDraw(o, file); }, ReadAnyScene(o.scene));
}

}  // namespace

void AddAssemble(CommandLine& program) {
  auto [verb, o] = program.Add("assemble", "The contact problems of a scene, over rationals", RunAssembleVerb);
  verb.Positional("SCENE", o.scene, kSceneHelp).Required();
  verb.Option("-o,--output", o.output, "stiction-problem to write; - is standard output")
      .Required()
      .Details("NAME-1.json, NAME-2.json, ... where there are independent problems");
  verb.Option("--level", o.level, "forces at this instant, or impulses of a collision")
      .OneOf({"forces", "impulses"});
  verb.Option("--given", o.given, "stiction-scene to write: this one with its contacts given, not found");
  verb.Flag("--explain", o.explain, "what was modelled, what was left out, and why that is exact");
  verb.Flag("--full", o.full, "one problem, with all rows for every contact, redundant ones too");
  verb.Prints(o.json, "the problems of a scene",
              "{problems: [{file: text, contacts: integer, rows: integer}], explained: [text]}");
}

void AddSimulate(CommandLine& program) {
  auto [verb, o] = program.Add("simulate", "Step a scene through time, over doubles", RunSimulateVerb);
  verb.Positional("SCENE", o.scene, kSceneHelp).Required();
  verb.Option("-o,--output", o.output, "folder to write; what a run before wrote is replaced")
      .Required()
      .Details(
          "Whole, when the run or Ctrl-C ends: energy.csv, drift.csv, animation.html and frames/*.svg; "
          "undecided.json where a frame has no answer (exit 3)");
  AddReplace(verb, o.replace);
  verb.Option("--seconds", o.seconds, "simulated time; by default the scene's").Unit("s").Range(1e-9, 1e6);
  verb.Option("--step", o.step, "length of a step; by default the scene's").Unit("s").Range(1e-9, 1);
  verb.Option("--rest", o.rest,
              "speed up to which a contact counts as at rest; by default what gravity makes in one step")
      .Unit("m/s")
      .Range(1e-15, 1e6);
  verb.Option("--frames", o.frames_a_second,
              "pictures a second of simulated time; all are kept in memory until the end")
      .Range(1, 100000);
  verb.Option("-t,--threads", o.threads,
              "for independent islands; results do not depend on it; by default one per core")
      .Range(1, 1024);
  verb.Option("-n,--problems", o.problems, "folder for every problem met, as stiction-problem files");
  verb.Flag("--full", o.full, "leave out nothing that the scene does not require");
  verb.Flag("--no-svg", o.svg, "no frames/*.svg");
  verb.Prints(o.json, "a simulation",
              "{written: written, animation: text, statistics: counters, worst_drift: {joints_m: rounded, "
              "overlap_m: rounded}}");
}

void AddDraw(CommandLine& program) {
  auto [verb, o] = program.Add("draw", "A scene as an SVG, with its contacts and forces", RunDrawVerb);
  verb.Positional("SCENE", o.scene, kSceneHelp).Required();
  verb.Option("-o,--output", o.output, "SVG to write; - is standard output").Required();
  verb.Prints(o.json, "a picture", "{written: written, contacts: integer, forces: integer}");
}

}  // namespace stiction
