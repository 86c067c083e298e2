// SPDX-License-Identifier: Apache-2.0
#include "reports/tables/since.h"

#include <fmt/format.h>

#include <set>

#include "corpus/input_error.h"

namespace stiction {
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
  const bool is_folder = std::filesystem::is_directory(report);
  const std::filesystem::path file = is_folder ? report / "findings.csv" : report;
  const auto refuse = [&report](const char* found) {
    throw InputError(
        fmt::format("--since: found {}, {}; expected the folder of an earlier report, which stiction report "
                    "STORE -o FOLDER writes",
                    report.string(), found));
  };
  if (!std::filesystem::exists(report)) refuse("which is not there");
  if (is_folder && !std::filesystem::exists(file)) refuse("a folder without findings.csv");
  const std::string text = ReadText(file);
  if (text.starts_with("SQLite format 3")) refuse("a store");
  const CsvReader rows(text, file.string(), "findings.csv of a report");
  for (const char* column : {"signature", "count", "state"})
    rows.IndexOf(column);  // also where there is no row
  Since since;
  for (std::size_t i = 0; i < rows.size(); ++i)
    since.earlier[rows.Text(i, "signature")] = {rows.Text(i, "state"), rows.Count(i, "count")};
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

}  // namespace stiction
