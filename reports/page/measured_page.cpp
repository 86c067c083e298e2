// SPDX-License-Identifier: Apache-2.0
#include "reports/page/measured_page.h"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "corpus/json.h"
#include "reports/page/page.h"
#include "reports/tables/discovery.h"

namespace stiction {
namespace {

constexpr char kMeasuredLead[] =
    "<p>Users trade speed for accuracy: how long each method takes for a friction problem over each "
    "arithmetic, and how often its answer is none. Measured by <code>stiction bench</code>, on families of "
    "problems with a dial from ordinary to extreme.</p>";

constexpr char kHowMeasured[] =
    "<p><strong>Method.</strong> All methods, over all arithmetics, are asked the same problems of a family at "
    "each setting of its dial. <em>Silent</em> is what is called solved within errors that, computed over "
    "rationals, it does not have, or without a solution where there is one; <em>wrong</em> is that, and of the "
    "published algorithm another end than over rationals; <em>undecided</em> what says itself that it is no "
    "answer. Problems whose numbers an arithmetic cannot hold are not asked of it. Times are those of the "
    "machine that measured, medians of the settings’ medians.</p>";

// Sums over all rows of a kind of arithmetic.
struct Runs {
  std::int64_t asked = 0, wrong = 0, silent = 0;

  void Add(const RungLine& line) {
    asked += line.problems - line.refused;
    wrong += line.wrong;
    silent += line.silent;
  }
};

// "double scaled" is double, with a remedy.
std::string ArithmeticOf(const RungLine& line) { return line.arithmetic.substr(0, line.arithmetic.find(' ')); }

bool IsExact(const RungLine& line) { return line.arithmetic == "exact" || line.arithmetic == "filtered"; }

std::string Told(const Runs& runs) {
  return fmt::format("of {} {} {} wrong, {} of them silently", Counted(runs.asked, "run"), Grouped(runs.wrong),
                     runs.wrong == 1 ? "was" : "were", Grouped(runs.silent));
}

Html MeasuredSentences(const std::vector<RungLine>& lines) {
  std::set<std::string> families, methods, arithmetics;
  Runs rounded, exact;
  for (const RungLine& line : lines) {
    families.insert(line.family);
    methods.insert(line.method);
    arithmetics.insert(ArithmeticOf(line));
    (IsExact(line) ? exact : rounded).Add(line);
  }
  const auto counted = [](const std::set<std::string>& names, const char* noun) {
    return Counted(static_cast<std::int64_t>(names.size()), noun);
  };
  std::string text = fmt::format("{} over {}, on {} of problems.", counted(methods, "method"),
                                 counted(arithmetics, "arithmetic"), counted(families, "kind"));
  if (rounded.asked > 0) text += fmt::format(" Over rounded numbers {}.", Told(rounded));
  if (exact.asked > 0) text += fmt::format(" Over rationals and certified signs {}.", Told(exact));
  return Tag("p")(text) + Html("\n");
}

Html Again(const std::vector<std::filesystem::path>& files) {
  std::string commands =
      "./run bench --suite trade --csv trade.csv\n./run bench --suite extremes --csv extremes.csv\n"
      "./run report --bench";
  for (const auto& file : files) commands += " " + BenchName(file);
  return Section(
      "again", "Reproducing it",
      Html("<p>What measures, in the folder of the sources, and what makes this page of the files beside "
           "it:</p>\n") +
          Tag("pre")(Tag("code")(commands + " -o again")));
}

Html Files(const std::vector<std::filesystem::path>& files, const std::vector<Table>& figures, bool records) {
  const auto row = [](const std::string& file, const char* meaning) {
    return Tag("li")(Tag("a", {{"href", file}})(Tag("code")(file)) + Html(": ") + Text(meaning)) + Html("\n");
  };
  Html list;
  for (const auto& file : files) list += row(BenchName(file), "as bench wrote it");
  for (const Table& figure : figures)
    list += row("figures/" + figure.name + ".csv", "the numbers that the figure draws");
  if (records) list += row("frontiers.csv", "the records, exactly, and what drew the random problems");
  list += row("SHA256SUMS", "the SHA-256 of every file of this folder, for sha256sum --check");
  return Section("files", "Files beside this page", Tag("ul")(list));
}

Html Links(bool records) {
  std::vector<std::pair<std::string, std::string>> places = {{"#found", "Measured"},
                                                             {"#rungs", "Speed against accuracy"}};
  if (records) places.emplace_back("#frontiers", "Frontiers");
  places.insert(places.end(),
                {{"#again", "Reproducing it"}, {"#files", "Files"}, {"#method", "Method and definitions"}});
  return LinksTo(places);
}

}  // namespace

std::string BenchName(const std::filesystem::path& file) {
  return "bench/" + FileName(file.stem().string()) + ".csv";
}

std::string MeasuredPage(const std::vector<RungLine>& lines, const std::vector<FrontierLine>& frontiers,
                         const std::vector<std::filesystem::path>& files, const std::vector<Table>& figures) {
  return FilledPage(
      figures, {.title = "stiction: speed against accuracy",
                .heading = "Speed against accuracy of friction solvers",
                .lead = Html(kMeasuredLead),
                .navigation = Links(!frontiers.empty()),
                .found = Section("found", "What was measured", MeasuredSentences(lines)) + RungsSection(lines) +
                         FrontiersSection(frontiers) + Again(files) + Files(files, figures, !frontiers.empty()),
                .how = Html(kHowMeasured)});
}

}  // namespace stiction
