// SPDX-License-Identifier: Apache-2.0
// What a search wrote passes, and each thing that none writes is refused by its place.

#include "search/testimony.h"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>

#include "corpus/json.h"
#include "corpus/record/kinds.h"
#include "search/campaign.h"
#include "search/units/finish.h"
#include "search/units/unit.h"

namespace stiction {
namespace {

// A unit of a search and a loop of it, finished. Made once.
struct Searched {
  Campaign campaign;
  Record record;
  Finding finding, unfinished;
};

const Searched& OfSearch() {
  static const Searched kSearched = [] {
    Searched searched;
    Campaign& campaign = searched.campaign;
    campaign.generators = {GeneratorId::kNearDegenerate};
    campaign.contacts = {2};
    campaign.unit_problems = 60000;
    campaign.representatives_per_unit = 100;
    campaign.enumerate_every = 500;
    campaign.audit_every = 500;
    UnitResult result = UnitRunner(campaign).Run(0);
    const auto loop = std::ranges::find(result.candidates, "cycle", &Finding::kind);
    REQUIRE(loop != result.candidates.end());
    searched.record = std::move(result.record);
    searched.unfinished = *loop;
    const auto finished = FinishFinding(*loop, campaign.limits, [] { return false; });
    REQUIRE(finished.has_value());
    searched.finding = *finished;
    return searched;
  }();
  return kSearched;
}

// The same of a solver under test.
Searched OfSolver() {
  Searched searched = OfSearch();
  searched.campaign.solver = {"toy", "1", SolverLaw::kCoulomb, "1e-06"};
  Finding& finding = searched.finding;
  finding.kind = "crash";
  finding.signature = "crash-sigsegv-2c";
  finding.certificate = finding.minimized_certificate = "";
  finding.facts = R"({"library": true, "found": {}, "alone": true, "minimized": {"contacts": 2}})";
  searched.record = {};
  searched.record.signatures = {{finding.signature, 3}};
  UnderTestTally tally;
  tally.problems = 5;
  tally.passed = 2;
  tally.crash = 3;
  tally.leak = tally.misses_coulomb = tally.neither = 1;
  searched.record.under_test[{"near-degenerate", 2, "1/2", 3, 1}] = tally;
  return searched;
}

void RequireRefused(const std::string& what, const std::string& says, const std::function<void()>& require) {
  CAPTURE(what);
  CHECK_THROWS_WITH(require(), Catch::Contains(says) && Catch::Contains("a.store"));
}

// A change that no search makes, and a part of the refusal.
template <class Part>
struct Falsified {
  const char* says;
  std::function<void(Part&)> change;
};

template <class Part>
void RequireAllRefused(const Part& whole, const Campaign& campaign,
                       const std::vector<Falsified<Part>>& falsified) {
  CHECK_NOTHROW(RequireSound(whole, campaign, "a.store"));
  for (std::size_t k = 0; k < falsified.size(); ++k) {
    Part changed = whole;
    falsified[k].change(changed);
    CHECK_FALSE(changed == whole);
    RequireRefused(fmt::format("{}: {}", k, falsified[k].says), falsified[k].says,
                   [&] { RequireSound(changed, campaign, "a.store"); });
  }
}

// Facts in which the member at a pointer is another, or gone.
std::function<void(Finding&)> WithFact(const char* pointer, const Json& value) {
  return [pointer, value](Finding& finding) {
    Json facts = Json::parse(finding.facts);
    facts[Json::json_pointer(pointer)] = value;
    finding.facts = facts.dump();
  };
}
std::function<void(Finding&)> WithoutFact(const char* pointer) {
  return [pointer](Finding& finding) {
    Json facts = Json::parse(finding.facts);
    const Json::json_pointer place(pointer);
    facts[place.parent_pointer()].erase(place.back());
    finding.facts = facts.dump();
  };
}

}  // namespace

TEST_CASE("testimony: a finding is of its campaign and its unit, and its parts are of its problem") {
  const Finding& finding = OfSearch().finding;
  const Campaign& campaign = OfSearch().campaign;
  CHECK_NOTHROW(RequireSound(OfSearch().unfinished, campaign, "a.store"));
  constexpr std::int64_t kBeyond = std::int64_t{1} << 62;
  const std::vector<Falsified<Finding>> falsified = {
      {"kind: found 'nonsense'", [](Finding& f) { f.kind = "nonsense"; }},
      {"kind: found 'crash'", [](Finding& f) { f.kind = "crash"; }},
      {"signature: found 'loop-", [](Finding& f) { f.signature = "loop-2c"; }},
      {"unit: found -1", [](Finding& f) { f.unit = -1; }},
      {"unit: found 4611686018427387904", [](Finding& f) { f.unit = kBeyond; }},
      {"index: found -1", [](Finding& f) { f.index = -1; }},
      {"index: found 4611686018427387904", [](Finding& f) { f.index = kBeyond; }},
      {"generator: found 'psd'", [](Finding& f) { f.generator = "psd"; }},
      {"contacts: found 3", [](Finding& f) { f.contacts = 3; }},
      {"policy: found 'ties=contacts'", [](Finding& f) { f.policy = "ties=contacts"; }},
      {"inexact_outcome: found 'won'", [](Finding& f) { f.inexact_outcome = "won"; }},
      {"exact_outcome: found 'won'", [](Finding& f) { f.exact_outcome = "won"; }},
      {"problem", [](Finding& f) { f.problem = "{}"; }},
      {"minimized_certificate: found one", [](Finding& f) { f.minimized = f.minimized_existence = ""; }},
      {"minimized_existence: found one", [](Finding& f) { f.minimized = f.minimized_certificate = ""; }},
      {"certificate: found the certificate of", [](Finding& f) { f.certificate = f.minimized_certificate; }},
      {"existence: found the certificate of", [](Finding& f) { f.existence = f.minimized_existence; }},
      {"minimized_certificate: found the", [](Finding& f) { f.minimized_certificate = f.certificate; }},
      {"minimized_existence: found the", [](Finding& f) { f.minimized_existence = f.existence; }},
  };
  REQUIRE(finding.problem != finding.minimized);
  RequireAllRefused(finding, campaign, falsified);
  for (const char* const key : {"format", "version", "claim", "problem", "witness"}) {
    Finding without = finding;
    Json certificate = Json::parse(finding.certificate);
    certificate.erase(key);
    without.certificate = certificate.dump();
    RequireRefused(key, key, [&] { RequireSound(without, campaign, "a.store"); });
  }
}

TEST_CASE("testimony: facts are those of a run, of as many contacts, and of a finished finding") {
  const Finding& finding = OfSearch().finding;
  const Campaign& campaign = OfSearch().campaign;
  std::vector<Falsified<Finding>> falsified = {
      {"facts: found none", [](Finding& f) { f.facts.clear(); }},
      {"more", WithFact("/more", 1)},
      {"more", WithFact("/found/more", 1)},
      {"outcome", WithFact("/ipopt/outcome", 1)},
      {"starts", WithFact("/ipopt/starts", -1)},
      {"more", WithFact("/ipopt/more", 1)},
      {"disagreement", WithFact("/disagreement", 1)},
      {"expected 2", WithFact("/found/contacts", 3)},
      {"expected 2", WithFact("/found/contacts", 1)},
      {"an outcome", WithFact("/found/outcome", "won")},
      {"an outcome", WithFact("/found/grid/won", 1)},
      {"a count", WithFact("/found/grid/solved", -1)},
      {"true, false or null", WithFact("/found/safe", 1)},
      {"more", WithFact("/found/existence/more", 1)},
      {"a claim or null", WithFact("/found/existence/claim", 1)},
      {"claim", WithoutFact("/found/existence/claim")},
      {"existence", WithoutFact("/found/existence")},
      {"grid", WithoutFact("/found/grid")},
      {"contacts", WithFact("/minimized/contacts", 7)},
      {"facts: found none", WithoutFact("/minimized")},
      {"found", WithoutFact("/found")},
  };
  for (const char* const key : {"/found/start", "/found/period", "/found/steps", "/minimized/steps"}) {
    falsified.push_back({"a count", WithFact(key, -1)});
    falsified.push_back({"a count", WithFact(key, 1e300)});
    falsified.push_back({"expected", WithoutFact(key)});
  }
  RequireAllRefused(finding, campaign, falsified);
  Finding unknown = finding;
  WithFact("/found/safe", nullptr)(unknown);
  CHECK_NOTHROW(RequireSound(unknown, campaign, "a.store"));

  // What is said before it is finished is held to the same.
  Finding begun = OfSearch().unfinished;
  CHECK(begun.facts.empty());
  begun.facts = Json{{"found", Json::parse(finding.facts).at("found")}}.dump();
  RequireAllRefused(begun, campaign,
                    {{"a count", WithFact("/found/steps", -1)},
                     {"facts: found those of a minimized problem",
                      WithFact("/minimized", Json::parse(finding.facts).at("minimized"))}});
  begun.facts = R"({"disagreement": "methods differ", "answers": {}})";
  CHECK_NOTHROW(RequireSound(begun, campaign, "a.store"));
}

TEST_CASE("testimony: facts of a solver under test are those of its failure") {
  const Searched searched = OfSolver();
  RequireAllRefused<Finding>(searched.finding, searched.campaign,
                             {{"kind: found 'cycle'", [](Finding& f) { f.kind = "cycle"; }},
                              {"more", WithFact("/more", 1)},
                              {"library", WithFact("/library", 1)},
                              {"found", WithoutFact("/found")},
                              {"found", WithFact("/found", 1)},
                              {"facts: found others", WithoutFact("/alone")},
                              {"alone", WithFact("/alone", 1)},
                              {"facts: found those of a finished finding", [](Finding& f) { f.done = false; }},
                              {"facts: found none", WithoutFact("/minimized")},
                              {"minimized", WithFact("/minimized", 1)},
                              {"contacts", WithoutFact("/minimized/contacts")},
                              {"at most as many", WithFact("/minimized/contacts", 3)},
                              {"at most as many", WithFact("/minimized/contacts", -1)},
                              {"scene", WithFact("/scene", 1)},
                              {"facts: found those of a minimized problem",
                               [](Finding& f) { f.minimized = f.minimized_existence = ""; }}});
  Finding begun = searched.finding;
  begun.done = false;
  begun.minimized = begun.minimized_existence = "";
  begun.facts = R"({"library": false, "found": {}})";
  CHECK_NOTHROW(RequireSound(begun, searched.campaign, "a.store"));
}

namespace {

// A change of the only tally.
std::function<void(Record&)> OfTally(const std::function<void(Tally&)>& change) {
  return [change](Record& record) { change(record.tallies.begin()->second); };
}
std::function<void(Record&)> OfStratum(const std::function<void(Stratum&)>& change) {
  return OfTally([change](Tally& tally) { change(tally.strata.begin()->second); });
}
// The only tally, of another key.
std::function<void(Record&)> OfKey(const std::function<void(TallyKey&)>& change) {
  return [change](Record& record) {
    auto node = record.tallies.extract(record.tallies.begin());
    change(node.key());
    record.tallies.insert(std::move(node));
  };
}
std::function<void(Record&)> OfStratumKey(const std::function<void(StratumKey&)>& change) {
  return OfTally([change](Tally& tally) {
    auto node = tally.strata.extract(tally.strata.begin());
    change(node.key());
    tally.strata.insert(std::move(node));
  });
}
std::function<void(Record&)> OfLoops(const std::function<void(LoopTally&)>& change) {
  return [change](Record& record) { change(record.loops.begin()->second); };
}

}  // namespace

TEST_CASE("testimony: statistics are of the campaign's families, and their counts add up") {
  const Record& record = OfSearch().record;
  REQUIRE(record.tallies.size() == 1);
  REQUIRE_FALSE(record.loops.empty());
  REQUIRE_FALSE(record.existence.empty());
  REQUIRE_FALSE(record.agreement.empty());
  const std::string signature = record.signatures.begin()->first;
  constexpr auto kSolvedEnd = static_cast<std::size_t>(Outcome::kSolved);
  RequireAllRefused<Record>(
      record, OfSearch().campaign,
      {{"generator: found 'psd'", OfKey([](TallyKey& key) { key.generator = "psd"; })},
       {"generator: found 'none'", OfKey([](TallyKey& key) { key.generator = "none"; })},
       {"contacts: found 3", OfKey([](TallyKey& key) { key.contacts = 3; })},
       {"policy: found 'ties=contacts'", OfKey([](TallyKey& key) { key.policy = "ties=contacts"; })},
       {"method: found 'lemke'", OfKey([](TallyKey& key) { key.method = "lemke"; })},
       {"arithmetic: found 'float'", OfKey([](TallyKey& key) { key.arithmetic = "float"; })},
       {"outcomes: found", OfTally([](Tally& t) { ++t.outcomes[kSolvedEnd]; })},
       {"steps: found", OfTally([](Tally& t) { ++t.steps[5]; })},
       {"misjudged: found", OfTally([](Tally& t) { t.misjudged = t.audited + 1; })},
       {"wrong: found", OfTally([](Tally& t) { t.wrong = t.problems + 1; })},
       {"with_zero_steps: found", OfTally([](Tally& t) { t.with_zero_steps = t.problems + 1; })},
       {"with_give_ups: found", OfTally([](Tally& t) { t.with_give_ups = t.problems + 1; })},
       {"audited: found", OfTally([](Tally& t) { t.audited = t.problems + 1; })},
       {"strata: found other sums", OfTally([](Tally& t) { ++t.sums.steps; })},
       {"strata: found other sums", OfTally([](Tally& t) { ++t.sums.zero_steps; })},
       {"strata: found other sums", OfTally([](Tally& t) { ++t.verdicts[kSolvedEnd][kSolvedEnd]; })},
       {"strata: found other sums", OfStratum([](Stratum& s) { ++s.problems; })},
       {"strata: found other sums", OfStratum([](Stratum& s) { ++s.outcomes[kSolvedEnd]; })},
       {"strata: found other sums", OfStratum([](Stratum& s) { ++s.exact[kSolvedEnd]; })},
       {"strata: found other sums", OfStratum([](Stratum& s) { ++s.audited; })},
       {"strata: found other sums", OfStratum([](Stratum& s) { ++s.misjudged; })},
       {"friction: found '7/9'", OfStratumKey([](StratumKey& key) { key.friction = "7/9"; })},
       {"rank: found 5, expected at most 4", OfStratumKey([](StratumKey& key) { key.rank = 5; })},
       {"signatures: found 'loop-2c'", [](Record& r) { r.signatures["loop-2c"] = 1; }},
       {"statistics: found answers of a solver",
        [](Record& r) {
          r.under_test[{"near-degenerate", 2, "1", 3, 1}] = {};
        }},
       {"existence: found 3 contacts", [](Record& r) { r.existence[3] = {}; }},
       {"solved, expected at most",
        [](Record& r) { r.existence.at(2).solved = r.existence.at(2).problems + 1; }},
       {"agreement: found 3 contacts", [](Record& r) { r.agreement[3] = {}; }},
       {"without zero steps", OfLoops([](LoopTally& t) { t.without_zero_steps = t.loops + 1; })},
       {"of zero steps alone", OfLoops([](LoopTally& t) { t.of_zero_steps_alone = t.loops + 1; })},
       {"zero steps of", OfLoops([](LoopTally& t) { t.zero_steps = t.steps + 1; })},
       {"by their zero steps", OfLoops([](LoopTally& t) { ++t.by_zero_steps.begin()->second; })},
       {"words: found 'cycle-unmet'", [](Record& r) { r.words["cycle-unmet"].Add(1); }},
       {"at most 1, the loops that were met", [&signature](Record& r) {
          r.signatures[signature] = 1;
          r.words[signature].Add(1);
          r.words[signature].Add(2);
        }}});
  Record full = record;
  full.signatures[signature] = 2;
  full.words[signature] = {};
  full.words[signature].Add(1);
  full.words[signature].Add(2);
  CHECK_NOTHROW(RequireSound(full, OfSearch().campaign, "a.store"));
  const auto& strata = record.tallies.begin()->second.strata;
  CHECK(std::ranges::any_of(strata, [](const auto& s) { return s.first.friction == kMixedFriction; }));
}

TEST_CASE("testimony: answers of a solver under test come each to one end") {
  const Searched searched = OfSolver();
  const auto of_key = [](const std::function<void(UnderTestKey&)>& change) {
    return [change](Record& record) {
      auto node = record.under_test.extract(record.under_test.begin());
      change(node.key());
      record.under_test.insert(std::move(node));
    };
  };
  RequireAllRefused<Record>(
      searched.record, searched.campaign,
      {{"generator: found 'psd'", of_key([](UnderTestKey& key) { key.generator = "psd"; })},
       {"contacts: found 3", of_key([](UnderTestKey& key) { key.contacts = 3; })},
       {"friction: found '7/9'", of_key([](UnderTestKey& key) { key.friction = "7/9"; })},
       {"under_test: found 6 ends", [](Record& r) { ++r.under_test.begin()->second.hang; }},
       {"under_test: found 4 ends", [](Record& r) { --r.under_test.begin()->second.passed; }},
       {"statistics: found runs of the published algorithm",
        [](Record& r) { r.tallies = OfSearch().record.tallies; }}});
}

}  // namespace stiction
