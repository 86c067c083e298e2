// SPDX-License-Identifier: Apache-2.0
// stiction survey: which assumptions of the paper problems meet, what solves them, and how well.

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <new>
#include <string>
#include <vector>

#include "certify/request/facts.h"
#include "cli/command_line.h"
#include "cli/shared.h"
#include "corpus/grouped.h"
#include "corpus/json.h"

namespace stiction {
namespace {

struct SurveyVerb {
  std::vector<std::string> paths;
  int rows = kDenseRows;
  bool suspicions = false;
  Limits limits = {};
  bool json = false;
};

// ---- Text for people -----------------------------------------------------------------------------

std::string CurvatureText(const Json& curvature) {
  if (curvature["psd"] == true) return "yes";
  const std::string least = curvature.contains("least") ? ShortText(curvature["least"].get<double>()) : "?";
  if (curvature["psd"] == false)
    return fmt::format("no: {} .. {}", least, ShortText(curvature["most"].get<double>()));
  return ">= " + least;
}

std::string RangeText(const Json& range) {
  if (range["in-range"] == true) return range["regular"] == true ? "yes, as all are" : "yes";
  return (range["in-range"] == false ? "no: " : "<= ") + ShortText(range["distance"].get<double>());
}

// Says nothing of an A that is far from symmetric.
std::string RoughText(const Json& facts) {
  if (facts["asymmetry"].value("relative", 0.0) > kMostRounding) return "";
  return ShortText(facts["range"]["rough distance"].get<double>());
}

// The facts in a line, then a table of the runs.
void PrintRuns(const std::string& head, const std::string& asymmetry, const Json& facts) {
  const std::string rough = RoughText(facts);
  Tell("{}\n  A - A' {}; A psd: {}; b in range: {}{}\n", head, asymmetry, CurvatureText(facts["curvature"]),
       RangeText(facts["range"]), rough.empty() ? "" : "; rough " + rough);
  TextTable table({"method", "outcome", "error", "seconds"}, 2);
  for (const Json& run : facts["runs"]) {
    std::string method = run["method"].get<std::string>();
    if (const std::string by = run.value("answered by", method); by != method) method += " (" + by + ")";
    if (run.contains("arithmetic")) method += ", " + run["arithmetic"].get<std::string>();
    std::string outcome = run["outcome"].get<std::string>();
    if (run.contains("reason")) outcome += ": " + run["reason"].get<std::string>();
    table.AddRow({method, outcome, run.contains("residual") ? ShortText(run["residual"].get<double>()) : "",
                  run.contains("seconds") ? fmt::format("{:.3f}", run["seconds"].get<double>()) : ""});
  }
  std::cout << table.Done();
}

// The facts once, then a line for every run; the same of (A + A')/2, if that was judged.
void PrintSurveyed(const Json& entry) {
  const std::string name = std::filesystem::path(entry["file"].get<std::string>()).filename().string();
  PrintRuns(fmt::format("{}: {}{}", name, Counted(entry["contacts"].get<int>(), "contact"),
                        entry["dimension"] == 3 ? " in space" : ""),
            ShortText(entry["asymmetry"]["relative"].get<double>()), entry);
  if (entry.contains("symmetrized")) PrintRuns("with (A + A')/2 in place of A:", "0", entry["symmetrized"]);
}

// How many of the problems meet the assumptions.
std::string MeetingText(const Json& entries) {
  int meet = 0, fail = 0, open = 0, unread = 0;
  for (const Json& entry : entries) {
    if (entry.contains("error")) {
      ++unread;
    } else {
      const Json& meets = entry["meets assumptions"];
      ++(meets == true ? meet : meets == false ? fail : open);
    }
  }
  std::string text =
      fmt::format("Of {} {} meet the paper's assumptions, {} do not, {} are undecided",
                  Counted(static_cast<std::int64_t>(entries.size()), "problem"), meet, fail, open);
  if (unread > 0) text += fmt::format(", {} could not be read", unread);
  return text + ".\n";
}

// The counts of many problems: how many meet the paper's assumptions, and how often each method ended how.
void PrintSurveyCounts(const Json& entries, bool suspicions) {
  std::map<std::string, std::map<std::string, int>> counts;
  for (const Json& entry : entries) {
    for (const Json& run : entry.value("runs", Json::array())) {
      const std::string method =
          fmt::format("{}, {}", run["method"].get<std::string>(), run.value("arithmetic", "-"));
      ++counts[method][run["outcome"].get<std::string>()];
    }
  }
  Tell("\n{}Each method, and how it ended{}:\n", MeetingText(entries),
       suspicions ? "; exact: those that doubles leave open" : "");
  for (const auto& [method, outcomes] : counts) {
    std::vector<std::string> parts;
    for (const auto& [outcome, count] : outcomes) parts.push_back(fmt::format("{} {}", outcome, count));
    Tell("{:24}  {}\n", method, fmt::join(parts, ", "));
  }
}

// ---- The verb --------------------------------------------------------------------------------------

// Files as they are given; of a folder those that look like problems, by name.
std::vector<std::filesystem::path> FilesOf(const std::vector<std::string>& paths) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path path : paths) {
    if (!std::filesystem::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path)) {
      const std::string extension = entry.path().extension().string();
      const bool looks_so = extension == ".dat" || extension == ".hdf5" || extension == ".json";
      if (entry.is_regular_file() && looks_so) found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

// A file that cannot be read, or ends in an error of ours, does not keep the others from being judged.
int Survey(const SurveyVerb& o) {
  int exit = kExitDone;
  Json entries = Json::array();
  ProgressBar bar;
  const std::vector<std::filesystem::path> files = FilesOf(o.paths);
  if (files.empty())
    throw InputError(
        fmt::format("survey: found no problem file in {}, expected files named *.json, *.dat or *.hdf5",
                    fmt::join(o.paths, ", ")));
  const auto fail = [&](const std::filesystem::path& file, const std::string& error, int ended) {
    if (exit != kExitInternal) exit = ended;
    bar.Clear();
    fmt::print(std::cerr, "stiction: {}\n", error);
    entries.push_back({{"file", file.string()}, {"error", error}});
  };
  for (const std::filesystem::path& file : files) {
    bar.Show(static_cast<double>(entries.size()) / static_cast<double>(files.size()),
             fmt::format("{} of {}: {}", entries.size() + 1, files.size(), file.filename().string()));
    try {
      Json entry = Surveyed(InFactors(ReadProblem(file, kAnyRows)), o.limits, o.rows, o.suspicions);
      entry["file"] = file.string();
      bar.Clear();
      if (!o.json) PrintSurveyed(entry);
      std::fflush(stdout);
      entries.push_back(std::move(entry));
    } catch (const InputError& error) {
      fail(file, error.what(), kExitBadInput);
    } catch (const std::bad_alloc&) {
      fail(file, fmt::format("{}: limit: out of memory", file.string()), kExitUndecided);
    } catch (const std::exception& error) {
      fail(file, fmt::format("{}: internal error: {}", file.string(), error.what()), kExitInternal);
    }
  }
  if (o.json) std::cout << JsonText(entries) << "\n";
  if (!o.json && entries.size() > 1) PrintSurveyCounts(entries, o.suspicions);
  return exit;
}

}  // namespace

const ListedVerb kSurveyVerb("Solve", 30, [](CommandLine& program) {
  auto [verb, o] =
      program.Add("survey", "Judge problems: the paper's assumptions, what solves them, and how well", Survey);
  verb.footer =
      "The error says by how much b and mu must change for the forces to be exact, by Coulomb's law, beside "
      "eight "
      "roundings of A: zero exactly at solutions; `solved` is at most 1e-8. It is that of the returned "
      "doubles, "
      "evaluated over rationals on the matrix of the problem. A - A' and the distance of b from the range of A "
      "are relative; `rough` is an estimate of the latter, the others are bounds. Witnesses of what fails: "
      "`certify FILE --claim psd` or `--claim in-range`.";
  verb.Positional("PATH", o.paths, "problems in any form that is read, or folders of files")
      .Required()
      .Details(kFileDetails);
  verb.Option("--rows", o.rows, "the most rows for methods that hold A as a dense matrix")
      .Range(0, kMostDenseRows);
  verb.Flag("--suspicions", o.suspicions, "in the plane: also the published algorithm over doubles")
      .Details("Over rationals only what no run over doubles solves with a residual of at most 1e-6");
  verb.Prints(o.json, "a row for each problem: assumptions, and what solves it",
              R"([{file: text, error: text} | {
      file: text, contacts: integer, dimension: 2 | 3, rows: integer, asymmetry: object,
      curvature: {psd: truth | null, how: "bound" | "exact" | "factors", least?: rounded, most?: rounded},
      range: {"in-range": truth | null, distance: rounded, "rough distance": rounded, regular: truth},
      "meets assumptions"?: truth | null, symmetrized?: object,
      runs: [{method: method | "none", "answered by"?: method, arithmetic?: arithmetic,
              outcome: outcome | "not tried", seconds?: number, statistics?: counters, residual?: rounded,
              certificate?: text, reason?: text, ...}]}])");
  AddLimits(verb, o.limits);
});

}  // namespace stiction
