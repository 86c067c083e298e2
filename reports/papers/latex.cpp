// SPDX-License-Identifier: Apache-2.0
#include "reports/papers/latex.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "corpus/plain_text.h"
#include "corpus/text_template.h"
#include "reports/papers/latex/citation_bib.h"
#include "reports/papers/latex/figure-loops_tex.h"
#include "reports/papers/latex/figure-steps_tex.h"
#include "reports/papers/latex/report_tex.h"
#include "reports/tables/campaign_tables.h"

namespace stiction {
namespace {

const By kBySize = {"policy", "contacts"};

// A table by another name.
Table Named(const char* name, Table table) {
  table.name = name;
  return table;
}

// Rates of the loops of the published algorithm by contacts, for each generator that has any.
std::map<std::string, Table> LoopCurves(const Record& record) {
  const By by = {"policy", "generator", "contacts"};
  Table table = CountedBy("often", by, GroupsBy(record, by));
  const auto loops = [](const Table::Row& row) { return std::get<Ratio>(row.cells.back().value); };
  std::erase_if(table.rows,
                [&](const auto& row) { return Shown(row.cells[0]) != "paper" || loops(row).of == 0; });
  std::map<std::string, Table> curves = SplitBy(table, "generator");
  std::erase_if(curves, [&](const auto& curve) {
    return std::ranges::all_of(curve.second.rows, [&](const auto& row) { return loops(row).count == 0; });
  });
  return curves;
}

// Of each number of contacts that shares of its runs took so many steps.
Table StepShares(const std::vector<Group>& sizes) {
  Table table{"steps", "", {{"steps"}}};
  for (const Group& size : sizes) table.columns.push_back({fmt::format(",,c{}", size.Number(1))});
  for (int steps = 0; steps < Tally::kBins; ++steps) {
    std::vector<TableCell> cells = {steps};
    for (const Group& size : sizes) cells.push_back(ShareOf(size.tally.steps[steps], size.counts.runs));
    table.Add(std::move(cells));
  }
  return table;
}

}  // namespace

std::map<std::string, std::string> LatexFiles(const Store& store) {
  const Record record = store.Total();
  const By by = {"generator", "policy", "arithmetic", "contacts"};
  std::map<std::string, std::string> files;
  for (const Table& table :
       {Named("loops", CountedBy("loops-in-papers", by, GroupsBy(record, by))),
        Named("contacts", CountedBy("contacts-in-papers", kBySize, GroupsBy(record, kBySize))),
        Named("methods", CountedByContacts("methods-in-papers", record))})
    files["latex/" + table.name + ".tex"] = ToLatex(table);
  std::vector<std::string> remarks, series, legend, contacts;
  for (const auto& [name, value] : PlainValues(RemarksOf(store.identity())))
    remarks.push_back(fmt::format("\\\\\n{}: {}", LatexText(name), LatexText(value)));
  for (const auto& [generator, rates] : LoopCurves(record)) {
    series.push_back(std::to_string(series.size() + 1));
    legend.push_back("{" + LatexText(generator) + "}");
    files["latex/loops-" + series.back() + ".csv"] = ToCsv(rates);
  }
  std::vector<Group> sizes = GroupsBy(record, kBySize);
  std::erase_if(sizes, [](const Group& size) { return size.Text(0) != "paper" || size.counts.runs == 0; });
  for (const Group& size : sizes) contacts.push_back(std::to_string(size.Number(1)));
  files["latex/steps.csv"] = ToCsv(StepShares(sizes));
  const Blanks blanks = {{{"SEED", std::to_string(store.identity().seed)},
                          {"ALGORITHM", std::to_string(store.identity().algorithm)},
                          {"REMARKS", fmt::format("{}", fmt::join(remarks, "\n"))},
                          {"SERIES", fmt::format("{}", fmt::join(series, ","))},
                          {"LEGEND", fmt::format("{}", fmt::join(legend, ","))},
                          {"CONTACTS", fmt::format("{}", fmt::join(contacts, ","))},
                          {"MOST", std::to_string(Tally::kBins - 1)}}};
  files["latex/report.tex"] = Filled(kReportTex, blanks);
  files["latex/figure-loops.tex"] = Filled(kFigureLoopsTex, blanks);
  files["latex/figure-steps.tex"] = Filled(kFigureStepsTex, blanks);
  return files;
}

std::string Citation(const Store& store) {
  std::string versions;  // "0.1.0 2060e9f249a5" of each build, whose compiler and flags follow
  for (const std::string& build : store.TotalWork().builds)
    versions += (versions.empty() ? "" : "; ") + build.substr(0, build.find(','));
  return Filled(kCitationBib, {{{"VERSIONS", LatexText(versions)},
                                {"SEED", std::to_string(store.identity().seed)},
                                {"ALGORITHM", std::to_string(store.identity().algorithm)}}});
}

}  // namespace stiction
