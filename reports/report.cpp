// SPDX-License-Identifier: Apache-2.0
#include "reports/report.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "corpus/json_text.h"
#include "reports/discovery.h"
#include "reports/figures.h"
#include "reports/finding_picture.h"
#include "reports/latex.h"
#include "reports/page.h"
#include "reports/report_files.h"
#include "reports/since.h"

namespace stiction {
namespace {

// What was searched, as stiction search reads it; the definition as it stands if that is no JSON object.
std::string CampaignFile(const CampaignIdentity& identity) {
  Json campaign = Json::parse(identity.definition, nullptr, false);
  const Json policies = Json::parse(identity.policies, nullptr, false);
  if (!campaign.is_object()) return identity.definition + "\n";
  if (policies.is_array()) campaign["policies"] = policies;
  return JsonText(campaign, 1) + "\n";
}

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

}  // namespace

std::filesystem::path WriteReport(const Store& store, const std::filesystem::path& directory, Occupied occupied,
                                  const ReportExtras& extras) {
  ReportContent content;
  if (!extras.since.empty()) content.since = ReadSince(extras.since);
  for (const auto& file : extras.benches) {
    for (RungLine& line : ReadRungs(file)) content.rungs.push_back(std::move(line));
  }
  content.frontiers = extras.frontiers;
  WholeFolder whole(directory, "report", occupied);
  ReportFiles folder(whole);
  const std::vector<Finding> findings = store.Findings();
  content.identity = store.identity();
  content.units = store.Units().Count();
  content.blocks = static_cast<std::int64_t>(store.Blocks().size());
  content.total = store.Total();
  content.work = store.TotalWork();
  content.discoveries = Discoveries(content.total, findings);
  LeaveFilesTo(content.discoveries, extras.files);
  for (Discovery& discovery : content.discoveries) {
    if (!discovery.HasFiles()) continue;
    for (const auto& [name, text] : FilesOf(discovery)) folder.Write(name, text);
    const std::string picture = SvgOfFinding(*discovery.representative);
    if (picture.empty()) continue;
    discovery.files.picture = "findings/" + FileName(discovery.signature) + ".svg";
    folder.Write(discovery.files.picture, picture);
  }
  for (const auto& [name, text] : TablesOf(content.total, content.discoveries)) folder.Write(name, text);
  folder.Write("citation.bib", Citation(store));
  folder.Write("campaign.json", CampaignFile(content.identity));
  if (content.since) folder.Write("since.csv", SinceCsv(*content.since, content.discoveries));
  if (!content.frontiers.empty()) folder.Write("frontiers.csv", FrontiersCsv(content.frontiers));
  if (extras.latex) {
    for (const auto& [name, text] : LatexFiles(store)) folder.Write(name, text);
  }
  const std::vector<FigureTable> figures = Figures(content);
  for (const FigureTable& figure : figures) folder.Write("figures/" + figure.name + ".csv", FigureCsv(figure));
  folder.Write("index.html", Page(content, figures));
  folder.WriteSums();
  return whole.Commit();
}

}  // namespace stiction
