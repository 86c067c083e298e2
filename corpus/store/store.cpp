// SPDX-License-Identifier: Apache-2.0
#include "corpus/store/store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <fstream>

#include "corpus/atomic_file.h"
#include "corpus/descriptor.h"
#include "corpus/output_error.h"
#include "corpus/printable.h"
#include "corpus/store/store_rows.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStoreFormat = "stiction-store";
constexpr int kStoreVersion = 4;  // 2: with existence; 3: with seals and work; 4: by friction and rank
constexpr const char* kTables = R"sql(
CREATE TABLE campaign (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE blocks (
  shards INTEGER NOT NULL, shard INTEGER NOT NULL, block INTEGER NOT NULL, record TEXT NOT NULL,
  seal TEXT NOT NULL, PRIMARY KEY (shards, shard, block)) WITHOUT ROWID;
CREATE TABLE units (
  unit INTEGER PRIMARY KEY, shards INTEGER NOT NULL, shard INTEGER NOT NULL, block INTEGER NOT NULL,
  record TEXT NOT NULL, seal TEXT NOT NULL);
CREATE TABLE findings (
  signature TEXT PRIMARY KEY, kind TEXT NOT NULL, unit INTEGER NOT NULL, idx INTEGER NOT NULL,
  generator TEXT NOT NULL, contacts INTEGER NOT NULL, policy TEXT NOT NULL,
  inexact_outcome TEXT NOT NULL, exact_outcome TEXT NOT NULL, problem TEXT NOT NULL, done INTEGER NOT NULL,
  certificate TEXT NOT NULL, minimized TEXT NOT NULL, minimized_certificate TEXT NOT NULL,
  existence TEXT NOT NULL, minimized_existence TEXT NOT NULL, facts TEXT NOT NULL, seal TEXT NOT NULL)
  WITHOUT ROWID;
CREATE TABLE elites (unit INTEGER PRIMARY KEY, elites TEXT NOT NULL, seal TEXT NOT NULL);
CREATE TABLE work (
  shards INTEGER NOT NULL, shard INTEGER NOT NULL, block INTEGER NOT NULL, unit INTEGER NOT NULL,
  builds TEXT NOT NULL, time TEXT NOT NULL, seal TEXT NOT NULL,
  PRIMARY KEY (shards, shard, block, unit)) WITHOUT ROWID;
)sql";
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

// A new folder, of this user alone, whose name begins as given; `target`: what it is for.
class TemporaryFolder {
 public:
  TemporaryFolder(const fs::path& begin, const fs::path& target) : path_(begin.string() + "XXXXXX") {
    if (mkdtemp(path_.data()) == nullptr) RefuseOutput(target, errno);
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
void RequireFile(const fs::path& file) {
  if (file == "-")
    throw InputError(
        "-: found standard input, expected a store in a file: it is read and written at many places");
}

// SQLite writes beside the store by name: nothing there is another's file, under a second name or behind a
// link. One that SQLite removes just now has no name any more.
void RequireOwnFiles(const fs::path& file) {
  for (const char* end : {"-wal", "-shm", "-journal"}) {
    const std::string name = file.string() + end;
    struct stat status = {};
    if (lstat(name.c_str(), &status) != 0 || (S_ISREG(status.st_mode) && status.st_nlink <= 1)) continue;
    throw InputError(
        name + ": found a link or no regular file, expected a file of the store or nothing: move it away");
  }
}

void RequireDatabase(const fs::path& file) {
  constexpr std::string_view kMagic("SQLite format 3\0", 16);
  const auto refuse = [&file](const std::string& found) {
    throw InputError(fmt::format("{}: found {}, expected a store: a file that stiction search writes",
                                 file.string(), found));
  };
  RequireOwnFiles(file);
  if (fs::is_directory(file))
    refuse(fs::exists(file / "findings.csv") ? "a report, which was made of a store" : "a directory");
  if (!fs::is_regular_file(file)) refuse("no regular file");
  std::string head(kMagic.size(), ' ');
  std::ifstream(file, std::ios::binary).read(head.data(), static_cast<std::streamsize>(head.size()));
  if (head != kMagic) refuse(fmt::format("another file, of {} bytes", fs::file_size(file)));
}

// Some network file systems have none. SQLite would wait for one, in vain.
bool HasLocks(const fs::path& file) {
  const Descriptor opened(open(file.c_str(), O_RDONLY | O_CLOEXEC));
  struct flock range = {};
  range.l_type = F_RDLCK;
  return !opened.valid() || fcntl(opened.number(), F_OFD_GETLK, &range) == 0;
}

// A database with tables of somebody else must not get ours beside them.
void RefuseForeignDatabase(sqlite3* db, const fs::path& file) {
  Statement tables(db, "SELECT COUNT(*), COUNT(CASE WHEN name = 'campaign' THEN 1 END) FROM sqlite_master");
  tables.Step();
  if (tables.Integer(0) > 0 && tables.Integer(1) == 0) {
    throw InputError(fmt::format(
        "{}: found another database, expected a store: a file that stiction search writes", file.string()));
  }
}

// Where the work of a unit is kept; empty if the store does not hold it.
std::optional<WorkKey> WorkKeyOf(sqlite3* db, std::int64_t unit) {
  Statement open(db, "SELECT shards, shard FROM units WHERE unit = ?");
  if (open.Bind(unit).Step()) {
    const Shard shard = ReadShard(open);
    return WorkKey{shard, BlockOf(shard, unit), unit};
  }
  Statement shards(db, "SELECT DISTINCT shards, shard FROM blocks");
  while (shards.Step()) {
    const Shard shard = ReadShard(shards);
    if (shard.Owns(unit) && HoldsBlock(db, shard, BlockOf(shard, unit)))
      return WorkKey{shard, BlockOf(shard, unit)};
  }
  return std::nullopt;
}

void AddWorkTo(sqlite3* db, std::int64_t unit, const Work& work) {
  const auto key = WorkKeyOf(db, unit);
  if (!key || work == Work{}) return;
  Work sum = ReadWork(db, *key);
  sum.Add(work);
  WriteWork(db, *key, sum);
}

}  // namespace

void Store::Close::operator()(sqlite3* db) const { sqlite3_close(db); }

Store::Store(sqlite3* db) : db_(db) {}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

Store::Store(const fs::path& file, const CampaignIdentity& identity) {
  RequireFile(file);
  if (!fs::exists(fs::symlink_status(file))) Make(file, identity);
  RequireDatabase(file);
  db_.reset(OpenDatabase(file, SQLITE_OPEN_READWRITE));
  RefuseForeignDatabase(db_.get(), file);
  // A killed process loses nothing that was committed; synchronous=NORMAL gives up only the last commits of a
  // machine that loses its power.
  Execute("PRAGMA journal_mode = WAL");
  Execute("PRAGMA synchronous = NORMAL");
  identity_ = ReadIdentity(file);
  if (identity_ == identity) {
    RequireSound();
    if (identity.remarks.empty() || identity.remarks == identity_.remarks) return;
    Transaction transaction(db_.get());
    TakeRemarks(identity.remarks);
    transaction.Commit();
    return;
  }
  throw InputError(
      fmt::format("{}: holds another search: {}; search with {}, or with --store NEW_FILE", file.string(),
                  Difference(identity_, identity),
                  identity_.algorithm == identity.algorithm ? "the same options" : "a build of that version"));
}

// In a folder of its own first: a store is never half made, and no file that came meanwhile is overwritten.
void Store::Make(const fs::path& file, const CampaignIdentity& identity) {
  const TemporaryFolder folder(file.string() + ".new-", file);
  const fs::path name = folder.path() / "store";
  {
    Store store(OpenDatabase(name, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE));
    store.Execute("PRAGMA journal_mode = WAL");  // now: two that open it could not both change it
    Transaction transaction(store.db_.get());
    store.CreateTables();
    store.WriteIdentity(identity);
    transaction.Commit();
  }
  if (renameat2(AT_FDCWD, name.c_str(), AT_FDCWD, file.c_str(), RENAME_NOREPLACE) != 0 && errno != EEXIST)
    RefuseOutput(file, errno);
}

Store Store::OpenToRead(const fs::path& file) {
  Store store = OpenUnchecked(file);
  store.RequireSound();
  return store;
}

CampaignIdentity Store::IdentityIn(const fs::path& file) { return OpenUnchecked(file).identity_; }

Store Store::OpenUnchecked(const fs::path& file) {
  RequireFile(file);
  if (!fs::exists(file))
    throw InputError(
        fmt::format("{0}: found no such store, expected one that a search wrote; stiction search --store {0} "
                    "makes it",
                    file.string()));
  RequireDatabase(file);
  if (!HasLocks(file)) return ReadAlone(file);
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
  const TemporaryFolder folder(fs::temp_directory_path() / "stiction-", fs::temp_directory_path());
  const fs::path copy = folder.path() / "store";
  CopyFile(file, copy);
  CopyFile(log, copy.string() + "-wal");
  return Snapshot(OpenDatabase(copy, SQLITE_OPEN_READWRITE), file);  // needs no names once it is open
}

// For all that is read: a running search may close a block between two questions.
Store Store::Snapshot(sqlite3* db, const fs::path& file) {
  Store store(db);
  store.Execute("PRAGMA writable_schema = ON");  // reads a file that ends too early, too, as far as it goes
  store.Execute("BEGIN");
  store.identity_ = store.ReadIdentity(file);
  return store;
}

void Store::Execute(const std::string& sql) const {
  if (sqlite3_exec(db_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) RefuseDatabase(db_.get());
}

void Store::CreateTables() { Execute(kTables); }

namespace {

// What makes a campaign, by key.
std::map<std::string, std::string> CampaignRows(const CampaignIdentity& identity) {
  std::map<std::string, std::string> rows = {{"format", kStoreFormat},
                                             {"version", std::to_string(kStoreVersion)},
                                             {"definition", identity.definition},
                                             {"seed", std::to_string(identity.seed)},
                                             {"policies", identity.policies},
                                             {"algorithm", std::to_string(identity.algorithm)}};
  if (!identity.remarks.empty()) rows["remarks"] = identity.remarks;
  return rows;
}

std::string CampaignSeal(const std::map<std::string, std::string>& rows) {
  std::vector<std::string> texts;
  for (const auto& [key, value] : rows) texts.insert(texts.end(), {key, value});
  return SealOf("campaign", texts);
}

[[noreturn]] void RefuseVersion(const std::string& file, std::map<std::string, std::string>& rows) {
  int version = 0;
  const std::string& text = rows["version"];
  std::from_chars(text.data(), text.data() + text.size(), version);
  const std::string way_out =
      rows["format"] != kStoreFormat || version <= 0 ? "It is damaged, or no store: take a copy of it"
      : version > kStoreVersion
          ? "It is of a newer stiction: take that one"
          : "It is of an older stiction" + (rows.contains("build") ? ", " + Printable(rows["build"]) : "") +
                ": that one goes on with it and reports it";
  throw InputError(
      fmt::format("{}: found format {} version {}, expected {} version {}. {}, or search anew with "
                  "--store NEW_FILE",
                  file, Printable(rows["format"]), Printable(text), kStoreFormat, kStoreVersion, way_out));
}

template <class Number>
Number NumberOf(const std::string& file, const char* what, const std::string& text, const char* expected) {
  Number number = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  if (read.ec == std::errc() && read.ptr == end) return number;
  throw InputError(fmt::format("{}: found {} '{}', expected {}", file, what, Printable(text), expected));
}

}  // namespace

void Store::WriteIdentity(const CampaignIdentity& identity) {
  std::map<std::string, std::string> rows = CampaignRows(identity);
  rows["seal"] = CampaignSeal(rows);
  for (const auto& [key, value] : rows)
    Statement(db_.get(), "INSERT OR REPLACE INTO campaign (key, value) VALUES (?, ?)")
        .Bind(key)
        .Bind(value)
        .Step();
}

// In the place of those before.
void Store::TakeRemarks(const std::string& remarks) {
  identity_.remarks = remarks;
  WriteIdentity(identity_);
}

// Its version first: a store of another one has other rows.
CampaignIdentity Store::ReadIdentity(const fs::path& name) const {
  const std::string file = StoreName(db_.get());
  std::map<std::string, std::string> values;
  Statement table(db_.get(), "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = 'campaign'");
  if (table.Step()) {
    Statement rows(db_.get(), "SELECT key, value FROM campaign");
    while (rows.Step()) values[rows.Text(0)] = rows.Text(1);
  }
  if (values.empty())
    throw InputError(fmt::format(
        "{}: found no campaign in it, expected a store: a file that stiction search writes", name.string()));
  if (values["format"] != kStoreFormat || values["version"] != std::to_string(kStoreVersion))
    RefuseVersion(file, values);
  const std::string stored = values["seal"];
  values.erase("seal");
  if (const std::string seal = CampaignSeal(values); seal != stored) {
    throw InputError(
        fmt::format("{}: campaign: found content of SHA-256 {}, expected {}: the store is damaged, and "
                    "what it is of cannot be told",
                    file, seal, stored));
  }
  return {values["definition"],
          NumberOf<std::uint64_t>(file, "seed", values["seed"], "an integer from 0 to 2^64 - 1"),
          values["policies"],
          NumberOf<int>(file, "algorithm", values["algorithm"], "a version of the algorithm"),
          values["remarks"]};
}

// Pages that SQLite cannot reach any more hide rows without a word.
void Store::RequireSound() const {
  Statement check(db_.get(), "PRAGMA quick_check(1)");
  if (check.Step() && check.Text(0) != "ok") {
    std::string said = check.Text(0);
    std::ranges::replace(said, '\n', ' ');
    throw InputError(
        fmt::format("{0}: found pages that do not fit together ({1}), expected a whole database: the "
                    "store is damaged. What is sound is saved by: stiction merge --salvage NEW_FILE {0}",
                    StoreName(db_.get()), said));
  }
  for (const StoreTable& table : StoreTables()) {
    Statement rows(db_.get(), SelectFrom(table.name, ""));
    while (rows.Step()) RequireSoundRow(db_.get(), table, rows);
  }
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
  for (const auto& [shard, block] : Blocks()) units.AddBlock(shard, block);
  return units;
}

void Store::InsertUnit(const Shard& shard, std::int64_t unit, const std::string& record) {
  STICTION_CHECK(shard.Owns(unit),
                 fmt::format("unit {} is not of shard {}/{}", unit, shard.index, shard.count));
  Statement alone(db_.get(), "SELECT 1 FROM units WHERE unit = ?");
  if (alone.Bind(unit).Step() || HoldsBlock(db_.get(), shard, BlockOf(shard, unit))) {
    throw InputError(
        fmt::format("{}: holds unit {} already; does another search work on the same store and shard?",
                    StoreName(db_.get()), unit));
  }
  PutRow(db_.get(), "units",
         {unit, std::int64_t{shard.count}, std::int64_t{shard.index}, BlockOf(shard, unit), record});
}

std::vector<Finding> Store::AddUnit(const Shard& shard, std::int64_t unit, const Record& record,
                                    const std::vector<Finding>& candidates, const std::string& elites,
                                    const Work& work) {
  Transaction transaction(db_.get());
  InsertUnit(shard, unit, Serialize(record));
  WriteWork(db_.get(), {shard, BlockOf(shard, unit), unit}, work);
  if (!elites.empty()) PutRow(db_.get(), "elites", {unit, elites});
  std::vector<Finding> representatives;
  for (const Finding& candidate : candidates) {
    if (Represent(candidate)) representatives.push_back(candidate);
  }
  CloseBlockIfComplete(shard, BlockOf(shard, unit));
  transaction.Commit();
  return representatives;
}

bool Store::AddFinding(const Finding& candidate) {
  Transaction transaction(db_.get());
  const bool represents = Represent(candidate);
  transaction.Commit();
  return represents;
}

std::map<std::int64_t, std::string> Store::Elites() const {
  std::map<std::int64_t, std::string> elites;
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

// Units of a block that stand alone, looked up one by one: the table may hold those of a thousand shards.
std::int64_t Store::CountUnits(const Shard& shard, std::int64_t block) const {
  Statement count(
      db_.get(),
      fmt::format("{} SELECT COUNT(*) FROM of_block JOIN units USING (unit) WHERE shards = ?", kUnitsOfBlock));
  const std::int64_t shards = shard.count;
  count.Bind(FirstUnit(shard, block)).Bind(shards).Bind(kUnitsPerBlock).Bind(shards).Step();
  return count.Integer(0);
}

void Store::CloseBlockIfComplete(const Shard& shard, std::int64_t block) {
  // Units come in their order, or nearly: until the last is there, nothing needs to be counted.
  Statement last(db_.get(), "SELECT 1 FROM units WHERE unit = ? AND shards = ?");
  const std::int64_t shards = shard.count;
  if (!last.Bind(FirstUnit(shard, block) + (kUnitsPerBlock - 1) * shards).Bind(shards).Step()) return;
  if (CountUnits(shard, block) < kUnitsPerBlock) return;
  const std::string of_block = " WHERE shards = ? AND shard = ? AND block = ?";
  Record sum;
  Statement records(db_.get(), "SELECT record FROM units" + of_block);
  records.Bind(shard).Bind(block);
  while (records.Step()) sum.Merge(ParseRecord(records.Text(0), "record of a unit"));
  Work work;
  Statement works(db_.get(), SelectFrom("work", of_block));
  works.Bind(shard).Bind(block);
  while (works.Step()) work.Add(ReadWorkRow(works));
  RemoveUnits(db_.get(), shard, block);
  PutRow(db_.get(), "blocks", {std::int64_t{shard.count}, std::int64_t{shard.index}, block, Serialize(sum)});
  WriteWork(db_.get(), {shard, block}, work);
}

void Store::Finish(const Finding& finding, const Work& work) {
  Transaction transaction(db_.get());
  Statement present(db_.get(), "SELECT 1 FROM findings WHERE signature = ? AND unit = ? AND idx = ?");
  present.Bind(finding.signature).Bind(finding.unit).Bind(finding.index);
  if (present.Step()) WriteFinding(db_.get(), finding);
  AddWorkTo(db_.get(), finding.unit, work);
  transaction.Commit();
}

void Store::AddWork(std::int64_t unit, const Work& work) {
  Transaction transaction(db_.get());
  AddWorkTo(db_.get(), unit, work);
  transaction.Commit();
}

std::vector<Finding> Store::SelectFindings(const std::string& where_and_order) const {
  Statement rows(db_.get(), SelectFrom("findings", where_and_order));
  std::vector<Finding> findings;
  while (rows.Step()) findings.push_back(ReadFinding(rows));
  return findings;
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

Work Store::TotalWork() const {
  Work total;
  Statement rows(db_.get(), SelectFrom("work", ""));
  while (rows.Step()) total.Add(ReadWorkRow(rows));
  return total;
}

std::vector<std::pair<Shard, std::int64_t>> Store::Blocks() const {
  Statement rows(db_.get(), "SELECT shards, shard, block FROM blocks ORDER BY shards, shard, block");
  std::vector<std::pair<Shard, std::int64_t>> blocks;
  while (rows.Step()) blocks.emplace_back(ReadShard(rows), ReadBlock(rows, 2));
  return blocks;
}

}  // namespace stiction
