// SPDX-License-Identifier: Apache-2.0
// Merging stores: whole ones, and what is sound of damaged ones.

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "corpus/store/store_rows.h"
#include "solver/problem/check.h"

namespace stiction {

// In a transaction.
void Store::BeginMerge(const Store& other) {
  if (other.identity_ != identity_) {
    throw InputError("merge: the stores hold different campaigns: " + Difference(other.identity_, identity_));
  }
  if (identity_.remarks.empty() && !other.identity_.remarks.empty()) TakeRemarks(other.identity_.remarks);
}

void Store::MergeFrom(const Store& other) {
  Transaction transaction(db_.get());
  BeginMerge(other);
  for (const StoreTable& table : StoreTables()) {
    Statement rows(other.db_.get(), SelectFrom(table.name, ""));
    while (rows.Step()) MergeRow(table.name, rows);
  }
  CloseBlocksOf(other);
  transaction.Commit();
}

// Blocks come before units, and both before their work.
void Store::MergeRow(std::string_view table, const Statement& row) {
  if (table == "blocks") {
    MergeBlock(ReadShard(row), ReadBlock(row, 2), row.Text(3));
  } else if (table == "units") {
    const Shard shard{static_cast<int>(row.Integer(2)), static_cast<int>(row.Integer(1))};
    MergeUnit(shard, ReadUnit(row, 0), row.Text(4));
  } else if (table == "findings") {
    MergeFinding(ReadFinding(row));
  } else if (table == "elites") {
    MergeElites(ReadUnit(row, 0), row.Text(1));
  } else {
    MergeWork(row);
  }
}

namespace {

// Numbers of shards that blocks have: mostly one.
std::vector<int> ShardCounts(sqlite3* db) {
  std::vector<int> counts;
  for (int last = 0;; last = counts.back()) {
    Statement next(db, "SELECT shards FROM blocks WHERE shards > ? ORDER BY shards LIMIT 1");
    if (!next.Bind(std::int64_t{last}).Step()) return counts;
    counts.push_back(static_cast<int>(next.Integer(0)));
  }
}

// Whether a block of so many shards has a unit.
bool HoldsIn(sqlite3* db, std::int64_t unit, int shards) {
  const Shard shard{static_cast<int>(unit % shards), shards};
  return HoldsBlock(db, shard, BlockOf(shard, unit));
}

[[noreturn]] void RefuseTwice(std::int64_t unit) {
  throw InputError(fmt::format("merge: unit {} is in both stores, in blocks of different shards", unit));
}

// The units of a block that is not here. Blocks of the same number of shards share none.
void RequireNoneOf(sqlite3* db, const Shard& shard, std::int64_t block) {
  Statement alone(db,
                  fmt::format("{} SELECT unit FROM of_block JOIN units USING (unit) LIMIT 1", kUnitsOfBlock));
  const std::int64_t first = FirstUnit(shard, block);
  if (alone.Bind(first).Bind(std::int64_t{shard.count}).Bind(std::int64_t{Store::kUnitsPerBlock}).Step())
    RefuseTwice(alone.Integer(0));
  for (const int shards : ShardCounts(db)) {
    if (shards == shard.count) continue;
    for (std::int64_t k = 0; k < Store::kUnitsPerBlock; ++k) {
      const std::int64_t unit = first + k * shard.count;
      if (HoldsIn(db, unit, shards)) RefuseTwice(unit);
    }
  }
}

}  // namespace

// Looked up, for a merge asks it of every unit.
bool Store::Holds(std::int64_t unit) const {
  Statement alone(db_.get(), "SELECT 1 FROM units WHERE unit = ?");
  if (alone.Bind(unit).Step()) return true;
  const std::vector<int> counts = ShardCounts(db_.get());
  return std::any_of(counts.begin(), counts.end(),
                     [&](int shards) { return HoldsIn(db_.get(), unit, shards); });
}

// A finished block takes the place of an unfinished copy of itself.
void Store::MergeBlock(const Shard& shard, std::int64_t block, const std::string& record) {
  Statement same(db_.get(), "SELECT record FROM blocks WHERE shards = ? AND shard = ? AND block = ?");
  if (same.Bind(shard).Bind(block).Step()) {
    STICTION_CHECK(same.Text(0) == record, fmt::format("two copies of block {} of shard {}/{} differ", block,
                                                       shard.index, shard.count));
    return;
  }
  RemoveUnits(db_.get(), shard, block);
  RequireNoneOf(db_.get(), shard, block);
  PutRow(db_.get(), "blocks", {std::int64_t{shard.count}, std::int64_t{shard.index}, block, record});
}

void Store::MergeUnit(const Shard& shard, std::int64_t unit, const std::string& record) {
  if (Holds(unit)) {
    // As part of the same block, finished here or not; otherwise it was counted for different shards.
    Statement same(db_.get(), "SELECT record FROM units WHERE unit = ? AND shards = ? AND shard = ?");
    if (same.Bind(unit).Bind(shard).Step()) {
      STICTION_CHECK(same.Text(0) == record, fmt::format("two copies of unit {} differ", unit));
      return;
    }
    if (HoldsBlock(db_.get(), shard, BlockOf(shard, unit))) return;
    RefuseTwice(unit);
  }
  InsertUnit(shard, unit, record);
}

void Store::MergeFinding(const Finding& finding) {
  Statement present(db_.get(), "SELECT unit, idx, done FROM findings WHERE signature = ?");
  present.Bind(finding.signature);
  if (present.Step()) {
    const std::tuple mine(present.Integer(0), present.Integer(1), -present.Integer(2));
    if (mine <= std::tuple(finding.unit, finding.index, -static_cast<std::int64_t>(finding.done))) return;
  }
  WriteFinding(db_.get(), finding);
}

void Store::MergeElites(std::int64_t unit, const std::string& elites) {
  Statement same(db_.get(), "SELECT elites FROM elites WHERE unit = ?");
  if (same.Bind(unit).Step()) {
    STICTION_CHECK(same.Text(0) == elites, fmt::format("two copies of the elites of unit {} differ", unit));
    return;
  }
  PutRow(db_.get(), "elites", {unit, elites});
}

void Store::MergeWork(const Statement& row) {
  const WorkKey key = ReadWorkKey(row);
  const bool of_unit = key.unit != WorkKey::kNoUnit;
  Statement present(db_.get(), of_unit ? "SELECT 1 FROM units WHERE shards = ? AND shard = ? AND unit = ?"
                                       : "SELECT 1 FROM blocks WHERE shards = ? AND shard = ? AND block = ?");
  if (!present.Bind(key.shard).Bind(of_unit ? key.unit : key.block).Step())
    return;  // of a block that is whole here
  Work work = ReadWork(db_.get(), key);
  work.Unite(ReadWorkRow(row));
  WriteWork(db_.get(), key, work);
}

// Those that units of the other store may have completed.
void Store::CloseBlocksOf(const Store& other) {
  std::vector<std::pair<Shard, std::int64_t>> listed;  // first: closing one changes the table
  Statement blocks(other.db_.get(), "SELECT DISTINCT shards, shard, block FROM units");
  while (blocks.Step()) listed.emplace_back(ReadShard(blocks), ReadBlock(blocks, 2));
  for (const auto& [shard, block] : listed) CloseBlockIfComplete(shard, block);
}

// ---- What is sound of a damaged store ---------------------------------------------------------

namespace {

// Of a table with a key of one column.
StoreValue KeyOf(const StoreTable& table, const Statement& row) {
  if (table.name == "findings") return row.Text(0);
  return row.Integer(0);
}

}  // namespace

std::vector<std::string> Store::Salvage(const std::filesystem::path& file) {
  const Store other = OpenUnchecked(file);
  std::vector<std::string> left_out;
  Transaction transaction(db_.get());
  BeginMerge(other);
  for (const StoreTable& table : StoreTables()) SalvageTable(table, other, left_out);
  CloseBlocksOf(*this);  // the other may not be read to its end
  transaction.Commit();
  return left_out;
}

namespace {

constexpr int kMostPages = 100'000;  // that cannot be read: keys may be in any order where pages are damaged

// Keys from which to go on behind one whose page cannot be read, the nearest first.
std::vector<StoreValue> KeysBehind(const StoreValue& last) {
  std::vector<StoreValue> keys;
  if (const auto* number = std::get_if<std::int64_t>(&last)) {
    for (std::int64_t k = 1; k <= Store::kUnitsPerBlock; ++k) keys.emplace_back(*number + k);
    return keys;
  }
  for (std::string text = std::get<std::string>(last); !text.empty(); text.pop_back()) {
    std::string next = text;
    ++next.back();
    keys.emplace_back(next);
  }
  return keys;
}

}  // namespace

// From both ends: a page that cannot be read ends a walk. Where one column is the key, the walk goes on behind
// it.
void Store::SalvageTable(const StoreTable& table, const Store& other, std::vector<std::string>& left_out) {
  bool whole = true;
  std::optional<StoreValue> last;  // key that was read by the walk upwards
  const auto walk = [&](const char* direction) {
    std::string order;
    for (int i = 0; i < table.keys; ++i)
      order += fmt::format("{}{} {}", i > 0 ? ", " : "", table.columns[i], direction);
    std::int64_t rows_read = 0;
    try {
      Statement rows(other.db_.get(), SelectFrom(table.name, "ORDER BY " + order));
      for (; rows.Step(); ++rows_read) {
        if (table.keys == 1 && whole) last = KeyOf(table, rows);
        if (auto reason = SalvageRow(table, other, rows); !reason.empty() && (whole || rows_read == 0))
          left_out.push_back(std::move(reason));
      }
    } catch (const InputError& error) {
      if (whole)
        left_out.push_back(fmt::format("{}: not all rows can be reached: {}", table.name, error.what()));
      whole = false;
    }
  };
  walk("ASC");
  if (whole) return;
  walk("DESC");
  bool at_end = false;
  const auto take_from = [&](const StoreValue& key) {
    try {
      Statement rows(other.db_.get(),
                     SelectFrom(table.name, fmt::format("WHERE {0} >= ? ORDER BY {0}", table.columns[0])));
      std::visit([&rows](const auto& value) { rows.Bind(value); }, key);
      while (rows.Step()) {
        last = KeyOf(table, rows);
        SalvageRow(table, other, rows);
      }
      at_end = true;
    } catch (const InputError&) {  // another page that cannot be read
    }
  };
  for (int pages = 0; last && !at_end && pages < kMostPages; ++pages) {
    const std::vector<StoreValue> keys = KeysBehind(*last);
    last.reset();
    for (std::size_t k = 0; k < keys.size() && !last && !at_end; ++k) take_from(keys[k]);
  }
}

// Empty if the row was taken in, otherwise why it was not.
std::string Store::SalvageRow(const StoreTable& table, const Store& other, const Statement& row) {
  Execute("SAVEPOINT of_row");
  try {
    RequireSoundRow(other.db_.get(), table, row);
    MergeRow(table.name, row);
    Execute("RELEASE of_row");
    return {};
  } catch (const InputError& error) {
    Execute("ROLLBACK TO of_row");
    Execute("RELEASE of_row");
    return error.what();
  } catch (const InternalError& error) {  // two copies differ
    Execute("ROLLBACK TO of_row");
    Execute("RELEASE of_row");
    return error.what();
  }
}

}  // namespace stiction
