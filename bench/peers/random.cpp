// SPDX-License-Identifier: Apache-2.0
// Random problems: stiction's methods, the solvers of other packages, and a linear system, by the number of
// contacts.

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "bench/output.h"
#include "bench/peers/rows.h"
#include "corpus/json.h"
#include "search/generators/choices.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

struct Table {
  std::string name, title;
  std::vector<int> sizes;
  std::function<PeerProblem(int contacts, std::uint64_t seed)> make;
  std::vector<PeerRow> rows;  // the first is the unit of time
  bool residuals = false;     // in the text, too
};

std::vector<Table> Tables() {
  const std::vector<int> frictionless = {3, 6, 10, 30, 75, 150}, planar = {2, 3, 4, 8, 16, 32},
                         spatial = {1, 2, 5, 10, 30, 100};
  const auto plane = [](bool friction, bool full_rank) {
    return [=](int contacts, std::uint64_t seed) { return MakePlanar(contacts, friction, full_rank, seed); };
  };
  const auto space = [](bool definite) {
    return [=](int contacts, std::uint64_t seed) { return MakeSpatial(contacts, definite, seed); };
  };
  return {
      {"full", "frictionless, A of full rank", frictionless, plane(false, true), FrictionlessRows()},
      {"half", "frictionless, A of rank n/2, b in its range", frictionless, plane(false, false),
       FrictionlessRows()},
      {"planar", "planar static friction, A of full rank, mu per contact", planar, plane(true, true),
       PlanarRows()},
      {"planar-half", "planar static friction, A of half rank, b in its range", planar, plane(true, false),
       PlanarRows()},
      {"space", "Coulomb's law in space, contacts of random bodies, A definite", spatial, space(true),
       SpatialRows(), true},
      {"space-half", "the same with n/4 bodies: A of rank 3n/2 of 3n, b in its range", spatial, space(false),
       SpatialRows(), true},
  };
}

std::vector<PeerProblem> ProblemsOf(const Table& table, int size, const PeersOptions& o) {
  const int count = size <= 10 ? o.problems : size <= 30 ? o.problems / 2 : o.problems / 8;
  std::vector<PeerProblem> problems;
  for (int k = 0; k < std::max(1, count); ++k)
    problems.push_back(table.make(size, ProblemSeed(o.seed, size, k)));
  return problems;
}

// ---- Text ------------------------------------------------------------------------------------

std::string CellText(const PeerCell& cell, bool residual) {
  if (!cell.installed) return "not inst.";
  if (cell.capped) return "-";
  std::string text = fmt::format("{:.2f}", cell.ratio.median);
  if (!cell.setting.empty()) text += fmt::format(" @{}", cell.setting);
  const Score& answers = cell.answers;
  if (residual && answers.tried > 0) text += fmt::format(" {:.0e}", answers.residual);
  if (answers.wrong > 0) text += fmt::format(" {}/{}/{}", answers.wrong, answers.silent, answers.tried);
  return text;
}

// By size, then by row.
using Columns = std::vector<std::vector<PeerCell>>;

void PrintTable(const Table& table, const std::vector<int>& sizes, const Columns& columns) {
  const int width = table.residuals ? 31 : 24;
  fmt::print("\n{}: time / LU of A{}, answers wrong/silent/tried where any is wrong\n{:20}", table.title,
             table.residuals ? ", median residual" : "", "contacts");
  for (const int size : sizes) fmt::print("{:>{}}", size, width);
  fmt::print("\n{:20}", "LU, microseconds");
  for (const auto& column : columns) fmt::print("{:>{}.2f}", 1e6 * column[0].seconds.median, width);
  fmt::print("\n");
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    fmt::print("{:20}", table.rows[i].name);
    for (const auto& column : columns) fmt::print("{:>{}}", CellText(column[i], table.residuals), width);
    fmt::print("\n");
  }
  for (const char* ours : {"fast", "auto"}) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::string ahead = AheadText(PeersAhead(table.rows, columns[c], ours));
      if (!ahead.empty()) fmt::print("ahead of {} at {} contacts: {}\n", ours, sizes[c], ahead);
    }
  }
  std::fflush(stdout);
}

// ---- JSON ------------------------------------------------------------------------------------

Json RowsJson(const Table& table, const std::vector<int>& sizes, const Columns& columns) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    Json cells = Json::array();
    for (std::size_t c = 0; c < columns.size(); ++c) {
      cells.push_back(CellJson(table.rows[i], columns[c][i]));
      cells.back()["contacts"] = sizes[c];
    }
    rows.push_back({{"name", table.rows[i].name}, {"package", table.rows[i].package}, {"cells", cells}});
  }
  return rows;
}

Json AheadJson(const Table& table, const std::vector<int>& sizes, const Columns& columns) {
  Json ahead = Json::array();
  for (const char* ours : {"fast", "auto"}) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      for (Json peer : ToJson(PeersAhead(table.rows, columns[c], ours))) {
        peer["contacts"] = sizes[c];
        ahead.push_back(peer);
      }
    }
  }
  return ahead;
}

Json MeasureAll(const Table& table, const PeersOptions& o) {
  const std::vector<int>& sizes = o.contacts.empty() ? table.sizes : o.contacts;
  Columns columns;
  progress::Begin(table.name, static_cast<std::int64_t>(sizes.size() * table.rows.size()));
  for (const int size : sizes) columns.push_back(MeasureRows(table.rows, ProblemsOf(table, size, o), o));
  progress::Clear();
  if (!o.json) PrintTable(table, sizes, columns);
  return {{"name", table.name},
          {"title", table.title},
          {"rows", RowsJson(table, sizes, columns)},
          {"ahead", AheadJson(table, sizes, columns)}};
}

}  // namespace

std::vector<std::string> PeerTableNames() {
  std::vector<std::string> names;
  for (const Table& table : Tables()) names.push_back(table.name);
  return names;
}

Json MeasureTable(const std::string& name, const PeersOptions& o) {
  const std::vector<Table> tables = Tables();
  const auto table = std::find_if(tables.begin(), tables.end(), [&](auto& t) { return t.name == name; });
  STICTION_CHECK(table != tables.end(), "the table is one of PeerTableNames()");
  return MeasureAll(*table, o);
}

}  // namespace stiction
