// SPDX-License-Identifier: Apache-2.0
// Store: one SQLite file with what a campaign has done and found.
//
//   campaign   its identity: definition, seed, policies, version of the algorithm
//   blocks     statistics of kUnitsPerBlock consecutive units of one shard
//   units      statistics of single units, of blocks that are not complete yet
//   findings   one representative per signature, with certificate and minimized form
//   elites     of an optimized search: the best of every unit
//   work       of every block and unit: the builds that made it, the machines, and their processor time
//
// Every row carries the SHA-256 of its content (store_rows.h), which is checked when a store is opened: what a
// disk or a hand has changed is named and refused, never read. Work is no part of what is compared.
//
// Never a row per problem tried. Units may be added in any order, each once; a finding's representative is
// the one with the smallest (unit, index), whoever came first. So the same units leave the same store,
// whatever the number of threads and interruptions. Every Add is one transaction: a killed process loses the
// unit that it was working on and nothing else.

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "corpus/record/campaign_identity.h"
#include "corpus/record/statistics.h"
#include "corpus/record/work.h"

struct sqlite3;

namespace stiction {

class Statement;
struct StoreTable;

struct Shard {
  int index = 0;
  int count = 1;

  bool Owns(std::int64_t unit) const { return unit % count == index; }
  bool operator==(const Shard&) const = default;
};

// A representative. `done` once it is certified and minimized.
struct Finding {
  std::string signature;
  std::string kind;  // kinds.h
  std::int64_t unit = 0;
  std::int64_t index = 0;
  std::string generator;
  int contacts = 0;
  std::string policy;
  std::string inexact_outcome;
  std::string exact_outcome;
  std::string problem;  // exact, as stiction-problem JSON
  bool done = false;
  // Filled when done.
  std::string certificate;            // of `problem`, JSON; empty for outcomes without one
  std::string minimized;              // stiction-problem JSON with `expect`
  std::string minimized_certificate;  // JSON
  // `solution-exists` (or, of a problem without a solution, `no-solution`) of `problem` and of `minimized`,
  // JSON; empty if undecided.
  std::string existence;
  std::string minimized_existence;
  // JSON: start, period, grid counts, sizes, ...; of a disagreement of methods their answers, done or not.
  std::string facts;

  bool operator==(const Finding&) const = default;
};

// visit(column, member), of a Finding or a const one, in the order of the table.
template <class OfFinding, class Visit>
void ForEachColumn(OfFinding& f, Visit visit) {
  visit("signature", f.signature);
  visit("kind", f.kind);
  visit("unit", f.unit);
  visit("idx", f.index);
  visit("generator", f.generator);
  visit("contacts", f.contacts);
  visit("policy", f.policy);
  visit("inexact_outcome", f.inexact_outcome);
  visit("exact_outcome", f.exact_outcome);
  visit("problem", f.problem);
  visit("done", f.done);
  visit("certificate", f.certificate);
  visit("minimized", f.minimized);
  visit("minimized_certificate", f.minimized_certificate);
  visit("existence", f.existence);
  visit("minimized_existence", f.minimized_existence);
  visit("facts", f.facts);
}

// The units of a store: whole blocks, and single units of blocks that are not complete.
class UnitSet {
 public:
  void AddUnit(std::int64_t unit) { units_.insert(unit); }
  void AddBlock(const Shard& shard, std::int64_t block) { blocks_[{shard.count, shard.index}].insert(block); }
  bool Contains(std::int64_t unit) const;
  std::int64_t Count() const;

 private:
  std::set<std::int64_t> units_;
  std::map<std::pair<int, int>, std::set<std::int64_t>> blocks_;  // by (shards, shard)
};

class Store {
 public:
  static constexpr std::int64_t kUnitsPerBlock = 1024;

  // Opens a store for a campaign, making it where no file is. Its remarks take the place of those of the store.
  // A file that is none, a store of another campaign, and a row that is not as it was written, is an InputError
  // that names the difference and the way out. Here and in all that changes a store: OutputError if the disk is
  // full or the store cannot be written; nothing that was committed is lost then.
  Store(const std::filesystem::path& file, const CampaignIdentity& identity);
  // Opens an existing store to read, while others write or not, in a folder that can be written or not. The
  // same errors.
  static Store OpenToRead(const std::filesystem::path& file);
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  ~Store();

  const CampaignIdentity& identity() const { return identity_; }

  // Units that are in the store.
  UnitSet Units() const;
  // A unit of a shard: its statistics and candidates for representatives. Returns those candidates that are now
  // representatives.
  // `elites`: what later units of an optimized search start from; empty of other searches.
  std::vector<Finding> AddUnit(const Shard& shard, std::int64_t unit, const Record& record,
                               const std::vector<Finding>& candidates, const std::string& elites = {},
                               const Work& work = {});
  // A candidate of a unit that is still being run, so that it is not lost with the unit. Whether it is now the
  // representative. It is counted with its unit.
  bool AddFinding(const Finding& candidate);
  // By unit.
  std::map<std::int64_t, std::string> Elites() const;
  // Fills in a representative, unless a smaller one has taken its place meanwhile. `work` is added to that of
  // its unit or block.
  void Finish(const Finding& finding, const Work& work = {});
  // What was spent on the findings of a unit that the store holds.
  void AddWork(std::int64_t unit, const Work& work);
  // All representatives in the order of signature.
  std::vector<Finding> Findings() const;
  // Sum over all units.
  Record Total() const;
  // What it took.
  Work TotalWork() const;

  std::vector<std::pair<Shard, std::int64_t>> Blocks() const;

  // Takes all of another store's units and findings in. Requires the same identity, and no unit in both unless
  // as the same block; a block in both with different content is an InternalError that names it.
  // The work of two copies is that of the longer one, with the builds and machines of both; remarks are taken
  // where there are none.
  void MergeFrom(const Store& other);
  // Takes in what is sound of a store that need not be, and what fits to what is here. Returns a line for
  // everything that is left out. InputError if not even its campaign can be read, or is another one.
  std::vector<std::string> Salvage(const std::filesystem::path& file);
  // The campaign of a store, of which nothing else need be sound.
  static CampaignIdentity IdentityIn(const std::filesystem::path& file);

 private:
  struct Close {
    void operator()(sqlite3* db) const;
  };
  explicit Store(sqlite3* db);
  static void Make(const std::filesystem::path& file, const CampaignIdentity& identity);
  static Store ReadAlone(const std::filesystem::path& file);
  static Store Snapshot(sqlite3* db, const std::filesystem::path& file);
  static Store OpenUnchecked(const std::filesystem::path& file);
  void CreateTables();
  void WriteIdentity(const CampaignIdentity& identity);
  void TakeRemarks(const std::string& remarks);
  CampaignIdentity ReadIdentity(const std::filesystem::path& file) const;
  void RequireSound() const;
  void InsertUnit(const Shard& shard, std::int64_t unit, const std::string& record);
  bool Holds(std::int64_t unit) const;
  std::int64_t CountUnits(const Shard& shard, std::int64_t block) const;
  void MergeBlock(const Shard& shard, std::int64_t block, const std::string& record);
  void MergeUnit(const Shard& shard, std::int64_t unit, const std::string& record);
  void MergeFinding(const Finding& finding);
  void MergeElites(std::int64_t unit, const std::string& elites);
  void MergeWork(const Statement& row);
  void BeginMerge(const Store& other);
  void MergeRow(std::string_view table, const Statement& row);
  void SalvageTable(const StoreTable& table, const Store& other, std::vector<std::string>& left_out);
  std::string SalvageRow(const StoreTable& table, const Store& other, const Statement& row);
  void CloseBlocksOf(const Store& other);
  void CloseBlockIfComplete(const Shard& shard, std::int64_t block);
  bool Represent(const Finding& candidate);
  std::vector<Finding> SelectFindings(const std::string& where_and_order) const;
  void Execute(const std::string& sql) const;

  std::unique_ptr<sqlite3, Close> db_;
  CampaignIdentity identity_;
};

}  // namespace stiction
