// SPDX-License-Identifier: Apache-2.0
// Rows of a store: the tables, statements on them, and the seal that every row carries.
//
// The seal of a row is the SHA-256 of the name of its table and of its columns, each as "LENGTH:BYTES\n" with
// the length in bytes, integers in decimal. It says that the row is as it was written, no more: rows that are
// gone leave no trace but the units that are missing.

#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "corpus/store/store.h"

namespace stiction {

std::string StoreName(sqlite3* db);

// A prepared statement: parameters are bound in order, rows read by column.
class Statement {
 public:
  Statement(sqlite3* db, const std::string& sql);
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  ~Statement();

  Statement& Bind(std::int64_t value);
  Statement& Bind(const std::string& text);
  Statement& Bind(const Shard& shard);  // its count and its index
  // False when there is no further row. InputError or OutputError where the database says no.
  bool Step();
  std::int64_t Integer(int column) const { return sqlite3_column_int64(statement_, column); }
  // InputError, which names `what`, unless it is from `least` to `most`.
  std::int64_t Integer(int column, std::int64_t least, std::int64_t most, const char* what) const;
  std::string Text(int column) const;

 private:
  sqlite3* db_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

// Rolls back unless committed.
class Transaction {
 public:
  explicit Transaction(sqlite3* db) : db_(db) { Statement(db_, "BEGIN IMMEDIATE").Step(); }
  ~Transaction() {
    if (!committed_) sqlite3_exec(db_, "ROLLBACK", nullptr, nullptr, nullptr);
  }
  void Commit() {
    Statement(db_, "COMMIT").Step();
    committed_ = true;
  }

 private:
  sqlite3* db_;
  bool committed_ = false;
};

// The columns in order, without the seal, which is the last one; the first `keys` of them are the key.
struct StoreTable {
  std::string_view name;
  std::vector<std::string_view> columns;
  int keys;
};
const std::vector<StoreTable>& StoreTables();  // all but `campaign`
const StoreTable& StoreTableNamed(std::string_view name);

std::string SealOf(std::string_view table, const std::vector<std::string>& columns);

using StoreValue = std::variant<std::int64_t, std::string>;
// Writes a row with its seal. A row of the same key is replaced.
void PutRow(sqlite3* db, std::string_view table, const std::vector<StoreValue>& columns);

// "SELECT columns FROM table REST".
std::string SelectFrom(std::string_view table, const std::string& rest);

// "block 5 of shard 0/2", "finding cycle-2c"
std::string RowName(const StoreTable& table, const Statement& row);

// InputError that names the row, what its content is and what was expected, unless the row that the statement
// stands on (all columns and the seal) is as it was written and its record can be read.
void RequireSoundRow(sqlite3* db, const StoreTable& table, const Statement& row);

// Columns that begin with shards, shard.
Shard ReadShard(const Statement& row);
std::int64_t ReadBlock(const Statement& row, int column);
std::int64_t ReadUnit(const Statement& row, int column);
Finding ReadFinding(const Statement& row);
void WriteFinding(sqlite3* db, const Finding& finding);

// Of a closed block, or of a unit of an open one.
struct WorkKey {
  Shard shard;
  std::int64_t block = 0;
  std::int64_t unit = kNoUnit;

  static constexpr std::int64_t kNoUnit = -1;
};
Work ReadWorkRow(const Statement& row);          // of a row of `work`
WorkKey ReadWorkKey(const Statement& row);       // likewise
Work ReadWork(sqlite3* db, const WorkKey& key);  // empty if there is none
void WriteWork(sqlite3* db, const WorkKey& key, const Work& work);

bool HoldsBlock(sqlite3* db, const Shard& shard, std::int64_t block);
// The units of a block and their work, which the whole block takes the place of.
void RemoveUnits(sqlite3* db, const Shard& shard, std::int64_t block);

// The block of a shard that has this unit.
std::int64_t BlockOf(const Shard& shard, std::int64_t unit);
std::int64_t FirstUnit(const Shard& shard, std::int64_t block);
// The table `of_block` of its units. To bind: the first of them, how many shards there are, units of a block.
inline constexpr const char* kUnitsOfBlock =
    "WITH RECURSIVE of_block(unit) AS (SELECT ? UNION ALL SELECT unit + ? FROM of_block LIMIT ?)";

// Throws what the last call on a database says: it cannot be written, or it is damaged or none.
[[noreturn]] void RefuseDatabase(sqlite3* db);

}  // namespace stiction
