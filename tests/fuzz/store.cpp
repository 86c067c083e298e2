// SPDX-License-Identifier: Apache-2.0
// Stores with other values in their columns: what reads them.
//
//   {"units": {"record": {...}}, "campaign": {"seed": "x"}, ...}   table -> column -> value; of `campaign` key
//   -> value
//
// A text, a number or null is one of SQLite; any other value is written as JSON text; "hex:ff00" are bytes.

#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "corpus/json.h"
#include "corpus/record/problem_file.h"
#include "corpus/store/store_rows.h"
#include "reports/page/page.h"
#include "reports/tables/campaign_tables.h"
#include "reports/text/text_report.h"
#include "search/campaign.h"
#include "search/summary.h"
#include "search/testimony.h"
#include "search/units/known_signatures.h"
#include "solver/problem/check.h"
#include "tests/fuzz/targets.h"
#include "tests/support.h"

namespace stiction::fuzz {
namespace {

namespace fs = std::filesystem;

// ---- A store --------------------------------------------------------------------------------------

// In memory where the system has such a folder; gone with the process.
class StoreFolder {
 public:
  StoreFolder() {
    const fs::path memory = "/dev/shm";
    std::error_code none;
    std::string name =
        ((fs::is_directory(memory, none) ? memory : fs::temp_directory_path()) / "stiction-fuzz-XXXXXX");
    STICTION_CHECK(mkdtemp(name.data()) != nullptr, "no folder for a store");
    path_ = name;
  }
  StoreFolder(const StoreFolder&) = delete;
  StoreFolder& operator=(const StoreFolder&) = delete;
  ~StoreFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  fs::path operator/(const char* name) const { return path_ / name; }

 private:
  fs::path path_;
};

Record SomeRecord() {
  Record record;
  Verdict verdict;
  verdict.outcome = Outcome::kCycle;
  verdict.statistics = {.drives = 9, .steps = 14, .pivots = 13, .zero_steps = 3, .give_ups = 2};
  Tally& tally = record.tallies[{"psd", 2, "paper"}];
  tally.Count(verdict);
  tally.strata[{"1/2", 3}].Count(verdict);
  record.signatures["cycle-2c-4d-14s-0123456789abcdef"] = 1;
  record.loops[2] = {.loops = 1, .drives = 4, .steps = 14, .zero_steps = 3, .by_zero_steps = {{3, 1}}};
  record.existence[2] = {.problems = 1, .solved = 1, .pieces = 6};
  record.agreement[2].compared = 1;
  record.agreement[2].words[1] = 1;
  return record;
}

Finding SomeFinding() {
  ProblemFile file;
  file.name = "found";
  file.problem = testing::ReferenceProblem();
  const Json run = {{"contacts", 2}, {"start", 2}, {"period", 4}, {"steps", 14}, {"grid", {{"cycle", 1536}}},
                    {"safe", false}};
  Finding finding;
  finding.signature = "cycle-2c-4d-14s-0123456789abcdef";
  finding.kind = "cycle";
  finding.generator = "psd";
  finding.contacts = 2;
  finding.policy = "paper";
  finding.inexact_outcome = finding.exact_outcome = "cycle";
  finding.problem = finding.minimized = Print(file);
  finding.certificate = finding.minimized_certificate = finding.existence = finding.minimized_existence = "{}";
  finding.facts = Json{{"found", run}, {"minimized", run}}.dump();
  finding.done = true;
  return finding;
}

std::string BytesOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A closed database.
class Database {
 public:
  explicit Database(const fs::path& file) {
    STICTION_CHECK(sqlite3_open(file.c_str(), &db_) == SQLITE_OK, "no database");
    Execute("PRAGMA journal_mode = OFF");
    Execute("PRAGMA synchronous = OFF");
  }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  ~Database() { sqlite3_close(db_); }

  void Execute(const std::string& sql) const { sqlite3_exec(db_, sql.c_str(), nullptr, nullptr, nullptr); }

  // Every row as if it had been written as it stands.
  void Seal() const {
    for (const StoreTable& table : StoreTables()) {
      std::string keys;
      for (int i = 0; i < table.keys; ++i)
        keys += (i > 0 ? " AND " : " WHERE ") + std::string(table.columns[i]) + " IS ?";
      std::vector<std::vector<std::string>> rows;
      ForEachRow(SelectFrom(table.name, ""),
                 [&](std::vector<std::string> row) { rows.push_back(std::move(row)); });
      for (std::vector<std::string>& row : rows) {
        row.pop_back();
        std::vector<std::string> values = {SealOf(table.name, row)};
        values.insert(values.end(), row.begin(), row.begin() + table.keys);
        Update("UPDATE " + std::string(table.name) + " SET seal = ?" + keys, values);
      }
    }
    std::vector<std::string> campaign;
    ForEachRow("SELECT key, value FROM campaign WHERE key != 'seal' ORDER BY key",
               [&](const auto& row) { campaign.insert(campaign.end(), row.begin(), row.end()); });
    Update("UPDATE campaign SET value = ? WHERE key = 'seal'", {SealOf("campaign", campaign)});
  }

  // Nothing happens where SQLite does not let it: null, a key that stands already, a column that is none.
  void Set(const std::string& table, const std::string& column, const Json& value) const {
    const bool campaign = table == "campaign";
    const std::string sql = campaign ? "UPDATE campaign SET value = ?1 WHERE key = ?2"
                                     : "UPDATE \"" + table + "\" SET \"" + column + "\" = ?1";
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(db_, sql.c_str(), -1, &statement, nullptr) != SQLITE_OK) return;
    Bind(statement, value);
    if (campaign)
      sqlite3_bind_text(statement, 2, column.data(), static_cast<int>(column.size()), SQLITE_TRANSIENT);
    sqlite3_step(statement);
    sqlite3_finalize(statement);
  }

 private:
  template <class Visit>
  void ForEachRow(const std::string& sql, const Visit& visit) const {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(db_, sql.c_str(), -1, &statement, nullptr) != SQLITE_OK) return;
    while (sqlite3_step(statement) == SQLITE_ROW) {
      std::vector<std::string> row;
      for (int i = 0; i < sqlite3_column_count(statement); ++i) {
        const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement, i));
        row.emplace_back(text == nullptr ? "" : text,
                         static_cast<std::size_t>(sqlite3_column_bytes(statement, i)));
      }
      visit(std::move(row));
    }
    sqlite3_finalize(statement);
  }

  void Update(const std::string& sql, const std::vector<std::string>& values) const {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(db_, sql.c_str(), -1, &statement, nullptr) != SQLITE_OK) return;
    int number = 0;
    for (const std::string& value : values)
      sqlite3_bind_text(statement, ++number, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
    sqlite3_step(statement);
    sqlite3_finalize(statement);
  }

  static std::string FromHex(const std::string& text) {
    std::string bytes;
    for (std::size_t i = 4; i + 1 < text.size(); i += 2)
      bytes += static_cast<char>(std::strtol(text.substr(i, 2).c_str(), nullptr, 16));
    return bytes;
  }

  static void Bind(sqlite3_stmt* statement, const Json& value) {
    if (value.is_null()) return;
    if (value.is_number_integer()) {
      sqlite3_bind_int64(statement, 1, value.get<std::int64_t>());
      return;
    }
    if (value.is_number()) {
      sqlite3_bind_double(statement, 1, value.get<double>());
      return;
    }
    std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    if (text.starts_with("hex:")) text = FromHex(text);
    sqlite3_bind_text(statement, 1, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  }

  sqlite3* db_ = nullptr;
};

// The bytes of a store with a unit, a block and a finding.
std::string MakeStore(const StoreFolder& folder) {
  const fs::path file = folder / "first";
  {
    Store store(file, IdentityOf(Campaign()));
    store.AddUnit({}, 0, SomeRecord(), {SomeFinding()});
    store.Finish(SomeFinding());
  }
  const Database database(file);
  database.Execute("INSERT INTO blocks SELECT shards, shard, 5, record, seal FROM units");
  database.Seal();
  return BytesOf(file);
}

// ---- Readers --------------------------------------------------------------------------------------

// Every reader in turn, whatever the others refuse.
class Readers {
 public:
  template <class Read>
  void operator()(Read read) {
    const auto done = Unrefused([&read] {
      read();
      return true;
    });
    all_ = all_ && done.has_value();
  }
  bool all() const { return all_; }

 private:
  bool all_ = true;
};

void ReadFindings(const Store& store) {
  const std::vector<Finding> findings = store.Findings();
  for (const Finding& finding : findings) {
    Unrefused([&finding] { return Print(ParseProblem(finding.problem, finding.signature)); });
    Unrefused([&finding] { return Print(ParseProblem(finding.minimized, finding.signature)); });
  }
  ReportContent content;
  content.identity = store.identity();
  content.blocks = static_cast<std::int64_t>(store.Blocks().size());
  content.totals = TotalsOf(store);
  content.discoveries = Discoveries(content.totals.record, findings);
  ToCsv(FindingsTable(content.discoveries));
  const auto figures = Figures(content);
  const Told told = Tell(content, {"index", "results", "findings"});
  JsonText(ToJson(told));
  for (const char* name : {"index", "results"}) Page(name, content, told, figures);
  FindingsPage(content, told);
}

void ReadTotal(const Store& store) {
  const Record total = store.Total();
  STICTION_CHECK(ParseRecord(Serialize(total)) == total, "a record that is read back to another");
  for (const Table& table : CampaignTables(total, {})) ToCsv(table);
}

void ReadUnits(const Store& store) {
  const UnitSet units = store.Units();
  for (const std::int64_t unit : {0, 1, 5000}) units.Contains(unit);
  store.Findings();
}

bool ReadAll(const Store& store, const StoreFolder& folder) {
  Unrefused([&store] {  // what is made here is of no unit that was run
    RequireSound(store, "input");
    return true;
  });
  Readers read;
  read([&store] { CampaignOf(store.identity(), "input"); });
  read([&store] { ReadTotal(store); });
  read([&store] { ReadUnits(store); });
  read([&store] { ReadFindings(store); });
  read([&store] { SummaryText(store, "input"); });
  read([&store] { TextReport(store, "input", KnownAs); });
  read([&store] { JsonText(SummaryToJson(store)); });
  read([&] {
    fs::remove(folder / "merged");
    Store(folder / "merged", store.identity()).MergeFrom(store);
  });
  return read.all();
}

}  // namespace

bool FuzzStore(std::string_view bytes) {
  static const StoreFolder folder;
  static const std::string made = MakeStore(folder);
  const auto changes = Unrefused([bytes] { return ParseJson(bytes, "input"); });
  if (!changes || !changes->is_object()) return false;
  const fs::path file = folder / "store";
  std::ofstream(file, std::ios::binary) << made;
  {
    const Database database(file);
    for (const auto& [table, columns] : changes->items()) {
      if (!columns.is_object()) continue;
      for (const auto& [column, value] : columns.items()) database.Set(table, column, value);
    }
    database.Seal();
  }
  const auto taken = Unrefused([&file] { return ReadAll(Store::OpenToRead(file), folder); });
  return taken.value_or(false);
}

}  // namespace stiction::fuzz
