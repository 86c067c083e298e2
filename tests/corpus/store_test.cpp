// SPDX-License-Identifier: Apache-2.0
// The store: the same units leave the same content, whatever their order, interruptions and merges.

#include "corpus/store/store.h"

#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <barrier>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "corpus/input_error.h"
#include "corpus/json.h"
#include "corpus/machine.h"
#include "corpus/record/kinds.h"
#include "corpus/stopwatch.h"
#include "corpus/store/store_rows.h"
#include "solver/problem/check.h"
#include "tests/scratch.h"

namespace stiction {
namespace {

namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using Catch::Matchers::Matches;
using testing::Scratch;

constexpr std::int64_t kBlock = Store::kUnitsPerBlock;

// ---- Stores to test --------------------------------------------------------------------------

CampaignIdentity Identity() { return {R"({"contacts":[2,3]})", 7, R"(["paper"])", 3}; }

// What unit `unit` counts; every unit counts something else.
Record RecordOf(std::int64_t unit) {
  Record record;
  Tally& tally = record.tallies[{unit % 2 == 0 ? "psd" : "small", 2, "paper"}];
  for (std::int64_t i = 0; i <= unit % 5; ++i) {
    Verdict verdict;
    verdict.outcome = i == 0 ? Outcome::kSolved : Outcome::kCycle;
    verdict.statistics.steps = unit % 70 + i;
    verdict.statistics.give_ups = i;
    tally.Count(verdict);
    tally.strata[{i == 0 ? "1/2" : kMixedFriction, static_cast<int>(unit % 3) + 1}].Count(verdict);
  }
  LoopTally& loops = record.loops[3];
  loops.loops += unit % 3;
  loops.by_zero_steps[static_cast<int>(unit % 5)] += unit % 3;
  record.words["cycle-3c-4d-14s"].Add(static_cast<std::uint64_t>(unit) * 0x9e3779b97f4a7c15u);
  AgreementTally& agreement = record.agreement[static_cast<int>(unit % 2) + 1];
  agreement.compared = unit % 11;
  ++agreement.words[static_cast<int>(unit % 4)];
  if (unit % 3 == 0) record.signatures[fmt::format("cycle-{}c", unit % 4)] = unit % 7 + 1;
  return record;
}

Finding Candidate(const std::string& signature, std::int64_t unit, std::int64_t index, int contacts = 2) {
  Finding finding;
  finding.signature = signature;
  finding.kind = "cycle";
  finding.unit = unit;
  finding.index = index;
  finding.generator = "psd";
  finding.contacts = contacts;
  finding.policy = "paper";
  finding.inexact_outcome = "stall";
  finding.exact_outcome = "cycle";
  finding.problem = fmt::format("problem {} {}", unit, index);
  return finding;
}

Finding Finished(Finding finding) {
  finding.done = true;
  finding.certificate = "certificate of " + finding.problem;
  finding.minimized = "minimized " + finding.problem;
  finding.minimized_certificate = "certificate of " + finding.minimized;
  finding.existence = "existence of " + finding.problem;
  finding.minimized_existence = "existence of " + finding.minimized;
  finding.facts = R"({"found":1})";
  return finding;
}

// The candidates of a unit: one group for each of 5 remainders, and one that all share.
std::vector<Finding> CandidatesOf(std::int64_t unit) {
  return {Candidate(fmt::format("group-{}", unit % 5), unit, unit * 37 % 11), Candidate("all", unit, 3)};
}

void Add(Store& store, std::int64_t unit, const Shard& shard = {}) {
  store.AddUnit(shard, unit, RecordOf(unit), CandidatesOf(unit));
}

// The k-th unit of a shard.
std::int64_t UnitOf(const Shard& shard, std::int64_t k) { return k * shard.count + shard.index; }

void AddRange(Store& store, const Shard& shard, std::int64_t from, std::int64_t to) {
  for (std::int64_t k = from; k < to; ++k) Add(store, UnitOf(shard, k), shard);
}

Record SumOf(std::int64_t units) {
  Record sum;
  for (std::int64_t unit = 0; unit < units; ++unit) sum.Merge(RecordOf(unit));
  return sum;
}

// Every row of every table, in order.
std::string Content(const fs::path& file) {
  sqlite3* db = nullptr;
  REQUIRE(sqlite3_open(file.c_str(), &db) == SQLITE_OK);
  std::string text;
  const auto take = [](void* out, int columns, char** values, char**) {
    for (int i = 0; i < columns; ++i) *static_cast<std::string*>(out) += std::string(values[i]) + "|";
    *static_cast<std::string*>(out) += "\n";
    return 0;
  };
  for (const char* query :
       {"SELECT * FROM campaign ORDER BY key", "SELECT * FROM units ORDER BY unit",
        "SELECT * FROM blocks ORDER BY shards, shard, block", "SELECT * FROM findings ORDER BY signature",
        "SELECT * FROM elites ORDER BY unit"}) {
    REQUIRE(sqlite3_exec(db, query, take, &text, nullptr) == SQLITE_OK);
  }
  sqlite3_close(db);
  return text;
}

std::size_t BlockCount(const Store& store) { return store.Blocks().size(); }

void WriteFile(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

void Execute(const fs::path& file, const char* sql) {
  sqlite3* db = nullptr;
  REQUIRE(sqlite3_open(file.c_str(), &db) == SQLITE_OK);
  CHECK(sqlite3_exec(db, sql, nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(db);
}

// ---- Identity --------------------------------------------------------------------------------

TEST_CASE("store: another campaign is refused, with the difference and the way to a new store") {
  const Scratch scratch;
  const fs::path file = scratch / "a.store";
  {
    Store store(file, Identity());
    Add(store, 0);
  }
  const std::string before = Content(file);
  const auto refused = [&file](const CampaignIdentity& other, const std::string& what,
                               const std::string& next) {
    CHECK_THROWS_AS(Store(file, other), InputError);
    CHECK_THROWS_WITH(Store(file, other), Contains(file.string()) && Contains(what) && Contains(next) &&
                                              Contains("--store NEW_FILE"));
  };
  CampaignIdentity other = Identity();
  other.seed = 8;
  refused(other, "seed 7, not 8", "the same options");
  other = Identity();
  other.algorithm = 4;
  refused(other, "version of the algorithm 3, not 4", "a build of that version");
  other = Identity();
  other.policies = R"(["ties=contacts"])";
  refused(other, "policies paper, not ties=contacts", "the same options");
  other = Identity();
  other.definition = R"({"contacts":[2,4]})";
  refused(other, "contacts 2, 3, not 2, 4", "the same options");
  other.seed = 8;
  refused(other, "contacts 2, 3, not 2, 4; seed 7, not 8;", "the same options");
  CHECK((Content(file) == before));

  Store again(file, Identity());
  CHECK(again.identity() == Identity());
  CHECK(again.Units().Contains(0));
}

TEST_CASE("store: a seed of all 64 bits comes back") {
  const Scratch scratch;
  CampaignIdentity identity = Identity();
  identity.seed = UINT64_MAX;
  { Store store(scratch / "a.store", identity); }
  CHECK(Store::OpenToRead(scratch / "a.store").identity() == identity);
}

// ---- Units and blocks ------------------------------------------------------------------------

TEST_CASE("store: units in any order leave the same content", "[slow]") {
  const Scratch scratch;
  std::vector<std::int64_t> units(2 * kBlock + 100);
  std::iota(units.begin(), units.end(), 0);
  std::vector<std::string> contents;
  for (int order = 0; order < 3; ++order) {
    const fs::path file = scratch / fmt::format("{}.store", order);
    if (order == 1) std::reverse(units.begin(), units.end());
    if (order == 2) std::shuffle(units.begin(), units.end(), std::mt19937(1994));
    Store store(file, Identity());
    for (const std::int64_t unit : units) Add(store, unit);
    CHECK(store.Total() == SumOf(2 * kBlock + 100));
    CHECK(BlockCount(store) == 2);
    contents.push_back(Content(file));
  }
  CHECK((contents[1] == contents[0]));
  CHECK((contents[2] == contents[0]));
}

TEST_CASE("store: a block closes with its last unit, and the total stays", "[slow]") {
  const Scratch scratch;
  const Shard shard{1, 3};
  Store store(scratch / "a.store", Identity());
  AddRange(store, shard, 1, kBlock);
  CHECK(BlockCount(store) == 0);
  CHECK(store.Units().Count() == kBlock - 1);
  Record total = store.Total();
  total.Merge(RecordOf(1));

  Add(store, 1, shard);
  REQUIRE(BlockCount(store) == 1);
  CHECK(store.Blocks()[0].first == shard);
  CHECK(store.Blocks()[0].second == 0);
  CHECK(store.Total() == total);
  const UnitSet units = store.Units();
  CHECK(units.Count() == kBlock);
  for (const std::int64_t k : {std::int64_t{0}, std::int64_t{1}, kBlock - 1}) {
    CHECK(units.Contains(UnitOf(shard, k)));
    CHECK_FALSE(units.Contains(UnitOf({0, 3}, k)));
    CHECK_FALSE(units.Contains(UnitOf({2, 3}, k)));
  }
  CHECK_FALSE(units.Contains(UnitOf(shard, kBlock)));

  Add(store, UnitOf(shard, kBlock), shard);
  CHECK(BlockCount(store) == 1);
  CHECK(store.Units().Count() == kBlock + 1);
}

TEST_CASE("store: a unit is counted once, and only by its own shard") {
  const Scratch scratch;
  const fs::path file = scratch / "a.store";
  Store store(file, Identity());
  AddRange(store, {}, 0, 5);
  const std::string before = Content(file);
  CHECK_THROWS_AS(Add(store, 4), InputError);
  CHECK_THROWS_AS(Add(store, 4, {1, 2}), InternalError);
  CHECK((Content(file) == before));
}

// Two searches on one store: both may be at work on the last unit of a block.
TEST_CASE("store: a unit of a closed block is not counted again", "[slow]") {
  const Scratch scratch;
  const fs::path file = scratch / "a.store";
  Store store(file, Identity());
  AddRange(store, {}, 0, kBlock);
  const std::string before = Content(file);
  CHECK_THROWS_AS(Add(store, kBlock - 1), InputError);
  CHECK((Content(file) == before));
  CHECK(store.Total() == SumOf(kBlock));
}

TEST_CASE("store: what was added is there when the file is opened again", "[slow]") {
  const Scratch scratch;
  {
    Store store(scratch / "a.store", Identity());
    AddRange(store, {}, 0, kBlock + 3);
  }
  Store store(scratch / "a.store", Identity());
  CHECK(store.Units().Count() == kBlock + 3);
  CHECK(store.Total() == SumOf(kBlock + 3));
  CHECK(store.Findings().size() == 6);
}

// ---- Findings --------------------------------------------------------------------------------

TEST_CASE("store: the representative has the smallest (unit, index), whoever came first") {
  const Scratch scratch;
  const std::vector<Finding> candidates = {Candidate("g", 5, 2), Candidate("g", 5, 9), Candidate("g", 6, 0),
                                           Candidate("g", 10, 1)};
  std::vector<int> order = {0, 1, 2, 3};
  int number = 0;
  do {
    // Two candidates of unit 5 cannot come apart: they are added together.
    Store store(scratch / fmt::format("{}.store", number++), Identity());
    std::vector<Finding> of_5;
    for (const int i : order) {
      if (candidates[i].unit == 5) of_5.push_back(candidates[i]);
    }
    for (const int i : order) {
      const std::int64_t unit = candidates[i].unit;
      if (unit != 5) {
        store.AddUnit({}, unit, {}, {candidates[i]});
      } else if (candidates[i] == of_5[0]) {
        store.AddUnit({}, 5, {}, of_5);
      }
    }
    const auto findings = store.Findings();
    REQUIRE(findings.size() == 1);
    CHECK(findings[0] == candidates[0]);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("store: adding a unit names the candidates that represent their group now") {
  const Scratch scratch;
  Store store(scratch / "a.store", Identity());
  CHECK(store.AddUnit({}, 3, {}, {Candidate("g", 3, 0), Candidate("h", 3, 1)}).size() == 2);
  CHECK(store.AddUnit({}, 4, {}, {Candidate("g", 4, 0)}).empty());
  const auto now = store.AddUnit({}, 1, {}, {Candidate("g", 1, 7), Candidate("k", 1, 8)});
  REQUIRE(now.size() == 2);
  CHECK(now[0] == Candidate("g", 1, 7));
  CHECK(now[1] == Candidate("k", 1, 8));
}

TEST_CASE("store: a finding that is replaced must be finished anew") {
  const Scratch scratch;
  Store store(scratch / "a.store", Identity());
  const Finding later = Candidate("g", 5, 1), first = Candidate("g", 2, 8);
  store.AddUnit({}, 5, {}, {later});
  store.Finish(Finished(later));
  CHECK(store.Findings() == std::vector{Finished(later)});

  store.AddUnit({}, 2, {}, {first});
  CHECK(store.Findings() == std::vector{first});

  store.Finish(Finished(later));  // by somebody who does not know of the other
  CHECK(store.Findings() == std::vector{first});
  store.Finish(Finished(first));
  CHECK(store.Findings() == std::vector{Finished(first)});
  store.Finish(Finished(Candidate("unknown", 1, 1)));
  CHECK(store.Findings().size() == 1);
}

TEST_CASE("store: findings are listed by signature") {
  const Scratch scratch;
  Store store(scratch / "a.store", Identity());
  store.AddUnit({}, 4, {}, {Candidate("b", 4, 1, 3), Candidate("a", 4, 0, 3)});
  store.AddUnit({}, 9, {}, {Candidate("d", 9, 0, 2)});
  store.AddUnit({}, 3, {}, {Candidate("c", 3, 5, 3)});
  const auto signatures = [](const std::vector<Finding>& findings) {
    std::string all;
    for (const Finding& finding : findings) all += finding.signature;
    return all;
  };
  CHECK(signatures(store.Findings()) == "abcd");
}

TEST_CASE("store: text with quotes, NUL bytes and any encoding comes back as it was") {
  const Scratch scratch;
  Store store(scratch / "a.store", Identity());
  Finding finding = Candidate("it's \"g\"; DROP TABLE findings --", 1, 1);
  finding.problem = std::string("a\0b\xff \xc3\xa4\n", 8);
  store.AddUnit({}, 1, {}, {finding});
  CHECK(store.Findings() == std::vector{finding});
}

// ---- Merging ---------------------------------------------------------------------------------

// A store of the units from `from` to `to`, counted within the shard.
fs::path MakeStore(const Scratch& scratch, const std::string& name, const Shard& shard, std::int64_t from,
                   std::int64_t to) {
  Store store(scratch / name, Identity());
  AddRange(store, shard, from, to);
  return scratch / name;
}

fs::path Merged(const Scratch& scratch, const std::string& name, const std::vector<fs::path>& stores) {
  Store store(scratch / name, Identity());
  for (const fs::path& other : stores) store.MergeFrom(Store::OpenToRead(other));
  return scratch / name;
}

TEST_CASE("merge: shards make the whole, in any order and as often as you like", "[slow]") {
  const Scratch scratch;
  const fs::path a = MakeStore(scratch, "a", {0, 3}, 0, kBlock + 40);
  const fs::path b = MakeStore(scratch, "b", {1, 3}, 0, kBlock);
  const fs::path c = MakeStore(scratch, "c", {2, 3}, 0, 17);
  const std::string content = Content(Merged(scratch, "abc", {a, b, c}));
  CHECK((Content(Merged(scratch, "cba", {c, b, a})) == content));
  CHECK((Content(Merged(scratch, "bacbb", {b, a, c, b, b})) == content));
  const fs::path ab = Merged(scratch, "ab", {a, b}), bc = Merged(scratch, "bc", {b, c});
  CHECK((Content(Merged(scratch, "ab+bc", {ab, bc})) == content));

  const Store store = Store::OpenToRead(scratch / "abc");
  CHECK(store.Units().Count() == 2 * kBlock + 57);
  Record total;
  for (const fs::path& part : {a, b, c}) total.Merge(Store::OpenToRead(part).Total());
  CHECK(store.Total() == total);
}

TEST_CASE("merge: a store with itself stays as it is", "[slow]") {
  const Scratch scratch;
  const fs::path a = MakeStore(scratch, "a", {}, 0, kBlock + 5);
  const std::string before = Content(a);
  Store store(a, Identity());
  store.MergeFrom(Store::OpenToRead(a));
  CHECK((Content(a) == before));
}

TEST_CASE("merge: a partial and a complete copy of a block make the complete one, either way", "[slow]") {
  const Scratch scratch;
  const fs::path whole = MakeStore(scratch, "whole", {}, 0, kBlock);
  const fs::path part = MakeStore(scratch, "part", {}, 100, 300);
  const std::string content = Content(whole);
  CHECK((Content(Merged(scratch, "1", {part, whole})) == content));
  CHECK((Content(Merged(scratch, "2", {whole, part})) == content));
}

TEST_CASE("merge: two halves of a block close it", "[slow]") {
  const Scratch scratch;
  const fs::path left = MakeStore(scratch, "left", {1, 2}, 0, 600);
  const fs::path right = MakeStore(scratch, "right", {1, 2}, 500, kBlock);  // 100 units are in both
  const std::string content = Content(MakeStore(scratch, "whole", {1, 2}, 0, kBlock));
  CHECK((Content(Merged(scratch, "1", {left, right})) == content));
  CHECK((Content(Merged(scratch, "2", {right, left})) == content));
}

TEST_CASE("merge: two copies of a block or unit that differ are an internal error that names it", "[slow]") {
  const Scratch scratch;
  const Shard shard{1, 2};
  const auto with_other_unit = [&](const std::string& name, std::int64_t units, std::int64_t other) {
    Store store(scratch / name, Identity());
    for (std::int64_t k = 0; k < units; ++k) {
      const std::int64_t unit = UnitOf(shard, k);
      store.AddUnit(shard, unit, RecordOf(k == other ? unit + 1 : unit), CandidatesOf(unit));
    }
    return scratch / name;
  };
  const fs::path whole = MakeStore(scratch, "whole", shard, 0, 2 * kBlock);
  const fs::path other_block = with_other_unit("other-block", 2 * kBlock, kBlock + 7);
  const fs::path part = MakeStore(scratch, "part", shard, 0, 20);
  const fs::path other_unit = with_other_unit("other-unit", 20, 7);
  const auto refused = [](const fs::path& into, const fs::path& from, const std::string& name) {
    const std::string before = Content(into);
    Store store(into, Identity());
    CHECK_THROWS_AS(store.MergeFrom(Store::OpenToRead(from)), InternalError);
    CHECK_THROWS_WITH(store.MergeFrom(Store::OpenToRead(from)), Contains(name));
    CHECK((Content(into) == before));
  };
  refused(whole, other_block, "block 1 of shard 1/2");
  refused(other_block, whole, "block 1 of shard 1/2");
  refused(part, other_unit, "unit 15");
  refused(other_unit, part, "unit 15");
}

TEST_CASE("merge: a unit that both stores counted for different shards is refused, either way", "[slow]") {
  const Scratch scratch;
  const std::vector<std::pair<std::string, fs::path>> unsharded = {
      {"block", MakeStore(scratch, "block", {}, 0, kBlock)}, {"units", MakeStore(scratch, "units", {}, 0, 9)}};
  const std::vector<std::pair<std::string, fs::path>> sharded = {
      {"half block", MakeStore(scratch, "half block", {0, 2}, 0, kBlock)},
      {"half units", MakeStore(scratch, "half units", {0, 2}, 0, 9)}};
  const auto refused = [](const fs::path& into, const fs::path& from) {
    const std::string before = Content(into);
    Store store(into, Identity());
    CHECK_THROWS_AS(store.MergeFrom(Store::OpenToRead(from)), InputError);
    CHECK((Content(into) == before));
  };
  for (const auto& [whole_name, whole] : unsharded) {
    for (const auto& [half_name, half] : sharded) {
      CAPTURE(whole_name, half_name);
      refused(whole, half);
      refused(half, whole);
    }
  }
}

TEST_CASE("merge: stores of different campaigns are refused") {
  const Scratch scratch;
  CampaignIdentity identity = Identity();
  identity.seed = 8;
  { Store store(scratch / "other", identity); }
  Store store(scratch / "a", Identity());
  const auto merge = [&] { store.MergeFrom(Store::OpenToRead(scratch / "other")); };
  CHECK_THROWS_AS(merge(), InputError);
  CHECK_THROWS_WITH(merge(), Contains("seed 8, not 7"));
}

TEST_CASE("store: remarks make no other campaign, a search's last ones stay, and of a merge the first") {
  const Scratch scratch;
  const auto remarks_in = [&scratch](const char* name) {
    return Store::OpenToRead(scratch / name).identity().remarks;
  };
  CampaignIdentity told = Identity();
  for (const char* remarks : {R"({"why":"one"})", "", R"({"why":"two"})", ""}) {
    told.remarks = remarks;
    CHECK(told == Identity());
    const Store store(scratch / "told", told);
  }
  CHECK(remarks_in("told") == R"({"why":"two"})");
  Merged(scratch, "plain", {scratch / "told"});
  CHECK(remarks_in("plain") == R"({"why":"two"})");
  told.remarks = R"({"why":"three"})";
  { Store(scratch / "other", told).MergeFrom(Store::OpenToRead(scratch / "told")); }
  CHECK(remarks_in("other") == R"({"why":"three"})");
  { Store(scratch / "saved", Identity()).Salvage(scratch / "other"); }
  CHECK(remarks_in("saved") == R"({"why":"three"})");
  const Store untold(scratch / "untold", Identity());
  CHECK(remarks_in("untold").empty());
}

TEST_CASE("merge: the smaller representative stays, and of two copies the finished one") {
  const Scratch scratch;
  const auto make = [&scratch](const std::string& name, std::int64_t unit, const Finding& finding) {
    Store store(scratch / name, Identity());
    store.AddUnit({}, unit, RecordOf(unit), {finding});
    if (finding.done) store.Finish(finding);
    return scratch / name;
  };
  const Finding first = Candidate("g", 2, 5), later = Candidate("g", 4, 0);
  const fs::path open = make("open", 2, first), done = make("done", 2, Finished(first)),
                 other = make("other", 4, Finished(later));
  const auto finding = [&](const std::string& name, const std::vector<fs::path>& stores) {
    return Store::OpenToRead(Merged(scratch, name, stores)).Findings().at(0);
  };
  CHECK(finding("1", {open, other}) == first);
  CHECK(finding("2", {other, open}) == first);
  CHECK(finding("3", {open, done, other}) == Finished(first));
  CHECK(finding("4", {other, done, open}) == Finished(first));
}

// ---- Files that are no stores ----------------------------------------------------------------

TEST_CASE("store: what is no store is refused by name and left as it is") {
  const Scratch scratch;
  const auto refused_to_read = [](const fs::path& file) {
    CHECK_THROWS_AS(Store::OpenToRead(file), InputError);
    CHECK_THROWS_WITH(Store::OpenToRead(file), Contains(file.string()));
  };
  const auto refused_to_write = [](const fs::path& file) {
    CHECK_THROWS_AS(Store(file, Identity()), InputError);
    CHECK_THROWS_WITH(Store(file, Identity()), Contains(file.string()));
  };
  SECTION("a file that does not exist is not made by reading") {
    refused_to_read(scratch / "none.store");
    CHECK_FALSE(fs::exists(scratch / "none.store"));
  }
  SECTION("a file of no bytes, or of one") {
    for (const std::string text : {"", "x"}) {
      WriteFile(scratch / "short", text);
      refused_to_read(scratch / "short");
      refused_to_write(scratch / "short");
      CHECK(fs::file_size(scratch / "short") == text.size());
    }
  }
  SECTION("a text file") {
    const std::string text = "{\"format\": \"stiction-problem\"}" + std::string(2000, ' ');
    WriteFile(scratch / "text", text);
    refused_to_read(scratch / "text");
    refused_to_write(scratch / "text");
    std::ifstream in(scratch / "text");
    CHECK(std::string(std::istreambuf_iterator<char>(in), {}) == text);
  }
  SECTION("a directory") {
    refused_to_read(scratch / "");
    refused_to_write(scratch / "");
  }
  SECTION("a path that leads nowhere") {
    refused_to_write(scratch / "no/such/directory.store");
    WriteFile(scratch / "file", "x");
    refused_to_write(scratch / "file/a.store");
    refused_to_write("/proc/stiction.store");
  }
  SECTION("a database of somebody else") {
    const fs::path file = scratch / "places.sqlite";
    sqlite3* db = nullptr;
    REQUIRE(sqlite3_open(file.c_str(), &db) == SQLITE_OK);
    REQUIRE(sqlite3_exec(db, "CREATE TABLE places (x); INSERT INTO places VALUES (1)", nullptr, nullptr,
                         nullptr) == SQLITE_OK);
    refused_to_read(file);
    refused_to_write(file);
    std::string tables;
    const auto take = [](void* out, int, char** values, char**) {
      *static_cast<std::string*>(out) += values[0];
      return 0;
    };
    sqlite3_exec(db, "SELECT name FROM sqlite_master; PRAGMA journal_mode", take, &tables, nullptr);
    CHECK(tables == "placesdelete");
    sqlite3_close(db);
  }
  SECTION("a store of another version") {
    const fs::path file = scratch / "a.store";
    { Store store(file, Identity()); }
    Execute(file, "UPDATE campaign SET value = '1' WHERE key = 'version'");
    refused_to_read(file);
    refused_to_write(file);
    CHECK_THROWS_WITH(Store::OpenToRead(file),
                      Contains("found format stiction-store version 1, expected stiction-store version 4") &&
                          Contains("of an older stiction") && Contains("search anew with --store NEW_FILE"));
    Execute(file, "UPDATE campaign SET value = '5' WHERE key = 'version'");
    CHECK_THROWS_WITH(Store::OpenToRead(file), Contains("of a newer stiction"));
    Execute(file, "UPDATE campaign SET value = '4' WHERE key = 'version'");
    Store::OpenToRead(file);
    Execute(file, "UPDATE campaign SET value = '8' WHERE key = 'seed'");
    CHECK_THROWS_WITH(Store::OpenToRead(file), Contains("campaign: found content of SHA-256"));
  }
}

// ---- Damage ----------------------------------------------------------------------------------

// A store with a closed block, open units, findings that are finished and not, and elites.
fs::path MakeFullStore(const Scratch& scratch, const std::string& name) {
  Store store(scratch / name, Identity());
  AddRange(store, {}, 0, kBlock + 3);
  store.AddUnit({}, kBlock + 3, RecordOf(kBlock + 3), {}, "elites");
  store.Finish(Finished(store.Findings().front()), {{"a build"}, {.finishing = 7}});
  return scratch / name;
}

TEST_CASE("store: a row that is not as it was written is named, and nothing is read", "[slow]") {
  const Scratch scratch;
  const fs::path file = MakeFullStore(scratch, "a.store");
  const std::vector<std::pair<std::string, std::string>> damages = {
      {"UPDATE blocks SET record = replace(record, '1', '2')",
       "block 0 of shard 0/1: found content of SHA-256"},
      {"UPDATE blocks SET block = 1", "block 1 of shard 0/1"},
      {"UPDATE units SET record = record || ' ' WHERE unit = 1025", "unit 1025"},
      {"UPDATE units SET unit = 2000 WHERE unit = 1025", "unit 2000"},
      {"UPDATE findings SET contacts = 3 WHERE signature = 'all'", "finding all"},
      {"UPDATE findings SET facts = 'x' WHERE signature = 'group-1'", "finding group-1"},
      {"UPDATE findings SET seal = 'none' WHERE signature = 'group-1'", "expected none"},
      {"UPDATE elites SET elites = 'elitez'", "elites of unit 1027"},
      {"UPDATE work SET time = replace(time, '0', '1') WHERE unit = -1", "work of block 0 of shard 0/1"}};
  for (const auto& [sql, name] : damages) {
    CAPTURE(sql);
    fs::copy_file(file, scratch / "b.store", fs::copy_options::overwrite_existing);
    Execute(scratch / "b.store", sql.c_str());
    CHECK_THROWS_AS(Store::OpenToRead(scratch / "b.store"), InputError);
    CHECK_THROWS_WITH(Store::OpenToRead(scratch / "b.store"), Contains(name) && Contains("--salvage NEW_FILE"));
    CHECK_THROWS_WITH(Store(scratch / "b.store", Identity()), Contains(name));
    Store into(scratch / fmt::format("{}.store", std::hash<std::string>()(sql)), Identity());
    CHECK_THROWS_WITH(into.MergeFrom(Store::OpenToRead(scratch / "b.store")), Contains(name));
    CHECK(into.Units().Count() == 0);
  }
}

TEST_CASE("store: pages that do not fit together are refused, though every row is as it was written",
          "[slow]") {
  const Scratch scratch;
  const fs::path file = MakeFullStore(scratch, "a.store");
  Execute(file, "PRAGMA wal_checkpoint(TRUNCATE)");
  std::fstream pages(file, std::ios::in | std::ios::out | std::ios::binary);
  constexpr int kPage = 4096, kCount = 28;  // the number of pages stands there, its most significant byte first
  const std::uint32_t count = static_cast<std::uint32_t>(fs::file_size(file) / kPage) + 1;
  pages.seekp(kCount);
  for (const int shift : {24, 16, 8, 0}) pages.put(static_cast<char>(count >> shift));
  pages.seekp(0, std::ios::end);
  pages << std::string(kPage, '\0');  // of which nothing says what it is
  pages.close();
  CHECK_THROWS_WITH(Store::OpenToRead(file), Contains("pages that do not fit together"));
}

TEST_CASE("store: of two that make one at the same time both work on the same", "[slow]") {
  const Scratch scratch;
  for (int k = 0; k < 20; ++k) {
    const fs::path file = scratch / fmt::format("{}.store", k);
    std::barrier start(2);
    std::array<std::string, 2> errors;
    const auto work = [&](int shard) {
      start.arrive_and_wait();
      try {
        Store store(file, Identity());
        store.AddUnit({shard, 2}, shard, RecordOf(shard), {});
      } catch (const std::exception& error) {
        errors[static_cast<std::size_t>(shard)] = error.what();
      }
    };
    std::thread other(work, 1);
    work(0);
    other.join();
    CHECK(errors == std::array<std::string, 2>{});
    CHECK(Store::OpenToRead(file).Units().Count() == 2);
  }
}

TEST_CASE("store: of one that ends too early salvage saves rows", "[slow]") {
  const Scratch scratch;
  const fs::path file = MakeFullStore(scratch, "a.store");
  Execute(file, "PRAGMA wal_checkpoint(TRUNCATE)");
  const auto whole = Store::OpenToRead(file).Units().Count();
  fs::resize_file(file, fs::file_size(file) - 4096);
  CHECK_THROWS_WITH(Store::OpenToRead(file), Contains("--salvage NEW_FILE"));
  Store rest(scratch / "rest", Identity());
  rest.Salvage(file);
  CHECK(rest.Units().Count() + static_cast<std::int64_t>(rest.Findings().size()) > 0);
  CHECK(rest.Units().Count() <= whole);
}

TEST_CASE("store: salvage saves what is sound and names what it leaves out", "[slow]") {
  const Scratch scratch;
  const fs::path file = MakeFullStore(scratch, "a.store");
  const std::string whole = Content(file);
  const auto salvaged = [&](const std::string& name) {
    Store store(scratch / name, Identity());
    return store.Salvage(file);
  };
  CHECK(salvaged("whole").empty());
  CHECK((Content(scratch / "whole") == whole));
  Execute(file, "UPDATE units SET record = record || ' ' WHERE unit = 1025");
  Execute(file, "UPDATE findings SET policy = 'x' WHERE signature = 'group-2'");
  const std::vector<std::string> left_out = salvaged("rest");
  REQUIRE(left_out.size() == 2);
  CHECK_THAT(left_out[0], Contains("unit 1025"));
  CHECK_THAT(left_out[1], Contains("finding group-2"));
  Store rest(scratch / "rest", Identity());
  CHECK(rest.Units().Count() == kBlock + 3);
  CHECK_FALSE(rest.Units().Contains(1025));
  CHECK(rest.Findings().size() == 5);
  CHECK(BlockCount(rest) == 1);
  Add(rest, 1025);  // what was left out can be run again
  CHECK(rest.Total() == Store::OpenToRead(scratch / "whole").Total());

  Execute(file, "UPDATE campaign SET value = 'x' WHERE key = 'definition'");
  CHECK_THROWS_WITH(Store::IdentityIn(file), Contains("what it is of cannot be told"));
}

TEST_CASE("store: salvage leaves out what contradicts what is there") {
  const Scratch scratch;
  Store store(scratch / "a.store", Identity()), other(scratch / "b.store", Identity());
  store.AddUnit({}, 3, RecordOf(3), {});
  other.AddUnit({}, 3, RecordOf(4), {});
  other.AddUnit({}, 4, RecordOf(4), {});
  const auto left_out = store.Salvage(scratch / "b.store");
  REQUIRE(left_out.size() == 1);
  CHECK_THAT(left_out[0], Contains("unit 3"));
  CHECK(store.Units().Count() == 2);
}

TEST_CASE("store: a record with a key that none has is refused, sealed or not") {
  const std::string record = Serialize(RecordOf(3));
  const auto with = [&record](const std::string& from, const std::string& to) {
    std::string text = record;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  CHECK_THROWS_WITH(ParseRecord(with("\"audited\"", "\"audits\":0,\"audited\"")), Contains("audits"));
  CHECK_THROWS_WITH(ParseRecord(with("\"drives\"", "\"drive\":0,\"drives\"")), Contains("drive"));
  CHECK_THROWS_WITH(ParseRecord(with("\"compared\"", "\"more\":0,\"compared\"")), Contains("more"));
  CHECK_THROWS_WITH(ParseRecord(with("{\"tallies\"", "{\"x\":0,\"tallies\"")), Contains("x"));
  Json twice = ParseJson(record, "record");
  twice["tallies"].push_back(twice["tallies"][0]);
  CHECK_THROWS_WITH(ParseRecord(twice.dump()), Contains("once"));
  twice = ParseJson(record, "record");
  twice["agreement"].push_back(twice["agreement"][0]);
  CHECK_THROWS_WITH(ParseRecord(twice.dump()), Contains("once"));
  twice = ParseJson(record, "record");
  twice["agreement"][0]["words"].push_back(twice["agreement"][0]["words"][0]);
  CHECK_THROWS_WITH(ParseRecord(twice.dump()), Contains("once"));
}

// ---- Work ------------------------------------------------------------------------------------

Work WorkOf(const std::string& build, std::int64_t exact) { return {{build}, {.doubles = 1, .exact = exact}}; }

TEST_CASE("work: a block has the builds and the time of its units, and of finishing their findings", "[slow]") {
  const Scratch scratch;
  const Shard shard{1, 2};
  Store store(scratch / "a.store", Identity());
  for (std::int64_t k = 0; k < kBlock; ++k) {
    if (k == 1) store.Finish(Finished(Candidate("all", 1, 3)), {{"finisher"}, {.finishing = 5}});
    const std::int64_t unit = UnitOf(shard, k);
    store.AddUnit(shard, unit, RecordOf(unit), CandidatesOf(unit), {}, WorkOf(k < 3 ? "first" : "second", 2));
  }
  REQUIRE(BlockCount(store) == 1);
  Work expected{{"first", "second", "finisher"}, {.doubles = kBlock, .exact = 2 * kBlock, .finishing = 5}};
  CHECK(store.TotalWork() == expected);
  store.AddWork(1, {{"later"}, {.finishing = 1}});  // in vain
  store.Finish(Finished(Candidate("all", 1, 3)), {{"later"}, {.finishing = 5}});
  expected.builds.insert("later");
  expected.time.finishing += 6;
  CHECK(store.TotalWork() == expected);
  CHECK(Store::OpenToRead(scratch / "a.store").TotalWork() == expected);
}

TEST_CASE("work: less time than none, by a clock that was set back, is none") {
  const Scratch scratch;
  Store store(scratch / "a.store", Identity());
  store.AddUnit({}, 0, RecordOf(0), CandidatesOf(0), {}, {{"build"}, {.doubles = -7, .exact = 3}});
  const Work expected{{"build"}, {.exact = 3}};
  CHECK(store.TotalWork() == expected);
  CHECK(Store::OpenToRead(scratch / "a.store").TotalWork() == expected);
}

TEST_CASE("work: time is that of the clock where no processor's can be read, and never more") {
  const double before = ReadSeconds(CLOCK_MONOTONIC);
  const pid_t child = fork();
  if (child == 0) _exit(0);
  clockid_t gone = 0;
  REQUIRE(clock_getcpuclockid(child, &gone) == 0);
  const Stopwatch of_child(gone), of_clock(CLOCK_MONOTONIC), of_thread;
  waitpid(child, nullptr, 0);
  CHECK(std::isinf(ReadSeconds(gone)));
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const double of_none = of_child.Seconds(), clock = of_clock.Seconds(), thread = of_thread.Seconds();
  const double all = ReadSeconds(CLOCK_MONOTONIC) - before;
  CHECK(of_none >= 0.02);
  CHECK(of_none <= all);
  CHECK(clock >= 0.02);
  CHECK(clock <= all);
  CHECK(thread <= all);
}

TEST_CASE("work: copies of a unit or block with other work are the same unit or block", "[slow]") {
  const Scratch scratch;
  const auto make = [&](const std::string& name, std::int64_t units, const std::string& build,
                        std::int64_t time) {
    Store store(scratch / name, Identity());
    for (std::int64_t unit = 0; unit < units; ++unit)
      store.AddUnit({}, unit, RecordOf(unit), CandidatesOf(unit), {}, WorkOf(build, time));
    return scratch / name;
  };
  const fs::path a = make("a", kBlock + 2, "here", 5), b = make("b", kBlock + 2, "there", 9);
  const Work expected{{"here", "there"}, {.doubles = kBlock + 2, .exact = 9 * (kBlock + 2)}};
  CHECK(Store::OpenToRead(Merged(scratch, "ab", {a, b})).TotalWork() == expected);
  CHECK(Store::OpenToRead(Merged(scratch, "ba", {b, a, b, a})).TotalWork() == expected);
  CHECK((Content(scratch / "ab") == Content(a)));
  const fs::path part = make("part", 10, "elsewhere", 100);  // of a block that is whole in the other
  CHECK(Store::OpenToRead(Merged(scratch, "1", {part, a})).TotalWork() == Store::OpenToRead(a).TotalWork());
  CHECK(Store::OpenToRead(Merged(scratch, "2", {a, part})).TotalWork() == Store::OpenToRead(a).TotalWork());
}

TEST_CASE("work: machines are kept beside builds, and no part of what is compared", "[slow]") {
  const Scratch scratch;
  const auto make = [&](const std::string& name, const std::string& machine) {
    Store store(scratch / name, Identity());
    Work work = WorkOf("build", 1);
    if (!machine.empty()) work.machines.insert(machine);
    for (std::int64_t unit = 0; unit < kBlock + 1; ++unit)
      store.AddUnit({}, unit, RecordOf(unit), CandidatesOf(unit), {}, work);
    return scratch / name;
  };
  const fs::path a = make("a", "one"), b = make("b", "another"), old = make("old", "");
  CHECK(Store::OpenToRead(a).TotalWork().machines == std::set<std::string>{"one"});
  CHECK(Store::OpenToRead(old).TotalWork().machines.empty());
  CHECK(Store::OpenToRead(old).TotalWork().builds == std::set<std::string>{"build"});
  CHECK((Content(Merged(scratch, "ab", {a, b, old})) == Content(a)));
  CHECK((Content(Merged(scratch, "ba", {old, b, a, b})) == Content(a)));
  CHECK(Store::OpenToRead(scratch / "ab").TotalWork().machines == std::set<std::string>{"another", "one"});
  CHECK(Store::OpenToRead(scratch / "ba").TotalWork() == Store::OpenToRead(scratch / "ab").TotalWork());
}

TEST_CASE("work: a list of builds alone, as stores without machines have it, is read") {
  const Scratch scratch;
  const fs::path file = scratch / "old.store";
  {
    Store store(file, Identity());
    store.AddUnit({}, 0, RecordOf(0), CandidatesOf(0), {}, WorkOf("build", 1));
  }
  sqlite3* db = nullptr;
  REQUIRE(sqlite3_open(file.c_str(), &db) == SQLITE_OK);
  {
    Statement row(db, "SELECT builds FROM work");
    REQUIRE(row.Step());
    CHECK(row.Text(0) == "[\"build\"]");
  }
  sqlite3_close(db);
}

TEST_CASE("machine: the processor's name, and no name of the host") {
  CHECK(ProcessorModel("processor\t: 0\nmodel\t\t: 85\nmodel name\t: Xeon 8 @ 2 GHz\nmodel name\t: b") ==
        "Xeon 8 @ 2 GHz");
  CHECK(ProcessorModel("model name\t:\n").empty());
  CHECK(ProcessorModel("processor: 0\nBogoMIPS: 1").empty());
  CHECK_THAT(MachineText(), Matches("(.+, )?\\d+ cores?, \\d+ GiB, Linux \\S+ \\S+"));
}

// ---- A running search ------------------------------------------------------------------------

TEST_CASE("store: a running search can be read, and each reader sees one state", "[slow]") {
  const Scratch scratch;
  const fs::path file = scratch / "a.store";
  Store writer(file, Identity());
  AddRange(writer, {}, 0, kBlock - 1);
  const Store early = Store::OpenToRead(file);
  CHECK(early.Units().Count() == kBlock - 1);
  Add(writer, kBlock - 1);  // closes the block between two questions of the reader
  CHECK(early.Units().Count() == kBlock - 1);
  CHECK(early.Total() == SumOf(kBlock - 1));
  CHECK(early.Blocks().empty());

  const Store late = Store::OpenToRead(file);
  CHECK(late.Total() == SumOf(kBlock));
  CHECK(late.Units().Count() == kBlock);
  CHECK(late.identity() == Identity());
}

TEST_CASE("store: two processes can add units of their shards to one file") {
  const Scratch scratch;
  const fs::path file = scratch / "a.store";
  Store even(file, Identity()), odd(file, Identity());
  for (std::int64_t k = 0; k < 30; ++k) {
    Add(even, 2 * k, {0, 2});
    Add(odd, 2 * k + 1, {1, 2});
  }
  CHECK(even.Total() == SumOf(60));
  CHECK(odd.Total() == SumOf(60));
}

// ---- Records ---------------------------------------------------------------------------------

// Every counter different.
Tally FullTally() {
  Tally tally;
  std::int64_t next = 1;
  tally.problems = next++;
  for (auto& count : tally.outcomes) count = next++;
  for (auto& row : tally.verdicts) {
    for (auto& count : row) count = next++;
  }
  tally.audited = next++;
  tally.misjudged = next++;
  tally.wrong = next++;
  tally.with_zero_steps = next++;
  tally.with_give_ups = next++;
  for (Statistics* s : {&tally.sums, &tally.maxima}) {
    ForEachField(*s, [&next](const char*, const char*, std::int64_t& value) { value = next++; });
  }
  for (auto& count : tally.steps) count = (std::int64_t{1} << 47) + next++;
  for (const StratumKey& key : {StratumKey{"1/3", 1}, StratumKey{"1/3", 4}, StratumKey{kMixedFriction, 4}}) {
    Stratum& stratum = tally.strata[key];
    for (std::int64_t* count :
         {&stratum.problems, &stratum.steps, &stratum.zero_steps, &stratum.audited, &stratum.misjudged,
          &stratum.outcomes[0], &stratum.outcomes[5], &stratum.exact[6]})
      *count = next++;
  }
  return tally;
}

// Every counter different.
Record FullByContacts() {
  Record record;
  std::int64_t next = 1;
  for (const int contacts : {1, 7}) {
    AgreementTally& agreement = record.agreement[contacts];
    const auto fill = [&next](const char*, std::int64_t& value) { value = next++; };
    ForEachCounter(record.existence[contacts], fill);
    ForEachCounter(agreement, fill);
    agreement.words = {{1, next++}, {64, next++}};
    agreement.solutions = {{3, next++}};
    ForEachCounter(record.loops[contacts], fill);
    record.loops[contacts].by_zero_steps = {{0, next++}, {9, next++}};
  }
  return record;
}

TEST_CASE("record: existence and agreement add up by contacts, and survive as text") {
  const Record record = FullByContacts();
  CHECK(ParseRecord(Serialize(record)) == record);
  Record sum = record;
  Record other;
  other.agreement[7].words = {{2, 5}, {64, 1}};
  other.agreement[7].safe = 4;
  other.agreement[2].compared = 9;
  other.existence[7].with_ties = 3;
  sum.Merge(other);
  CHECK(sum.agreement.at(7).words ==
        std::map<int, std::int64_t>{
            {1, record.agreement.at(7).words.at(1)}, {2, 5}, {64, record.agreement.at(7).words.at(64) + 1}});
  CHECK(sum.agreement.at(7).safe == record.agreement.at(7).safe + 4);
  CHECK(sum.agreement.at(7).compared == record.agreement.at(7).compared);
  CHECK(sum.agreement.at(2).compared == 9);
  CHECK(sum.agreement.at(1) == record.agreement.at(1));
  CHECK(sum.existence.at(7).with_ties == record.existence.at(7).with_ties + 3);
  other = {};
  other.loops[7].zero_steps = 5;
  other.loops[7].by_zero_steps = {{9, 2}, {10, 1}};
  sum.Merge(other);
  CHECK(sum.loops.at(7).zero_steps == record.loops.at(7).zero_steps + 5);
  CHECK(sum.loops.at(7).by_zero_steps.at(9) == record.loops.at(7).by_zero_steps.at(9) + 2);
  CHECK(sum.loops.at(7).by_zero_steps.at(10) == 1);
  CHECK(sum.loops.at(1) == record.loops.at(1));
  CHECK(ParseRecord(Serialize(sum)) == sum);
}

TEST_CASE("record: text and back is the same, to the byte") {
  Record record;
  record.tallies[{"psd", 2, "paper"}] = FullTally();
  record.tallies[{"psd", 3, "paper"}];
  record.tallies[{"psd", 2, "ties=contacts"}] = FullTally();
  record.tallies[{"psd", 2, "paper", "complete", "exact"}].problems = 5;
  record.signatures = {{"cycle-2c", 3}, {"stall-3c \"quoted\"", 1}};
  const std::string text = Serialize(record);
  CHECK(ParseRecord(text) == record);
  CHECK(Serialize(ParseRecord(text)) == text);
  CHECK(ParseRecord(Serialize(Record{})) == Record{});
}

TEST_CASE("record: words are counted exactly up to what a sketch keeps, beyond it nearly") {
  std::uint64_t state = 1;
  const auto next = [&state] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return state ^ (state >> 29);
  };
  for (const std::size_t words : {std::size_t{0}, std::size_t{1}, WordSketch::kMost - 1, std::size_t{5000}}) {
    std::vector<std::uint64_t> hashes(words);
    for (auto& hash : hashes) hash = next();
    WordSketch whole, odd, even;
    for (std::size_t i = 0; i < words; ++i) {
      whole.Add(hashes[i]);
      whole.Add(hashes[i / 2]);
      (i % 2 == 0 ? even : odd).Add(hashes[words - 1 - i]);
    }
    even.Merge(odd);
    CHECK(even == whole);
    if (words < WordSketch::kMost) {
      CHECK(whole.IsExact());
      CHECK(whole.Count() == static_cast<double>(words));
    } else {
      CHECK_FALSE(whole.IsExact());
      CHECK(whole.Count() > 0.6 * static_cast<double>(words));  // three standard errors
      CHECK(whole.Count() < 1.4 * static_cast<double>(words));
    }
    Record record;
    record.words["cycle-3c-4d-14s"] = whole;
    CHECK(ParseRecord(Serialize(record)) == record);
  }
}

TEST_CASE("record: strata and words that none writes are refused by their place") {
  const auto with = [](auto change) {
    Json json = ParseJson(Serialize(RecordOf(9)), "record");
    change(json);
    return json.dump();
  };
  CHECK_THROWS_WITH(ParseRecord(with([](Json& r) { r["tallies"][0]["strata"][0].push_back(1); })),
                    Contains("strata[0]") && Contains("friction, rank"));
  CHECK_THROWS_WITH(ParseRecord(with([](Json& r) {
                      auto& strata = r["tallies"][0]["strata"];
                      strata.push_back(strata[0]);
                    })),
                    Contains("once"));
  CHECK_THROWS_WITH(ParseRecord(with([](Json& r) { r["words"]["cycle-3c-4d-14s"][0] = "00"; })),
                    Contains("16 hexadecimal digits"));
  CHECK_THROWS_WITH(ParseRecord(with([](Json& r) {
                      auto& hashes = r["words"]["cycle-3c-4d-14s"];
                      hashes.push_back(hashes[0]);
                    })),
                    Contains("each once"));
  CHECK_THROWS_WITH(ParseRecord(with([](Json& r) { r["loops"][0]["loop"] = 1; })), Contains("loop"));
}

TEST_CASE("record: sums are the same in any order and grouping") {
  const Record a = RecordOf(3), b = RecordOf(24), c = RecordOf(6);
  Record left = a, right = c;
  left.Merge(b);
  left.Merge(c);
  Record cb = c;
  cb.Merge(b);
  right = cb;
  right.Merge(a);
  CHECK(left == right);
  CHECK(Serialize(left) == Serialize(right));
  Record same = left;
  same.Merge({});
  CHECK(same == left);
}

TEST_CASE("tally: sums add, maxima do not, and long runs share the last bin") {
  Tally tally;
  Verdict verdict;
  for (const std::int64_t steps : {0, 5, 62, 63, 64, 100000}) {
    verdict.statistics = {};
    verdict.statistics.steps = steps;
    verdict.statistics.zero_steps = steps == 5 ? 2 : 0;
    tally.Count(verdict);
  }
  CHECK(tally.problems == 6);
  CHECK(tally.outcomes[static_cast<int>(Outcome::kSolved)] +
            tally.outcomes[static_cast<int>(Outcome::kUndecided)] ==
        6);
  CHECK(tally.with_zero_steps == 1);
  CHECK(tally.sums.steps == 100194);
  CHECK(tally.maxima.steps == 100000);
  CHECK((tally.steps[0] == 1 && tally.steps[5] == 1 && tally.steps[62] == 1 && tally.steps[63] == 3));
  Tally twice = tally;
  twice.Merge(tally);
  CHECK(twice.sums.steps == 2 * tally.sums.steps);
  CHECK(twice.maxima == tally.maxima);
  CHECK(twice.steps[63] == 6);
}

TEST_CASE("tally: a run counts once among those with zero steps, and with give-ups") {
  Tally tally;
  Verdict verdict;
  verdict.statistics.zero_steps = 5;
  verdict.statistics.give_ups = 3;
  tally.Count(verdict);
  tally.Count({});
  CHECK(tally.with_zero_steps == 1);
  CHECK(tally.with_give_ups == 1);
  CHECK(tally.sums.give_ups == 3);
}

TEST_CASE("tally: every counter is added, every maximum kept") {
  Tally tally;
  std::int64_t next = 0;
  const auto fill = [&next](auto& values) {
    for (auto& value : values) value = ++next;
  };
  fill(tally.outcomes);
  for (auto& row : tally.verdicts) fill(row);
  fill(tally.steps);
  for (std::int64_t* counter : {&tally.problems, &tally.audited, &tally.misjudged, &tally.wrong,
                                &tally.with_zero_steps, &tally.with_give_ups})
    *counter = ++next;
  ForEachField(tally.sums, [&next](const char*, const char*, std::int64_t& value) { value = ++next; });
  ForEachField(tally.maxima, [&next](const char*, const char*, std::int64_t& value) { value = ++next; });
  Tally twice = tally;
  twice.Merge(tally);
  // Every number of the text is twice what it was, but those of the maxima.
  const std::function<void(const Json&, const Json&, int)> compare = [&](const Json& sum, const Json& one,
                                                                         int factor) {
    REQUIRE(sum.size() == one.size());
    if (!one.is_structured()) {
      CHECK(sum.get<std::int64_t>() == factor * one.get<std::int64_t>());
      return;
    }
    for (const auto& [key, value] : one.items()) {
      const bool is_index = one.is_array();
      compare(is_index ? sum[std::stoul(key)] : sum.at(key), value, key == "maxima" ? 1 : factor);
    }
  };
  compare(ToJson(twice), ToJson(tally), 2);
}

// ---- Kinds -----------------------------------------------------------------------------------

TEST_CASE("kinds: a signature begins with its kind, and the grave ones come first") {
  CHECK(KindOf("safe-cycle-2c-4d-10s-00c0ffee") == kSafeCycle);
  CHECK(KindOf("disagreement-of-methods-lemke-ray-2c") == kDisagreementOfMethods);
  CHECK(KindOf("disagreement-ray-solved-3c") == "disagreement");
  CHECK(KindOf("wrong-answer-3c") == "wrong-answer");
  CHECK(KindOf("cycle-3c-4d-10s@ties=contacts") == "cycle");
  CHECK(KindOf("something else") == "something else");
  CHECK(Gravity(kSafeCycle) < Gravity(kDisagreementOfMethods));
  CHECK(Gravity(kDisagreementOfMethods) < Gravity("cycle"));
  CHECK(Gravity("cycle") == Gravity("disagreement"));
  CHECK((IsGrave(kSafeCycle) && IsGrave(kDisagreementOfMethods) && !IsGrave("cycle")));
  CHECK((IsLoopKind(kSafeCycle) && IsLoopKind("stall") && !IsLoopKind("ray")));
}

}  // namespace
}  // namespace stiction
