// SPDX-License-Identifier: Apache-2.0
#include "reports/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "corpus/input_error.h"
#include "corpus/json_text.h"
#include "reports/page/page.h"
#include "reports/papers/latex.h"
#include "reports/pictures/finding_picture.h"
#include "reports/tables/campaign_tables.h"
#include "reports/tables/discovery.h"
#include "reports/tables/since.h"

namespace stiction {
namespace {

// To the first in the order of interest alone; but the simplest loop, which the page shows, comes before all.
void LeaveFilesTo(std::vector<Discovery>& discoveries, std::int64_t most) {
  const Discovery* const simplest = SimplestLoop(discoveries);
  std::vector<const Discovery*> order = ByInterest(discoveries);
  std::stable_partition(order.begin(), order.end(), [simplest](const Discovery* d) { return d == simplest; });
  std::set<std::string> kept;
  for (const Discovery* discovery : order) {
    if (static_cast<std::int64_t>(kept.size()) < most) kept.insert(discovery->signature);
  }
  for (Discovery& discovery : discoveries) {
    if (!kept.contains(discovery.signature)) discovery.files = {};
  }
}

std::vector<RungLine> ReadAllRungs(const std::vector<std::filesystem::path>& files) {
  std::vector<RungLine> lines;
  for (const auto& file : files) {
    for (RungLine& line : ReadRungs(file)) lines.push_back(std::move(line));
  }
  return lines;
}

// What was measured, and the records, as they came.
void WriteMeasures(ReportFiles& folder, const ReportExtras& extras) {
  std::set<std::string> names;
  for (const auto& file : extras.benches) {
    const std::string name = BenchName(file);
    if (!names.insert(name).second)
      throw InputError(fmt::format("--bench: found two files {}, expected names of their own", name));
    folder.Write(name, ReadText(file));
  }
  if (!extras.frontiers.empty()) folder.Write("frontiers.csv", ToCsv(FrontiersTable(extras.frontiers)));
}

// What the report plays: the simplest loop, or the finding of most interest.
const Discovery* PlayedOf(const std::vector<Discovery>& discoveries) {
  if (const Discovery* simplest = SimplestLoop(discoveries)) return simplest;
  const std::vector<const Discovery*> all = ByInterest(discoveries);
  return all.empty() ? nullptr : all.front();
}

// The data of the player; null without one.
SharedJson WritePlayer(ReportFiles& folder, const std::vector<Discovery>& discoveries,
                       const ReportExtras& extras) {
  const Discovery* const played = PlayedOf(discoveries);
  if (played == nullptr || !extras.play) return {};
  const Finding& finding = *played->representative;
  const ProblemFile file =
      ParseProblem(finding.minimized.empty() ? finding.problem : finding.minimized, finding.signature);
  std::optional<Playable> playable = extras.play(file, finding.policy, played->files.problem);
  if (!playable) return {};
  if (const auto& run = played->minimized ? played->minimized : played->found) {
    playable->data.Add({{"looping", run->grid.Loops()}, {"policies", run->grid.Total()}});
  }
  playable->origin.report = "index.html";
  folder.Write("replay.html", ViewerPage(file.name + ", step by step", playable->data, playable->origin));
  return playable->data;
}

void WriteTables(ReportFiles& folder, const std::string& place, const std::vector<Table>& tables) {
  for (const Table& table : tables) folder.Write(place + table.name + ".csv", ToCsv(table));
}

// What pages say, as data, too; `measured` is the one page of benchmarks alone.
void WritePages(ReportFiles& folder, const ReportContent& content, const std::vector<std::string>& pages) {
  const Told told = Tell(content, pages);
  const std::vector<Table> figures = Figures(content);
  WriteTables(folder, "figures/", figures);
  folder.Write("report.json", JsonText(ToJson(told), 1) + "\n");
  for (const std::string& name : pages) {
    const std::string page =
        name == "findings" ? FindingsPage(content, told) : Page(name, content, told, figures);
    folder.Write(name == "measured" ? "index.html" : name + ".html", page);
  }
}

}  // namespace

std::filesystem::path WriteMeasured(const std::filesystem::path& directory, Occupied occupied,
                                    const ReportExtras& extras) {
  ReportContent content;
  content.rungs = ReadAllRungs(extras.benches);
  content.benches = extras.benches;
  content.frontiers = extras.frontiers;
  WholeFolder whole(directory, "report", occupied);
  ReportFiles folder(whole);
  WriteMeasures(folder, extras);
  WritePages(folder, content, {"measured"});
  folder.WriteSums();
  return whole.Commit();
}

std::filesystem::path WriteReport(const Store& store, const std::filesystem::path& directory, Occupied occupied,
                                  const ReportExtras& extras) {
  ReportContent content;
  if (!extras.since.empty()) content.since = ReadSince(extras.since);
  content.rungs = ReadAllRungs(extras.benches);
  content.frontiers = extras.frontiers;
  content.own = extras.own;
  content.labels = extras.labels;
  WholeFolder whole(directory, "report", occupied);
  ReportFiles folder(whole, extras.show);
  const std::vector<Finding> findings = store.Findings();
  content.identity = store.identity();
  content.blocks = static_cast<std::int64_t>(store.Blocks().size());
  content.totals = TotalsOf(store);
  content.discoveries = Discoveries(content.totals.record, findings);
  LeaveFilesTo(content.discoveries, extras.files);
  folder.ExpectFindings(std::count_if(content.discoveries.begin(), content.discoveries.end(),
                                      [](const Discovery& discovery) { return discovery.HasFiles(); }));
  for (Discovery& discovery : content.discoveries) {
    if (!discovery.HasFiles()) continue;
    for (const auto& [name, text] : FilesOf(discovery)) folder.Write(name, text);
    folder.FinishFinding();
    const std::string picture = SvgOfFinding(*discovery.representative);
    if (picture.empty()) continue;
    discovery.files.picture = "findings/" + FileName(discovery.signature) + ".svg";
    folder.Write(discovery.files.picture, picture);
  }
  WriteTables(folder, "", CampaignTables(content.totals.record, content.discoveries));
  whole.Write("work.csv",
              ToCsv(WorkTable(content.totals.work)));  // not among the sums: equal searches differ in it alone
  folder.Write("citation.bib", Citation(store));
  folder.Write("campaign.json", CampaignText(content.identity));
  if (content.since) WriteTables(folder, "", {SinceTable(*content.since, content.discoveries)});
  WriteMeasures(folder, extras);
  if (extras.latex) {
    for (const auto& [name, text] : LatexFiles(store)) folder.Write(name, text);
  }
  content.player = WritePlayer(folder, content.discoveries, extras);
  WritePages(folder, content, {"index", "results", "findings"});
  folder.WriteSums();
  return whole.Commit();
}

}  // namespace stiction
