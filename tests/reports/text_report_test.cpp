// SPDX-License-Identifier: Apache-2.0
// A store as text: the most important first, every number a sum over its records, as wide as a pipe.

#include "reports/text/text_report.h"

#include <catch2/catch.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "corpus/intervals.h"
#include "corpus/plain_text.h"
#include "corpus/record/kinds.h"
#include "corpus/store/store_totals.h"
#include "tests/scratch.h"
#include "tests/two_policies.h"

namespace stiction {
namespace {

using Catch::Matchers::Contains;
using testing::MinimizedTo;
using testing::Scratch;
using testing::TwoPolicies;

const std::string kTextProblem =
    R"({"format":"stiction-problem","version":1,"name":"smaller","dimension":2,)"
    R"("contacts":[{"kind":"static","mu":"5/17"}],"A":[["19","-3/23"],["-3/23","1"]],"b":["-1","29"]})";

Finding Waiting(const std::string& signature, std::string_view kind, std::int64_t unit) {
  return testing::Waiting(signature, kind, unit, kTextProblem);
}

const CampaignIdentity kTextIdentity = {
    R"({"format":"stiction-campaign","version":1,"generators":["psd"],"contacts":[2]})", 7, R"(["paper"])"};

Store StoreOf(const std::filesystem::path& file, bool grave = false) {
  Store store(file, kTextIdentity);
  const Finding cycle = Waiting("cycle-2c-4d-10s-00", "cycle", 0), ray = Waiting("ray-2c", "ray", 0);
  Record record = TwoPolicies();
  if (grave) record.signatures["safe-cycle-2c-4d-10s-00"] = 3;
  store.AddUnit({}, 0, record, {cycle, ray});
  store.AddUnit({}, 1, record, {Waiting("cycle-2c-4d-12s-00", "cycle", 1)});
  store.Finish(MinimizedTo(cycle, kTextProblem, R"({"cycle":36,"solved":1500})"));
  store.Finish(MinimizedTo(ray, "{}", R"({"ray":1536})"));
  if (grave) store.AddUnit({}, 2, {}, {Waiting("safe-cycle-2c-4d-10s-00", kSafeCycle, 2)});
  return store;
}

std::string_view KnownNone(std::string_view) { return {}; }
std::string_view KnownTenSteps(std::string_view signature) {
  return signature == "cycle-2c-4d-10s-00" ? "two-contact-cycle" : "";
}

std::vector<std::string> LinesOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// As one line, each run of blanks one blank.
std::string Flowing(const std::string& text) {
  std::istringstream stream(text);
  std::string flowing;
  for (std::string word; stream >> word;) flowing += word + " ";
  return flowing;
}

TEST_CASE("text: loops come before all other findings, as a sentence and in every list") {
  const Scratch scratch;
  const Store store = StoreOf(scratch / "s.store");
  for (const std::string& text : {SummaryText(store, "the.store"), TextReport(store, "the.store", KnownNone)}) {
    const std::string flowing = Flowing(text);
    const std::size_t loops = flowing.find("loops for ever in"), kind = flowing.find("loop for ever cycle"),
                      ray = flowing.find("ray");
    CHECK(loops < kind);
    CHECK(kind < ray);
  }
  const std::string summary = SummaryText(store, "the.store");
  const std::size_t simplest = summary.find("Simplest, proved and minimized");
  REQUIRE(simplest != std::string::npos);
  // Though the ray's problem is shorter.
  CHECK(summary.find("cycle-2c-4d-10s-00", simplest) < summary.find("ray-2c", simplest));
}

TEST_CASE("text: what is grave is named before anything was found") {
  const Scratch scratch;
  const Store store = StoreOf(scratch / "s.store", true);
  for (const std::string& text : {SummaryText(store, "the.store"), TextReport(store, "the.store", KnownNone)}) {
    CHECK(LinesOf(text).at(2) == "  GRAVE: safe-cycle: safe-cycle-2c-4d-10s-00");
    CHECK_THAT(Flowing(text), Contains("1 of safe-cycle"));
  }
}

TEST_CASE("text: every number is a sum over the units") {
  const Scratch scratch;
  const Store store = StoreOf(scratch / "s.store");
  for (const std::string& text :
       {Flowing(SummaryText(store, "the.store")), Flowing(TextReport(store, "the.store", KnownNone))}) {
    CHECK_THAT(text, Contains("the.store: 60 problems in 2 units, seed 7; 120 runs"));
    CHECK_THAT(text,
               Contains("The published algorithm, under 2 policies (paper, ties=contacts), loops for ever"));
    CHECK_THAT(text, Contains("loops for ever in 4 runs: " + RateText(4, 120) + " in a million"));
    CHECK_THAT(
        text,
        Contains("Found in 2 groups; of 1 finished, 0 loop under every policy that stiction distinguishes"));
    CHECK_THAT(text, Contains("in the periods of 92 loops: 6 have none, 4 have no others."));
    CHECK_THAT(text, Contains("loop for ever cycle 4 " + RateText(4, 120)));
    CHECK_THAT(text, Contains("a step without limit ray 2 " + RateText(2, 120)));
    CHECK_THAT(text, Contains("FAILED on 2: of 26 problems given to complete driving 24 solved"));
    CHECK_THAT(text, Contains("on 34 problems, on 38 of them all contact modes, too: 46 disagreements"));
    CHECK_THAT(text, Contains("62 of 58 audited problems are safe"));
    CHECK_THAT(text, Contains("Groups of findings: 2 of cycle, 1 of ray."));
    CHECK_THAT(text, Contains("in 2 runs they differ from exact arithmetic (" + RateText(2, 120)));
    CHECK_THAT(text, Contains("in 22 runs they call solved what is not (" + RateText(22, 120)));
    CHECK_THAT(
        text,
        Contains(
            "They were suspected in 8 runs, and right in 6 of them; of 14 audited runs, 10 were misjudged."));
    CHECK_THAT(text, Contains("14 of 112 runs without a suspicion were audited; " + ShareText(10, 14)));
    CHECK_THAT(text, Contains("2 certified and minimized, 1 to go"));
    CHECK_THAT(text, Contains("stiction search --store the.store --finish"));
  }
}

TEST_CASE("text: the page has exact rates by policy, generator and contacts, and by friction") {
  const Scratch scratch;
  const std::string text = Flowing(TextReport(StoreOf(scratch / "s.store"), "the.store", KnownNone));
  CHECK_THAT(
      text,
      Contains("Policy paper: generator contacts runs loops in a million [95 %] singular rays psd 2 60 4 " +
               RateText(4, 60) + " 0 2 "));
  CHECK_THAT(
      text,
      Contains("Policy ties=contacts: generator contacts runs loops in a million [95 %] singular rays psd 2 "
               "60 0 " +
               RateText(0, 60) + " 0 0 "));
  CHECK_THAT(text, Contains("1/2 60 4 " + RateText(4, 60) + " 0 0 "));
}

TEST_CASE("text: what doubles do otherwise is no disagreement of exact methods") {
  const Scratch scratch;
  Store store(scratch / "s.store", kTextIdentity);
  Record record = TwoPolicies();
  for (auto& [contacts, tally] : record.agreement) tally.disagreements = 0;
  record.signatures = {{"disagreement-ray-solved-2c", 1}, {"disagreement-ray-solved-3c", 1}};
  store.AddUnit({}, 0, record, {Waiting("disagreement-ray-solved-2c", "disagreement", 0)});
  const std::string text = Flowing(SummaryText(store, "s.store"));
  CHECK_THAT(text, Contains("Groups of findings: 2 of disagreement-ray-solved (doubles: ray, exact: solved)."));
  CHECK_THAT(text, Contains("all contact modes, too: they never disagree with each other."));
  CHECK_THAT(text, !Contains("0 disagreements"));
}

TEST_CASE("text: a disagreement of methods that only finishing shows is counted") {
  const Scratch scratch;
  Store store(scratch / "s.store", kTextIdentity);
  Record record = TwoPolicies();
  for (auto& [contacts, tally] : record.agreement) tally.disagreements = 0;
  Finding finding = Waiting("ray-2c", "ray", 0);
  store.AddUnit({}, 0, record, {finding});
  CHECK(TotalsOf(store).disagreements == 0);
  finding.kind = kDisagreementOfMethods;
  finding.done = true;
  finding.facts = R"({"disagreement":"lemke ended in ray, expected solved"})";
  store.Finish(finding);
  CHECK(TotalsOf(store).disagreements == 1);
  CHECK_THAT(Flowing(SummaryText(store, "s.store")), Contains("too: 1 disagreement."));
}

TEST_CASE("text: the simplest loop stands in numbers, with commands that replay it") {
  const Scratch scratch;
  const std::string text = TextReport(StoreOf(scratch / "s.store"), "a store's", KnownNone);
  CHECK_THAT(text, Contains("The simplest loop: cycle-2c-4d-10s-00"));
  CHECK_THAT(Flowing(text),
             Contains("the state after 3 drives recurs 1 drive later; policies: 36 cycle, 1500 solved"));
  CHECK_THAT(Flowing(text), Contains("19 -3/23 -1 -3/23 1 29 mu = 5/17"));
  CHECK_THAT(text, Contains("    stiction report 'a store'\\''s' -o report\n"));
  CHECK_THAT(text, Contains("    stiction replay report/findings/cycle-2c-4d-10s-00.json --step\n"));
  CHECK_THAT(text, Contains("    stiction problem 'a store'\\''s' 0 7\n"));
}

TEST_CASE("text: loops that the corpus has are told from new ones") {
  const Scratch scratch;
  const Store store = StoreOf(scratch / "s.store");
  CHECK_THAT(TextReport(store, "s", KnownNone), Contains("Of 2 groups 2 are shown by no case of the corpus"));
  const std::string text = TextReport(store, "s", KnownTenSteps);
  CHECK_THAT(text, Contains("Of 2 groups 1 is shown by no case of the corpus"));
  const std::string unknown = text.substr(text.find("New groups of loops"));
  CHECK_THAT(unknown, Contains("cycle-2c-4d-12s-00"));
  CHECK_THAT(unknown, !Contains("cycle-2c-4d-10s-00"));
}

TEST_CASE("text: a store without loops says how rare they can be, one of nothing that there is nothing") {
  const Scratch scratch;
  Store store(scratch / "s.store", kTextIdentity);
  CHECK_THAT(SummaryText(store, "s"), Contains("No findings."));
  CHECK_THAT(TextReport(store, "s", KnownNone), Contains("s: 0 problems in 0 units, seed 7\n"));
  Record record;
  record.tallies[{"psd", 2, "paper"}].problems = 1000;
  store.AddUnit({}, 0, record, {});
  CHECK_THAT(Flowing(TextReport(store, "s", KnownNone)),
             Contains("No run of the published algorithm, under the policy paper, was found to loop: " +
                      RateText(0, 1000) + " in a million"));
}

TEST_CASE("text: no line is wider than a pipe, and nothing steers a terminal") {
  const Scratch scratch;
  Store store(scratch / "s.store", kTextIdentity);
  Record record = TwoPolicies();
  record.signatures["cycle-2c-\x1b[31m-red\r\n"] = 3;
  store.AddUnit({}, 0, record, {Waiting("cycle-2c-\x1b[31m-red\r\n", "cycle", 0)});
  store.Finish(MinimizedTo(Waiting("cycle-2c-\x1b[31m-red\r\n", "cycle", 0), kTextProblem, R"({"cycle":1})"));
  for (const std::string& text : {SummaryText(store, "s"), TextReport(store, "s", KnownNone)}) {
    CHECK(text.find('\x1b') == std::string::npos);
    CHECK(text.find('\r') == std::string::npos);
    for (const std::string& line : LinesOf(text)) {
      const bool is_command = line.starts_with("    stiction ");  // to be copied whole
      CHECK((is_command || line.size() <= kUsualTextWidth));
    }
  }
}

TEST_CASE("text: paragraphs break between words alone, intervals stay whole") {
  const std::string filled(kUsualTextWidth - 4, 'x');
  CHECK(Paragraph(filled + " [1, 2] end") == "  " + filled + "\n  [1, 2] end\n");
  CHECK(Paragraph("a  b", 0) == "a b\n");
  CHECK(Paragraph("") == "");
  const std::string endless(kUsualTextWidth + 10, 'y');
  CHECK(Paragraph("a " + endless + " b") == "  a\n  " + endless + "\n  b\n");
  CHECK(Paragraph("open [1, 2") == "  open [1, 2\n");
}

TEST_CASE("text: what does not fit the terminal goes on below") {
  const FixedTextWidth narrow(24);
  TextTable table({"name", "first", "second", "third"}, 1);
  table.AddRow({"abc", "1,000", "2", "3"});
  CHECK(table.Done() == "  name  first  second\n  abc   1,000       2\n\n  name  third\n  abc       3\n");
  TextTable numbers({"first", "second", "third", "fourth"}, 0);
  numbers.AddRow({"1", "2", "3", "4"});
  CHECK(numbers.Done() == "  first  second  third\n      1       2      3\n\n  fourth\n       4\n");
  CHECK(Folded("one two three four five six\nshort") == "one two three four five\n  six\nshort");
  CHECK(Folded("key   a value that is long") == "key   a value that is\n      long");
  CHECK(Folded("    x   y\n") == "    x   y\n");
  CHECK(Folded(std::string(30, 'x')) == std::string(30, 'x'));
  CHECK(Paragraph("one two three four five six", 0) == "one two three four five\nsix\n");
}

TEST_CASE("text: a table has its names to the left and its numbers to the right") {
  TextTable table({"name", "n"}, 1);
  CHECK(table.Done() == "");
  table.AddRow({"\xc3\xa9t\xc3\xa9", "1,000"});
  table.AddRow({"a", "1"});
  CHECK(table.Done() == "  name      n\n  \xc3\xa9t\xc3\xa9   1,000\n  a         1\n");
}

}  // namespace
}  // namespace stiction
