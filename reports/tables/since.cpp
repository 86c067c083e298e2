// SPDX-License-Identifier: Apache-2.0
#include "reports/tables/since.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "corpus/input_error.h"
#include "corpus/input_file.h"

namespace stiction {
namespace {

// Of the columns, one that must be there.
std::size_t ColumnOf(const std::vector<std::string>& columns, const std::string& name,
                     const std::string& source) {
  const auto at = std::find(columns.begin(), columns.end(), name);
  if (at == columns.end())
    throw InputError(fmt::format("{}:1: found no column {}, expected findings.csv of a report", source, name));
  return static_cast<std::size_t>(at - columns.begin());
}

}  // namespace

std::string_view StateOf(const Discovery& discovery) {
  return discovery.representative == nullptr ? "counted" : discovery.Finished() ? "finished" : "pending";
}

std::string_view Since::ChangeOf(const Discovery& discovery) const {
  const auto before = earlier.find(discovery.signature);
  if (before == earlier.end()) return "new";
  if (discovery.Finished() && before->second.state != "finished") return "finished";
  return discovery.met > before->second.met ? "more" : "";
}

Since ReadSince(const std::filesystem::path& report) {
  const std::filesystem::path file = std::filesystem::is_directory(report) ? report / "findings.csv" : report;
  const std::string source = file.string();
  const auto rows = ReadCsv(ReadText(file), source);
  const std::vector<std::string> columns = rows.empty() ? std::vector<std::string>() : rows.front();
  const std::size_t signature = ColumnOf(columns, "signature", source),
                    count = ColumnOf(columns, "count", source), state = ColumnOf(columns, "state", source);
  Since since;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::string& text = rows[i][count];
    Since::Line line{rows[i][state], 0};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), line.met);
    if (error != std::errc() || end != text.data() + text.size() || line.met < 0)
      throw InputError(fmt::format("{}: row {}: count: found '{}', expected a count", source, i + 1, text));
    since.earlier[rows[i][signature]] = line;
  }
  return since;
}

Table SinceTable(const Since& since, const std::vector<Discovery>& discoveries) {
  Table table{"since", "", Columns("signature* change* count_before count state_before* state*")};
  std::set<std::string> present;
  for (const Discovery& discovery : discoveries) {
    present.insert(discovery.signature);
    const std::string_view change = since.ChangeOf(discovery);
    if (change.empty()) continue;
    const auto found = since.earlier.find(discovery.signature);
    const Since::Line before = found == since.earlier.end() ? Since::Line() : found->second;
    table.Add({discovery.signature, change, before.met, discovery.met, before.state, StateOf(discovery)});
  }
  for (const auto& [signature, line] : since.earlier) {
    if (present.count(signature) > 0) continue;
    table.Add({signature, "gone", line.met, 0, line.state, ""});
  }
  return table;
}

Html SinceText(const Since& since, const std::vector<Discovery>& discoveries) {
  std::map<std::string, std::int64_t> changes;
  for (const Table::Row& row : SinceTable(since, discoveries).rows) ++changes[Shown(row.cells[1])];
  std::string text = fmt::format(
      "Since the earlier report: {} new, {} finished that were not, and {} met more often, of {} groups; it "
      "had {}.",
      Grouped(changes["new"]), Grouped(changes["finished"]), Grouped(changes["more"]),
      Grouped(static_cast<std::int64_t>(discoveries.size())),
      Grouped(static_cast<std::int64_t>(since.earlier.size())));
  if (changes["gone"] > 0)
    text += fmt::format(" {} of those are not here: the earlier report is of another store.",
                        Grouped(changes["gone"]));
  return Tag("p", {{"class", "since"}})(Text(text) +
                                        Html(" Each is in <a href=\"since.csv\"><code>since.csv</code></a>.")) +
         Html("\n");
}

}  // namespace stiction
