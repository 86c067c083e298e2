// SPDX-License-Identifier: Apache-2.0
#include "corpus/store/store_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <new>
#include <type_traits>

#include "corpus/json.h"
#include "corpus/output_error.h"
#include "corpus/record/digest.h"
#include "solver/problem/check.h"

namespace stiction {

std::string StoreName(sqlite3* db) { return sqlite3_db_filename(db, "main"); }

void RefuseDatabase(sqlite3* db) {
  const std::string file = StoreName(db), reason = sqlite3_errmsg(db);
  switch (sqlite3_errcode(db)) {
    case SQLITE_FULL:
    case SQLITE_IOERR:
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
      throw OutputError(file, reason);
    case SQLITE_NOMEM:
      throw std::bad_alloc();
    default:
      throw InputError(fmt::format("{}: {}", file, reason));
  }
}

// ---- Statements ------------------------------------------------------------------------------

Statement::Statement(sqlite3* db, const std::string& sql) : db_(db) {
  if (sqlite3_prepare_v2(db, sql.c_str(), -1, &statement_, nullptr) != SQLITE_OK) RefuseDatabase(db_);
}

Statement::~Statement() { sqlite3_finalize(statement_); }

Statement& Statement::Bind(std::int64_t value) {
  if (sqlite3_bind_int64(statement_, ++bound_, value) != SQLITE_OK) RefuseDatabase(db_);
  return *this;
}

Statement& Statement::Bind(const std::string& text) {
  const int size = static_cast<int>(text.size());
  if (sqlite3_bind_text(statement_, ++bound_, text.data(), size, SQLITE_TRANSIENT) != SQLITE_OK)
    RefuseDatabase(db_);
  return *this;
}

Statement& Statement::Bind(const Shard& shard) {
  return Bind(static_cast<std::int64_t>(shard.count)).Bind(static_cast<std::int64_t>(shard.index));
}

bool Statement::Step() {
  const int status = sqlite3_step(statement_);
  if (status != SQLITE_ROW && status != SQLITE_DONE) RefuseDatabase(db_);
  return status == SQLITE_ROW;
}

std::int64_t Statement::Integer(int column, std::int64_t least, std::int64_t most, const char* what) const {
  const std::int64_t value = Integer(column);
  if (least <= value && value <= most) return value;
  throw InputError(StoreName(db_), what, std::to_string(value), fmt::format("{} to {}", least, most));
}

std::string Statement::Text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  return {text == nullptr ? "" : text, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

// ---- Tables and seals ------------------------------------------------------------------------

namespace {

std::vector<std::string_view> ColumnsOfFinding() {
  std::vector<std::string_view> names;
  const Finding any;
  ForEachColumn(any, [&names](const char* name, const auto&) { names.emplace_back(name); });
  return names;
}

}  // namespace

const std::vector<StoreTable>& StoreTables() {
  static const std::vector<StoreTable> tables = {
      {"blocks", {"shards", "shard", "block", "record"}, 3},
      {"units", {"unit", "shards", "shard", "block", "record"}, 1},
      {"findings", ColumnsOfFinding(), 1},
      {"elites", {"unit", "elites"}, 1},
      {"work", {"shards", "shard", "block", "unit", "builds", "time"}, 4}};
  return tables;
}

const StoreTable& StoreTableNamed(std::string_view name) {
  const auto& tables = StoreTables();
  const auto table = std::find_if(tables.begin(), tables.end(), [&](const auto& t) { return t.name == name; });
  STICTION_CHECK(table != tables.end(), fmt::format("a store has no table {}", name));
  return *table;
}

std::string SealOf(std::string_view table, const std::vector<std::string>& columns) {
  std::string text = fmt::format("{}:{}\n", table.size(), table);
  for (const std::string& column : columns) text += fmt::format("{}:{}\n", column.size(), column);
  return Sha256(text);
}

void PutRow(sqlite3* db, std::string_view table, const std::vector<StoreValue>& columns) {
  const StoreTable& row = StoreTableNamed(table);
  STICTION_CHECK(columns.size() == row.columns.size(), fmt::format("a row of {} has other columns", table));
  std::string marks;
  for (std::size_t i = 0; i < columns.size(); ++i) marks += "?,";
  Statement insert(db, fmt::format("INSERT OR REPLACE INTO {} ({}, seal) VALUES ({}?)", table,
                                   fmt::join(row.columns, ", "), marks));
  std::vector<std::string> texts;
  for (const StoreValue& value : columns) {
    if (const auto* number = std::get_if<std::int64_t>(&value)) {
      insert.Bind(*number);
      texts.push_back(std::to_string(*number));
    } else {
      insert.Bind(std::get<std::string>(value));
      texts.push_back(std::get<std::string>(value));
    }
  }
  insert.Bind(SealOf(table, texts)).Step();
}

std::string SelectFrom(std::string_view table, const std::string& rest) {
  return fmt::format("SELECT {}, seal FROM {} {}", fmt::join(StoreTableNamed(table).columns, ", "), table,
                     rest);
}

std::string RowName(const StoreTable& table, const Statement& row) {
  if (table.name == "blocks")
    return fmt::format("block {} of shard {}/{}", row.Text(2), row.Text(1), row.Text(0));
  if (table.name == "units") return "unit " + row.Text(0);
  if (table.name == "findings") return "finding " + Shortened(row.Text(0), 100);
  if (table.name == "elites") return "elites of unit " + row.Text(0);
  const std::string block = fmt::format("block {} of shard {}/{}", row.Text(2), row.Text(1), row.Text(0));
  return row.Integer(3) == WorkKey::kNoUnit ? "work of " + block : "work of unit " + row.Text(3);
}

void RequireSoundRow(sqlite3* db, const StoreTable& table, const Statement& row) {
  std::vector<std::string> columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) columns.push_back(row.Text(static_cast<int>(i)));
  const std::string seal = SealOf(table.name, columns);
  const std::string stored = row.Text(static_cast<int>(columns.size()));
  const std::string place = fmt::format("{}: {}", StoreName(db), RowName(table, row));
  if (seal != stored) {
    throw InputError(
        fmt::format("{}: found content of SHA-256 {}, expected {}: the store is damaged. What is sound "
                    "is saved by: stiction merge --salvage NEW_FILE {}",
                    place, seal, Shortened(stored, 64), StoreName(db)));
  }
  if (table.name == "blocks" || table.name == "units") ParseRecord(columns.back(), place);
  if (table.name == "blocks") ReadShard(row);
  if (table.name == "units") {
    Statement shard(db, "SELECT shards, shard FROM units WHERE unit = ?");
    if (shard.Bind(ReadUnit(row, 0)).Step() && !ReadShard(shard).Owns(row.Integer(0)))
      throw InputError(
          fmt::format("{}: found in shard {}/{}, which does not have it", place, columns[2], columns[1]));
  }
  if (table.name == "work") ReadWorkRow(row);
}

// ---- Rows ------------------------------------------------------------------------------------

Shard ReadShard(const Statement& row) {
  const auto count = static_cast<int>(row.Integer(0, 1, 1 << 20, "shards"));
  return {static_cast<int>(row.Integer(1, 0, count - 1, "shard")), count};
}
std::int64_t ReadBlock(const Statement& row, int column) {
  return row.Integer(column, 0, std::int64_t{1} << 32, "block");
}
std::int64_t ReadUnit(const Statement& row, int column) {
  return row.Integer(column, 0, std::int64_t{1} << 62, "unit");
}

namespace {

void ReadValue(const Statement& row, int column, std::string& text) { text = row.Text(column); }
void ReadValue(const Statement& row, int column, std::int64_t& number) { number = row.Integer(column); }
void ReadValue(const Statement& row, int column, bool& truth) { truth = row.Integer(column) != 0; }
void ReadValue(const Statement& row, int column, int& contacts) {
  contacts = static_cast<int>(row.Integer(column, 0, 1 << 20, "contacts"));
}

}  // namespace

Finding ReadFinding(const Statement& row) {
  Finding finding;
  int column = 0;
  ForEachColumn(finding, [&](const char*, auto& value) { ReadValue(row, column++, value); });
  return finding;
}

void WriteFinding(sqlite3* db, const Finding& finding) {
  std::vector<StoreValue> values;
  ForEachColumn(finding, [&values](const char*, const auto& value) {
    if constexpr (std::is_integral_v<std::remove_cvref_t<decltype(value)>>)
      values.emplace_back(std::int64_t{value});
    else
      values.emplace_back(value);
  });
  PutRow(db, "findings", values);
}

// ---- Work ------------------------------------------------------------------------------------

namespace {

std::set<std::string> ReadNames(const JsonPlace& list, const char* what) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < list.Size(what); ++i) names.insert(list[i].Text(what));
  return names;
}

// A list of builds, or, where machines were recorded, {"builds": [...], "machines": [...]}.
void ReadMakers(Work& work, const JsonPlace& makers) {
  if (makers.json().is_array()) {
    work.builds = ReadNames(makers, "a list of names of builds");
    return;
  }
  makers.RequireObject();
  makers.AllowKeys({"builds", "machines"});
  work.builds = ReadNames(makers.Required("builds", "a list"), "a list of names of builds");
  work.machines = ReadNames(makers.Required("machines", "a list"), "a list of machines");
}

}  // namespace

// A clock that was set back measures less than nothing: no time, and no fault of the store that has it.
static std::int64_t NoLessThanNone(std::int64_t microseconds) {
  return std::max<std::int64_t>(0, microseconds);
}

Work ReadWorkRow(const Statement& row) {
  const std::string source = RowName(StoreTableNamed("work"), row);
  Work work;
  const Json makers = ParseJson(row.Text(4), source);
  ReadMakers(work, JsonPlace(makers, source, "builds"));
  const Json times = ParseJson(row.Text(5), source);
  const JsonPlace parts(times, source, "time");
  parts.RequireObject();
  std::vector<std::string> names;
  ForEachPart(work.time, [&](const char* name, const char*, std::int64_t& value) {
    names.emplace_back(name);
    constexpr std::int64_t kMost = std::int64_t{1} << 53;
    value = NoLessThanNone(parts.Required(name, "microseconds").Integer(-kMost, kMost, "microseconds"));
  });
  parts.AllowKeys(names);
  return work;
}

WorkKey ReadWorkKey(const Statement& row) {
  return {ReadShard(row), ReadBlock(row, 2), row.Integer(3, WorkKey::kNoUnit, std::int64_t{1} << 62, "unit")};
}

Work ReadWork(sqlite3* db, const WorkKey& key) {
  Statement row(db, SelectFrom("work", "WHERE shards = ? AND shard = ? AND block = ? AND unit = ?"));
  return row.Bind(key.shard).Bind(key.block).Bind(key.unit).Step() ? ReadWorkRow(row) : Work{};
}

void WriteWork(sqlite3* db, const WorkKey& key, const Work& work) {
  Json builds = work.builds, times = Json::object();
  if (!work.machines.empty()) builds = {{"builds", work.builds}, {"machines", work.machines}};
  ForEachPart(work.time, [&times](const char* name, const char*, std::int64_t value) {
    times[name] = NoLessThanNone(value);
  });
  PutRow(db, "work",
         {std::int64_t{key.shard.count}, std::int64_t{key.shard.index}, key.block, key.unit, JsonText(builds),
          JsonText(times)});
}

bool HoldsBlock(sqlite3* db, const Shard& shard, std::int64_t block) {
  Statement present(db, "SELECT 1 FROM blocks WHERE shards = ? AND shard = ? AND block = ?");
  return present.Bind(shard).Bind(block).Step();
}

void RemoveUnits(sqlite3* db, const Shard& shard, std::int64_t block) {
  for (const char* table : {"units", "work"})
    Statement(db, fmt::format("DELETE FROM {} WHERE shards = ? AND shard = ? AND block = ?", table))
        .Bind(shard)
        .Bind(block)
        .Step();
}

std::int64_t BlockOf(const Shard& shard, std::int64_t unit) {
  return (unit - shard.index) / shard.count / Store::kUnitsPerBlock;
}

std::int64_t FirstUnit(const Shard& shard, std::int64_t block) {
  return block * Store::kUnitsPerBlock * shard.count + shard.index;
}

}  // namespace stiction
