// SPDX-License-Identifier: Apache-2.0
// Problems with structure (structure.h): the same rows as on random ones, a block for each family.

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>

#include "bench/output.h"
#include "bench/peers/families.h"
#include "bench/peers/rows.h"
#include "corpus/json.h"

namespace stiction {
namespace {

std::vector<PeerRow> RowsOf(const StructuredFamily& family) {
  if (family.dimension == 3) return SpatialRows();
  return family.friction ? PlanarRows() : FrictionlessRows();
}

Eigen::Index RankOf(const PeerProblem& problem) {
  Eigen::FullPivLU<Eigen::MatrixXd> lu(problem.A);
  lu.setThreshold(1e-12);
  return lu.rank();
}

std::string TimeText(double seconds) {
  return seconds < 1e-3 ? fmt::format("{:.1f} us", 1e6 * seconds) : fmt::format("{:.1f} ms", 1e3 * seconds);
}

std::string AnswersText(const PeerRow& row, const Score& answers) {
  if (row.judge == Judge::kNone) return "";
  if (row.judge == Judge::kClaim) return "another law";
  std::string text = fmt::format("{:8.0e} {:8.0e} {:5.0f} % of {}", answers.residual, answers.worst,
                                 100 * answers.share(), answers.tried);
  if (answers.silent > 0) text += fmt::format(", {} silently wrong", answers.silent);
  if (answers.refused > 0) text += fmt::format(", {} called failures", answers.refused);
  for (const auto& [method, count] : answers.by) text += fmt::format(", {} by {}", count, method);
  return text;
}

void PrintRow(const PeerRow& row, const PeerCell& cell) {
  const std::string name = row.name + (cell.setting.empty() ? "" : " " + cell.setting);
  if (!cell.measured()) {
    fmt::print("  {:26} {}\n", name, cell.installed ? "-" : "not inst.");
    return;
  }
  const std::string spread =
      fmt::format("({:.2f} - {:.2f}, {:.2f})", cell.ratio.low, cell.ratio.high, cell.ratio.ninety);
  fmt::print("  {:26} {:>9.2f} {:>22} {:>11}  {}\n", name, cell.ratio.median, spread,
             TimeText(cell.processor.median), AnswersText(row, cell.answers));
}

void PrintBlock(const StructuredFamily& family, const Json& size, const std::vector<PeerRow>& rows,
                const std::vector<PeerCell>& cells) {
  fmt::print("\n{}: {} contacts, {} rows of rank {}, {} problems\n", family.title,
             size["contacts"].get<std::int64_t>(), size["rows"].get<std::int64_t>(),
             size["rank"].get<std::int64_t>(), size["problems"].get<std::int64_t>());
  fmt::print("  {:26} {:>9} {:>22} {:>11}  {:>8} {:>8} {}\n", "", "time / LU", "quartiles, 90 %", "processor",
             "residual", "worst", "solved");
  for (std::size_t i = 0; i < rows.size(); ++i) PrintRow(rows[i], cells[i]);
  for (const char* ours : {"fast", "auto"}) {
    const std::string ahead = AheadText(PeersAhead(rows, cells, ours));
    if (!ahead.empty()) fmt::print("  ahead of {}: {}\n", ours, ahead);
  }
  std::fflush(stdout);
}

Json MeasureFamily(const StructuredFamily& family, const PeersOptions& o) {
  const auto problems = family.make(std::min(family.problems, o.problems), o.seed);
  const std::vector<PeerRow> rows = RowsOf(family);
  PeersOptions patient = o;
  patient.cap = o.structure_cap;
  const std::vector<PeerCell> cells = MeasureRows(rows, problems, patient);
  const PeerProblem& first = problems.front();
  Json json = {{"name", family.name},
               {"title", family.title},
               {"dimension", family.dimension},
               {"friction", family.friction}};
  const Json size = {{"contacts", first.contacts.size()},
                     {"rows", first.rows()},
                     {"rank", RankOf(first)},
                     {"problems", problems.size()}};
  json.update(size);
  progress::Clear();
  if (!o.json) PrintBlock(family, size, rows, cells);
  json["methods"] = Json::array();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    json["methods"].push_back(CellJson(rows[i], cells[i]));
    json["methods"].back().update({{"name", rows[i].name}, {"package", rows[i].package}});
  }
  json["ahead"] = Json::array();
  for (const char* ours : {"fast", "auto"}) {
    for (const Json& peer : ToJson(PeersAhead(rows, cells, ours))) json["ahead"].push_back(peer);
  }
  return json;
}

}  // namespace

Json MeasureStructure(const PeersOptions& o) {
  std::vector<StructuredFamily> asked = StructuredFamilies(o.scenes);
  std::erase_if(asked, [&o](const StructuredFamily& family) {
    return !o.families.empty() &&
           std::find(o.families.begin(), o.families.end(), family.name) == o.families.end();
  });
  std::size_t rows = 0;
  for (const StructuredFamily& family : asked) rows += RowsOf(family).size();
  progress::Begin("structure", static_cast<std::int64_t>(rows));
  Json families = Json::array();
  for (const StructuredFamily& family : asked) families.push_back(MeasureFamily(family, o));
  return {{"name", "structure"}, {"families", families}};
}

}  // namespace stiction
