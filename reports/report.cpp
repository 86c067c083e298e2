// SPDX-License-Identifier: Apache-2.0
#include "reports/report.h"

#include "reports/discovery.h"
#include "reports/latex.h"
#include "reports/page.h"
#include "reports/report_files.h"

namespace stiction {
std::filesystem::path WriteReport(const Store& store, const std::filesystem::path& directory, Occupied occupied,
                                  const std::vector<std::filesystem::path>& benches, bool latex) {
  ReportContent content;
  for (const auto& file : benches) {
    for (RungLine& line : ReadRungs(file)) content.rungs.push_back(std::move(line));
  }
  WholeFolder whole(directory, "report", occupied);
  ReportFiles folder(whole);
  const std::vector<Finding> findings = store.Findings();
  content.identity = store.identity();
  content.units = store.Units().Count();
  content.blocks = static_cast<std::int64_t>(store.Blocks().size());
  content.total = store.Total();
  content.work = store.TotalWork();
  content.discoveries = Discoveries(content.total, findings);
  for (const Discovery& discovery : content.discoveries) {
    if (discovery.representative == nullptr) continue;
    for (const auto& [name, text] : FilesOf(discovery)) folder.Write(name, text);
  }
  for (const auto& [name, text] : TablesOf(content.total, content.discoveries)) folder.Write(name, text);
  folder.Write("citation.bib", Citation(store));
  if (latex) {
    for (const auto& [name, text] : LatexFiles(store)) folder.Write(name, text);
  }
  folder.Write("index.html", Page(content));
  folder.WriteSums();
  return whole.Commit();
}

}  // namespace stiction
