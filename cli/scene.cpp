// SPDX-License-Identifier: Apache-2.0
// stiction assemble, simulate, draw: scenes.

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <set>

#include "cli/command_line.h"
#include "cli/convert.h"
#include "cli/shared.h"
#include "corpus/grouped.h"
#include "corpus/json_text.h"
#include "corpus/output_error.h"
#include "corpus/record/scene_file.h"
#include "corpus/record/scene_problems.h"
#include "corpus/rounded.h"
#include "reports/animation.h"
#include "reports/pictures/draw.h"
#include "reports/pictures/rounded_scene.h"
#include "reports/tables/run_tables.h"
#include "scene/tables.h"

namespace stiction {
namespace {

namespace fs = std::filesystem;

// ---- assemble --------------------------------------------------------------------------------

// The words of `assemble`; `draw` takes scene, output and json alone.
struct AssembleCommand : SceneProblemOptions {
  std::string scene, output, given;
  bool explain = false, json = false;
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
  const auto model = Assemble(file.scene, contacts, o.AtLevel(), !o.full);
  if (!o.given.empty()) WriteText(o.given, Print(WithGivenContacts(file, contacts)));
  std::string text;
  std::vector<SharedJson> written;
  std::vector<std::string> explained;
  for (const int i : model.colliding) {
    if (o.AtLevel() == Level::kForces) {
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
  const std::vector<ProblemFile> problems = ProblemsOf(file, model, o);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const ExactProblem& problem = problems[i].problem;
    const std::string name = NumberedFile(o.output, i, problems.size());
    WriteText(name, Print(problems[i]));
    const auto many = problem.contacts.size();
    text += fmt::format("{}: {}, {}\n", name, Counted(static_cast<std::int64_t>(many), "contact"),
                        Counted(problem.rows(), "row"));
    written.push_back({{"file", name}, {"contacts", many}, {"rows", problem.rows()}});
  }
  if (model.islands.empty()) text += "no contacts and no joints: nothing to solve\n";
  if (o.explain) {
    for (const std::string& line : Explain(file.scene, contacts, model, o.AtLevel())) {
      text += line + "\n";
      explained.push_back(line);
    }
  }
  SayWhatWasDone(o.output, o.json, text, {{"problems", written}, {"explained", explained}});
  return kExitDone;
}

// ---- simulate --------------------------------------------------------------------------------

struct SimulateCommand {
  std::string scene, output, problems, tables = "csv";
  std::optional<double> seconds, step;
  double rest = 0;
  int frames_a_second = 30, threads = 0;
  bool full = false, svg = true, replace = false, json = false;
};

ProblemFile ExactFile(const ContactProblem<double>& problem, const std::string& name,
                      const SharedJson& origin) {
  ProblemFile file;
  file.name = name;
  file.origin = origin;
  const auto require_finite = [&name](const char* where, bool is_finite) {
    if (is_finite) return;
    throw InputError(name, where, "a number beyond those that double holds",
                     "lengths, masses, velocities and forces of the scene from 1e-100 to 1e100");
  };
  for (const auto& contact : problem.contacts) require_finite("mu", std::isfinite(contact.mu));
  require_finite("b", problem.b.allFinite());
  require_finite("A", problem.A.allFinite());
  ExactProblem unrounded = Unrounded(problem);
  for (auto& [kind, mu, slip] : unrounded.contacts)
    if (kind == ContactKind::kSliding) slip = ExactDirection<Rational>(MakeVector2<Rational>(slip[0], slip[1]));
  file.problem = std::move(unrounded);
  return file;
}

void WriteProblem(const fs::path& file, const std::string& scene, std::int64_t frame, const char* level,
                  const ContactProblem<double>& problem) {
  const SharedJson origin = {
      {"scene", scene}, {"frame", frame}, {"level", level}, {"rounded", "J, A and b to doubles"}};
  WriteText(file.string(), Print(ExactFile(problem, file.stem().string(), origin)));
}

// The folder with what a run writes: tables as the run goes, pictures, which share a view, at its end.
template <class Kind>
class SimulationWriter {
 public:
  using SceneType = SceneIn<Kind, double>;
  using Picture = FrameIn<Kind>;

  explicit SimulationWriter(const SimulateCommand& o)
      : o_(o),
        folder_(o.output, "simulate", OccupiedIf(o.replace)),
        tables_(Place(o.output), FormsOf(o.tables)) {
    if (!o.problems.empty()) MakeFolder(Place(o.problems));
  }

  // The first state; then each that a step led to, from the one at `time`.
  void AddFirst(const SimulationIn<Kind>& simulation) { tables_.AddFirst(simulation, Measured(simulation)); }
  void AddStep(const SimulationIn<Kind>& simulation, double time) {
    tables_.AddStep(simulation, time, Measured(simulation));
  }

  // A picture of the last state; what has been added reaches the files.
  void AddPicture(const SceneType& scene, Picture picture) {
    picture.energy = {last_.energy.kinetic, last_.energy.potential};
    picture.drift = {since_.joints, since_.overlap};
    since_ = {};
    view_.Include(scene);
    pictures_.push_back(std::move(picture));
    tables_.Flush();
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
      const SharedJson origin = {{"scene", simulation.scene().name},
                                 {"frame", frame},
                                 {"level", "forces"},
                                 {"rounded", "J, A and b to doubles"}};
      picture.problems.push_back(Print(ExactFile(simulation.model().Problem(i), name, origin)));
      room_ -= std::min(room_, picture.problems.back().size());
    }
    has_room_ = room_ > 0;
  }

  // The place of a file while the folder of the output is not whole.
  fs::path Place(const fs::path& path) const { return folder_.Place(path); }

  void WritePictures(const SceneType& scene) {
    view_.AddMargin();
    std::vector<double> largest;
    for (const Picture& picture : pictures_) largest.push_back(LargestForce(picture.marks));
    const double newton = ForceScale(view_, std::move(largest));
    folder_.Write("animation.html", AnimationPage(scene, view_, pictures_, newton,
                                                  static_cast<double>(o_.frames_a_second), tables_.Motions()));
    SceneType moved = scene;
    for (std::size_t k = 0; o_.svg && k < pictures_.size(); ++k) {
      SetPoses(moved, pictures_[k]);
      folder_.Write(fmt::format("frames/{:05}.svg", k), DrawSvg(moved, view_, pictures_[k].marks, newton));
    }
  }

  std::vector<BodyMotion> Commit(const SceneType& scene) {
    std::vector<BodyMotion> motions = tables_.WriteMotions(scene);
    TellAside(folder_.Commit());
    return motions;
  }

  const Drift& worst() const { return worst_; }

 private:
  // What problems a page holds: of a frame with at most so many entries of A, and about so many characters.
  static constexpr std::size_t kMostEntries = 10'000, kMostText = 200'000;

  static void MakeFolder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) RefuseOutput(folder, error.value());
  }

  static TableForms FormsOf(const std::string& word) {
    return {word == "csv" || word == "both", word == "jsonl" || word == "both"};
  }

  StateRow Measured(const SimulationIn<Kind>& simulation) {
    last_ = {simulation.time(), EnergyOf(simulation.scene()), DriftOf(simulation.scene())};
    for (Drift* worst : {&worst_, &since_}) {
      worst->joints = std::max(worst->joints, last_.drift.joints);
      worst->overlap = std::max(worst->overlap, last_.drift.overlap);
    }
    return last_;
  }

  const SimulateCommand& o_;
  WholeFolder folder_;
  RunTables<Kind> tables_;
  StateRow last_;
  Drift worst_, since_;  // of all, and since the last picture
  View view_;
  std::vector<Picture> pictures_;
  std::size_t room_ = kMostText;
  bool has_room_ = true;
};

void ShowStep(ProgressBar& bar, std::int64_t done, std::int64_t steps, double time) {
  bar.ShowSome(done, steps, [&] {
    const double left = bar.Seconds() * static_cast<double>(steps - done) / static_cast<double>(done);
    return fmt::format("t = {:.6g} s, {} of {}, {:.0f} s left", time, Grouped(done), Counted(steps, "step"),
                       left);
  });
}

// All steps, or as many as there are before an interruption. A picture shows a state with the contacts and
// forces that the step from there finds; the last one, where the run ended, those of the step before it. The
// first problem that was not solved.
template <class Kind>
std::optional<UndecidedProblem> Run(SimulationIn<Kind>& simulation, std::int64_t steps, int pictures_a_second,
                                    const std::atomic<bool>& interrupted, SimulationWriter<Kind>& writer) {
  std::optional<UndecidedProblem> first;
  ProgressBar progress;
  double next = 0;  // picture, s
  writer.AddFirst(simulation);
  for (std::int64_t k = 0; k < steps && !interrupted; ++k) {
    const bool shown = simulation.time() >= next - 1e-9;
    if (shown) next += 1.0 / pictures_a_second;
    const double time = simulation.time();
    const auto start = shown ? std::optional(simulation.scene()) : std::nullopt;
    simulation.Step();
    const bool is_undecided = !simulation.undecided().empty();
    if (is_undecided && !first) first = simulation.undecided().front();
    if (start) {
      auto picture = RecordFrame(*start, time, MarksOf(simulation));
      if (is_undecided) picture.remark = "undecided";
      writer.AddProblems(simulation, k, picture);
      writer.AddPicture(*start, std::move(picture));
    }
    writer.AddStep(simulation, time);
    ShowStep(progress, k + 1, steps, simulation.time());
  }
  auto picture = RecordFrame(simulation.scene(), simulation.time(), MarksOf(simulation));
  picture.remark = "last";
  writer.AddPicture(simulation.scene(), std::move(picture));
  return first;
}

// How many bodies rest, and how those that do not move, the fastest first.
template <class Kind>
std::string MotionText(const SceneIn<Kind, double>& scene, std::vector<BodyMotion> motions) {
  constexpr std::size_t kMostTold = 10;
  if (motions.empty()) return "";
  const double seconds = motions.front().seconds;
  const std::size_t all = motions.size();
  std::erase_if(motions, [](const BodyMotion& motion) { return motion.word == "rests"; });
  std::stable_sort(motions.begin(), motions.end(),
                   [](const BodyMotion& one, const BodyMotion& other) { return one.speed > other.speed; });
  std::string text = fmt::format("in the last {:.6g} s {} of {} that can move rest\n", seconds,
                                 all - motions.size(), Counted(static_cast<std::int64_t>(all), "body"));
  for (std::size_t i = 0; i < std::min(motions.size(), kMostTold); ++i) {
    text += fmt::format("  {} {}: moved by {:.3g} m, {:.3g} m/s at last\n", NameOfBody(scene, motions[i].body),
                        motions[i].word, motions[i].moved, motions[i].speed);
  }
  if (motions.size() > kMostTold)
    text += fmt::format("  and {} more: --json has all\n", motions.size() - kMostTold);
  return text;
}

// By the names of their table.
SharedJson StatisticsToJson(const SimulationStatistics& statistics) {
  SharedJson json;
  ForEachField(statistics, [&json](const char* name, const char*, std::int64_t value) {
    json.Add({{name, value}});
  });
  return json;
}

template <class Kind>
void WriteSummary(const SimulationIn<Kind>& simulation, const std::vector<BodyMotion>& motions,
                  const Drift& worst, const SimulateCommand& o) {
  std::string text;
  ForEachField(simulation.statistics(), [&text](const char* name, const char* help, std::int64_t value) {
    text += fmt::format("{:12} {:>10}   {}\n", name, value, help);
  });
  const std::string animation = (fs::path(o.output) / "animation.html").string();
  text += fmt::format("worst drift of joints {:.3g}, overlap {:.3g} m\n{}{}\n", worst.joints, worst.overlap,
                      MotionText(simulation.scene(), motions), animation);
  SayWhatWasDone(o.output, o.json, text,
                 {{"written", std::vector{o.output}},
                  {"animation", animation},
                  {"statistics", StatisticsToJson(simulation.statistics())},
                  {"worst_drift", SharedJson{{"joints_m", worst.joints}, {"overlap_m", worst.overlap}}},
                  {"motion", MotionsToJson(simulation.scene(), motions)}});
}

template <class Kind>
int RunSimulate(const SimulateCommand& o, const SceneFileIn<Kind>& file) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    o.threads > 0 ? o.threads : tbb::info::default_concurrency());
  const double step = o.step ? *o.step : StepOf(file, o.scene);
  const double seconds = o.seconds ? *o.seconds : SecondsOf(file, o.scene);
  const SceneIn<Kind, double> scene = RoundedScene(file, o.scene);
  SimulationWriter<Kind> writer(o);
  std::function<void(const FrameProblemIn<Kind>&)> observe;
  if (!o.problems.empty()) {
    const std::string scene_name = fs::path(file.scene.name).filename().string();  // may hold anything
    observe = [&o, &file, &writer, scene_name, frame = std::int64_t{-1},
               number = 0](const FrameProblemIn<Kind>& met) mutable {
      const char* level = kLevelNames[static_cast<int>(met.level)];
      number = met.frame == frame ? number + 1 : 1;  // a frame can ask for several of one level and island
      frame = met.frame;
      const std::string name = fmt::format("{}-{:05}-{:02}-{}.json", scene_name, frame, number, level);
      WriteProblem(writer.Place(fs::path(o.problems) / name), file.scene.name, met.frame, level,
                   met.model.Problem(met.island));
    };
  }
  const std::atomic<bool>& interrupted = Interruption();
  SimulationIn<Kind> simulation(scene, step, o.rest, observe);
  simulation.minimal = !o.full;
  const auto steps = static_cast<std::int64_t>(std::llround(seconds / step));
  const auto undecided = Run(simulation, steps, o.frames_a_second, interrupted, writer);
  const fs::path first = fs::path(o.output) / "undecided.json";
  if (undecided)
    WriteProblem(writer.Place(first), file.scene.name, undecided->frame, "undecided", undecided->problem);
  writer.WritePictures(scene);
  const std::vector<BodyMotion> motions = writer.Commit(scene);
  WriteSummary(simulation, motions, writer.worst(), o);
  if (interrupted) {
    fmt::print(stderr, "Interrupted at t = {:.6g} s of {:.6g} s; everything up to there is written.\n",
               simulation.time(), seconds);
  }
  if (!undecided) return kExitDone;
  std::cerr << "stiction: " << TextOf(*undecided) << "; written to " << first.string() << "\n";
  return kExitUndecided;
}

// ---- draw ------------------------------------------------------------------------------------

template <class Kind>
int RunDraw(const AssembleCommand& o, const SceneFileIn<Kind>& file) {
  const SceneIn<Kind, double> scene = RoundedScene(file, o.scene);
  SimulationIn<Kind> simulation(scene, StepOf(file, o.scene));
  simulation.Step();
  for (const auto& undecided : simulation.undecided()) std::cerr << "stiction: " << TextOf(undecided) << "\n";
  const auto& touches = simulation.contacts();
  const MarksIn<Kind> marks = MarksOf(simulation);
  View view;
  view.Include(scene);
  view.AddMargin();
  const double newton = ForceScale(view, {LargestForce(marks)});
  const std::string svg = DrawExplained(scene, view, touches, marks.forces, newton);
  const std::string end = fs::path(o.output).extension();
  WriteText(o.output, end == ".png" || end == ".pdf" ? Converted(svg, end.substr(1)) : svg);
  const SharedJson done = {{"written", std::vector{o.output}},
                           {"contacts", touches.size()},
                           {"forces", marks.forces.size()},
                           {"undecided", simulation.undecided().size()}};
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
int RunDrawVerb(const AssembleCommand& o) {
  return std::visit([&o](const auto& file) { return RunDraw(o, file); }, ReadAnyScene(o.scene));
}

}  // namespace

const ListedVerb kAssembleVerb("Solve", 60, [](CommandLine& program) {
  auto [verb, o] = program.Add("assemble", "The contact problems of a scene, over rationals", RunAssembleVerb);
  verb.Positional("SCENE", o.scene, kSceneHelp).Required();
  verb.Option("-o,--output", o.output, "stiction-problem to write; - is standard output")
      .Required()
      .Details("NAME-1.json, NAME-2.json, ... where there are independent problems");
  verb.Option("--level", o.level, "forces at this instant, or impulses of a collision")
      .OneOf({"forces", "impulses"});
  verb.Option("--given", o.given, "stiction-scene to write: this one with its contacts given, not found");
  verb.Flag("--explain", o.explain, "what was modelled, what was left out, and why that is exact");
  verb.Flag("--factors", o.factors, "in factors J, M, w in place of A and b, as large scenes are written best");
  verb.Flag("--full", o.full, "one problem, with all rows for every contact, redundant ones too");
  verb.Prints(o.json, "the problems of a scene",
              "{problems: [{file: text, contacts: integer, rows: integer}], explained: [text]}");
});

const ListedVerb kSimulateVerb("Solve", 70, [](CommandLine& program) {
  auto [verb, o] = program.Add("simulate", "Step a scene through time, over doubles", RunSimulateVerb);
  verb.Positional("SCENE", o.scene, kSceneHelp).Required();
  verb.Option("-o,--output", o.output, "folder to write; what a run before wrote is replaced")
      .Required()
      .Details(
          "Whole, when the run or Ctrl-C ends: the tables, animation.html and frames/*.svg; undecided.json "
          "where "
          "a frame has no answer (exit 3)");
  verb.Option("--tables", o.tables, "bodies, contacts, energy, drift and motion as files of CSV or JSON lines")
      .OneOf({"csv", "jsonl", "both", "none"})
      .Details("columns.csv says what each column has");
  AddReplace(verb, o.replace);
  verb.Option("--seconds", o.seconds, "simulated time; by default the scene's")
      .Unit("s")
      .Range(kLeastTime, kMostSeconds);
  verb.Option("--step", o.step, "length of a step; by default the scene's")
      .Unit("s")
      .Range(kLeastTime, kMostStep);
  verb.Option("--rest", o.rest,
              "speed up to which a contact counts as at rest; by default what gravity makes in one step")
      .Unit("m/s")
      .Range(1e-15, kMostRest);
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
              "overlap_m: rounded}, motion: [{body: integer, name: text, moved_m: rounded, window_s: rounded, "
              "speed_m_per_s: rounded, does: \"rests\" | \"flies\" | \"creeps\" | \"slides\" | \"moves\"}]}");
});

const ListedVerb kDrawVerb("Show", 40, [](CommandLine& program) {
  auto [verb, o] = program.Add("draw", "A scene as a picture, with its contacts and forces", RunDrawVerb);
  verb.Positional("SCENE", o.scene, kSceneHelp).Required();
  verb.Option("-o,--output", o.output,
              "picture to write: NAME.png, NAME.pdf, all else SVG; - is standard output")
      .Required()
      .Details("PNG and PDF by rsvg-convert, of Debian's package librsvg2-bin");
  verb.footer =
      "Contacts by the numbers of `assemble --explain`, each with its cone of friction; forces and gravity, to "
      "the "
      "scale below; joints as pins.";
  verb.Prints(o.json, "a picture",
              "{written: written, contacts: integer, forces: integer, undecided: integer}");
});

}  // namespace stiction
