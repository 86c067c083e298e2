// SPDX-License-Identifier: Apache-2.0
// The report: what it writes says what the store holds, and nothing that stands in a store can break it.

#include "reports/report.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "corpus/input_error.h"
#include "corpus/intervals.h"
#include "corpus/json.h"
#include "corpus/record/counts.h"
#include "corpus/record/kinds.h"
#include "corpus/record/problem_file.h"
#include "reports/animation.h"
#include "reports/html/html.h"
#include "reports/page/page.h"
#include "reports/papers/package.h"
#include "reports/pictures/draw.h"
#include "reports/pictures/finding_picture.h"
#include "reports/tables/discovery.h"
#include "reports/tables/since.h"
#include "reports/tables/table.h"
#include "reports/text/text_report.h"
#include "scene/simulate.h"
#include "solver/problem/check.h"
#include "tests/reports/packed.h"
#include "tests/scratch.h"

namespace stiction {
namespace {

namespace fs = std::filesystem;
using testing::Scratch;

// ---- Stores to report on ----

const std::string kProblem =
    R"({"format":"stiction-problem","version":1,"name":"as-found","dimension":2,)"
    R"("contacts":[{"kind":"static","mu":"1"},{"kind":"static","mu":"1"}],)"
    R"("A":[["7","-2","-6","0"],["-2","9","-1","-7"],["-6","-1","7","3"],["0","-7","3","7"]],)"
    R"("b":["2","-1","-2","2"]})";
const std::string kSmaller =
    R"({"format":"stiction-problem","version":1,"name":"smaller","dimension":2,)"
    R"("contacts":[{"kind":"static","mu":"5/17"}],"A":[["19","-3/23"],["-3/23","1"]],"b":["-1","29"]})";
const std::string kFacts =
    R"({"found":{"contacts":2,"outcome":"cycle","start":3,"period":4,"steps":17,"grid":{"cycle":1536},"safe":false},)"
    R"("minimized":{"contacts":1,"outcome":"cycle","start":5,"period":6,"steps":21,)"
    R"("grid":{"solved":36,"cycle":1500}},"ipopt":{"outcome":"solved","starts":2}})";

const CampaignIdentity kIdentity = {
    R"({"format":"stiction-campaign","version":1,"generators":["integers","psd"],)"
    R"("contacts":[1,2],"mu":["1/2","5"],"unit_problems":10000})",
    4711, R"(["paper","scan=highest"])"};

Finding PendingFinding(const std::string& signature, std::int64_t unit) {
  Finding finding;
  finding.signature = signature;
  finding.kind = "cycle";
  finding.unit = unit;
  finding.index = 77;
  finding.generator = "integers";
  finding.contacts = 2;
  finding.policy = "paper";
  finding.inexact_outcome = "cycle";
  finding.exact_outcome = "cycle";
  finding.problem = kProblem;
  return finding;
}

Finding Finished(Finding finding) {
  finding.done = true;
  finding.certificate = R"({"certificate":"of the original"})";
  finding.minimized = kSmaller;
  finding.minimized_certificate = R"({"certificate":"of the minimized"})";
  finding.existence = R"({"existence":"of the original"})";
  finding.minimized_existence = R"({"existence":"of the minimized"})";
  finding.facts = kFacts;
  return finding;
}

// Every counter of it has a value of its own, of at most five digits if the seed is small.
Tally SampleTally(std::int64_t seed) {
  Tally tally;
  std::int64_t next = seed;
  const auto fill = [&next](auto& values) {
    for (auto& value : values) value = ++next;
  };
  tally.problems = 1000000 + seed;
  fill(tally.outcomes);
  for (auto& row : tally.verdicts) fill(row);
  for (std::int64_t* counter :
       {&tally.audited, &tally.misjudged, &tally.wrong, &tally.with_zero_steps, &tally.with_give_ups}) {
    *counter = ++next;
  }
  ForEachField(tally.sums, [&next](const char*, const char*, std::int64_t& value) { value = ++next; });
  ForEachField(tally.maxima, [&next](const char*, const char*, std::int64_t& value) { value = ++next; });
  fill(tally.steps);
  tally.verdicts[3][4] = 0;
  tally.steps[7] = 0;
  return tally;
}

// Likewise.
Record SampleByContacts() {
  Record record;
  std::int64_t next = 70000;
  for (const int contacts : {2, 3}) {
    AgreementTally& agreement = record.agreement[contacts];
    const auto fill = [&next](const char*, std::int64_t& value) { value = ++next; };
    ForEachCounter(record.existence[contacts], fill);
    ForEachCounter(agreement, fill);
    agreement.words = {{1, ++next}, {4 * contacts, ++next}};
    agreement.solutions = {{3, ++next}};
  }
  return record;
}

const std::string kDone = "cycle-2c-4d-10s-00c0ffee00c0ffee";
const std::string kPending = "cycle-2c-4d-12s-0123456789abcdef@give-up=second,ties=contacts";
const std::string kCounted = "disagreement-ray-solved-3c";

Record SampleRecord() {
  Record record = SampleByContacts();
  record.tallies[{"integers", 2, "paper"}] = SampleTally(100);
  record.tallies[{"psd", 3, "scan=highest,ties=contacts"}] = SampleTally(5000);
  record.signatures = {{kDone, 1234}, {kPending, 5}, {kCounted, 6}};
  std::int64_t next = 1;
  for (auto& [key, tally] : record.tallies) {
    for (const StratumKey& stratum_key : {StratumKey{"1/2", 3}, StratumKey{kMixedFriction, 4}}) {
      Stratum& stratum = tally.strata[stratum_key];
      for (std::int64_t* count : {&stratum.problems, &stratum.steps, &stratum.zero_steps, &stratum.audited,
                                  &stratum.misjudged, &stratum.outcomes[0], &stratum.exact[1]})
        *count = next++;
    }
  }
  for (const int contacts : {2, 3}) {
    ForEachCounter(record.loops[contacts], [&next](const char*, std::int64_t& value) { value = next++; });
    record.loops[contacts].by_zero_steps = {{2, next++}, {5, next++}};
  }
  record.words[kCounted].Add(5);
  record.words[kCounted].Add(6);
  return record;
}

Store SampleStore(const fs::path& file) {
  Store store(file, kIdentity);
  store.AddUnit({}, 0, SampleRecord(), {PendingFinding(kDone, 0), PendingFinding(kPending, 0)});
  store.Finish(Finished(PendingFinding(kDone, 0)));
  return store;
}

// ---- Reading what was written ----

using Row = std::map<std::string, std::string>;

std::vector<std::vector<std::string>> ParseCsv(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> row(1);
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      row.back() += text[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      row.emplace_back();
    } else if (!quoted && c == '\r' && i + 1 < text.size() && text[i + 1] == '\n') {
      rows.push_back(row);
      row.assign(1, "");
      ++i;
    } else {
      row.back() += c;
    }
  }
  REQUIRE_FALSE(quoted);
  REQUIRE(row == std::vector<std::string>(1));  // the last line ends, too
  return rows;
}

std::vector<Row> ReadTable(const fs::path& file) {
  const auto lines = ParseCsv(ReadText(file));
  REQUIRE_FALSE(lines.empty());
  std::vector<Row> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    REQUIRE(lines[i].size() == lines[0].size());
    Row& row = rows.emplace_back();
    for (std::size_t k = 0; k < lines[i].size(); ++k) row[lines[0][k]] = lines[i][k];
    REQUIRE(row.size() == lines[0].size());  // no column twice
  }
  return rows;
}

std::vector<Row> RowsOf(const std::vector<Row>& table, const TallyKey& key) {
  std::vector<Row> rows;
  for (const Row& row : table) {
    const TallyKey found{row.at("generator"), std::stoi(row.at("contacts")), row.at("policy"), row.at("method"),
                         row.at("arithmetic")};
    if (found == key) rows.push_back(row);
  }
  return rows;
}

Row FindingRow(const fs::path& report, const std::string& signature) {
  for (const Row& row : ReadTable(report / "findings.csv")) {
    if (row.at("signature") == signature) return row;
  }
  FAIL("no row for " << signature);
  return {};
}

std::map<std::string, std::string> Contents(const fs::path& directory) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    if (entry.is_regular_file())
      contents[fs::relative(entry.path(), directory).string()] = ReadText(entry.path());
  }
  return contents;
}

bool Has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::vector<std::string> Matches(const std::string& text, const std::string& pattern) {
  std::vector<std::string> found;
  const std::regex regex(pattern);
  for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match) {
    found.push_back((*match)[1]);
  }
  return found;
}

// What stands between two marks, the first time.
std::string Between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  REQUIRE(from != std::string::npos);
  const std::size_t start = from + begin.size(), to = text.find(end, start);
  REQUIRE(to != std::string::npos);
  return text.substr(start, to - start);
}

const std::string kLinesBegin = "<script type=\"text/plain\" id=\"lines\">";
const std::string kDataBegin = "<script type=\"application/json\" id=\"data\">";

Json DataOf(const std::string& page) { return ParseJson(Between(page, kDataBegin, "</script>"), "data"); }

// Of the page of findings.
Json ListedIn(const std::string& page) {
  std::istringstream lines(Unpacked(Between(page, "id=\"lines\">", "</script>")));
  Json listed = Json::array();
  for (std::string line; std::getline(lines, line);) listed.push_back(ParseJson(line, "a finding"));
  return listed;
}

// What the page says without its script, its style sheet, its data and its notices.
std::string TextOf(std::string page) {
  for (const auto& [begin, end] :
       std::initializer_list<std::pair<std::string, std::string>>{{"<!--", "-->"},
                                                                  {"<style>", "</style>"},
                                                                  {kDataBegin, "</script>"},
                                                                  {kLinesBegin, "</script>"},
                                                                  {"<script type=\"module\">", "</script>"}}) {
    if (begin == kLinesBegin && !Has(page, begin)) continue;  // of findings alone
    const std::string inside = Between(page, begin, end);
    page.erase(page.find(begin), begin.size() + inside.size() + end.size());
  }
  return page;
}

// Every element is closed in its order (in formulas some close themselves), attributes are quoted, no id stands
// twice.
void RequireWellFormed(const std::string& whole) {
  static const std::set<std::string> kVoid = {"meta", "br"};
  const std::string page = TextOf(whole);
  REQUIRE(page.starts_with("<!DOCTYPE html>\n"));
  REQUIRE(Has(page, "<html lang=\"en\">"));
  static const std::regex tag("^<(/?)([a-z0-9]+)((?: [a-zA-Z0-9-]+=\"[^\"<>]*\")*)(/?)>");
  std::vector<std::string> open;
  std::size_t at = page.find('<', 1);
  for (; at != std::string::npos; at = page.find('<', at + 1)) {
    std::smatch match;
    const std::string rest = page.substr(at, 2000);
    INFO("at: " << rest.substr(0, 80));
    REQUIRE(std::regex_search(rest, match, tag));
    if (kVoid.count(match[2]) > 0 || match[4].length() > 0) continue;
    if (match[1].length() == 0) {
      open.push_back(match[2]);
      continue;
    }
    REQUIRE_FALSE(open.empty());
    REQUIRE(open.back() == match[2].str());
    open.pop_back();
  }
  REQUIRE(open.empty());
  std::set<std::string> ids;
  for (const std::string& id : Matches(page, " id=\"([^\"]*)\"")) REQUIRE(ids.insert(id).second);
  for (const std::string& id : Matches(page, " href=\"#([^\"]*)\"")) REQUIRE(ids.count(id) == 1);
  REQUIRE(Matches(page, "(&)(?!(?:amp|lt|gt|quot|#39);)").empty());
}

// The pages of a report, each well formed, one after the other.
std::string PagesOf(const fs::path& report) {
  std::string pages;
  for (const char* name : {"index.html", "results.html", "findings.html"}) {
    pages += ReadText(report / name);
    RequireWellFormed(ReadText(report / name));
  }
  return pages;
}

// ---- CSV ----

TEST_CASE("report: statistics.csv holds every counter of every tally") {
  const Scratch scratch;
  WriteReport(SampleStore(scratch / "s"), scratch / "out");
  const auto table = ReadTable(scratch / "out/statistics.csv");
  REQUIRE(table.size() == 2);
  for (const auto& [key, tally] : SampleRecord().tallies) {
    const auto rows = RowsOf(table, key);
    REQUIRE(rows.size() == 1);
    const Row& row = rows[0];
    CHECK(row.at("problems") == std::to_string(tally.problems));
    for (int i = 0; i < kOutcomeCount; ++i) {
      CHECK(row.at(std::string(kOutcomeNames[i])) == std::to_string(tally.outcomes[i]));
    }
    CHECK(row.at("audited") == std::to_string(tally.audited));
    CHECK(row.at("misjudged") == std::to_string(tally.misjudged));
    CHECK(row.at("wrong") == std::to_string(tally.wrong));
    CHECK(row.at("with_zero_steps") == std::to_string(tally.with_zero_steps));
    CHECK(row.at("with_give_ups") == std::to_string(tally.with_give_ups));
    ForEachField(tally.sums, [&row](const char* name, const char*, std::int64_t value) {
      CHECK(row.at(std::string("sum_") + name) == std::to_string(value));
    });
    ForEachField(tally.maxima, [&row](const char* name, const char*, std::int64_t value) {
      CHECK(row.at(std::string("max_") + name) == std::to_string(value));
    });
  }
}

TEST_CASE("report: verdicts.csv holds every pair of outcomes that occurred, and no other") {
  const Scratch scratch;
  WriteReport(SampleStore(scratch / "s"), scratch / "out");
  const auto table = ReadTable(scratch / "out/verdicts.csv");
  for (const auto& [key, tally] : SampleRecord().tallies) {
    std::map<std::pair<std::string, std::string>, std::string> found, expected;
    for (const Row& row : RowsOf(table, key)) {
      found[{row.at("inexact_outcome"), row.at("exact_outcome")}] = row.at("count");
    }
    for (int i = 0; i < kOutcomeCount; ++i) {
      for (int k = 0; k < kOutcomeCount; ++k) {
        if (i == 3 && k == 4) continue;
        expected[{std::string(kOutcomeNames[i]), std::string(kOutcomeNames[k])}] =
            std::to_string(tally.verdicts[i][k]);
      }
    }
    CHECK(found == expected);
  }
}

TEST_CASE("report: strata.csv holds every counter of every friction and rank") {
  const Scratch scratch;
  WriteReport(SampleStore(scratch / "s"), scratch / "out");
  const auto table = ReadTable(scratch / "out/strata.csv");
  std::size_t strata = 0;
  for (const auto& [key, tally] : SampleRecord().tallies) {
    const auto rows = RowsOf(table, key);
    CHECK(rows.size() == tally.strata.size());
    strata += rows.size();
    for (const Row& row : rows) {
      const Stratum& s = tally.strata.at({row.at("friction"), std::stoi(row.at("rank"))});
      CHECK(row.at("problems") == std::to_string(s.problems));
      CHECK(row.at("steps") == std::to_string(s.steps));
      CHECK(row.at("zero_steps") == std::to_string(s.zero_steps));
      CHECK(row.at("audited") == std::to_string(s.audited));
      CHECK(row.at("misjudged") == std::to_string(s.misjudged));
      for (int i = 0; i < kOutcomeCount; ++i) {
        const std::string name(kOutcomeNames[i]);
        CHECK(row.at(name) == std::to_string(s.outcomes[i]));
        CHECK(row.at("exact_" + name) == std::to_string(s.exact[i]));
      }
    }
  }
  CHECK(strata == 4);
}

TEST_CASE("report: an estimate of words is no more than the loops") {
  Finding finding = PendingFinding("cycle-3c-4d-14s", 0);
  Record record;
  record.signatures = {{finding.signature, 70}};
  for (std::uint64_t i = 1; i <= 70; ++i) record.words[finding.signature].Add(i);
  CHECK(record.words[finding.signature].Count() > 70);
  CHECK(Discoveries(record, {finding}).front().Words() == 70);
}

TEST_CASE("report: loops.csv and zero_steps.csv hold every counter of loops") {
  const Scratch scratch;
  WriteReport(SampleStore(scratch / "s"), scratch / "out");
  const Record record = SampleRecord();
  const auto table = ReadTable(scratch / "out/loops.csv");
  REQUIRE(table.size() == record.loops.size());
  for (const Row& row : table) {
    ForEachCounter(
        record.loops.at(std::stoi(row.at("contacts"))),
        [&row](const char* name, std::int64_t value) { CHECK(row.at(name) == std::to_string(value)); });
  }
  std::map<int, std::map<int, std::int64_t>> histograms;
  for (const Row& row : ReadTable(scratch / "out/zero_steps.csv"))
    histograms[std::stoi(row.at("contacts"))][std::stoi(row.at("zero_steps"))] = std::stoll(row.at("loops"));
  for (const auto& [contacts, tally] : record.loops) CHECK(histograms[contacts] == tally.by_zero_steps);
}

TEST_CASE("report: the page says of a group of counts how many words its loops have") {
  Finding finding = PendingFinding("cycle-3c-4d-14s", 0);
  Record record;
  record.signatures = {{finding.signature, 900}};
  for (std::uint64_t i = 1; i <= 5; ++i) record.words[finding.signature].Add(i << 40);
  const std::vector<Finding> findings = {finding};
  CHECK(Has(FindingsRows(Discoveries(record, findings), {}).markup(), "900<small>5 words</small>"));
  for (std::uint64_t i = 6; i <= 100; ++i) record.words[finding.signature].Add(i << 40);
  CHECK(Has(FindingsRows(Discoveries(record, findings), {}).markup(), "900<small>about "));
}

TEST_CASE("report: findings.csv says how many words the loops of a group have, where its signature has none") {
  const Scratch scratch;
  WriteReport(SampleStore(scratch / "s"), scratch / "out");
  for (const Row& row : ReadTable(scratch / "out/findings.csv")) {
    const bool counted = row.at("signature") == kCounted;
    CHECK(row.at("words") == (counted ? "2" : ""));
    CHECK(row.at("words_exact") == (counted ? "yes" : ""));
  }
}

TEST_CASE("report: steps.csv holds the histogram of every tally") {
  const Scratch scratch;
  WriteReport(SampleStore(scratch / "s"), scratch / "out");
  const auto table = ReadTable(scratch / "out/steps.csv");
  for (const auto& [key, tally] : SampleRecord().tallies) {
    std::array<std::int64_t, Tally::kBins> steps = {};
    for (const Row& row : RowsOf(table, key)) {
      const int bin = std::stoi(row.at("steps"));
      steps.at(bin) += std::stoll(row.at("problems"));
      CHECK(row.at("or_more") == (bin == Tally::kBins - 1 ? "yes" : "no"));
    }
    CHECK(steps == tally.steps);
  }
}

TEST_CASE("report: agreement.csv and solutions.csv hold every counter by contacts") {
  const Scratch scratch;
  WriteReport(SampleStore(scratch / "s"), scratch / "out");
  const Record record = SampleRecord();
  const auto table = ReadTable(scratch / "out/agreement.csv");
  REQUIRE(table.size() == 2);
  for (const Row& row : table) {
    const int contacts = std::stoi(row.at("contacts"));
    const auto same = [&row](const char* name, std::int64_t value) {
      INFO(name);
      CHECK(row.at(name) == std::to_string(value));
    };
    ForEachCounter(record.existence.at(contacts), same);
    ForEachCounter(record.agreement.at(contacts), same);
  }
  std::map<int, std::map<int, std::int64_t>> words, solutions;
  for (const Row& row : ReadTable(scratch / "out/solutions.csv")) {
    auto& histogram = row.at("counted") == "words" ? words : solutions;
    histogram[std::stoi(row.at("contacts"))][std::stoi(row.at("count"))] = std::stoll(row.at("problems"));
  }
  for (const auto& [contacts, tally] : record.agreement) {
    CHECK(words.at(contacts) == tally.words);
    CHECK(solutions.at(contacts) == tally.solutions);
  }
}

TEST_CASE("report: what Ipopt made of each finished finding, and how often it led to a solution") {
  const Scratch scratch;
  Store store = SampleStore(scratch / "s");
  Finding other = Finished(PendingFinding(kPending, 0)), absent = Finished(PendingFinding(kDone, 0));
  const std::string solved = R"("outcome":"solved","starts":2)";
  other.facts.replace(other.facts.find(solved), solved.size(), R"("outcome":"undecided","starts":20)");
  store.Finish(other);
  WriteReport(store, scratch / "out");
  const auto table = ReadTable(scratch / "out/ipopt.csv");
  REQUIRE(table.size() == 2);
  std::map<std::string, std::string> answers;
  for (const Row& row : table) answers[row.at("signature")] = row.at("outcome") + " " + row.at("starts");
  CHECK(answers == std::map<std::string, std::string>{{kDone, "solved 2"}, {kPending, "undecided 20"}});
  CHECK(Has(PagesOf(scratch / "out"), "of 1 of 2 finished findings, 50 % [1.25, 98.8], after 2"));
  absent.facts.replace(absent.facts.find(solved), solved.size(), R"("outcome":"unavailable","starts":0)");
  store.Finish(absent);
  WriteReport(store, scratch / "again");
  CHECK(Has(PagesOf(scratch / "again"), "it could not be asked about 1;"));
}

TEST_CASE("report: findings.csv holds every signature with its count and facts") {
  const Scratch scratch;
  WriteReport(SampleStore(scratch / "s"), scratch / "out");
  REQUIRE(ReadTable(scratch / "out/findings.csv").size() == 3);

  const Row done = FindingRow(scratch / "out", kDone);
  const Row expected = {{"kind", "cycle"},
                        {"count", "1234"},
                        {"unit", "0"},
                        {"index", "77"},
                        {"generator", "integers"},
                        {"contacts", "2"},
                        {"policy", "paper"},
                        {"inexact_outcome", "cycle"},
                        {"exact_outcome", "cycle"},
                        {"state", "finished"},
                        {"loop_drives", "4"},
                        {"loop_steps", "10"},
                        {"start", "3"},
                        {"period", "4"},
                        {"steps", "17"},
                        {"whole_grid", "yes"},
                        {"every_policy_loops", "yes"},
                        {"found_grid_cycle", "1536"},
                        {"found_grid_solved", "0"},
                        {"minimized_contacts", "1"},
                        {"minimized_start", "5"},
                        {"minimized_period", "6"},
                        {"minimized_steps", "21"},
                        {"minimized_grid_cycle", "1500"},
                        {"minimized_grid_solved", "36"},
                        {"safe", "no"},
                        {"minimized_safe", ""}};
  for (const auto& [column, value] : expected) {
    INFO(column);
    CHECK(done.at(column) == value);
  }

  const Row pending = FindingRow(scratch / "out", kPending);
  CHECK(pending.at("count") == "5");
  CHECK(pending.at("state") == "pending");
  CHECK(pending.at("loop_steps") == "12");
  CHECK(pending.at("whole_grid").empty());
  CHECK(pending.at("certificate_file").empty());

  const Row counted = FindingRow(scratch / "out", kCounted);
  CHECK(counted.at("kind") == "disagreement");
  CHECK(counted.at("count") == "6");
  CHECK(counted.at("state") == "counted");
  CHECK(counted.at("problem_file").empty());
}

TEST_CASE("report: CSV cells are quoted where RFC 4180 asks for it") {
  Table table{"t", "", {{"1"}, {"2"}, {"3"}, {"4"}, {"5"}, {"6"}}};
  table.Add({"plain", "a,b", "say \"so\"", "two\r\nlines", "", -12345678});
  CHECK(ToCsv(table) == "1,2,3,4,5,6\r\nplain,\"a,b\",\"say \"\"so\"\"\",\"two\r\nlines\",,-12345678\r\n");
}

// ---- Files of findings ----

TEST_CASE("report: a finished finding has its minimized problem, the original and the minimized certificate") {
  const Scratch scratch;
  WriteReport(SampleStore(scratch / "s"), scratch / "out");
  const Row row = FindingRow(scratch / "out", kDone);
  CHECK(row.at("problem_file") == "findings/" + kDone + ".json");
  CHECK(ReadText(scratch / "out" / row.at("problem_file")) == Print(ParseProblem(kSmaller, "")));
  CHECK(ReadText(scratch / "out" / row.at("original_file")) == Print(ParseProblem(kProblem, "")));
  CHECK(ReadText(scratch / "out" / row.at("certificate_file")) == "{\"certificate\":\"of the minimized\"}\n");
  CHECK(row.at("existence_file") == "findings/" + kDone + ".existence.certificate.json");
  CHECK(ReadText(scratch / "out" / row.at("existence_file")) == "{\"existence\":\"of the minimized\"}\n");
  CHECK(row.at("original_existence_file") == "findings/" + kDone + ".original.existence.certificate.json");
  CHECK(ReadText(scratch / "out" / row.at("original_existence_file")) ==
        "{\"existence\":\"of the original\"}\n");
}

TEST_CASE("report: a finding that is only certified has the certificate of its original") {
  const Scratch scratch;
  Store store = SampleStore(scratch / "s");
  Finding finding = Finished(PendingFinding(kPending, 0));
  finding.minimized = finding.minimized_certificate = finding.minimized_existence = "";
  finding.facts = R"({"found":{"contacts":2,"start":0,"period":0,"steps":9,"grid":{"solved":1536}}})";
  finding.exact_outcome = "solved";
  store.Finish(finding);
  WriteReport(store, scratch / "out");
  const Row row = FindingRow(scratch / "out", kPending);
  CHECK(ReadText(scratch / "out" / row.at("certificate_file")) == "{\"certificate\":\"of the original\"}\n");
  CHECK(ReadText(scratch / "out" / row.at("problem_file")) == Print(ParseProblem(kProblem, "")));
  CHECK(ReadText(scratch / "out" / row.at("existence_file")) == "{\"existence\":\"of the original\"}\n");
  CHECK(row.at("original_existence_file").empty());
  CHECK(row.at("whole_grid") == "no");
}

TEST_CASE("report: no certificate of an earlier representative stays behind") {
  const Scratch scratch;
  Store store(scratch / "s", kIdentity);
  store.AddUnit({}, 5, SampleRecord(), {PendingFinding(kDone, 5)});
  store.Finish(Finished(PendingFinding(kDone, 5)));
  WriteReport(store, scratch / "out");
  const fs::path certificate = scratch / ("out/findings/" + kDone + ".certificate.json");
  const auto count = [&scratch] { return Contents(scratch / "out/findings").size(); };
  REQUIRE(fs::exists(certificate));
  REQUIRE(count() == 5);
  store.AddUnit({}, 2, SampleRecord(), {PendingFinding(kDone, 2)});
  WriteReport(store, scratch / "out");
  CHECK(FindingRow(scratch / "out", kDone).at("state") == "pending");
  CHECK_FALSE(fs::exists(certificate));
  CHECK(count() == 2);  // problem and original
}

TEST_CASE("report: every file that is named exists") {
  const Scratch scratch;
  WriteReport(SampleStore(scratch / "s"), scratch / "out");
  std::set<std::string> named;
  for (const Row& row : ReadTable(scratch / "out/findings.csv")) {
    for (const char* column :
         {"problem_file", "original_file", "certificate_file", "existence_file", "original_existence_file"})
      named.insert(row.at(column));
  }
  std::string page;
  for (const char* name : {"index.html", "results.html", "findings.html"})
    page += TextOf(ReadText(scratch / "out" / name));
  for (const std::string& link : Matches(page, "href=\"([^#\"][^#\"]*)[^\"]*\"")) named.insert(link);
  for (const std::string& file : Matches(page, "(findings/[^ <\"]*\\.json)")) named.insert(file);
  named.erase("");
  CHECK(named.size() == 3 + 14 + 10 + 5 + 2);  // pages, tables, figures, files of findings
  for (const std::string& file : named) {
    INFO(file);
    CHECK(fs::is_regular_file(scratch / "out" / file));
  }
}

TEST_CASE("report: a signature becomes a file name of its own") {
  CHECK(FileName(kDone) == kDone);
  CHECK(FileName(kPending) == kPending);
  const std::vector<std::string> odd = {"",
                                        ".",
                                        "..",
                                        "a/b",
                                        "a_b",
                                        "a\\b",
                                        "a b",
                                        "x.original",
                                        "x_original",
                                        "../../x",
                                        std::string(400, 'a'),
                                        std::string(401, 'a')};
  std::set<std::string> names;
  for (const std::string& signature : odd) {
    const std::string name = FileName(signature);
    INFO(name);
    CHECK(names.insert(name).second);
    CHECK(std::regex_match(name, std::regex("[-A-Za-z0-9_=,@]{1,230}")));
  }
}

// ---- The page ----

TEST_CASE("html: what a script holds neither ends it nor begins a comment") {
  const std::string text = R"(["</script>", "<!--", "a / b"])";
  CHECK(ScriptData(text).markup() == R"(["\u003c/script>", "\u003c!--", "a / b"])");
  CHECK(Json::parse(ScriptData(text).markup()) == Json::parse(text));
}

TEST_CASE("html: numbers of pictures") {
  CHECK(Fixed(2.0 / 3) == "0.7");
  CHECK(Fixed(800, 0) == "800");
  CHECK(Significant(2.0 / 3) == "0.66667");
  CHECK(Significant(1234567, 4) == "1.235e+06");
}

TEST_CASE("draw: a page escapes the name of its scene, and its frames are JSON, in the plane and in space") {
  const auto check = [](const auto& scene, std::size_t transforms) {
    using Kind = std::conditional_t<std::is_same_v<decltype(scene), const Scene<double>&>, Plane, Space>;
    View view;
    view.Include(scene);
    view.AddMargin();
    MarksIn<Kind> marks;
    marks.contacts.push_back(scene.bodies[0].position);
    const std::string page = AnimationPage<Kind>(scene, view, {RecordFrame(scene, 0.5, marks)}, 1, 30);
    CHECK(Has(page, "<title>a&lt;b&gt;</title>"));
    const std::string begin = "id=\"data\">";
    const std::size_t from = page.find(begin) + begin.size(), to = page.find("</script>", from);
    const Json data = ParseJson(page.substr(from, to - from), "data");
    const Json frames = ParseJson(Unpacked(data["frames"].get<std::string>()), "frames");
    REQUIRE(frames.size() == 1);
    CHECK(frames[0]["time"] == 0.5);
    CHECK(frames[0]["poses"].size() == 4 * transforms);
    CHECK(frames[0]["points"].size() == 1);
    CHECK(Has(DrawSvg(scene, view, marks, 1), "#30c030"));
  };
  Scene<double> disc;
  disc.name = "a<b>";
  disc.bodies.emplace_back().shapes.emplace_back().radius = 1;
  check(disc, 1);
  SceneInSpace<double> ball;
  ball.name = "a<b>";
  ball.bodies.emplace_back().shapes.emplace_back().radius = 1;
  check(ball, 0);
}

// A loop in space, with its certificate.
Finding LoopInBox(const std::string& signature, const char* claim) {
  Finding finding = Finished(PendingFinding(signature, 0));
  finding.policy = "slip=redirect";
  finding.minimized_certificate = fmt::format(
      R"({{"claim":"{}","witness":{{"policy":"slip=redirect","kind":"box","start":5,"period":48,"word":["a","b"]}}}})",
      claim);
  return finding;
}

TEST_CASE("report: of a loop in space it says what its certificate proves, in page and table") {
  const Scratch scratch;
  const std::string boxed =
      "from the state after 5 drives on it never leaves a box, the same steps every 48 drives";
  for (const char* claim : {"cycle", "endless"}) {
    const std::string name = claim, out = "out-" + name;
    Store store(scratch / name, kIdentity);
    Record record = SampleRecord();
    record.signatures = {{"cycle-2c-48d", 1}};
    store.AddUnit({}, 0, record, {LoopInBox("cycle-2c-48d", claim)});
    WriteReport(store, scratch / out);
    const std::string page = PagesOf(scratch / out);
    const bool endless = name == "endless";
    CHECK(Has(page, "Under slip=redirect: " + std::string(endless ? "no state recurs: " : "") + boxed +
                        ", for ever"));
    CHECK_FALSE(Has(page, "recurs 6 drives later"));
    CHECK_FALSE(Has(page, "(21 steps in all)"));  // of a run that intervals ended early
    const auto rows = ReadTable(scratch / out / "findings.csv");
    CHECK(rows.at(0).at("minimized_steps") == "2");  // those of the certificate
    CHECK(rows.at(0).at("minimized_proof") == (endless ? "endless" : "box"));
    const Json listed = ListedIn(ReadText(scratch / out / "findings.html"));
    CHECK(listed[0]["period"] == 0);  // whose drives a page would say recur
    CHECK_THAT(SummaryText(store, "s"), Catch::Contains("never leaves a box"));
  }
}

TEST_CASE("report: the command of a finding of doubles replays it over doubles") {
  const Scratch scratch;
  Store store(scratch / "s", kIdentity);
  Record record = SampleRecord();
  record.signatures = {{"wrong-answer-2c", 1}, {"disagreement-ray-solved-2c", 1}, {"ray-2c", 1}};
  std::vector<Finding> findings;
  for (const auto& [signature, unused] : record.signatures) {
    Finding finding = PendingFinding(signature, 0);
    finding.kind = KindOf(signature);
    finding.exact_outcome = finding.kind == "ray" ? "ray" : "solved";
    findings.push_back(finding);
  }
  store.AddUnit({}, 0, record, findings);
  WriteReport(store, scratch / "out");
  const Json listed = ListedIn(ReadText(scratch / "out/findings.html"));
  REQUIRE(listed.size() == 3);
  for (const Json& row : listed) {
    const bool of_doubles = row["kind"] != "ray";
    CHECK(Has(row["commands"], "--arithmetic double --step") == of_doubles);
    CHECK(Has(row["commands"], "--arithmetic double --html") == of_doubles);
  }
}

TEST_CASE("report: the table of work names the machines that searched, and nothing else does") {
  const Scratch scratch;
  Store store(scratch / "t", kIdentity);
  Work work{{"a build"}, {}};
  work.machines = {"Processor <9>, 8 cores", "another"};
  store.AddUnit({}, 0, SampleRecord(), {}, {}, work);
  WriteReport(store, scratch / "named");
  const std::string page = PagesOf(scratch / "named");
  const std::string work_table = ReadText(scratch / "named/work.csv");
  CHECK(Has(work_table, "machine,,\"Processor <9>, 8 cores\"\r\n"));
  CHECK(Has(work_table, "machine,,another\r\n"));
  CHECK(!Has(page, "Processor"));
  CHECK(!Has(TextReport(store, "t", [](std::string_view) { return std::string_view(); }), "Processor"));
  CHECK(!Has(ReadText(scratch / "named/SHA256SUMS"), "work.csv"));
}

TEST_CASE("report: the page needs nothing but itself") {
  const Scratch scratch;
  WriteReport(SampleStore(scratch / "s"), scratch / "out");
  const std::string page = ReadText(scratch / "out/index.html");
  for (const char* part : {"<link", "<img", "src=", "style=\"", "@import", "onclick", "javascript:", "http"}) {
    INFO(part);
    CHECK_FALSE(Has(TextOf(page), part == std::string("http") ? "https:" : part));
  }
  CHECK_FALSE(Has(Between(page, "<style>", "</style>"), "url("));
  const std::string policy = Between(page, "Content-Security-Policy\" content=\"", "\"");
  CHECK(policy.starts_with("default-src 'none'; script-src 'sha256-"));
  CHECK_FALSE(Has(policy, "unsafe"));
  CHECK_FALSE(Has(page, "{{" + std::string("data") + "}}"));
}

TEST_CASE("template: each mark is filled once, and what fills one is not read for marks") {
  CHECK(FilledTemplate("a{{x}}b{{y}}c", {{"y", Text("<")}, {"x", Text("{{y}}")}}) == "a{{y}}b&lt;c");
  CHECK_THROWS_AS(FilledTemplate("a", {{"x", Html()}}), InternalError);
  CHECK_THROWS_AS(FilledTemplate("{{x}}{{x}}", {{"x", Html()}}), InternalError);
}

TEST_CASE("report: whatever stands in a store is shown as text") {
  const Scratch scratch;
  const std::string evil = "</td><script>alert(\"1\")</script>&'\x01";
  CampaignIdentity identity = {evil, 1, evil};
  Record record;
  record.tallies[{evil, 2, evil, evil, evil}] = SampleTally(1);
  record.signatures = {{"cycle-2c-" + evil, 1}, {evil, 2}};
  Finding finding = PendingFinding("cycle-2c-" + evil, 0);
  finding.kind = finding.generator = finding.policy = finding.inexact_outcome = finding.exact_outcome = evil;
  for (const bool done : {false, true}) {
    const fs::path file = scratch / (done ? "done" : "pending"), out = scratch / (done ? "out1" : "out2");
    Store store(file, identity);
    store.AddUnit({}, 0, record, {finding});
    if (done) store.Finish(Finished(finding));
    WriteReport(store, out);
    const std::string page = PagesOf(out);
    for (const char* name : {"index.html", "results.html", "findings.html"})
      CHECK_FALSE(Has(TextOf(ReadText(out / name)), "<script"));
    CHECK(DataOf(page)["findings"][0]["signature"] == "cycle-2c-" + evil);
    CHECK_FALSE(Has(page, "\x01"));
    CHECK(Has(page, "&lt;/td&gt;&lt;script&gt;alert(&quot;1&quot;)&lt;/script&gt;&amp;&#39;\xEF\xBF\xBD"));
    CHECK(RowsOf(ReadTable(out / "statistics.csv"), {evil, 2, evil, evil, evil}).size() == 1);
    CHECK(FindingRow(out, "cycle-2c-" + evil).at("policy") == evil);
    CHECK(Contents(out / "findings").size() == (done ? 5 : 2));
  }
}

TEST_CASE("report: remarks of a campaign are told as text, in every medium") {
  const Scratch scratch;
  CampaignIdentity identity = kIdentity;
  identity.remarks = Json{{"why", "<b>50 % & more"}}.dump();
  Store store(scratch / "s", identity);
  store.AddUnit({}, 0, SampleRecord(), {});
  WriteReport(store, scratch / "out", Occupied::kRefused,
              {.latex = true, .labels = {{"why", "reason"}, {"mu", "palette"}}});
  const std::string page = PagesOf(scratch / "out");
  CHECK(Has(page, "<dt>reason</dt><dd>&lt;b&gt;50 % &amp; more</dd>"));
  CHECK(Has(page, "<dt>palette</dt><dd>1/2, 5</dd>"));
  CHECK(Has(page, "<dt>unit_problems</dt><dd>10,000</dd>"));
  CHECK(Json::parse(ReadText(scratch / "out/campaign.json"))["why"] == "<b>50 % & more");
  CHECK(Has(ReadText(scratch / "out/latex/report.tex"), "why: \\textless{}b\\textgreater{}50 \\% \\& more\n"));
  CHECK(Has(TextReport(store, "s", [](std::string_view) { return std::string_view("case"); }),
            "\n  why: <b>50 % & more\n"));
  CHECK(Has(SummaryText(store, "s"), "\n  why: <b>50 % & more\n"));
  WritePackage(store, scratch / "package", {});
  CHECK(Json::parse(ReadText(scratch / "package/manifest.json"))["campaign"]["definition"]["why"] ==
        "<b>50 % & more");
}

TEST_CASE("report: a policy in a command is a single shell word") {
  const Scratch scratch;
  Store store(scratch / "s", kIdentity);
  Finding finding = PendingFinding(kDone, 0);
  finding.policy = "x; rm 'y'";
  store.AddUnit({}, 0, SampleRecord(), {finding});
  WriteReport(store, scratch / "out");
  CHECK(Has(PagesOf(scratch / "out"), "--policy &#39;x; rm &#39;\\&#39;&#39;y&#39;\\&#39;&#39;&#39; --step"));
}

TEST_CASE("report: of many findings some stand in the page as text, and all as data and in findings.csv",
          "[slow]") {
  const Scratch scratch;
  Record record = SampleRecord();
  record.signatures.clear();
  std::vector<Finding> findings;
  const int many = static_cast<int>(kFindingsShown) + 20;
  for (int i = 0; i < many; ++i) {
    const std::string signature = fmt::format("cycle-2c-4d-10s-{:016x}", i);
    record.signatures[signature] = i + 1;
    findings.push_back(PendingFinding(signature, 0));
    findings.back().contacts = i == 0 ? 1 : 2;
  }
  Store store(scratch / "s", kIdentity);
  store.AddUnit({}, 0, record, findings);
  WriteReport(store, scratch / "out");
  const std::string page = PagesOf(scratch / "out");
  const auto shown = Matches(page, "<th scope=\"row\" class=\"signature code\">([^<]*)</th>");
  REQUIRE(shown.size() == kFindingsShown);
  CHECK(shown[0] == fmt::format("cycle-2c-4d-10s-{:016x}", 0));
  CHECK(shown[1] == fmt::format("cycle-2c-4d-10s-{:016x}", many - 1));
  CHECK(Has(page, "All 70 signatures are here, without a script the first 50"));
  CHECK(DataOf(page)["findings"].size() == kFindingsNamed);  // of the first page
  CHECK_FALSE(Has(ReadText(scratch / "out/index.html"), shown[kFindingsNamed]));
  const Json listed = ListedIn(ReadText(scratch / "out/findings.html"));
  REQUIRE(listed.size() == static_cast<std::size_t>(many));
  CHECK(listed[0]["signature"] == shown[0]);
  CHECK(listed[51]["story"] == listed[1]["story"]);
  CHECK(listed[51]["numbers"]["A"][0][1] == "-2");
  CHECK(ReadTable(scratch / "out/findings.csv").size() == static_cast<std::size_t>(many));
}

TEST_CASE("report: numbers too long to read stay out of the page") {
  const Scratch scratch;
  Finding finding = PendingFinding(kDone, 0);
  const std::string digits(10000, '7'), entry = "\"9\"";
  finding.problem.replace(finding.problem.find(entry), entry.size(), "\"" + digits + "\"");
  Store store(scratch / "s", kIdentity);
  store.AddUnit({}, 0, SampleRecord(), {finding});
  WriteReport(store, scratch / "out");
  const std::string page = PagesOf(scratch / "out");
  CHECK(Has(page, "too long for a page"));
  CHECK_FALSE(Has(page, digits));
  CHECK(Has(ReadText(scratch / ("out/findings/" + kDone + ".json")), digits));
}

TEST_CASE("report: findings of interest come first") {
  Finding small = PendingFinding("cycle-2c-1d-2s-a", 0), rare = small, often = small, other = small,
          large = small;
  Finding whole = Finished(PendingFinding("cycle-2c-1d-2s-w", 0));
  const std::string minimized = R"("minimized":{"contacts":1,)";
  whole.facts.replace(whole.facts.find(minimized), minimized.size(), R"("minimized":{"contacts":2,)");
  small = Finished(small);  // minimized to one contact
  small.contacts = 8;
  rare.signature = "cycle-2c-1d-2s-r";
  often.signature = "cycle-2c-1d-2s-s";
  other.signature = "wrong-answer-2c";
  other.kind = "wrong-answer";
  large.signature = "cycle-3c-1d-2s-l";
  large.contacts = 3;
  const Record record{{},
                      {{small.signature, 1},
                       {whole.signature, 1},
                       {rare.signature, 2},
                       {often.signature, 9},
                       {other.signature, 10},
                       {large.signature, 100},
                       {"cycle-1c-1d-1s-counted", 7}},
                      {},
                      {},
                      {},
                      {},
                      {}};
  const std::vector<Finding> findings = {large, often, other, rare, small, whole};
  const auto discoveries = Discoveries(record, findings);
  std::vector<std::string> order;
  for (const Discovery* discovery : ByInterest(discoveries)) order.push_back(discovery->signature);
  CHECK(order == std::vector<std::string>{small.signature, whole.signature, often.signature, rare.signature,
                                          large.signature, other.signature});
}

TEST_CASE(
    "report: --files leaves files to the simplest loop and what is of most interest, and says so of others") {
  const Scratch scratch;
  Store store(scratch / "s", kIdentity);
  Finding longer = PendingFinding("cycle-2c-1d-2s-a", 0), shorter = longer, counted = longer;
  shorter.signature = "cycle-2c-1d-2s-b";
  counted.signature = "cycle-2c-1d-2s-c";
  Record record = SampleByContacts();
  for (const Finding* finding : {&longer, &shorter, &counted}) record.signatures[finding->signature] = 1;
  store.AddUnit({}, 0, record, {longer, shorter, counted});
  longer = Finished(longer);
  longer.minimized += std::string(10, ' ');
  shorter = Finished(shorter);  // the shortest text, though of more contacts
  const std::string minimized = R"("minimized":{"contacts":1,)";
  shorter.facts.replace(shorter.facts.find(minimized), minimized.size(), R"("minimized":{"contacts":2,)");
  store.Finish(longer);
  store.Finish(shorter);
  const auto problems_with = [&](std::int64_t files) {
    WriteReport(store, scratch / "out", Occupied::kRefused, {{}, {}, false, files});
    std::vector<std::string> names;
    for (const auto& row : ReadTable(scratch / "out/findings.csv")) {
      const std::string file = row.at("problem_file");
      CHECK(file.empty() != fs::exists(scratch / ("out/findings/" + row.at("signature") + ".json")));
      if (!file.empty()) names.push_back(row.at("signature"));
    }
    return names;
  };
  CHECK(problems_with(0).empty());
  CHECK(problems_with(1) == std::vector<std::string>{shorter.signature});
  const std::string page = PagesOf(scratch / "out");
  CHECK(Has(page, "Files: left out of this report."));
  CHECK(Has(page, "stiction problem STORE 0 "));
  CHECK(problems_with(2) == std::vector<std::string>{longer.signature, shorter.signature});
  CHECK(problems_with(9).size() == 3);
}

TEST_CASE("report: the simplest loop has the shortest minimized problem, the gravest first") {
  Finding longer = Finished(PendingFinding("cycle-2c-1d-2s-a", 0)), shorter = longer;
  shorter.signature = "cycle-2c-1d-2s-b";
  longer.minimized += std::string(10, ' ');
  const auto simplest = [&](const char* kind_of_longer) {
    longer.kind = kind_of_longer;
    Record record = SampleByContacts();
    record.signatures = {{longer.signature, 1}, {shorter.signature, 1}};
    const std::vector<Finding> findings = {longer, shorter};
    return SimplestLoop(Discoveries(record, findings))->signature;
  };
  CHECK(simplest("cycle") == shorter.signature);
  CHECK(simplest("safe-cycle") == longer.signature);
  CHECK(SimplestLoop({}) == nullptr);
}

TEST_CASE("report: cycles of safe problems and disagreements of methods outrank everything") {
  Finding simple = Finished(PendingFinding("cycle-2c-1d-2s-a", 0)), large = simple, methods = simple,
          safe = simple;
  large.signature = "cycle-8c-1d-2s-safe-when-minimized";
  large.kind = "safe-cycle";
  large.minimized += std::string(200, ' ');
  safe.signature = "safe-cycle-8c-5d-9s";
  safe.kind = "safe-cycle";
  methods.signature = "disagreement-of-methods-lemke-ray-8c";
  methods.kind = "disagreement-of-methods";
  methods.minimized = methods.minimized_certificate = methods.minimized_existence = "";
  methods.contacts = 8;
  methods.facts = "";
  const std::vector<Finding> findings = {simple, large, safe, methods};
  Record record = SampleByContacts();
  for (const Finding& finding : findings) record.signatures[finding.signature] = 1;
  const auto discoveries = Discoveries(record, findings);
  std::vector<std::string> order;
  for (const Discovery* discovery : ByInterest(discoveries)) order.push_back(discovery->signature);
  CHECK(order ==
        std::vector<std::string>{safe.signature, large.signature, methods.signature, simple.signature});
  for (const Discovery& discovery : discoveries) {
    CHECK(discovery.IsLoop() == (discovery.kind != "disagreement-of-methods"));
    CHECK(discovery.loop.has_value() == discovery.IsLoop());
  }
  const Scratch scratch;
  Store store(scratch / "s", kIdentity);
  store.AddUnit({}, 0, record, findings);
  WriteReport(store, scratch / "out");
  const std::string page = PagesOf(scratch / "out");
  CHECK(Has(page, "<strong>3</strong> of these grave"));
  const std::string results = TextOf(ReadText(scratch / "out/results.html"));
  CHECK(results.find(">safe-cycle<") < results.find(">disagreement-of-methods<"));
  CHECK(results.find(">disagreement-of-methods<") < results.find(">cycle<"));
}

// ---- What is told ----

// A loop of space, policies and frictions that differ, and nothing known of existence.
Record OfScenes() {
  Record record;
  for (const char* policy : {"paper", "scan=highest"}) {
    Tally& tally = record.tallies[{"scenes", 4, policy}];
    tally.problems = 4000000;
    tally.outcomes = {3999997, 3};
    tally.verdicts[static_cast<int>(Outcome::kCycle)] = {0, 3};
    tally.audited = 800;
    tally.misjudged = 2;
    for (const char* friction : {"mixed", "1/2", "1/10", "2"}) {
      Stratum& stratum = tally.strata[{friction, 3}];
      stratum.problems = 1000000;
      stratum.exact[static_cast<int>(Outcome::kCycle)] = friction[0] == '1';
    }
  }
  record.signatures = {{"cycle-4c-9d", 6}};
  return record;
}

// A part to a line.
std::string LineByLine(const Json& told) {
  std::string lines;
  for (const Json& section : told["sections"]) {
    lines += fmt::format("# {} | {}\n", section["id"].get<std::string>(), section["title"].get<std::string>());
    for (const Json& part : section["parts"]) lines += JsonText(part) + "\n";
  }
  return lines;
}

// What every medium renders. STICTION_TOLD=record writes the files anew, which are to be read then.
TEST_CASE("report: report.json tells of three stores what their files here say") {
  const Scratch scratch;
  Store scenes(scratch / "scenes.store", kIdentity), empty(scratch / "empty.store", kIdentity);
  scenes.AddUnit({}, 0, OfScenes(), {});
  const Store sample = SampleStore(scratch / "sample.store");
  for (const auto& [name, store] : {std::pair("sample", &sample), {"scenes", &scenes}, {"empty", &empty}}) {
    WriteReport(*store, scratch / name);
    const std::string told = LineByLine(ParseJson(ReadText(scratch / name / "report.json"), name));
    const fs::path file = fs::path(STICTION_SCENES).parent_path().parent_path() / "tests/reports/told" /
                          (std::string(name) + ".txt");
    if (const char* said = std::getenv("STICTION_TOLD"); said != nullptr && said == std::string("record"))
      std::ofstream(file) << told;
    INFO(name);
    CHECK(told == ReadText(file));
  }
}

TEST_CASE("report: a page says what report.json does") {
  const Scratch scratch;
  WriteReport(SampleStore(scratch / "s"), scratch / "out");
  const Json told = ParseJson(ReadText(scratch / "out/report.json"), "report.json");
  for (const std::string name : {"index", "results", "findings"}) {
    const std::string page = TextOf(ReadText(scratch / "out" / (name + ".html")));
    std::string plain;
    bool in_tag = false;
    for (const char c : page) {
      in_tag = in_tag || c == '<';
      if (!in_tag) plain += c;
      in_tag = in_tag && c != '>';
    }
    int seen = 0;
    for (const Json& section : told["sections"]) {
      for (const Json& part : section["parts"]) {
        const bool here = std::ranges::count(part["in"], Json(name)) > 0;
        if (!here || !part.contains("text")) continue;
        INFO(part);
        CHECK(Has(plain, Text(part["text"].get<std::string>()).markup()));
        CHECK(Has(page, Text(section["title"].get<std::string>()).markup() + "</h2>"));
        ++seen;
      }
    }
    CHECK(seen > (name == "findings" ? 2 : 8));
  }
}

// ---- Figures ----

std::vector<Row> RowsWhere(const fs::path& report, const std::string& figure, const Row& wanted) {
  std::vector<Row> rows;
  for (const Row& row : ReadTable(report / "figures" / (figure + ".csv"))) {
    const auto fits = [&row](const auto& cell) { return row.at(cell.first) == cell.second; };
    if (std::all_of(wanted.begin(), wanted.end(), fits)) rows.push_back(row);
  }
  return rows;
}

TEST_CASE("figures: the page draws what their files say, to the digit") {
  const Scratch scratch;
  WriteReport(SampleStore(scratch / "s"), scratch / "out");
  Json figures = DataOf(ReadText(scratch / "out/index.html"))["figures"];
  CHECK(figures.size() == 3);
  figures.update(DataOf(ReadText(scratch / "out/results.html"))["figures"]);
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(scratch / "out/figures"))
    files.insert(entry.path().stem().string());
  REQUIRE(files.size() == figures.size());
  REQUIRE(files.size() == 10);
  for (const auto& [name, figure] : figures.items()) {
    INFO(name);
    const auto lines = ParseCsv(ReadText(scratch / ("out/figures/" + name + ".csv")));
    REQUIRE(lines.size() == figure["rows"].size() + 1);
    CHECK(Json(lines[0]) == figure["columns"]);
    for (std::size_t i = 1; i < lines.size(); ++i) {
      for (std::size_t k = 0; k < lines[i].size(); ++k) {
        const Json& cell = figure["rows"][i - 1][k];
        CHECK(lines[i][k] == (cell.is_string() ? cell.get<std::string>() : JsonText(cell)));
      }
    }
  }
}

TEST_CASE("figures: exact rates by contacts, friction and rank are those of the store, with their intervals") {
  const Scratch scratch;
  WriteReport(SampleStore(scratch / "s"), scratch / "out");
  const int cycle = static_cast<int>(Outcome::kCycle), stall = static_cast<int>(Outcome::kStall);
  for (const auto& [key, tally] : SampleRecord().tallies) {
    std::int64_t loops = 0;
    for (const auto& exact : tally.verdicts) loops += exact[cycle] + exact[stall];
    const Row of = {{"generator", key.generator}, {"policy", key.policy}, {"outcome", "loop"}};
    const auto check = [&](Row wanted, std::int64_t count, std::int64_t runs) {
      wanted.insert(of.begin(), of.end());
      const auto rows = RowsWhere(scratch / "out", "rates", wanted);
      REQUIRE(rows.size() == 1);
      CHECK(rows[0].at("count") == std::to_string(count));
      CHECK(rows[0].at("runs") == std::to_string(runs));
      const double scale = 1e6 / static_cast<double>(runs);
      CHECK(std::stod(rows[0].at("rate")) == Approx(scale * static_cast<double>(count)).epsilon(1e-5));
      CHECK(std::stod(rows[0].at("low")) == Approx(scale * CountInterval(count).low).epsilon(1e-5));
      CHECK(std::stod(rows[0].at("high")) == Approx(scale * CountInterval(count).high).epsilon(1e-5));
    };
    check({{"by", "contacts"}, {"value", std::to_string(key.contacts)}}, loops, tally.problems);
    for (const auto& [stratum_key, stratum] : tally.strata) {
      check({{"by", "friction"}, {"value", stratum_key.friction}}, stratum.exact[cycle] + stratum.exact[stall],
            stratum.problems);
      check({{"by", "rank"}, {"value", std::to_string(stratum_key.rank)}},
            stratum.exact[cycle] + stratum.exact[stall], stratum.problems);
    }
  }
}

TEST_CASE("figures: steps, zero steps, doubles and driving are those of the store") {
  const Scratch scratch;
  WriteReport(SampleStore(scratch / "s"), scratch / "out");
  const Record record = SampleRecord();
  const auto only = [&scratch](const std::string& figure, const Row& wanted, const char* column) {
    const auto rows = RowsWhere(scratch / "out", figure, wanted);
    REQUIRE(rows.size() == 1);
    return rows[0].at(column);
  };
  for (const auto& [key, tally] : record.tallies) {
    const Row of = {{"policy", key.policy}};
    const auto with = [&of](Row more) {
      more.insert(of.begin(), of.end());
      return more;
    };
    CHECK(only("steps", with({{"steps", "5"}}), "runs") == std::to_string(tally.steps[5]));
    CHECK(only("steps", with({{"or_more", "yes"}}), "runs") == std::to_string(tally.steps[Tally::kBins - 1]));
    CHECK(RowsWhere(scratch / "out", "steps", with({{"steps", "7"}})).empty());
    CHECK(only("pivoting", with({{"what", "a step of length zero"}}), "count") ==
          std::to_string(tally.with_zero_steps));
    CHECK(only("pivoting", with({{"what", "a variable given up"}}), "count") ==
          std::to_string(tally.with_give_ups));
    CHECK(only("doubles", with({{"in_doubles", "cycle"}, {"exact", "solved"}}), "runs") ==
          std::to_string(tally.verdicts[static_cast<int>(Outcome::kCycle)][0]));
    CHECK(only("trust", {{"generator", key.generator}, {"what", "audited runs, misjudged"}}, "count") ==
          std::to_string(tally.misjudged));
    CHECK(only("trust", {{"generator", key.generator}, {"what", "runs with a wrong answer"}}, "count") ==
          std::to_string(tally.wrong));
  }
  for (const int contacts : {2, 3}) {
    const Row of = {{"contacts", std::to_string(contacts)}};
    const auto with = [&of](Row more) {
      more.insert(of.begin(), of.end());
      return more;
    };
    CHECK(only("loop-steps", with({{"zero_steps", "5"}}), "loops") ==
          std::to_string(record.loops.at(contacts).by_zero_steps.at(5)));
    const ExistenceTally& existence = record.existence.at(contacts);
    CHECK(only("driving", with({{"what", "folds"}}), "count") == std::to_string(existence.with_folds));
    CHECK(only("driving", with({{"what", "ties"}}), "count") == std::to_string(existence.with_ties));
    CHECK(only("methods", with({{"method", "complete driving"}}), "solved") ==
          std::to_string(existence.solved));
    CHECK(only("methods", with({{"method", "Lemke’s method"}}), "solved") ==
          std::to_string(record.agreement.at(contacts).compared - record.agreement.at(contacts).disagreements));
  }
  CHECK(only("methods", {{"method", "Ipopt"}}, "solved") == "1");
  CHECK(only("methods", {{"method", "published, exact"}, {"asked_about", "finished findings"}}, "solved") ==
        "0");
  const Tally& tally = record.tallies.at({"integers", 2, "paper"});
  CHECK(only("methods", {{"method", "published, in doubles"}, {"contacts", "2"}}, "solved") ==
        std::to_string(tally.outcomes[0] - tally.wrong));
}

// ---- Since an earlier report ----

TEST_CASE("since: the page, its data and since.csv say what is new, finished, met more often, or gone") {
  const Scratch scratch;
  Store store(scratch / "s", kIdentity);
  Record record = SampleRecord();
  record.signatures.erase(kCounted);
  record.signatures["cycle-gone"] = 3;
  store.AddUnit({}, 0, record, {PendingFinding(kDone, 0), PendingFinding(kPending, 0)});
  WriteReport(store, scratch / "earlier");
  WriteReport(SampleStore(scratch / "later"), scratch / "out", Occupied::kRefused, {{}, scratch / "earlier"});
  std::map<std::string, std::string> changes;
  for (const Row& row : ReadTable(scratch / "out/since.csv")) changes[row.at("signature")] = row.at("change");
  CHECK(changes ==
        std::map<std::string, std::string>{{kDone, "finished"}, {kCounted, "new"}, {"cycle-gone", "gone"}});
  const std::string page = PagesOf(scratch / "out");
  CHECK(Has(
      page,
      "Since the earlier report: 1 new, 1 finished that were not, and 0 met more often, of 3 groups; it had "
      "3. 1 of those are not here"));
  const Json findings = ListedIn(ReadText(scratch / "out/findings.html"));
  for (const Json& finding : findings)
    CHECK(finding["change"] == (finding["signature"] == kDone ? "finished" : ""));
  CHECK(Has(page, ">cycle<small>whole grid finished</small>"));

  Store more = SampleStore(scratch / "more");
  more.AddUnit({}, 1, SampleRecord(), {});
  WriteReport(more, scratch / "again", Occupied::kRefused, {{}, scratch / "out/findings.csv"});
  const auto rows = ReadTable(scratch / "again/since.csv");
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].at("change") == "more");
  CHECK(rows[0].at("count_before") == "1234");
  CHECK(rows[0].at("count") == "2468");
  CHECK_FALSE(Has(PagesOf(scratch / "earlier"), "Since the earlier report"));
}

TEST_CASE("since: what is no findings.csv is refused by its place") {
  const Scratch scratch;
  const auto refused = [&scratch](const std::string& text) {
    std::ofstream(scratch / "findings.csv") << text;
    try {
      ReadSince(scratch / "findings.csv");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  CHECK(Has(refused(""), "findings.csv:1: found no column signature"));
  CHECK(Has(refused("signature,count\r\n"), "found no column state"));
  CHECK(Has(refused("signature,count,state\r\na,b,finished\r\n"), "row 2: count: found 'b', expected a count"));
  CHECK(Has(refused("signature,count,state\r\na,-1,finished\r\n"), "found '-1'"));
  CHECK(Has(refused("signature,count,state\r\na,1\r\n"), "row 2: found 2 cells, expected 3"));
  CHECK(Has(refused("signature,count,state\r\n\"a,1,x\r\n"), "row 2: found a quotation that does not end"));
  CHECK(refused("signature,count,state\r\n\"a\"\",\nb\",1,finished\r\n") == "nothing");
  CHECK(ReadSince(scratch / "findings.csv").earlier.begin()->first == "a\",\nb");
  CHECK_THROWS_AS(ReadSince(scratch / "nowhere"), InputError);
}

// ---- Pictures ----

TEST_CASE("report: a finding that was found with a scene shows it, without ids") {
  Finding finding = PendingFinding(kDone, 0);
  CHECK(PictureOfFinding(finding).empty());
  Json problem = ParseJson(kProblem, "problem");
  problem["scene"] = ParseJson(ReadText(fs::path(STICTION_SCENES) / "block-in-a-valley.json"), "scene");
  finding.problem = JsonText(problem);
  const std::string picture = PictureOfFinding(finding).markup();
  CHECK(Has(picture, "aria-label=\"Scene of " + kDone + ": "));
  CHECK(Has(picture, "touching at 2 points"));
  CHECK_FALSE(Has(picture, " id="));
  CHECK_FALSE(Has(picture, "style="));
  problem["scene"] = "that of the parent";
  finding.problem = JsonText(problem);
  CHECK(PictureOfFinding(finding).empty());
}

// ---- All of it ----

TEST_CASE("report: the same content gives the same bytes, in whatever order it came into the store") {
  const Scratch scratch;
  const auto fill = [](Store& store, const std::vector<std::int64_t>& units) {
    for (const std::int64_t unit : units)
      store.AddUnit({}, unit, SampleRecord(), {PendingFinding(kDone, unit)});
    store.Finish(Finished(PendingFinding(kDone, 0)));
  };
  Store one(scratch / "one", kIdentity), two(scratch / "two", kIdentity);
  fill(one, {0, 1, 2});
  fill(two, {2, 0, 1});
  WriteReport(one, scratch / "a");
  WriteReport(two, scratch / "b");
  const auto contents = Contents(scratch / "a");
  CHECK(contents.size() == 18 + 10 + 5 + 1);  // tables, figures, files of the finding, and the list of them
  CHECK(contents == Contents(scratch / "b"));
  WriteReport(one, scratch / "a");
  CHECK(contents == Contents(scratch / "a"));
}

TEST_CASE("report: a directory that cannot be written is an input error that names it") {
  const Scratch scratch;
  const Store store = SampleStore(scratch / "s");
  std::ofstream(scratch / "file") << "in the way";
  CHECK_THROWS_AS(WriteReport(store, scratch / "file"), InputError);
  CHECK_THROWS_WITH(WriteReport(store, scratch / "file"), Catch::Contains((scratch / "file").string()));
  fs::create_directories(scratch / "out/index.html");
  CHECK_THROWS_AS(WriteReport(store, scratch / "out"), InputError);
}

TEST_CASE("report: files of others in the directory are refused by name, or kept in another directory") {
  const Scratch scratch;
  const Store store = SampleStore(scratch / "s");
  fs::create_directories(scratch / "out/findings");
  std::ofstream(scratch / "out/findings/notes.json") << "mine";
  CHECK_THROWS_WITH(WriteReport(store, scratch / "out"), Catch::Contains("found 'findings"));
  CHECK(WriteReport(store, scratch / "out", Occupied::kSetAside) == scratch / "out.old");
  CHECK(ReadText(scratch / "out.old/findings/notes.json") == "mine");
  CHECK_FALSE(fs::exists(scratch / "out/findings/notes.json"));
}

// ---- Building blocks ----

TEST_CASE("report: numbers for people") {
  CHECK(Grouped(0) == "0");
  CHECK(Grouped(999) == "999");
  CHECK(Grouped(1000) == "1,000");
  CHECK(Grouped(-1234567) == "-1,234,567");
  CHECK(Grouped(-123) == "-123");
  CHECK(Mean(7, 2) == "3.50");
  CHECK(Counted(1, "contact") == "1 contact");
  CHECK(Counted(1200, "contact") == "1,200 contacts");
}

TEST_CASE("report: text and attribute values are escaped, tables keep their shape") {
  CHECK(Text("a<b & \"c\" > 'd'").markup() == "a&lt;b &amp; &quot;c&quot; &gt; &#39;d&#39;");
  CHECK(Tag("a", {{"href", "x\"y"}, {"class", ""}})("<").markup() == "<a href=\"x&quot;y\">&lt;</a>");
  Table table{"name", "caption", {{"one"}, {"two"}}};
  CHECK_THROWS_AS(table.Add({"alone"}), InternalError);
}

}  // namespace
}  // namespace stiction
