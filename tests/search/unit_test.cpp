// SPDX-License-Identifier: Apache-2.0
// Units: the same problems, counts and findings wherever they are run, and no allocation per problem.

#include "search/units/unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <string>
#include <vector>

#include "certify/claims/agreement.h"
#include "certify/claims/certificate.h"
#include "certify/exact/exact.h"
#include "certify/exact/published_space.h"
#include "corpus/json.h"
#include "corpus/record/kinds.h"
#include "corpus/record/problem_file.h"
#include "search/units/finish.h"
#include "search/units/minimize.h"
#include "search/units/regenerate.h"
#include "search/units/signature.h"

// ---- Counting allocations --------------------------------------------------------------------

// Eigen calls malloc and not operator new, so malloc itself is replaced, as glibc allows. Sanitizers replace it
// themselves: there nothing is counted.
#ifdef __has_feature
#define STICTION_HAS_FEATURE(feature) __has_feature(feature)
#else
#define STICTION_HAS_FEATURE(feature) 0
#endif
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    !STICTION_HAS_FEATURE(address_sanitizer) && !STICTION_HAS_FEATURE(thread_sanitizer)
#define STICTION_COUNTS_ALLOCATIONS
namespace {
std::atomic<std::int64_t> allocations = 0;
}
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* memory);

void* malloc(std::size_t size) noexcept {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) noexcept {
  ++allocations;
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  ++allocations;
  return __libc_memalign(alignment, size);
}
void free(void* memory) noexcept { __libc_free(memory); }
}
#endif

namespace stiction {
namespace {

Campaign Small(GeneratorId generator, int contacts, std::int64_t problems) {
  Campaign campaign;
  campaign.generators = {generator};
  campaign.contacts = {contacts};
  campaign.unit_problems = problems << std::max(0, contacts - 2);  // UnitProblems takes it back
  return campaign;
}

bool Equal(const UnitResult& left, const UnitResult& right) {
  return left.problems == right.problems && left.record == right.record && left.candidates == right.candidates;
}

std::int64_t Sum(const Tally::Outcomes& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

// All generators, at sizes with suspicions; two policies.
Campaign Mixed() {
  Campaign campaign;
  campaign.contacts = {3, 5};
  campaign.unit_problems = 1200;
  campaign.audit_every = 100;
  campaign.policies = {Policy{}, ParsePolicy("give-up=second,ties=contacts")};
  return campaign;
}
constexpr std::int64_t kMixedUnits = 14;  // each generator at each size

// ---- What comes out --------------------------------------------------------------------------

TEST_CASE("unit: nothing but the campaign and the number decides what comes out") {
  const Campaign campaign = Mixed();
  UnitRunner forwards(campaign), backwards(campaign);
  std::vector<UnitResult> first, second;
  for (std::int64_t unit = 0; unit < kMixedUnits; ++unit) first.push_back(forwards.Run(unit));
  for (std::int64_t unit = kMixedUnits; unit-- > 0;) second.insert(second.begin(), backwards.Run(unit));
  std::size_t findings = 0;
  for (std::int64_t unit = 0; unit < kMixedUnits; ++unit) {
    CAPTURE(unit);
    CHECK(Equal(first[unit], second[unit]));
    CHECK(Equal(first[unit], forwards.Run(unit)));
    findings += first[unit].candidates.size();
  }
  CHECK(findings > 5);  // otherwise little has been compared
}

TEST_CASE("unit: other units, seeds and generators give other problems") {
  const Campaign campaign = Small(GeneratorId::kSmall, 3, 500);
  UnitRunner runner(campaign);
  CHECK_FALSE(runner.Run(0).record == runner.Run(1).record);
  Campaign seeded = campaign;
  seeded.seed = 2;
  CHECK_FALSE(UnitRunner(seeded).Run(0).record == runner.Run(0).record);
}

TEST_CASE("unit: its tallies stand under its generator, size and policies") {
  const Campaign campaign = Mixed();
  const std::vector<Task> schedule = Schedule(campaign);
  UnitRunner runner(campaign);
  for (const std::int64_t unit :
       {std::int64_t{0}, std::int64_t{8}, static_cast<std::int64_t>(schedule.size()) + 3}) {
    const Task task = schedule[static_cast<std::size_t>(unit) % schedule.size()];
    const UnitResult result = runner.Run(unit);
    CHECK(result.problems == UnitProblems(campaign, task, unit));
    REQUIRE(result.record.tallies.size() == 2);
    for (const Policy& policy : campaign.policies) {
      const TallyKey key{std::string(Row(task.generator).name), task.contacts, PolicyName(policy)};
      REQUIRE(result.record.tallies.contains(key));
      CHECK(result.record.tallies.at(key).problems == result.problems);
    }
  }
}

TEST_CASE("unit: the counts add up") {
  const Campaign campaign = Mixed();
  UnitRunner runner(campaign);
  Record total;
  for (std::int64_t unit = 0; unit < kMixedUnits; ++unit) {
    CAPTURE(unit);
    const UnitResult result = runner.Run(unit);
    total.Merge(result.record);
    for (const auto& [key, tally] : result.record.tallies) {
      CAPTURE(key.policy);
      CHECK(tally.problems == Sum(tally.outcomes));
      CHECK(tally.problems == std::accumulate(tally.steps.begin(), tally.steps.end(), std::int64_t{0}));
      // Each run that did not end in a verified solution was run again, exactly, once.
      std::int64_t suspicions = 0;
      for (int outcome = 0; outcome < kOutcomeCount; ++outcome) {
        const bool solved = outcome == static_cast<int>(Outcome::kSolved);
        CHECK(Sum(tally.verdicts[outcome]) == (solved ? tally.wrong : tally.outcomes[outcome]));
        suspicions += Sum(tally.verdicts[outcome]);
      }
      // One in audit_every, those under suspicion apart.
      const std::int64_t audits = tally.problems / campaign.audit_every;
      CHECK(tally.audited <= audits + 1);
      CHECK(tally.audited >= audits - suspicions);
      CHECK(tally.misjudged <= tally.audited);
      CHECK(tally.with_zero_steps <= tally.sums.zero_steps);
      CHECK(tally.with_give_ups <= tally.sums.give_ups);
      CHECK(tally.maxima.steps <= tally.sums.steps);
      // By friction and rank, all of it again.
      Stratum sum;
      for (const auto& [stratum_key, stratum] : tally.strata) {
        CHECK(stratum_key.rank <= 2 * key.contacts);
        sum.Merge(stratum);
      }
      CHECK(sum.problems == tally.problems);
      CHECK(sum.outcomes == tally.outcomes);
      CHECK(Sum(sum.exact) == suspicions);
      CHECK(sum.audited == tally.audited);
      CHECK(sum.misjudged == tally.misjudged);
      CHECK(sum.steps == tally.sums.steps);
      CHECK(sum.zero_steps == tally.sums.zero_steps);
    }
  }
  // A finding is an exact outcome other than solved, or a wrong answer, or a disagreement.
  std::int64_t findings = 0, unsolved = 0, suspicions = 0;
  for (const auto& [signature, count] : total.signatures) findings += count;
  for (const auto& [key, tally] : total.tallies) {
    for (const auto& row : tally.verdicts) {
      unsolved += Sum(row) - row[static_cast<int>(Outcome::kSolved)];
      suspicions += Sum(row);
    }
  }
  CHECK(findings >= unsolved);
  CHECK(findings <= suspicions);
}

// Counted here from the problems themselves.
TEST_CASE("unit: strata have the friction and the rank of their problems") {
  Campaign campaign = Small(GeneratorId::kIntegers, 2, 500);
  campaign.palette = {{1, 3}, {2, 6}, {2, 1}};  // the first two are one coefficient
  const UnitResult result = UnitRunner(campaign).Run(0);
  const Tally& tally = result.record.tallies.begin()->second;
  std::map<std::string, std::int64_t> found, expected;
  for (const auto& [key, stratum] : tally.strata) found[key.friction] += stratum.problems;
  for (std::int64_t index = 0; index < result.problems; ++index) {
    const ExactProblem problem = Regenerate(campaign, 0, index).problem;
    const Rational &mu = problem.contacts[0].mu, &other = problem.contacts[1].mu;
    ++expected[mu == other ? ToString(mu) : kMixedFriction];
  }
  CHECK(found == expected);
  CHECK(found.size() == 3);
}

TEST_CASE("unit: loops are counted with the zero steps of their periods, and the words of their groups") {
  Campaign campaign = Small(GeneratorId::kNearDegenerate, 3, 20000);
  campaign.representatives_per_unit = 1000;
  const UnitResult result = UnitRunner(campaign).Run(0);
  std::int64_t cycles = 0, loops = 0;
  for (const auto& row : result.record.tallies.begin()->second.verdicts)
    cycles += row[static_cast<int>(Outcome::kCycle)];
  for (const auto& [contacts, tally] : result.record.loops) {
    loops += tally.loops;
    CHECK(tally.zero_steps <= tally.steps);
    CHECK(tally.drives <= tally.steps);
    std::int64_t by_zero_steps = 0;
    for (const auto& [zero_steps, count] : tally.by_zero_steps) by_zero_steps += count;
    CHECK(by_zero_steps == tally.loops);
  }
  CHECK(loops == cycles);
  REQUIRE(loops > 3);
  // A group has no more words than loops; one that was met once has one.
  REQUIRE_FALSE(result.record.words.empty());
  for (const auto& [signature, sketch] : result.record.words) {
    const std::int64_t met = result.record.signatures.at(signature);
    CHECK(sketch.Count() >= 1);
    CHECK(sketch.Count() <= static_cast<double>(met));
  }
  for (const Finding& finding : result.candidates) {
    if (finding.kind != "cycle") continue;
    const ExactProblem problem = Regenerate(campaign, finding.unit, finding.index).problem;
    const ExactRun run = RunExact(problem, {.limits = campaign.limits});
    const LoopFacts loop = FactsOfLoop(problem, run.verdict, run.trace.pivots);
    std::int64_t zero_steps = 0;
    for (const auto& step : run.trace.pivots) zero_steps += step.drive > run.verdict.start && step.s == 0;
    CHECK(loop.zero_steps == zero_steps);
    CHECK(loop.signature == finding.signature);
    CHECK(result.record.loops.at(loop.contacts).by_zero_steps.contains(static_cast<int>(zero_steps)));
    CHECK(result.record.words.contains(finding.signature) == !loop.named);
  }
}

TEST_CASE("unit: an exact run of a finding's problem gives what the finding says") {
  const Campaign campaign = Mixed();
  UnitRunner runner(campaign);
  int checked = 0;
  for (std::int64_t unit = 0; unit < kMixedUnits; ++unit) {
    const UnitResult result = runner.Run(unit);
    std::string last;
    for (const Finding& finding : result.candidates) {
      CAPTURE(finding.signature, finding.unit, finding.index);
      const ExactProblem problem = Regenerate(campaign, finding.unit, finding.index).problem;
      const ProblemFile file = ParseProblem(finding.problem, "finding");
      CHECK(*ProblemToJson(file.problem) == *ProblemToJson(problem));
      CHECK(ToJson(file)->dump() == finding.problem);
      const Policy policy = ParsePolicy(finding.policy);
      const ExactRun run = RunExact(problem, {.policy = policy, .limits = campaign.limits});
      CHECK(Name(run.verdict.outcome) == finding.exact_outcome);
      if (finding.kind == finding.exact_outcome) {
        const std::string suffix = policy == Policy{} ? "" : "@" + finding.policy;
        CHECK(finding.signature == Signature(problem, run) + suffix);
      }
      CHECK(finding.unit == unit);
      CHECK(finding.index < result.problems);
      CHECK(finding.contacts == static_cast<int>(problem.contacts.size()));
      CHECK(result.record.signatures.contains(finding.signature));
      CHECK_FALSE(finding.done);
      ++checked;
    }
  }
  CHECK(checked > 5);
}

TEST_CASE("unit: all signatures are counted, of the first few the first problem is kept") {
  Campaign campaign = Small(GeneratorId::kNearDegenerate, 5, 1500);
  campaign.representatives_per_unit = 1000;
  const UnitResult all = UnitRunner(campaign).Run(0);
  REQUIRE(all.candidates.size() > 3);
  CHECK(all.candidates.size() == all.record.signatures.size());
  for (std::size_t i = 1; i < all.candidates.size(); ++i) {
    CHECK(all.candidates[i].index >= all.candidates[i - 1].index);
  }
  campaign.representatives_per_unit = 2;
  const UnitResult two = UnitRunner(campaign).Run(0);
  CHECK(two.record == all.record);
  REQUIRE(two.candidates.size() == 2);
  CHECK((two.candidates[0] == all.candidates[0] && two.candidates[1] == all.candidates[1]));
}

TEST_CASE("unit: every policy runs on the same problems as if it were alone") {
  Campaign both = Small(GeneratorId::kSmall, 4, 2000);
  both.policies = {Policy{}, ParsePolicy("scan=highest")};
  const Record together = UnitRunner(both).Run(5).record;
  for (const Policy& policy : both.policies) {
    Campaign alone = both;
    alone.policies = {policy};
    for (const auto& [key, tally] : UnitRunner(alone).Run(5).record.tallies)
      CHECK(together.tallies.at(key) == tally);
  }
}

TEST_CASE("unit: one problem in so many is audited, of units that are smaller than that too") {
  Campaign campaign = Small(GeneratorId::kIntegers, 2, 10);
  campaign.audit_every = 25;
  UnitRunner runner(campaign);
  std::int64_t audited = 0, with_audit = 0, suspicions = 0;
  constexpr std::int64_t kUnits = 500;
  for (std::int64_t unit = 0; unit < kUnits; ++unit) {
    const Record record = runner.Run(unit).record;
    const Tally& tally = record.tallies.begin()->second;
    REQUIRE(tally.audited <= 1);
    audited += tally.audited;
    for (const auto& verdicts : tally.verdicts) suspicions += Sum(verdicts);
    with_audit += record.agreement.contains(2) && record.agreement.at(2).safety_decided > 0;
  }
  CHECK(with_audit == audited);
  CHECK(suspicions < 50);
  CHECK(audited > kUnits * 10 / 25 - 50);  // three standard deviations of what is drawn are 33
  CHECK(audited < kUnits * 10 / 25 + 50);
}

TEST_CASE(
    "unit: complete driving solves the first of each group of a unit, and no more unless they are drawn") {
  Campaign campaign = Small(GeneratorId::kNearDegenerate, 4, 12000);
  campaign.audit_every = campaign.complete_every = campaign.lemke_every = campaign.enumerate_every = 1 << 30;
  const Record record = UnitRunner(campaign).Run(0).record;
  std::int64_t unsolved = 0, groups = 0;
  for (const auto& [signature, count] : record.signatures) {
    if (signature.starts_with("disagreement") || signature.starts_with("wrong-answer")) continue;  // of doubles
    unsolved += count;
    ++groups;
  }
  REQUIRE(unsolved > groups);
  CHECK(record.existence.at(4).problems == groups);
  CHECK(record.existence.at(4).solved == groups);
}

TEST_CASE("unit: the double problem is the exact problem, so an audit agrees with it") {
  for (const GeneratorRow& row : Generators()) {
    if (!row.exact_in_double || row.InSpace()) continue;  // intervals leave some open
    Campaign campaign = Small(row.id, 2, 60);
    campaign.audit_every = 1;
    const UnitResult result = UnitRunner(campaign).Run(3);
    const Tally& tally = result.record.tallies.begin()->second;
    std::int64_t suspicions = 0;
    for (const auto& verdicts : tally.verdicts) suspicions += Sum(verdicts);
    CAPTURE(row.name);
    CHECK(tally.audited + suspicions == 60);
    CHECK(tally.misjudged == 0);
  }
}

// The first loop that a unit found, finished; no finding is grave.
Finding FinishedLoop(const UnitResult& result, const Campaign& campaign) {
  for (const Finding& finding : result.candidates) CHECK_FALSE(IsGrave(finding.kind));
  const auto loop = std::find_if(result.candidates.begin(), result.candidates.end(),
                                 [](const Finding& finding) { return finding.kind == "cycle"; });
  REQUIRE(loop != result.candidates.end());
  const auto finished = FinishFinding(*loop, campaign.limits, [] { return false; });
  REQUIRE(finished.has_value());
  return *finished;
}

TEST_CASE("unit: where contacts slide or are bilateral, loops are found, certified, and nothing disagrees",
          "[slow]") {
  for (const GeneratorId id : {GeneratorId::kBilateral, GeneratorId::kSliding}) {
    Campaign campaign = Small(id, 3, 20000);
    campaign.enumerate_every = 10;
    const UnitResult result = UnitRunner(campaign).Run(0);
    const Tally& tally = result.record.tallies.begin()->second;
    CHECK(Sum(tally.outcomes) == 20000);
    CHECK(tally.misjudged == 0);
    CHECK(tally.wrong == 0);
    const Finding finished = FinishedLoop(result, campaign);
    CHECK(finished.kind == "cycle");
    CHECK_FALSE(finished.certificate.empty());
  }
}

TEST_CASE("unit: in space loops are proved over intervals, minimized as such, and have the solution they miss",
          "[slow]") {
  Campaign campaign = Small(GeneratorId::kSpace, 2, 12000);
  campaign.policies = {Policy{}, ParsePolicy("slip=redirect")};
  campaign.audit_every = 1000;
  const UnitResult result = UnitRunner(campaign).Run(0);
  REQUIRE(result.record.tallies.size() == 2);
  constexpr auto kLoop = static_cast<std::size_t>(Outcome::kCycle);
  for (const auto& [key, tally] : result.record.tallies) {
    CAPTURE(key.policy);
    CHECK(Sum(tally.outcomes) == 12000);
    CHECK(tally.audited > 4);  // that intervals decide
    CHECK(tally.audited <= 12);
    CHECK(tally.misjudged == 0);
    CHECK(tally.wrong == 0);
    CHECK(tally.verdicts[kLoop][kLoop] > 0);
    // Intervals deny no loop of doubles.
    CHECK(tally.verdicts[kLoop][static_cast<std::size_t>(Outcome::kSolved)] == 0);
  }
  const Finding finished = FinishedLoop(result, campaign);
  const ExactProblem small = ParseProblem(finished.minimized, "minimized").problem;
  CHECK(small.dimension == 3);
  CHECK(SimplicityOf(small) < SimplicityOf(ParseProblem(finished.problem, "found").problem));
  const auto run =
      RunIntervalsInSpace(small, {.policy = ParsePolicy(finished.policy), .limits = campaign.limits});
  CHECK(run.outcome == Outcome::kCycle);
  CHECK(finished.signature.ends_with(fmt::format("-{}d", run.period)));
  for (const std::string& solution : {finished.existence, finished.minimized_existence}) {
    const CheckReport report = CheckCertificate(Json::parse(solution), "certificate");
    CHECK(report.accepted);
    CHECK(report.claim == "solution-exists");
  }
  CHECK(Json::parse(finished.facts).at("minimized").at("outcome") == "cycle");
}

// ---- Methods held against each other ---------------------------------------------------------

TEST_CASE("unit: methods are compared, and all modes tried, as often as the campaign says") {
  Campaign campaign = Small(GeneratorId::kSmall, 2, 400);
  campaign.audit_every = 4;
  campaign.enumerate_every = 1;
  const Record all = UnitRunner(campaign).Run(0).record;
  const AgreementTally& tally = all.agreement.at(2);
  const ExistenceTally& existence = all.existence.at(2);
  CHECK(tally.compared >= 100);
  CHECK(existence.problems == existence.solved);
  CHECK(tally.enumerated == existence.problems);
  CHECK(tally.disagreements == 0);
  CHECK(tally.safety_decided == all.tallies.begin()->second.audited);
  CHECK(tally.safe > 0);
  CHECK(tally.safe < tally.safety_decided);
  CHECK(tally.safe_gave_up_no_ties == 0);
  std::int64_t words = 0, solutions = 0;
  for (const auto& [count, problems] : tally.words) {
    CHECK(count >= 1);
    words += problems;
  }
  for (const auto& [count, problems] : tally.solutions) solutions += problems;
  CHECK(words == tally.enumerated);
  CHECK(solutions == tally.regular);
  CHECK(tally.regular > 10);
  CHECK(tally.regular < tally.enumerated);

  campaign.enumerate_every = 10;
  const AgreementTally tenth = UnitRunner(campaign).Run(0).record.agreement.at(2);
  CHECK(tenth.enumerated > 0);
  CHECK(tenth.enumerated < tally.enumerated / 3);
  CHECK(tenth.compared == tally.compared);

  Campaign large = Small(GeneratorId::kSmall, kMostContactsEnumerated + 1, 40);
  large.audit_every = large.enumerate_every = 1;
  const AgreementTally none = UnitRunner(large).Run(0).record.agreement.begin()->second;
  CHECK((none.compared == 40 && none.enumerated == 0 && none.safety_decided == 0));
  const CampaignIdentity usual = IdentityOf(large);
  large.enumerate_contacts = kMostContactsEnumerated + 1;
  CHECK_FALSE(IdentityOf(large) == usual);
  const AgreementTally asked = UnitRunner(large).Run(0).record.agreement.begin()->second;
  CHECK((asked.compared == 40 && asked.enumerated == 40 && asked.safety_decided == 0));
}

TEST_CASE("unit: Lemke's method runs on all audits, and by lot on suspicions") {
  Campaign campaign = Small(GeneratorId::kConditioned, 2, 1000);
  campaign.audit_every = 1000000;
  campaign.complete_every = 1;
  const auto counts = [&campaign](std::int64_t every) {
    campaign.lemke_every = every;
    const Record record = UnitRunner(campaign).Run(0).record;
    return std::pair(record.agreement.at(2).compared, record.existence.at(2).problems);
  };
  const auto [all, problems] = counts(1);
  CHECK(all == problems);
  CHECK(problems > 5);
  const auto [some, same] = counts(1000000);
  CHECK(same == problems);
  CHECK(some <= 1);  // an audit
}

TEST_CASE("unit: suspicions that certified signs refute are seen by other methods by lot, and counted alike") {
  Campaign campaign = Small(GeneratorId::kConditioned, 2, 3000);
  campaign.audit_every = 3000;
  const auto run = [&campaign](std::int64_t every) {
    campaign.complete_every = campaign.lemke_every = campaign.enumerate_every = every;
    return UnitRunner(campaign).Run(0);
  };
  const UnitResult all = run(1), few = run(1000000);
  const Tally &of_all = all.record.tallies.begin()->second, &of_few = few.record.tallies.begin()->second;
  CHECK(of_all == of_few);  // verdicts, rungs and all
  CHECK(all.candidates == few.candidates);
  CHECK(of_few.rungs[static_cast<int>(Rung::kDoubleDouble)] > of_few.rungs[static_cast<int>(Rung::kExact)]);
  const std::int64_t compared = few.record.existence.at(2).problems;
  CHECK(compared >= 1);
  CHECK(compared < all.record.existence.at(2).problems / 2);
}

TEST_CASE("unit: what certified signs confirm is counted and signed as by rationals") {
  Campaign campaign = Small(GeneratorId::kNearDegenerate, 4, 3000);
  campaign.audit_every = 1000000;
  campaign.complete_every = campaign.lemke_every = campaign.enumerate_every = 1000000;
  const UnitResult certified = UnitRunner(campaign).Run(0);
  campaign.complete_every = 1;
  const UnitResult exact = UnitRunner(campaign).Run(0);
  CHECK(certified.record.signatures == exact.record.signatures);
  CHECK(certified.record.tallies == exact.record.tallies);
  CHECK(certified.candidates == exact.candidates);
  CHECK(certified.record.signatures.size() > 4);  // loops, and what doubles suspected
  // Of what is solved only rationals tell complete driving; loops it solves in both.
  const ExistenceTally& confirmed = certified.record.existence.at(4);
  CHECK(confirmed.problems > 5);
  CHECK(confirmed.solved == confirmed.problems);
  CHECK(confirmed.with_folds > 0);
}

TEST_CASE("unit: with certified signs from the start all counts are those of rationals") {
  for (const GeneratorId generator :
       {GeneratorId::kSmall, GeneratorId::kConditioned, GeneratorId::kBilateral}) {
    Campaign campaign = Small(generator, 3, 120);
    campaign.audit_every = 1;
    campaign.policies = {Policy{}, ParsePolicy("give-up=second,ties=contacts")};
    const auto run = [&campaign](Arithmetic arithmetic) {
      campaign.arithmetic = arithmetic;
      return UnitRunner(campaign).Run(0);
    };
    const UnitResult filtered = run(Arithmetic::kFiltered), exact = run(Arithmetic::kExact);
    CAPTURE(Row(generator).name);
    CHECK(filtered.record.signatures == exact.record.signatures);
    CHECK(filtered.record.existence == exact.record.existence);
    CHECK(filtered.record.agreement == exact.record.agreement);
    CHECK(filtered.candidates.size() == exact.candidates.size());
    REQUIRE(filtered.record.tallies.size() == 2);
    for (const auto& [key, tally] : filtered.record.tallies) {
      CHECK(key.arithmetic == "filtered");
      TallyKey other = key;
      other.arithmetic = "exact";
      Tally without = tally;
      CHECK(std::accumulate(without.rungs.begin(), without.rungs.end(), std::int64_t{0}) == 120);
      without.rungs = {};
      CHECK(without == exact.record.tallies.at(other));
      CHECK(tally.audited + Sum(tally.outcomes) - tally.outcomes[static_cast<int>(Outcome::kSolved)] == 120);
      CHECK(tally.misjudged == 0);
    }
  }
}

// Too small a budget makes a method end otherwise than it must: a wrong method as a unit sees one.
TEST_CASE("unit: a method that does not solve is a grave finding with all answers") {
  Campaign campaign = Small(GeneratorId::kIntegers, 3, 40);
  campaign.audit_every = 1;
  campaign.representatives_per_unit = 1;
  campaign.limits.pivots = 1;
  const UnitResult result = UnitRunner(campaign).Run(0);
  CHECK(result.record.agreement.at(3).disagreements > 0);
  const auto found = std::find_if(
      result.candidates.begin(), result.candidates.end(),
      [](const Finding& finding) { return finding.signature == "disagreement-of-methods-complete-limit-3c"; });
  REQUIRE(found != result.candidates.end());  // kept beside the one representative of other kinds
  CHECK(found->kind == kDisagreementOfMethods);
  std::int64_t counted = 0;
  for (const auto& [signature, count] : result.record.signatures)
    counted += KindOf(signature) == kDisagreementOfMethods ? count : 0;
  CHECK(counted == result.record.agreement.at(3).disagreements);
  const Json facts = Json::parse(found->facts);
  CHECK(facts.at("disagreement") == "complete ended in limit, expected solved");
  REQUIRE(facts.at("answers").size() >= 2);
  CHECK(facts.at("answers")[0].at("method") == "complete");
  CHECK(facts.at("answers")[0].at("outcome") == "limit");
}

// ---- Allocations -----------------------------------------------------------------------------

#ifdef STICTION_COUNTS_ALLOCATIONS

// Of the unit, with a runner that has its workspace already. -1: it had a suspicion.
std::int64_t AllocationsOf(GeneratorId generator, int contacts, std::int64_t problems, std::int64_t unit) {
  Campaign campaign = Small(generator, contacts, problems);
  campaign.palette = {{1, 2}};           // few strata, each of which is met
  campaign.audit_every = 1'000'000'000;  // audits allocate
  UnitRunner runner(campaign);
  runner.Run(unit);
  const std::int64_t before = allocations;
  const UnitResult result = runner.Run(unit);
  const std::int64_t count = allocations - before;
  const Tally& tally = result.record.tallies.begin()->second;
  return tally.outcomes[static_cast<int>(Outcome::kSolved)] == problems && tally.wrong == 0 ? count : -1;
}

TEST_CASE("unit: the path of a problem without suspicion allocates nothing", "[slow]") {
  const std::int64_t before = allocations;
  int* volatile memory = new int;
  const std::int64_t counted = allocations - before;
  delete memory;
  REQUIRE(counted == 1);  // otherwise the rest says nothing
  int compared = 0;
  for (const GeneratorRow& row : Generators()) {
    if (!row.IsPlain()) continue;  // reductions do, and runs in space
    for (const int contacts : {1, 2, 3, 8}) {
      if (contacts == 8 && !row.exact_in_double) continue;  // exact runs of their suspicions take seconds
      for (std::int64_t unit = 0; unit < 3; ++unit) {
        const std::int64_t problems = contacts == 8 ? 400 : 1000;
        const std::int64_t many = AllocationsOf(row.id, contacts, 4 * problems, unit);
        if (many < 0) continue;
        CAPTURE(row.name, contacts, unit);
        CHECK(many == AllocationsOf(row.id, contacts, problems, unit));
        ++compared;
        break;
      }
    }
  }
  CHECK(compared >= 14);
}

#endif

}  // namespace
}  // namespace stiction
