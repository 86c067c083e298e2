// SPDX-License-Identifier: Apache-2.0
// stiction-peers: stiction beside the solvers of other packages, on the same problems in the same run. A
// program of its own, so that stiction is not linked with these packages.

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <filesystem>
#include <iostream>
#include <optional>

#include "bench/output.h"
#include "bench/peers/engines.h"
#include "bench/peers/families.h"
#include "bench/peers/native_lu.h"
#include "bench/peers/one_thread.h"
#include "bench/peers/tables.h"
#include "corpus/exit_code.h"
#include "corpus/input_error.h"
#include "corpus/json.h"
#include "corpus/keep_memory.h"

namespace stiction {
namespace {

constexpr const char* kFindex =
    "findex, of ODE, DART and Bullet, is another law than Coulomb's: abs(fF) <= mu abs(fN) with the normal "
    "forces "
    "as they are before any friction, whatever they become; in space for two directions by themselves, a "
    "pyramid. "
    "Its answers are judged by Coulomb's law like all others.";
constexpr const char* kSettings =
    "of several settings the one that answers best on the problems at hand: CFM, what ODE adds to the diagonal "
    "as a "
    "part of its largest entry, 1e-12, 1e-10, 1e-8 or 1e-6; NSN-AC, from f = 0 (plain) or after extragradient "
    "steps "
    "(hybrid).";

// Of the packages that were not found when this was built.
std::vector<std::string> MissingPackages() {
  std::vector<std::string> missing;
  if (MakeOde(false, 0) == nullptr) missing.push_back("libode-dev");
  if (MakeDart(false) == nullptr) missing.push_back("libdart-external-odelcpsolver-dev");
  if (MakeBullet(false) == nullptr) missing.push_back("libbullet-dev");
  if (MakeSiconos(SiconosMethod::kLcpLemke) == nullptr) missing.push_back("libsiconos-numerics-dev");
  if (Box2dEngines().empty()) missing.push_back("libbox2d-dev");
  if (MujocoEngines().empty()) missing.push_back("libmujoco-dev");
  return missing;
}

std::string UnitText() {
  return fmt::format(
      "times are ratios to Eigen's LU of A, compiled for {}; its row `native` for this processor, {}; "
      "`Gauss, plain loops` is elimination without blocks and pivoting",
      Eigen::SimdInstructionSetsInUse(), NativeLu::Instructions());
}

Json HeadJson(const PeersOptions& o) {
  return {{"seed", o.seed},
          {"one_thread", ThreadsJson()},
          {"lu", {{"instructions", Eigen::SimdInstructionSetsInUse()}, {"native", NativeLu::Instructions()}}},
          {"findex", kFindex},
          {"settings", kSettings},
          {"missing", MissingPackages()}};
}

void PrintHead(const PeersOptions& o) {
  const auto missing = MissingPackages();
  fmt::print("{}\n", ThreadsText());
  if (o.tables != std::vector<std::string>{"engines"})
    fmt::print("{}\n{}\n{}\n", UnitText(), kFindex, kSettings);
  if (!missing.empty()) fmt::print("not installed: {}\n", fmt::join(missing, ", "));
}

Json MeasureNamed(const std::string& name, const PeersOptions& o) {
  if (name == "structure") return MeasureStructure(o);
  if (name == "lemke") return MeasureLemke(o);
  if (name == "engines") return MeasureEngines(o);
  if (name == "growth-frictionless") return MeasureGrowth(false, o);
  if (name == "growth-planar") return MeasureGrowth(true, o);
  if (name == "growth-walls") return MeasureWallGrowth(2, o);
  if (name == "growth-walls-in-space") return MeasureWallGrowth(3, o);
  if (name == "extremes") return MeasureExtremes(true, o);
  if (name == "extremes-frictionless") return MeasureExtremes(false, o);
  return MeasureTable(name, o);
}

// A file descriptor that leads nowhere for a while.
class Silenced {
 public:
  explicit Silenced(int descriptor) : descriptor_(descriptor), kept_(dup(descriptor)) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, descriptor);
    close(nowhere);
  }
  Silenced(const Silenced&) = delete;
  Silenced& operator=(const Silenced&) = delete;
  ~Silenced() {
    std::fflush(stdout);
    dup2(kept_, descriptor_);
    close(kept_);
  }

 private:
  int descriptor_, kept_;
};

// Packages complain on standard error and output, Siconos of every singular matrix; what they claim is in the
// tables.
Json MeasureQuietly(const PeersOptions& o) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> heard(fdopen(dup(STDERR_FILENO), "w"), &std::fclose);
  progress::Expect(o.tables.size(), heard.get());
  const Silenced errors(STDERR_FILENO);
  std::optional<Silenced> output;
  if (o.json) output.emplace(STDOUT_FILENO);
  Json tables = Json::array();
  for (const std::string& name : o.tables) tables.push_back(MeasureNamed(name, o));
  progress::Clear();
  return tables;
}

void RequireScenes(const PeersOptions& o) {
  if (std::filesystem::is_directory(o.scenes)) return;
  throw InputError(fmt::format("--scenes: found no folder {}, expected that of the corpus's scenes", o.scenes));
}

// Those of the tables that have some.
std::vector<std::string> FamilyNames(const PeersOptions& o) {
  std::vector<std::string> names;
  if (std::find(o.tables.begin(), o.tables.end(), "engines") != o.tables.end()) names = EngineSceneNames();
  if (std::find(o.tables.begin(), o.tables.end(), "structure") == o.tables.end()) return names;
  for (const StructuredFamily& family : StructuredFamilies({})) names.push_back(family.name);
  return names;
}

void RequireFamilies(const PeersOptions& o) {
  const std::vector<std::string> names = FamilyNames(o);
  for (const std::string& family : o.families) {
    if (std::find(names.begin(), names.end(), family) == names.end())
      throw InputError(
          fmt::format("--families: found '{}', expected some of {}", family, fmt::join(names, ", ")));
  }
}

int RunPeers(const PeersOptions& o) {
  RequireFamilies(o);
  if (std::find(o.tables.begin(), o.tables.end(), "structure") != o.tables.end()) RequireScenes(o);
  Json json = HeadJson(o);
  if (!o.json) PrintHead(o);
  const Clocks start = ReadClocks();
  json["tables"] = MeasureQuietly(o);
  const Clocks clocks = ReadClocks() - start;
  json["clocks"] = ToJson(clocks);
  json["threads"] = ThreadCount();
  if (o.json) {
    std::cout << JsonText(json) << "\n";
  } else {
    fmt::print("\n{}\n", ClocksText(clocks));
  }
  return 0;
}

std::vector<std::string> UsualTables() {
  std::vector<std::string> tables = PeerTableNames();
  tables.insert(tables.end(),
                {"structure", "growth-frictionless", "growth-planar", "growth-walls", "growth-walls-in-space"});
  return tables;
}

std::vector<std::string> AllTables() {
  std::vector<std::string> tables = UsualTables();
  tables.insert(tables.end(), {"extremes-frictionless", "extremes", "lemke", "engines"});
  return tables;
}

void AddOptions(CLI::App& program, PeersOptions& o) {
  program.add_option("--table", o.tables, "tables to measure")
      ->capture_default_str()
      ->check(CLI::IsMember(AllTables()));
  program.add_option("--family", o.families, "of the tables `structure` and `engines`, these alone");
  program.add_option("--scenes", o.scenes, "folder of the corpus's scenes, for the table `structure`")
      ->capture_default_str();
  program.add_option("--contacts", o.contacts, "numbers of contacts, instead of each table's own")
      ->check(CLI::Range(1, 2000));
  program.add_option("--problems", o.problems, "of a size; half and an eighth of it above 10 and 30 contacts")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  program.add_option("--seconds", o.seconds, "time for each row and size")->capture_default_str();
  program.add_option("--cap", o.cap, "a row that needs more seconds of processor time for a problem shows '-'")
      ->capture_default_str();
  program.add_option("--structure-cap", o.structure_cap, "the same, of the table `structure`")
      ->capture_default_str();
  program
      .add_option("--frames", o.frames, "of a scene of the table `engines`, at most; those of a second or ten")
      ->check(CLI::PositiveNumber);
  program
      .add_option("--engine-cap", o.engine_cap,
                  "of the table `engines`, a scene ends after so many seconds of processor time")
      ->capture_default_str();
  program.add_option("--examples", o.examples,
                     "of the tables `extremes`, a folder for files of silently wrong answers");
  program.add_option("--seed", o.seed, "of the problems")->capture_default_str();
  program.add_flag("--json", o.json, "machine output");
}

int Main(int argc, char** argv) {
  RequireOneThread(argv);
  PeersOptions o;
  o.tables = UsualTables();
  CLI::App program("stiction beside the solvers of other packages", "stiction-peers");
  AddOptions(program, o);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw InputError(error.what());
    return program.exit(error);
  }
  return RunPeers(o);
}

}  // namespace
}  // namespace stiction

int main(int argc, char** argv) {
  stiction::KeepFreedMemory();  // for peers, too
  try {
    return stiction::Main(argc, argv);
  } catch (const stiction::InputError& error) {
    std::cerr << "stiction-peers: " << error.what() << "\n";
    return stiction::kExitBadInput;
  } catch (const std::exception& error) {
    std::cerr << "stiction-peers: internal error: " << error.what() << "\n";
    return stiction::kExitInternal;
  }
}
