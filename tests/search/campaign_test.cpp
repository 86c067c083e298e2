// SPDX-License-Identifier: Apache-2.0
// Campaigns: files are read strictly, what they mean is canonical, and every generator and size has its turn.

#include "search/campaign.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "corpus/input_error.h"
#include "corpus/json.h"
#include "search/algorithm_version.h"
#include "tests/scratch.h"

namespace stiction {
namespace {

namespace fs = std::filesystem;
using Catch::Matchers::Contains;

class CampaignFile {
 public:
  explicit CampaignFile(const std::string& text) {
    std::string pattern = (fs::temp_directory_path() / "stiction-campaign-XXXXXX").string();
    const int descriptor = mkstemp(pattern.data());
    REQUIRE(descriptor >= 0);
    close(descriptor);
    path_ = pattern;
    std::ofstream(path_) << text;
  }
  CampaignFile(const CampaignFile&) = delete;
  CampaignFile& operator=(const CampaignFile&) = delete;
  ~CampaignFile() { fs::remove(path_); }

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

Campaign Read(const std::string& text) { return ReadCampaign(CampaignFile(text).path()); }

// A file with these members beside format and version.
std::string With(const std::string& members) {
  return R"({"format": "stiction-campaign", "version": 1)" + (members.empty() ? "" : ", " + members) + "}";
}

// ---- Files -----------------------------------------------------------------------------------

TEST_CASE("campaign: what a file leaves out has its default") {
  CHECK(Read(With("")) == Campaign{});
  CHECK(Campaign{}.generators.size() == kOrdinaryGeneratorCount);
  CHECK(Campaign{}.policies == std::vector{Policy{}});
}

TEST_CASE("campaign: every key of a file is read") {
  const Campaign campaign = Read(With(
      R"("seed": 9223372036854775807, "generators": ["bodies", "psd"], "contacts": [8, 1], "mu": ["0", "1/3", "0.5"],
         "policies": ["paper", "ties=contacts"], "unit_problems": 11, "audit_every": 12,
         "complete_every": 19, "arithmetic": "filtered", "lemke_every": 17, "enumerate_every": 18, "representatives_per_unit": 13, "max_drives": 14, "max_pivots": 15, "max_bits": 16)"));
  CHECK(campaign.seed == std::numeric_limits<std::int64_t>::max());
  CHECK(campaign.generators == std::vector{GeneratorId::kBodies, GeneratorId::kPsd});
  CHECK(campaign.contacts == std::vector{8, 1});
  CHECK(campaign.palette == std::vector<MuChoice>{{0, 1}, {1, 3}, {1, 2}});
  CHECK(campaign.policies == std::vector{Policy{}, ParsePolicy("ties=contacts")});
  CHECK(campaign.unit_problems == 11);
  CHECK(campaign.audit_every == 12);
  CHECK(campaign.complete_every == 19);
  CHECK(campaign.arithmetic == Arithmetic::kFiltered);
  CHECK(campaign.lemke_every == 17);
  CHECK(campaign.enumerate_every == 18);
  CHECK(campaign.representatives_per_unit == 13);
  CHECK(campaign.limits == Limits{14, 15, 16});
}

TEST_CASE("campaign: a wrong file is refused with file, place, found and expected") {
  struct Wrong {
    std::string text, place, expected;
  };
  const std::string generators =
      "integers, psd, small, near-degenerate, duplicates, conditioned, bodies, exponential";
  const std::vector<Wrong> wrongs = {
      {"", "line 1, column 1", "expected JSON text"},
      {"{", "line 1, column 2", "expected JSON text"},
      {R"({"format": "stiction-campaign", "version": 1, "seed": 1, "seed": 2})", "seed: found a duplicate key",
       "expected each key once"},
      {"[]", "$: found []", "expected an object"},
      {"3", "$: found 3", "expected an object"},
      {"{}", "format: found nothing", "expected \"stiction-campaign\""},
      {R"({"format": "stiction-problem", "version": 1})", "format: found \"stiction-problem\"",
       "expected \"stiction-campaign\""},
      {R"({"format": 1, "version": 1})", "format: found 1", "expected \"stiction-campaign\""},
      {R"({"format": "stiction-campaign"})", "version: found nothing", "expected 1"},
      {R"({"format": "stiction-campaign", "version": 2})", "version: found 2", "expected 1"},
      {R"({"format": "stiction-campaign", "version": "1"})", "version: found \"1\"", "expected 1"},
      {With(R"("threads": 2)"), "threads: found an unknown key", "expected only format, version, seed"},
      {With(R"("threads": 2, "seed": -1, "unit_problems": 0)"), "threads: found an unknown key",
       "; seed: found -1, expected an integer from 0 to 9223372036854775807; unit_problems: found 0"},
      {With(R"("seed": -1)"), "seed: found -1", "expected an integer from 0 to 9223372036854775807"},
      {With(R"("seed": 1.0)"), "seed: found 1.0", "expected an integer from 0"},
      {With(R"("seed": "1")"), "seed: found \"1\"", "expected an integer from 0"},
      {With(R"("seed": 9223372036854775808)"), "seed: found 9223372036854775808", "expected an integer from 0"},
      {With(R"("seed": null)"), "seed: found null", "expected an integer from 0"},
      {With(R"("unit_problems": 0)"), "unit_problems: found 0",
       "expected an integer from 1 to 9007199254740992"},
      {With(R"("unit_problems": 9007199254740993)"), "unit_problems: found 9007199254740993",
       "expected an integer from 1"},
      {With(R"("audit_every": 0)"), "audit_every: found 0", "expected an integer from 1"},
      {With(R"("representatives_per_unit": 0)"), "representatives_per_unit: found 0",
       "expected an integer from 1"},
      {With(R"("max_drives": 0)"), "max_drives: found 0", "expected an integer from 1"},
      {With(R"("max_pivots": true)"), "max_pivots: found true", "expected an integer from 1"},
      {With(R"("max_bits": [])"), "max_bits: found []", "expected an integer from 1"},
      {With(R"("generators": [])"), "generators: found []", "expected a list that is not empty"},
      {With(R"("generators": "psd")"), "generators: found \"psd\"", "expected a list that is not empty"},
      {With(R"("generators": ["psd", 3])"), "generators[1]: found 3", "expected the name of a generator"},
      {With(R"("generators": ["psd", "PSD"])"), "generators[1]: found \"PSD\"",
       "expected one of " + generators},
      {With(R"("contacts": {})"), "contacts: found {}", "expected a list that is not empty"},
      {With(R"("contacts": [0])"), "contacts[0]: found 0", "expected a number of contacts, 1 to 8"},
      {With(R"("contacts": [2, 9])"), "contacts[1]: found 9", "expected a number of contacts, 1 to 8"},
      {With(R"("contacts": [2.5])"), "contacts[0]: found 2.5", "expected a number of contacts, 1 to 8"},
      {With(R"("mu": [])"), "mu: found []", "expected a list that is not empty"},
      {With(R"("mu": [1])"), "mu[0]: found 1", "expected a friction coefficient as a string"},
      {With(R"("mu": ["-1"])"), "mu[0]: found \"-1\"", "0 <= p <= 2147483647 and 1 <= q <= 2147483647"},
      {With(R"("mu": ["1", "2147483648"])"), "mu[1]: found \"2147483648\"",
       "0 <= p <= 2147483647 and 1 <= q <= 2147483647"},
      {With(R"("mu": ["1/2147483648"])"), "mu[0]: found \"1/2147483648\"",
       "0 <= p <= 2147483647 and 1 <= q <= 2147483647"},
      {With(R"("mu": ["1/0"])"), "mu[0]: found \"1/0\"", "0 <= p <= 2147483647 and 1 <= q <= 2147483647"},
      {With(R"("mu": ["one"])"), "mu[0]: found \"one\"", "0 <= p <= 2147483647 and 1 <= q <= 2147483647"},
      {With(R"("policies": [])"), "policies: found []", "expected a list that is not empty"},
      {With(R"("policies": [{}])"), "policies[0]: found {}", "expected a policy"},
      {With(R"("policies": ["paper", "ties=none"])"), "policies[1]: found \"ties=none\"", "ties"},
  };
  for (const Wrong& wrong : wrongs) {
    const CampaignFile file(wrong.text);
    CAPTURE(wrong.text);
    CHECK_THROWS_AS(ReadCampaign(file.path()), InputError);
    CHECK_THROWS_WITH(ReadCampaign(file.path()),
                      Contains(file.path().string() + ": " + wrong.place) && Contains(wrong.expected));
  }
}

TEST_CASE("campaign: a file that is not there, or a directory, is refused by name") {
  CHECK_THROWS_AS(ReadCampaign("/no/such/campaign.json"), InputError);
  CHECK_THROWS_WITH(ReadCampaign("/no/such/campaign.json"), Contains("/no/such/campaign.json"));
  CHECK_THROWS_WITH(ReadCampaign("/tmp"), Contains("/tmp") && Contains("a directory"));
}

TEST_CASE("campaign: friction coefficients are small fractions, however they are written") {
  CHECK(ParseMu("1/2") == MuChoice{1, 2});
  CHECK(ParseMu("0.5") == MuChoice{1, 2});
  CHECK(ParseMu("32/64") == MuChoice{1, 2});
  CHECK(ParseMu("128/256") == MuChoice{1, 2});
  CHECK(ParseMu("5e-1") == MuChoice{1, 2});
  CHECK(ParseMu("0") == MuChoice{0, 1});
  CHECK(ParseMu("64") == MuChoice{64, 1});
  CHECK(ParseMu("1/64") == MuChoice{1, 64});
  for (const char* text :
       {"", " 1", "1 ", "+1", "-0.5", "2147483648", "1/2147483648", "0.1e-9", "1/0", "inf", "nan", "1,5"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(ParseMu(text), InputError);
    CHECK_THROWS_WITH(ParseMu(text), Contains(fmt::format("found '{}', expected p/q", text)));
  }
}

// ---- Definition ------------------------------------------------------------------------------

TEST_CASE("campaign: the definition is a campaign file of the same campaign") {
  Campaign campaign = Read(With(
      R"("generators": ["small"], "contacts": [3, 2], "mu": ["2/4", "7"], "unit_problems": 50, "max_bits": 99)"));
  const std::string definition = DefinitionToJson(campaign).dump();
  CHECK(
      definition ==
      R"({"format":"stiction-campaign","version":1,"generators":["small"],"contacts":[3,2],"mu":["1/2","7"],)"
      R"("unit_problems":50,"audit_every":5000,"lemke_every":100,"enumerate_every":1000,)"
      R"("representatives_per_unit":4,"max_drives":1000,"max_pivots":10000,"max_bits":99,"complete_every":100})");
  CHECK(Read(definition) == campaign);
  CHECK(Read(DefinitionToJson(Campaign{}).dump()) == Campaign{});
}

TEST_CASE("campaign: a store's identity is its campaign") {
  Campaign campaign =
      Read(With(R"("seed": 12, "generators": ["bodies"], "contacts": [4], "enumerate_every": 3)"));
  campaign.policies = {ParsePolicy("ties=contacts"), Policy{}};
  CHECK(CampaignOf(IdentityOf(campaign), "store") == campaign);
  CHECK_THROWS_WITH(CampaignOf({"{}", 1, "[]"}, "a.store"), Contains("a.store: definition: format"));
}

TEST_CASE("campaign: the identity is the same however the file is written, and differs with its meaning") {
  const auto identity = [](const std::string& members) { return IdentityOf(Read(With(members))); };
  CHECK(identity(R"("seed": 1, "mu": ["1/4", "2/4", "1.0", "2", "5"], "policies": ["scan=lowest"])") ==
        identity(""));
  CHECK(identity(R"("policies": ["ties=contacts,give-up=second"])") ==
        identity(R"("policies": ["give-up=second,ties=contacts,scan=lowest"])"));
  CHECK(identity(R"("contacts": [2], "seed": 3)") == identity(R"("seed": 3, "contacts": [2])"));
  for (const char* members : {R"("seed": 2)", R"("generators": ["psd"])", R"("contacts": [2])",
                              R"("mu": ["1"])", R"("policies": ["ties=contacts"])", R"("unit_problems": 1)",
                              R"("audit_every": 1)", R"("lemke_every": 1)", R"("enumerate_every": 1)",
                              R"("representatives_per_unit": 1)", R"("max_drives": 1)", R"("max_pivots": 1)",
                              R"("max_bits": 1)", R"("complete_every": 1)", R"("arithmetic": "exact")"}) {
    CAPTURE(members);
    CHECK_FALSE(identity(members) == identity(""));
  }
  CHECK(identity("").algorithm == kCountsVersion);
  CHECK(identity(R"("seed": 5)").definition == identity("").definition);
  CHECK(identity(R"("policies": ["ties=contacts"])").definition == identity("").definition);
}

TEST_CASE("campaign: a note is told, comes back from the store, and makes no other campaign") {
  const Campaign campaign = Read(With(R"("note": "near mu = 1, \u00e0 la Baraff <1994>")"));
  CHECK(campaign.note == "near mu = 1, \u00e0 la Baraff <1994>");
  const CampaignIdentity identity = IdentityOf(campaign);
  CHECK(identity == IdentityOf(Campaign{}));
  CHECK(identity.definition == IdentityOf(Campaign{}).definition);
  CHECK(IdentityOf(Campaign{}).remarks.empty());
  CHECK(CampaignOf(identity, "store") == campaign);
  CHECK(Read(ToJson(campaign)->dump()) == campaign);
  CHECK(*RemarksOf(identity) == Json{{"note", campaign.note}});
  CHECK(ToldDefinition(identity)->at("note") == campaign.note);
  for (const std::string& wrong : std::vector<std::string>{R"("note": 3)", R"("note": "two\nlines")",
                                                           R"("note": ")" + std::string(201, 'x') + '"'}) {
    CAPTURE(wrong);
    CHECK_THROWS_WITH(Read(With(wrong)),
                      Contains("note: found") && Contains("expected one line of text of at most 200 bytes"));
  }
  CampaignIdentity changed = identity;
  changed.remarks = R"({"seed": 3})";
  CHECK_THROWS_WITH(CampaignOf(changed, "a.store"), Contains("a.store: remarks: seed: found an unknown key"));
}

TEST_CASE("campaign: a store from before lots for complete driving goes on as it began") {
  CampaignIdentity identity = IdentityOf(Campaign{});
  CHECK(CampaignOf(identity, "store").complete_every == 100);
  const std::string key = R"(,"complete_every":100)";
  identity.definition.erase(identity.definition.find(key), key.size());
  const Campaign before = CampaignOf(identity, "store");
  CHECK(before.complete_every == 1);
  CHECK(IdentityOf(before).definition == identity.definition);
}

TEST_CASE(
    "campaign: the first units try every family, and each round has twice as many problems as the one before") {
  Campaign campaign = AsBegun(Read(With(R"("generators": ["integers", "psd"], "contacts": [2, 3, 4])")));
  const std::vector<Task> schedule = Schedule(campaign);
  REQUIRE(FamilyCount(campaign) == 6);
  std::set<std::pair<GeneratorId, int>> families;
  std::int64_t problems = 0;
  for (std::int64_t unit = 0; unit < FamilyCount(campaign); ++unit) {
    const Task task = TaskOf(schedule, unit);
    families.insert({task.generator, task.contacts});
    problems += UnitProblems(campaign, task, unit);
  }
  CHECK(families.size() == 6);
  CHECK(problems == 6);
  CHECK(UnitProblems(campaign, TaskOf(schedule, 6), 6) == 2);
  CHECK(UnitProblems(campaign, TaskOf(schedule, 17), 17) == 4);
  // The last is as it would be without.
  const Task two = {GeneratorId::kPsd, 2}, four = {GeneratorId::kPsd, 4};
  for (const std::int64_t unit : {6 * 14, 1'000'000, std::numeric_limits<int>::max()}) {
    CHECK(UnitProblems(campaign, two, unit) == 10000);
    CHECK(UnitProblems(campaign, four, unit) == 2500);
  }
  campaign.first_unit_problems = 10000;
  CHECK(UnitProblems(campaign, two, 0) == 10000);
  CHECK(UnitProblems(campaign, four, 0) == 2500);
}

TEST_CASE("campaign: units for a number of problems are the least that hold so many, however units begin") {
  for (const std::int64_t first : {0, 1, 7, 10000}) {
    Campaign campaign = Read(With(R"("generators": ["integers", "psd"], "contacts": [1, 2, 4])"));
    campaign.first_unit_problems = first;
    const std::vector<Task> schedule = Schedule(campaign);
    for (const std::int64_t asked : {1, 2, 6, 100, 9999, 10001, 123456, 5000000}) {
      CAPTURE(first, asked);
      std::int64_t units = 0, held = 0;
      for (; held < asked; ++units) held += UnitProblems(campaign, TaskOf(schedule, units), units);
      CHECK(UnitsFor(campaign, asked) == units);
    }
  }
}

TEST_CASE("campaign: a store from before units began small goes on as it began") {
  const testing::Scratch folder;
  const Campaign asked = Read(With(R"("generators": ["psd"])"));
  CHECK(AsBegunIn(folder / "none.store", asked).first_unit_problems == 1);
  { const Store store(folder / "old.store", IdentityOf(asked)); }
  CHECK(AsBegunIn(folder / "old.store", asked) == asked);
  { const Store store(folder / "new.store", IdentityOf(AsBegun(asked))); }
  CHECK(AsBegunIn(folder / "new.store", asked) == AsBegun(asked));
  CHECK(CampaignOf(IdentityOf(asked), "old").first_unit_problems == 0);
  CHECK(CampaignOf(IdentityOf(AsBegun(asked)), "new") == AsBegun(asked));
}

TEST_CASE("campaign: certified signs are for the plane, without an objective") {
  const auto refused = [](const std::string& members, const char* says) {
    CHECK_THROWS_WITH(RequireConsistent(Read(With(members))), Contains(says));
  };
  refused(R"("arithmetic": "exact", "generators": ["space"], "policies": ["slip=redirect"])",
          "expected double in space");
  refused(R"("arithmetic": "filtered", "objective": "friction")", "expected double");
  CHECK_THROWS_WITH(Read(With(R"("arithmetic": "float")")), Contains("expected double, filtered or exact"));
}

// Each policy is a column of the statistics: twice the same would count every problem twice.
TEST_CASE("campaign: the same policy twice is refused") {
  for (const char* policies : {R"(["paper", "paper"])", R"(["paper", "scan=lowest"])"}) {
    const CampaignFile file(With(fmt::format("\"policies\": {}", policies)));
    CHECK_THROWS_AS(ReadCampaign(file.path()), InputError);
    CHECK_THROWS_WITH(ReadCampaign(file.path()), Contains("policies[1]"));
  }
}

// ---- Schedule --------------------------------------------------------------------------------

TEST_CASE("campaign: over float in the plane alone") {
  Campaign campaign;
  campaign.arithmetic = Arithmetic::kFloat;
  campaign.generators = {GeneratorId::kPsd};
  CHECK_NOTHROW(RequireConsistent(campaign));
  campaign.generators = {GeneratorId::kPsd, GeneratorId::kSpace};
  CHECK_THROWS_WITH(RequireConsistent(campaign), Contains("found float for generator space, expected double"));
  campaign.arithmetic = Arithmetic::kDouble;
  CHECK_NOTHROW(RequireConsistent(campaign));
}

TEST_CASE("campaign: in space policies that are built there, and no objective") {
  const auto refused = [](const std::string& more) {
    const CampaignFile file(With(R"("generators": ["psd", "space"], )" + more));
    try {
      RequireConsistent(ReadCampaign(file.path()));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refused(R"("contacts": [2])").empty());
  CHECK(refused(R"("policies": ["paper", "scan=highest,slip=redirect"])").empty());
  for (const std::string policy : {"file=yes", "apex=suspended", "slip=polygon"}) {
    CHECK(refused(R"("policies": ["paper", ")" + policy + "\"]") ==
          "policies: found " + policy +
              " for generator space, expected file=no, apex=kept, and slip=literal or slip=redirect, as the "
              "published "
              "algorithm is built in space");
  }
  CHECK(refused(R"("objective": "steps")") ==
        "objective: found generator space, expected one of static contacts of the plane");
}

TEST_CASE("campaign: the schedule has every generator at every size, small sizes more often") {
  const Campaign campaign;
  std::map<std::pair<GeneratorId, int>, int> times;
  for (const Task& task : Schedule(campaign)) ++times[{task.generator, task.contacts}];
  CHECK(times.size() == campaign.generators.size() * campaign.contacts.size());
  for (const GeneratorId generator : campaign.generators) {
    for (const int contacts : campaign.contacts) {
      const int expected = contacts == 2 ? 8 : contacts == 3 ? 4 : contacts == 4 ? 2 : 1;
      CHECK(times[{generator, contacts}] == expected);
    }
  }
}

TEST_CASE("campaign: every generator and size has its turn in the first round") {
  Campaign campaign;
  campaign.generators = {GeneratorId::kBodies, GeneratorId::kPsd};
  campaign.contacts = {4, 1, 2};
  const std::vector<Task> schedule = Schedule(campaign);
  REQUIRE(schedule.size() == 2 * (2 + 1 + 8));
  std::vector<std::pair<GeneratorId, int>> first;
  for (int i = 0; i < 6; ++i) first.emplace_back(schedule[i].generator, schedule[i].contacts);
  using enum GeneratorId;
  CHECK(first == std::vector<std::pair<GeneratorId, int>>{
                     {kBodies, 4}, {kPsd, 4}, {kBodies, 1}, {kPsd, 1}, {kBodies, 2}, {kPsd, 2}});
}

TEST_CASE("campaign: a unit has half as many problems for each contact beyond two, at least one") {
  Campaign campaign;
  campaign.unit_problems = 100;
  const auto problems = [&](int contacts) { return UnitProblems(campaign, {GeneratorId::kPsd, contacts}, 0); };
  CHECK(
      (problems(1) == 100 && problems(2) == 100 && problems(3) == 50 && problems(4) == 25 && problems(8) == 1));
  campaign.unit_problems = 1;
  CHECK(problems(8) == 1);
}

TEST_CASE("campaign: units for a number of problems are the fewest that hold it") {
  Campaign campaign;
  campaign.generators = {GeneratorId::kPsd, GeneratorId::kSmall};
  campaign.contacts = {1, 2, 3, 8};
  campaign.unit_problems = 9;
  const std::vector<Task> schedule = Schedule(campaign);
  const auto held = [&](std::int64_t units) {
    std::int64_t problems = 0;
    for (std::int64_t unit = 0; unit < units; ++unit)
      problems += UnitProblems(campaign, TaskOf(schedule, unit), unit);
    return problems;
  };
  for (std::int64_t problems = 1; problems < 900; ++problems) {
    const std::int64_t units = UnitsFor(campaign, problems);
    CAPTURE(problems, units);
    REQUIRE(held(units) >= problems);
    REQUIRE(held(units - 1) < problems);
  }
  CHECK(UnitsFor(campaign, 0) == 0);
  CHECK(UnitsFor(campaign, std::int64_t{1} << 53) > 0);
}

}  // namespace
}  // namespace stiction
