// SPDX-License-Identifier: Apache-2.0
#include "corpus/store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <new>
#include <tuple>
#include <utility>

#include "corpus/atomic_file.h"
#include "corpus/output_error.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFormat = "stiction-store";
constexpr const char* kVersion = "2";  // 2: with existence
constexpr const char* kTables = R"sql(
CREATE TABLE IF NOT EXISTS campaign (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS blocks (
  shards INTEGER NOT NULL, shard INTEGER NOT NULL, block INTEGER NOT NULL, record TEXT NOT NULL,
  PRIMARY KEY (shards, shard, block)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS units (
  unit INTEGER PRIMARY KEY, shards INTEGER NOT NULL, shard INTEGER NOT NULL, block INTEGER NOT NULL,
  record TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS findings (
  signature TEXT PRIMARY KEY, kind TEXT NOT NULL, unit INTEGER NOT NULL, idx INTEGER NOT NULL,
  generator TEXT NOT NULL, contacts INTEGER NOT NULL, policy TEXT NOT NULL,
  inexact_outcome TEXT NOT NULL, exact_outcome TEXT NOT NULL, problem TEXT NOT NULL, done INTEGER NOT NULL,
  certificate TEXT NOT NULL, minimized TEXT NOT NULL, minimized_certificate TEXT NOT NULL,
  existence TEXT NOT NULL, minimized_existence TEXT NOT NULL, facts TEXT NOT NULL)
  WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS elites (unit INTEGER PRIMARY KEY, elites TEXT NOT NULL);
)sql";
constexpr const char* kFindingColumns =
    "signature, kind, unit, idx, generator, contacts, policy, inexact_outcome, exact_outcome, problem, done, "
    "certificate, minimized, minimized_certificate, existence, minimized_existence, facts";

std::string StoreName(sqlite3* db) { return sqlite3_db_filename(db, "main"); }

// What the last call on a database says: it cannot be written, or it is damaged or none.
[[noreturn]] void Refuse(sqlite3* db) {
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

// A prepared statement: parameters are bound in order, rows read by column.
class Statement {
 public:
  Statement(sqlite3* db, const std::string& sql) : db_(db) {
    if (sqlite3_prepare_v2(db, sql.c_str(), -1, &statement_, nullptr) != SQLITE_OK) Fail();
  }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  ~Statement() { sqlite3_finalize(statement_); }

  Statement& Bind(std::int64_t value) {
    if (sqlite3_bind_int64(statement_, ++bound_, value) != SQLITE_OK) Fail();
    return *this;
  }
  Statement& Bind(const std::string& text) {
    const int size = static_cast<int>(text.size());
    if (sqlite3_bind_text(statement_, ++bound_, text.data(), size, SQLITE_TRANSIENT) != SQLITE_OK) Fail();
    return *this;
  }
  // False when there is no further row.
  bool Step() {
    const int status = sqlite3_step(statement_);
    if (status != SQLITE_ROW && status != SQLITE_DONE) Fail();
    return status == SQLITE_ROW;
  }
  std::int64_t Integer(int column) const { return sqlite3_column_int64(statement_, column); }
  // InputError, which names `what`, unless it is from `least` to `most`.
  std::int64_t Integer(int column, std::int64_t least, std::int64_t most, const char* what) const {
    const std::int64_t value = Integer(column);
    if (least <= value && value <= most) return value;
    throw InputError(StoreName(db_), what, std::to_string(value), fmt::format("{} to {}", least, most));
  }
  std::string Text(int column) const {
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
    return {text == nullptr ? "" : text, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
  }

 private:
  [[noreturn]] void Fail() const { Refuse(db_); }

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

sqlite3* OpenDatabase(const std::string& name, int flags) {
  sqlite3* db = nullptr;
  if (sqlite3_open_v2(name.c_str(), &db, flags | SQLITE_OPEN_NOMUTEX, nullptr) != SQLITE_OK) {
    const std::string reason = db != nullptr ? sqlite3_errmsg(db) : "out of memory";
    sqlite3_close(db);
    throw InputError(fmt::format("{}: cannot be opened as a store: {}", name, reason));
  }
  sqlite3_busy_timeout(db, 10000);
  return db;
}

// A name that may have parameters behind it.
std::string UriOf(const fs::path& file) {
  std::string uri = "file:";
  for (const char c : fs::absolute(file).string()) {
    uri += c == '%' || c == '?' || c == '#' ? fmt::format("%{:02X}", static_cast<int>(c)) : std::string(1, c);
  }
  return uri;
}

class TemporaryFolder {
 public:
  TemporaryFolder() : path_((fs::temp_directory_path() / "stiction-XXXXXX").string()) {
    if (mkdtemp(path_.data()) == nullptr) RefuseOutput(path_, errno);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  fs::path path() const { return path_; }

 private:
  std::string path_;
};

void CopyFile(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy_file(from, to, error);
  if (error) RefuseOutput(to, error.value());
}

// What is there and no database is not taken over: SQLite would make an empty file one.
void RequireDatabase(const fs::path& file) {
  constexpr std::string_view kMagic("SQLite format 3\0", 16);
  const auto refuse = [&file](const std::string& found) {
    throw InputError(fmt::format("{}: is no stiction store but {}", file.string(), found));
  };
  if (fs::is_directory(file)) refuse("a directory");
  if (!fs::is_regular_file(file)) refuse("no regular file");
  std::string head(kMagic.size(), ' ');
  std::ifstream(file, std::ios::binary).read(head.data(), static_cast<std::streamsize>(head.size()));
  if (head != kMagic) refuse(fmt::format("another file of {} bytes", fs::file_size(file)));
}

// Of rows that begin with shards, shard.
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

Finding ReadFinding(const Statement& row) {
  Finding finding;
  finding.signature = row.Text(0);
  finding.kind = row.Text(1);
  finding.unit = row.Integer(2);
  finding.index = row.Integer(3);
  finding.generator = row.Text(4);
  finding.contacts = static_cast<int>(row.Integer(5, 0, 1 << 20, "contacts"));
  finding.policy = row.Text(6);
  finding.inexact_outcome = row.Text(7);
  finding.exact_outcome = row.Text(8);
  finding.problem = row.Text(9);
  finding.done = row.Integer(10) != 0;
  finding.certificate = row.Text(11);
  finding.minimized = row.Text(12);
  finding.minimized_certificate = row.Text(13);
  finding.existence = row.Text(14);
  finding.minimized_existence = row.Text(15);
  finding.facts = row.Text(16);
  return finding;
}

void WriteFinding(sqlite3* db, const Finding& finding) {
  Statement(db, fmt::format("INSERT OR REPLACE INTO findings ({}) VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)",
                            kFindingColumns))
      .Bind(finding.signature)
      .Bind(finding.kind)
      .Bind(finding.unit)
      .Bind(finding.index)
      .Bind(finding.generator)
      .Bind(static_cast<std::int64_t>(finding.contacts))
      .Bind(finding.policy)
      .Bind(finding.inexact_outcome)
      .Bind(finding.exact_outcome)
      .Bind(finding.problem)
      .Bind(static_cast<std::int64_t>(finding.done))
      .Bind(finding.certificate)
      .Bind(finding.minimized)
      .Bind(finding.minimized_certificate)
      .Bind(finding.existence)
      .Bind(finding.minimized_existence)
      .Bind(finding.facts)
      .Step();
}

std::string Difference(const CampaignIdentity& stored, const CampaignIdentity& wanted) {
  const auto differ = [](const char* what, const std::string& there, const std::string& here) {
    return fmt::format("its {} is {}, this campaign's is {}", what, there, here);
  };
  if (stored.seed != wanted.seed)
    return differ("seed", std::to_string(stored.seed), std::to_string(wanted.seed));
  if (stored.build != wanted.build) return differ("build", stored.build, wanted.build);
  if (stored.policies != wanted.policies) return differ("set of policies", stored.policies, wanted.policies);
  return differ("definition", stored.definition, wanted.definition);
}

// A database with tables of somebody else must not get ours beside them.
void RefuseForeignDatabase(sqlite3* db, const fs::path& file) {
  Statement tables(db, "SELECT COUNT(*), COUNT(CASE WHEN name = 'campaign' THEN 1 END) FROM sqlite_master");
  tables.Step();
  if (tables.Integer(0) > 0 && tables.Integer(1) == 0) {
    throw InputError(fmt::format("{}: is no stiction store but another database", file.string()));
  }
}

std::int64_t BlockOf(const Shard& shard, std::int64_t unit) {
  return (unit - shard.index) / shard.count / Store::kUnitsPerBlock;
}

}  // namespace

void Store::Close::operator()(sqlite3* db) const { sqlite3_close(db); }

Store::Store(sqlite3* db) : db_(db) {}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

Store::Store(const fs::path& file, const CampaignIdentity& identity) {
  if (!fs::exists(file)) Make(file, identity);
  RequireDatabase(file);
  db_.reset(OpenDatabase(file, SQLITE_OPEN_READWRITE));
  RefuseForeignDatabase(db_.get(), file);
  // A killed process loses nothing that was committed; synchronous=NORMAL gives up only the last commits of a
  // machine that loses its power.
  Execute("PRAGMA journal_mode = WAL");
  Execute("PRAGMA synchronous = NORMAL");
  const auto stored = ReadIdentity();
  if (!stored) throw InputError(fmt::format("{}: is no stiction store", file.string()));
  identity_ = *stored;
  if (*stored == identity) return;
  throw InputError(fmt::format(
      "{}: holds another campaign: {}. Go on with the same options and build, or start a new store with "
      "--store NEW_FILE",
      file.string(), Difference(*stored, identity)));
}

// Under another name first: a store is never half made, and no file that came meanwhile is overwritten.
void Store::Make(const fs::path& file, const CampaignIdentity& identity) {
  fs::path name = file;
  name += fmt::format(".new-{}", getpid());
  {
    Store store(OpenDatabase(name, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE));
    Transaction transaction(store.db_.get());
    store.CreateTables();
    store.WriteIdentity(identity);
    transaction.Commit();
  }
  if (renameat2(AT_FDCWD, name.c_str(), AT_FDCWD, file.c_str(), RENAME_NOREPLACE) == 0) return;
  const int error = errno;
  fs::remove(name);
  if (error != EEXIST) RefuseOutput(file, error);
}

Store Store::OpenToRead(const fs::path& file) {
  if (!fs::exists(file)) throw InputError(fmt::format("{}: no such store", file.string()));
  RequireDatabase(file);
  try {
    return Snapshot(OpenDatabase(file, SQLITE_OPEN_READWRITE), file);
  } catch (const OutputError&) {  // a folder where the files that readers share cannot be made
    return ReadAlone(file);
  }
}

// Commits that wait beside the store, of a search that was killed, are read from a copy.
Store Store::ReadAlone(const fs::path& file) {
  fs::path log = file;
  log += "-wal";
  std::error_code none;
  if (const auto size = fs::file_size(log, none); none || size == 0)
    return Snapshot(OpenDatabase(UriOf(file) + "?immutable=1", SQLITE_OPEN_READONLY | SQLITE_OPEN_URI), file);
  const TemporaryFolder folder;
  const fs::path copy = folder.path() / "store";
  CopyFile(file, copy);
  CopyFile(log, copy.string() + "-wal");
  return Snapshot(OpenDatabase(copy, SQLITE_OPEN_READWRITE), file);  // needs no names once it is open
}

// For all that is read: a running search may close a block between two questions.
Store Store::Snapshot(sqlite3* db, const fs::path& file) {
  Store store(db);
  store.Execute("BEGIN");
  const auto identity = store.ReadIdentity();
  if (!identity) throw InputError(fmt::format("{}: is no stiction store", file.string()));
  store.identity_ = *identity;
  return store;
}

void Store::Execute(const std::string& sql) const {
  if (sqlite3_exec(db_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) Refuse(db_.get());
}

void Store::CreateTables() { Execute(kTables); }

void Store::WriteIdentity(const CampaignIdentity& identity) {
  const std::vector<std::pair<std::string, std::string>> rows = {{"format", kFormat},
                                                                 {"version", kVersion},
                                                                 {"definition", identity.definition},
                                                                 {"seed", std::to_string(identity.seed)},
                                                                 {"policies", identity.policies},
                                                                 {"build", identity.build}};
  for (const auto& [key, value] : rows) {
    Statement(db_.get(), "INSERT INTO campaign (key, value) VALUES (?, ?)").Bind(key).Bind(value).Step();
  }
}

std::optional<CampaignIdentity> Store::ReadIdentity() const {
  Statement table(db_.get(), "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = 'campaign'");
  if (!table.Step()) return std::nullopt;
  std::map<std::string, std::string> values;
  Statement rows(db_.get(), "SELECT key, value FROM campaign");
  while (rows.Step()) values[rows.Text(0)] = rows.Text(1);
  if (values.empty()) return std::nullopt;
  if (values["format"] != kFormat || values["version"] != kVersion) {
    throw InputError(fmt::format(
        "{}: found format {} version {}, expected {} version {}. A store of another version of stiction is "
        "read "
        "by that version only; search anew with --store NEW_FILE",
        StoreName(db_.get()), values["format"], values["version"], kFormat, kVersion));
  }
  std::uint64_t seed = 0;
  const std::string& text = values["seed"];
  const char* const end = text.data() + text.size();
  if (const auto read = std::from_chars(text.data(), end, seed); read.ec != std::errc() || read.ptr != end) {
    throw InputError(
        fmt::format("{}: found seed '{}', expected an integer from 0 to 2^64 - 1", StoreName(db_.get()), text));
  }
  return CampaignIdentity{values["definition"], seed, values["policies"], values["build"]};
}

bool UnitSet::Contains(std::int64_t unit) const {
  if (units_.contains(unit)) return true;
  for (const auto& [key, blocks] : blocks_) {
    const Shard shard{key.second, key.first};
    if (shard.Owns(unit) && blocks.contains(BlockOf(shard, unit))) return true;
  }
  return false;
}

std::int64_t UnitSet::Count() const {
  auto count = static_cast<std::int64_t>(units_.size());
  for (const auto& [key, blocks] : blocks_)
    count += Store::kUnitsPerBlock * static_cast<std::int64_t>(blocks.size());
  return count;
}

UnitSet Store::Units() const {
  UnitSet units;
  Statement open(db_.get(), "SELECT unit FROM units");
  while (open.Step()) units.AddUnit(ReadUnit(open, 0));
  for (const BlockInfo& info : Blocks()) units.AddBlock(info.shard, info.block);
  return units;
}

void Store::InsertUnit(const Shard& shard, std::int64_t unit, const std::string& record) {
  STICTION_CHECK(shard.Owns(unit),
                 fmt::format("unit {} is not of shard {}/{}", unit, shard.index, shard.count));
  Statement present(db_.get(),
                    "SELECT 1 FROM units WHERE unit = ? UNION ALL "
                    "SELECT 1 FROM blocks WHERE shards = ? AND shard = ? AND block = ?");
  present.Bind(unit).Bind(static_cast<std::int64_t>(shard.count)).Bind(static_cast<std::int64_t>(shard.index));
  if (present.Bind(BlockOf(shard, unit)).Step()) {
    throw InputError(
        fmt::format("{}: holds unit {} already; does another search work on the same store and shard?",
                    StoreName(db_.get()), unit));
  }
  Statement(db_.get(), "INSERT INTO units (unit, shards, shard, block, record) VALUES (?, ?, ?, ?, ?)")
      .Bind(unit)
      .Bind(static_cast<std::int64_t>(shard.count))
      .Bind(static_cast<std::int64_t>(shard.index))
      .Bind(BlockOf(shard, unit))
      .Bind(record)
      .Step();
}

std::vector<Finding> Store::AddUnit(const Shard& shard, std::int64_t unit, const Record& record,
                                    const std::vector<Finding>& candidates, const std::string& elites) {
  Transaction transaction(db_.get());
  InsertUnit(shard, unit, Serialize(record));
  if (!elites.empty())
    Statement(db_.get(), "INSERT INTO elites (unit, elites) VALUES (?, ?)").Bind(unit).Bind(elites).Step();
  std::vector<Finding> representatives;
  for (const Finding& candidate : candidates) {
    if (Represent(candidate)) representatives.push_back(candidate);
  }
  CloseBlockIfComplete(shard, BlockOf(shard, unit));
  transaction.Commit();
  return representatives;
}

std::map<std::int64_t, std::string> Store::Elites() const {
  std::map<std::int64_t, std::string> elites;
  Statement table(db_.get(), "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = 'elites'");
  if (!table.Step()) return elites;  // a store from before there were any
  Statement rows(db_.get(), "SELECT unit, elites FROM elites ORDER BY unit");
  while (rows.Step()) elites[ReadUnit(rows, 0)] = rows.Text(1);
  return elites;
}

// Whether the candidate is now the representative of its group.
bool Store::Represent(const Finding& candidate) {
  Statement present(db_.get(), "SELECT unit, idx FROM findings WHERE signature = ?");
  present.Bind(candidate.signature);
  if (present.Step()) {
    const std::pair now(present.Integer(0), present.Integer(1));
    if (now <= std::pair(candidate.unit, candidate.index)) return false;
  }
  WriteFinding(db_.get(), candidate);
  return true;
}

void Store::CloseBlockIfComplete(const Shard& shard, std::int64_t block) {
  const std::string of_block = " FROM units WHERE shards = ? AND shard = ? AND block = ?";
  const auto bind = [&](Statement& statement) -> Statement& {
    return statement.Bind(static_cast<std::int64_t>(shard.count))
        .Bind(static_cast<std::int64_t>(shard.index))
        .Bind(block);
  };
  Statement count(db_.get(), "SELECT COUNT(*)" + of_block);
  bind(count).Step();
  if (count.Integer(0) < kUnitsPerBlock) return;
  Record sum;
  Statement records(db_.get(), "SELECT record" + of_block);
  bind(records);
  while (records.Step()) sum.Merge(ParseRecord(records.Text(0), "record of a unit"));
  Statement insert(db_.get(), "INSERT INTO blocks (shards, shard, block, record) VALUES (?, ?, ?, ?)");
  bind(insert).Bind(Serialize(sum)).Step();
  Statement remove(db_.get(), "DELETE" + of_block);
  bind(remove).Step();
}

void Store::Finish(const Finding& finding) {
  Transaction transaction(db_.get());
  Statement present(db_.get(), "SELECT 1 FROM findings WHERE signature = ? AND unit = ? AND idx = ?");
  present.Bind(finding.signature).Bind(finding.unit).Bind(finding.index);
  if (present.Step()) WriteFinding(db_.get(), finding);
  transaction.Commit();
}

std::vector<Finding> Store::SelectFindings(const std::string& where_and_order) const {
  Statement rows(db_.get(), fmt::format("SELECT {} FROM findings {}", kFindingColumns, where_and_order));
  std::vector<Finding> findings;
  while (rows.Step()) findings.push_back(ReadFinding(rows));
  return findings;
}

std::vector<Finding> Store::Pending() const {
  return SelectFindings("WHERE done = 0 ORDER BY contacts, unit, idx");
}

std::vector<Finding> Store::Findings() const { return SelectFindings("ORDER BY signature"); }

Record Store::Total() const {
  Record total;
  for (const char* table : {"blocks", "units"}) {
    Statement rows(db_.get(), fmt::format("SELECT record FROM {}", table));
    while (rows.Step())
      total.Merge(ParseRecord(rows.Text(0), fmt::format("{}: record of {}", StoreName(db_.get()), table)));
  }
  return total;
}

std::vector<Store::BlockInfo> Store::Blocks() const {
  Statement rows(db_.get(), "SELECT shards, shard, block FROM blocks ORDER BY shards, shard, block");
  std::vector<BlockInfo> blocks;
  while (rows.Step()) {
    blocks.push_back({ReadShard(rows), ReadBlock(rows, 2)});
  }
  return blocks;
}

void Store::MergeFrom(const Store& other) {
  if (other.identity_ != identity_) {
    throw InputError("merge: the stores hold different campaigns: " + Difference(other.identity_, identity_));
  }
  Transaction transaction(db_.get());
  const UnitSet before = Units();
  Statement blocks(other.db_.get(), "SELECT shards, shard, block, record FROM blocks");
  while (blocks.Step()) MergeBlock(ReadShard(blocks), ReadBlock(blocks, 2), blocks.Text(3), before);
  Statement units(other.db_.get(), "SELECT shards, shard, unit, record FROM units");
  while (units.Step()) {
    const Shard shard = ReadShard(units);
    const std::int64_t unit = ReadUnit(units, 2);
    if (!shard.Owns(unit))
      throw InputError(fmt::format("merge: found unit {} in shard {}/{}, which does not have it", unit,
                                   shard.index, shard.count));
    MergeUnit(shard, unit, units.Text(3));
  }
  for (const Finding& finding : other.Findings()) MergeFinding(finding);
  for (const auto& [unit, elites] : other.Elites()) {
    Statement same(db_.get(), "SELECT elites FROM elites WHERE unit = ?");
    if (same.Bind(unit).Step()) {
      STICTION_CHECK(same.Text(0) == elites, fmt::format("two copies of the elites of unit {} differ", unit));
      continue;
    }
    Statement(db_.get(), "INSERT INTO elites (unit, elites) VALUES (?, ?)").Bind(unit).Bind(elites).Step();
  }
  transaction.Commit();
}

// A finished block takes the place of an unfinished copy of itself.
void Store::MergeBlock(const Shard& shard, std::int64_t block, const std::string& record,
                       const UnitSet& before) {
  const auto bind = [&](Statement& statement) -> Statement& {
    return statement.Bind(static_cast<std::int64_t>(shard.count))
        .Bind(static_cast<std::int64_t>(shard.index))
        .Bind(block);
  };
  Statement same(db_.get(), "SELECT record FROM blocks WHERE shards = ? AND shard = ? AND block = ?");
  if (bind(same).Step()) {
    STICTION_CHECK(same.Text(0) == record, fmt::format("two copies of block {} of shard {}/{} differ", block,
                                                       shard.index, shard.count));
    return;
  }
  Statement remove(db_.get(), "DELETE FROM units WHERE shards = ? AND shard = ? AND block = ?");
  bind(remove).Step();
  const UnitSet rest = Units();
  for (std::int64_t k = 0; k < kUnitsPerBlock; ++k) {
    const std::int64_t unit = (block * kUnitsPerBlock + k) * shard.count + shard.index;
    if (before.Contains(unit) && rest.Contains(unit)) {
      throw InputError(fmt::format("merge: unit {} is in both stores, in blocks of different shards", unit));
    }
  }
  Statement insert(db_.get(), "INSERT INTO blocks (shards, shard, block, record) VALUES (?, ?, ?, ?)");
  bind(insert).Bind(record).Step();
}

void Store::MergeUnit(const Shard& shard, std::int64_t unit, const std::string& record) {
  if (Units().Contains(unit)) {
    // As part of the same block, finished here or not; otherwise it was counted for different shards.
    Statement same(db_.get(), "SELECT record FROM units WHERE unit = ? AND shards = ? AND shard = ?");
    same.Bind(unit).Bind(static_cast<std::int64_t>(shard.count)).Bind(static_cast<std::int64_t>(shard.index));
    if (same.Step()) {
      STICTION_CHECK(same.Text(0) == record, fmt::format("two copies of unit {} differ", unit));
      return;
    }
    Statement closed(db_.get(), "SELECT 1 FROM blocks WHERE shards = ? AND shard = ? AND block = ?");
    closed.Bind(static_cast<std::int64_t>(shard.count)).Bind(static_cast<std::int64_t>(shard.index));
    if (closed.Bind(BlockOf(shard, unit)).Step()) return;
    throw InputError(fmt::format("merge: unit {} is in both stores, in blocks of different shards", unit));
  }
  InsertUnit(shard, unit, record);
  CloseBlockIfComplete(shard, BlockOf(shard, unit));
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

}  // namespace stiction
