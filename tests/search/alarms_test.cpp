// SPDX-License-Identifier: Apache-2.0
// Alarms of a unit: with a wrong solver in the place of a right one, every one of them rings; with right ones
// none.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "certify/claims/agreement.h"
#include "certify/exact/enumerate.h"
#include "certify/exact/exact.h"
#include "certify/exact/filtered.h"
#include "certify/exact/published_space.h"
#include "certify/exact/space.h"
#include "corpus/record/kinds.h"
#include "search/units/regenerate.h"
#include "search/units/signature.h"
#include "search/units/unit.h"
#include "solver/problem/lenient.h"
#include "tests/methods.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

constexpr std::int64_t kTried = 40;

// Two contacts, problems that doubles hold exactly, all of them run exactly and by every method.
Campaign Audited(GeneratorId generator = GeneratorId::kSmall, int contacts = 2) {
  Campaign campaign;
  campaign.generators = {generator};
  campaign.contacts = {contacts};
  campaign.unit_problems = kTried << std::max(0, contacts - 2);
  campaign.audit_every = campaign.lemke_every = campaign.enumerate_every = 1;
  campaign.representatives_per_unit = 1000;
  return campaign;
}

UnitResult RunWith(const Campaign& campaign, const UnitSolvers& solvers) {
  return UnitRunner(campaign, solvers).Run(0);
}

const Tally& OnlyTally(const UnitResult& result) {
  REQUIRE(result.record.tallies.size() == 1);
  const Tally& tally = result.record.tallies.begin()->second;
  Stratum sum;
  for (const auto& [key, stratum] : tally.strata) sum.Merge(stratum);
  CHECK(sum.misjudged == tally.misjudged);
  CHECK(sum.audited == tally.audited);
  return result.record.tallies.begin()->second;
}

std::int64_t SumOf(const Tally::Outcomes& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

std::int64_t Suspicions(const Tally& tally) {
  std::int64_t sum = 0;
  for (const Tally::Outcomes& row : tally.verdicts) sum += SumOf(row);
  return sum;
}

// Findings of this kind, counted.
std::int64_t Met(const UnitResult& result, std::string_view kind) {
  std::int64_t sum = 0;
  for (const auto& [signature, count] : result.record.signatures) sum += KindOf(signature) == kind ? count : 0;
  return sum;
}

std::int64_t MetOf(const UnitResult& result, const std::string& signature) {
  const auto found = result.record.signatures.find(signature);
  return found == result.record.signatures.end() ? 0 : found->second;
}

std::set<std::string> KindsKept(const UnitResult& result) {
  std::set<std::string> kinds;
  for (const Finding& finding : result.candidates) kinds.insert(finding.kind);
  return kinds;
}

// Whose certified signs leave everything to rationals, where the test's own run is.
ExactMethods WithoutSigns() {
  ExactMethods methods;
  methods.filtered = [](const ExactProblem&, const Request&, const Rungs& rungs) {
    OnRung filtered;
    filtered.verdict.reason = kUnsureSign;
    filtered.rung = rungs.last;
    return filtered;
  };
  return methods;
}

// A method that answers in this outcome whatever the problem.
ExactMethods PublishedEndsIn(Outcome outcome) {
  ExactMethods methods = WithoutSigns();
  methods.published = [outcome](const ExactProblem& problem, const Request& request) {
    ExactRun run = RunExact(problem, request);
    run.verdict.outcome = outcome;
    return run;
  };
  return methods;
}

ExactRun CycleOfTwo(const Request& request) { return RunExact(ReferenceProblem(), request); }

TEST_CASE("alarms: none rings with right solvers") {
  const UnitResult result = RunWith(Audited(), {});
  const Tally& tally = OnlyTally(result);
  CHECK(tally.audited + Suspicions(tally) == kTried);
  CHECK(tally.audited > 20);
  CHECK(tally.misjudged == 0);
  CHECK(tally.wrong == 0);
  CHECK(result.record.agreement.at(2).disagreements == 0);
  CHECK(result.record.existence.at(2).solved == kTried);
  for (const Finding& finding : result.candidates) CHECK_FALSE(IsGrave(finding.kind));
}

// ---- Certified signs that are not ------------------------------------------------------------

TEST_CASE("alarms: a filtered run that ends otherwise than over rationals is a grave finding") {
  for (const Arithmetic arithmetic : {Arithmetic::kDouble, Arithmetic::kFiltered}) {
    for (const bool outcome : {true, false}) {  // or another number of steps
      UnitSolvers solvers;
      std::int64_t decided = 0;
      solvers.exact.filtered = [&](const ExactProblem& problem, const Request& request, const Rungs& rungs) {
        OnRung filtered = RunPublishedFiltered(problem, request, rungs);
        if (filtered.verdict.outcome == Outcome::kUndecided) return filtered;
        ++decided;
        if (outcome) {
          filtered.verdict.outcome = Outcome::kRay;
        } else {
          ++filtered.verdict.statistics.steps;
        }
        return filtered;
      };
      Campaign campaign = Audited();
      campaign.arithmetic = arithmetic;
      const UnitResult result = RunWith(campaign, solvers);
      CAPTURE(Name(arithmetic), outcome);
      CHECK(decided > kTried / 2);
      CHECK(MetOf(result, "disagreement-of-methods-filtered-baraff-2c") == decided);
      CHECK(std::any_of(result.candidates.begin(), result.candidates.end(),
                        [](const Finding& finding) { return IsGrave(finding.kind); }));
    }
  }
}

TEST_CASE("alarms: complete driving with certified signs that does not solve a loop is a grave finding") {
  Campaign campaign = Audited(GeneratorId::kNearDegenerate, 4);
  campaign.unit_problems = 12000;
  campaign.audit_every = campaign.lemke_every = campaign.enumerate_every = 1000000;
  CHECK(RunWith(campaign, {}).record.agreement[4].disagreements == 0);
  for (const bool ray : {true, false}) {  // or forces that are none
    UnitSolvers solvers;
    solvers.exact.complete_filtered = [ray](const ExactProblem& problem, const Limits& limits) {
      ExactAnswer filtered = RunCompleteFiltered(problem, limits);
      if (ray) filtered.outcome = Outcome::kRay;
      filtered.f[0] += 1;
      return filtered;
    };
    const UnitResult result = RunWith(campaign, solvers);
    CAPTURE(ray);
    const std::int64_t alarms = MetOf(
        result, ray ? "disagreement-of-methods-complete-ray-4c" : "disagreement-of-methods-complete-wrong-4c");
    CHECK(alarms > 0);
    CHECK(alarms + result.record.existence.at(4).solved == result.record.existence.at(4).problems);
    CHECK(std::any_of(result.candidates.begin(), result.candidates.end(),
                      [](const Finding& finding) { return IsGrave(finding.kind); }));
  }
}

// ---- Doubles that say something wrong --------------------------------------------------------

TEST_CASE("alarms: an audit that ends otherwise than doubles said is counted as misjudged, each once") {
  for (const int every : {1, 3}) {
    int calls = 0, wrong = 0;
    UnitSolvers solvers;
    solvers.exact.published = [&](const ExactProblem& problem, const Request& request) {
      ExactRun run = RunExact(problem, request);
      if (request.policy != Policy{} || ++calls % every != 0) return run;  // not the second look at a safe one
      wrong += run.verdict.outcome == Outcome::kSolved;
      run.verdict.outcome = Outcome::kRay;
      return run;
    };
    const UnitResult result = RunWith(Audited(), solvers);
    const Tally& tally = OnlyTally(result);
    CHECK(calls == kTried);
    CHECK(tally.misjudged <= wrong);
    CHECK(tally.misjudged >= wrong - Suspicions(tally));  // what is under suspicion is counted there
    if (every == 1) CHECK(tally.misjudged == tally.audited);
    CHECK(tally.misjudged > 5);
    CHECK(Met(result, "ray") >= tally.misjudged);
    CHECK(KindsKept(result).contains("ray"));
  }
}

TEST_CASE("alarms: forces that are wrong by more than 1e-6 are a wrong answer, run exactly and kept") {
  for (const double error : {1e-4, 1e-5, 0.5}) {
    Campaign campaign = Audited();
    campaign.audit_every = 1000000;  // so that only suspicions are run exactly
    std::int64_t moved = 0;
    UnitSolvers solvers;
    solvers.distort = [&](Verdict& verdict, std::span<double> f) {
      if (verdict.outcome != Outcome::kSolved || f[0] == 0) return;
      ++moved;
      f[0] *= 1 + error;
    };
    const UnitResult result = RunWith(campaign, solvers);
    const Tally& tally = OnlyTally(result);
    const auto solved = static_cast<int>(Outcome::kSolved);
    CAPTURE(error);
    REQUIRE(moved > 5);
    CHECK(tally.wrong > moved / 4);
    CHECK(tally.wrong <= moved);
    CHECK(SumOf(tally.verdicts[solved]) == tally.wrong);
    CHECK(tally.outcomes[solved] >= tally.wrong);
    CHECK(MetOf(result, "wrong-answer-2c") == tally.verdicts[solved][solved]);
    const auto kept = std::find_if(result.candidates.begin(), result.candidates.end(),
                                   [](const Finding& finding) { return finding.kind == "wrong-answer"; });
    REQUIRE(kept != result.candidates.end());
    CHECK(kept->inexact_outcome == "solved");
    CHECK(kept->exact_outcome == "solved");
  }
}

TEST_CASE("alarms: the residual that a wrong answer is told by is that of its forces") {
  Campaign campaign = Audited();
  campaign.unit_problems = 1;
  for (std::int64_t unit = 0; unit < 30; ++unit) {
    const ExactProblem exact = Regenerate(campaign, unit, 0).problem;
    const auto problem = As<double>(exact);
    for (const double error : {1e-4, 3e-6, 1e-7}) {
      bool wrong = false, near = false;  // so near to the bound that rounding decides
      UnitSolvers solvers;
      solvers.distort = [&](Verdict& verdict, std::span<double> f) {
        if (verdict.outcome != Outcome::kSolved) return;
        Eigen::VectorXd moved(f.size());
        for (std::size_t i = 0; i < f.size(); ++i) moved[i] = f[i] *= 1 + error;
        const Eigen::VectorXd a = problem.A * moved + problem.b;
        const double lenient = MeasureLeniently(problem, FrictionLaw::kCoulomb, moved, a).error;
        wrong = lenient > 1e-6;
        near = std::abs(lenient - 1e-6) < 1e-8;
      };
      CAPTURE(unit, error);
      const UnitResult result = UnitRunner(campaign, solvers).Run(unit);  // sets `wrong`
      if (!near) CHECK(OnlyTally(result).wrong == (wrong ? 1 : 0));
    }
  }
}

TEST_CASE("alarms: forces that are none are a wrong answer, small errors are not") {
  UnitSolvers none;
  none.distort = [](Verdict&, std::span<double> f) { f[1] = std::numeric_limits<double>::quiet_NaN(); };
  const UnitResult result = RunWith(Audited(), none);
  CHECK(OnlyTally(result).wrong == OnlyTally(result).outcomes[0]);
  UnitSolvers rounding;
  rounding.distort = [](Verdict&, std::span<double> f) { f[0] *= 1 + 1e-9; };
  CHECK(OnlyTally(RunWith(Audited(), rounding)).wrong == 0);
}

TEST_CASE("alarms: another outcome than the exact one is a disagreement, where the problem is the same") {
  UnitSolvers solvers;
  solvers.distort = [](Verdict& verdict, std::span<double>) { verdict.outcome = Outcome::kRay; };
  const UnitResult result = RunWith(Audited(), solvers);
  const Tally& tally = OnlyTally(result);
  const auto ray = static_cast<int>(Outcome::kRay);
  CHECK(tally.outcomes[ray] == kTried);
  CHECK(SumOf(tally.verdicts[ray]) == kTried);
  CHECK(tally.audited == 0);
  CHECK(result.record.agreement.at(2).safety_decided == 0);  // of audits only
  CHECK(MetOf(result, "disagreement-ray-solved-2c") == tally.verdicts[ray][0]);
  CHECK(tally.verdicts[ray][0] > 20);
  CHECK(KindsKept(result).contains("disagreement"));
}

TEST_CASE("alarms: where doubles ran a rounded problem, what exact numbers do not confirm is no finding") {
  const auto rounded = std::find_if(Generators().begin(), Generators().end(),
                                    [](const GeneratorRow& row) { return !row.exact_in_double; });
  REQUIRE(rounded != Generators().end());
  UnitSolvers ray, wrong;
  ray.distort = [](Verdict& verdict, std::span<double>) { verdict.outcome = Outcome::kRay; };
  wrong.distort = [](Verdict&, std::span<double> f) { f[0] += 1000; };
  const UnitResult rays = RunWith(Audited(rounded->id), ray), wrongs = RunWith(Audited(rounded->id), wrong);
  CHECK(Met(rays, "disagreement") == 0);
  CHECK(Met(wrongs, "wrong-answer") == 0);
  CHECK(OnlyTally(wrongs).wrong > 20);
}

// ---- Exact methods that are wrong ------------------------------------------------------------

// Each wrong in one way, with the alarm that it sets off.
struct WrongMethod {
  std::string alarm;
  ExactMethods methods;
};

ExactAnswer CompleteEndsIn(Outcome outcome, const ExactProblem& problem, const Limits& limits) {
  ExactAnswer run = RunComplete(problem, limits);
  run.outcome = outcome;
  return run;
}

std::vector<WrongMethod> WrongMethods() {
  std::vector<WrongMethod> wrong(7);
  for (const Outcome outcome : {Outcome::kRay, Outcome::kLimit}) {
    WrongMethod& complete = wrong[outcome == Outcome::kRay ? 0 : 1];
    complete.alarm = "complete-" + std::string(Name(outcome));
    complete.methods.complete = [outcome](const ExactProblem& problem, const Limits& limits) {
      return CompleteEndsIn(outcome, problem, limits);
    };
  }
  wrong[2].alarm = "complete-wrong";
  wrong[2].methods.complete = [](const ExactProblem& problem, const Limits& limits) {
    ExactAnswer run = RunComplete(problem, limits);
    run.f[0] -= run.f[0] + Rational(1, 1000);
    return run;
  };
  wrong[3].alarm = "lemke-undecided";
  wrong[3].methods.lemke = [](const ExactProblem& problem, const Limits& limits) {
    ExactAnswer run = RunLemke(problem, limits);
    run.outcome = Outcome::kUndecided;
    return run;
  };
  wrong[4].alarm = "lemke-wrong";
  wrong[4].methods.lemke = [](const ExactProblem& problem, const Limits& limits) {
    ExactAnswer run = RunLemke(problem, limits);
    run.f[0] = -1;
    return run;
  };
  wrong[5].alarm = "baraff-wrong";
  wrong[5].methods.published = [](const ExactProblem& problem, const Request& request) {
    ExactRun run = RunExact(problem, request);
    run.f[0] = -1;
    return run;
  };
  wrong[6].alarm = "enumerate-none";
  wrong[6].methods.modes = [](const ExactProblem& problem) {
    Enumeration modes = EnumerateModes(problem);
    modes.solutions.clear();
    modes.distinct_witnesses = 0;
    return modes;
  };
  return wrong;
}

TEST_CASE("alarms: a method that contradicts the others, or a proof, is a grave finding of its name") {
  for (const WrongMethod& wrong : WrongMethods()) {
    CAPTURE(wrong.alarm);
    const UnitResult result = RunWith(Audited(), {wrong.methods, {}});
    const std::int64_t rung = MetOf(result, "disagreement-of-methods-" + wrong.alarm + "-2c");
    // The published algorithm may end without a solution, and then says nothing.
    CHECK(rung >= kTried - 5);
    CHECK(result.record.agreement.at(2).disagreements == Met(result, kDisagreementOfMethods));
    CHECK(KindsKept(result).contains(std::string(kDisagreementOfMethods)));
    const bool of_complete = wrong.alarm.starts_with("complete");
    CHECK(result.record.existence.at(2).problems == kTried);
    CHECK(result.record.existence.at(2).solved == (of_complete ? kTried - rung : kTried));
  }
}

TEST_CASE("alarms: in space wrong runs, wrong forces and a missing solution are noticed") {
  const Campaign campaign = Audited(GeneratorId::kSpace);
  {
    const UnitResult right = RunWith(campaign, {});
    CHECK(OnlyTally(right).misjudged == 0);
    CHECK(OnlyTally(right).wrong == 0);
    CHECK(OnlyTally(right).audited + Suspicions(OnlyTally(right)) > kTried / 2);
    CHECK(right.record.existence.at(2).solved == kTried);
    for (const Finding& finding : right.candidates) CHECK_FALSE(IsGrave(finding.kind));
  }
  UnitSolvers missing, wrong, loop, shifted;
  missing.exact.complete_in_space = [](const ExactProblem& problem, const Limits& limits) {
    ExactAnswer solution = SolveInSpace(problem, {.limits = limits});
    solution.outcome = Outcome::kRay;
    return solution;
  };
  wrong.exact.complete_in_space = [](const ExactProblem& problem, const Limits& limits) {
    ExactAnswer solution = SolveInSpace(problem, {.limits = limits});
    solution.f[0] = -1;
    return solution;
  };
  for (const auto& [solvers, alarm] : {std::pair{missing, "complete-ray"}, {wrong, "complete-wrong"}}) {
    const UnitResult result = RunWith(campaign, solvers);
    CHECK(MetOf(result, "disagreement-of-methods-" + std::string(alarm) + "-2c") == kTried);
    CHECK(KindsKept(result).contains(std::string(kDisagreementOfMethods)));
    CHECK(result.record.existence.at(2).solved == 0);
  }
  missing.exact.complete_in_space = [](const ExactProblem&, const Limits&) { return ExactAnswer(); };
  const UnitResult open = RunWith(campaign, missing);  // undecided: that enough corners are added is not proved
  CHECK(Met(open, kDisagreementOfMethods) == 0);
  CHECK(open.record.existence.at(2).problems == kTried);
  CHECK(open.record.existence.at(2).solved == 0);
  loop.exact.published_in_space = [](const ExactProblem& problem, const Request& request) {
    InexactAnswer run = RunIntervalsInSpace(problem, request);
    run.outcome = Outcome::kCycle;
    return run;
  };
  const UnitResult looping = RunWith(campaign, loop);
  CHECK(OnlyTally(looping).misjudged == OnlyTally(looping).audited);
  CHECK(Met(looping, "cycle") == kTried);
  UnitSolvers nothing;
  nothing.exact.published_in_space = [](const ExactProblem& problem, const Request& request) {
    InexactAnswer run = RunIntervalsInSpace(problem, request);
    run.outcome = Outcome::kUndecided;
    return run;
  };
  CHECK(OnlyTally(RunWith(campaign, nothing)).misjudged == 0);
  CHECK(OnlyTally(RunWith(campaign, nothing)).audited == 0);
  CHECK(Met(RunWith(campaign, nothing), "undecided") == 0);
  nothing.distort = [](Verdict& verdict, std::span<double>) { verdict.outcome = Outcome::kCycle; };
  CHECK(Met(RunWith(campaign, nothing), "undecided") == kTried);
  shifted.distort = [](Verdict&, std::span<double> f) { f[0] += 1000; };
  const UnitResult wrongs = RunWith(campaign, shifted);
  CHECK(OnlyTally(wrongs).wrong > 20);
  CHECK(Met(wrongs, "wrong-answer") > 10);
}

TEST_CASE("alarms: signs that do not sum to one are counted", "[slow]") {
  UnitSolvers solvers;
  std::int64_t missing = 0;
  solvers.exact.modes = [&missing](const ExactProblem& problem) {
    Enumeration modes = EnumerateModes(problem);
    const SolutionCount count = CountSolutions(problem, modes);
    if (!count.regular || count.words < 3 || count.signs != 1) return modes;
    ++missing;
    modes.solutions.pop_back();
    --modes.distinct_witnesses;
    return modes;
  };
  Campaign campaign = Audited();
  campaign.unit_problems = 1500;
  const auto counted = [&campaign](const UnitSolvers& of) {
    return RunWith(campaign, of).record.agreement.at(2).signs_not_one;
  };
  std::int64_t of_singular = 0;  // where A is not definite, they need not sum to one
  UnitSolvers right;
  right.exact.modes = [&of_singular](const ExactProblem& problem) {
    const Enumeration modes = EnumerateModes(problem);
    const SolutionCount count = CountSolutions(problem, modes);
    of_singular += count.regular && count.signs != 1;
    return modes;
  };
  const std::int64_t without_fault = counted(right), with_fault = counted(solvers);
  CHECK(without_fault == of_singular);
  CHECK(with_fault == of_singular + missing);
  CHECK(missing > 0);
}

TEST_CASE("alarms: a grave finding is kept in a unit that is full, others are not") {
  Campaign campaign = Audited();
  campaign.representatives_per_unit = 1;
  int runs = 0;
  UnitSolvers solvers = {WithoutSigns(), {}};
  solvers.distort = [](Verdict& verdict, std::span<double>) { verdict.outcome = Outcome::kRay; };
  solvers.exact.complete = [&runs](const ExactProblem& problem, const Limits& limits) {
    ++runs;
    if (runs == 20) return CompleteEndsIn(Outcome::kLimit, problem, limits);
    return runs == 30 ? CompleteEndsIn(Outcome::kRay, problem, limits) : RunComplete(problem, limits);
  };
  solvers.exact.published = [&runs](const ExactProblem& problem, const Request& request) {
    ExactRun run = RunExact(problem, request);
    if (runs == 10) run.verdict.outcome = Outcome::kLimit;  // a second kind that is not grave
    return run;
  };
  const UnitResult result = RunWith(campaign, solvers);
  REQUIRE(runs == kTried);
  std::vector<std::string> kept;
  for (const Finding& finding : result.candidates) kept.push_back(finding.signature);
  CHECK(kept == std::vector<std::string>{"disagreement-ray-solved-2c",
                                         "disagreement-of-methods-complete-limit-2c",
                                         "disagreement-of-methods-complete-ray-2c"});
  CHECK(MetOf(result, "limit-2c") == 1);  // counted all the same
}

// ---- Safe problems ---------------------------------------------------------------------------

ExactMethods CyclesEverywhere(std::optional<bool> safe) {
  ExactMethods methods;
  methods.published = [](const ExactProblem&, const Request& request) { return CycleOfTwo(request); };
  methods.is_safe = [safe](const ExactProblem&) { return safe; };
  return methods;
}

TEST_CASE("alarms: a cycle of a safe problem has a grave kind and signature of its own") {
  const std::string signature = Signature(ReferenceProblem(), RunExact(ReferenceProblem(), {}));
  Campaign campaign = Audited();
  for (const std::optional<bool> safe : {std::optional(true), std::optional(false), std::optional<bool>()}) {
    const UnitResult result = RunWith(campaign, {CyclesEverywhere(safe), {}});
    const bool grave = safe == true;
    CHECK(MetOf(result, "safe-" + signature) == (grave ? kTried : 0));
    CHECK(MetOf(result, signature) == (grave ? 0 : kTried));
    CHECK(KindsKept(result).contains(std::string(kSafeCycle)) == grave);
    CHECK(KindsKept(result).contains("cycle") == !grave);
  }
}

// Gives something up under this value of the switch only.
ExactMethods GivesUpUnder(Apex apex, std::vector<Policy>& asked) {
  ExactMethods methods = WithoutSigns();
  methods.published = [apex, &asked](const ExactProblem& problem, const Request& request) {
    asked.push_back(request.policy);
    ExactRun run = RunExact(problem, request);
    run.trace.pivots.clear();  // and there is no tie
    run.verdict.statistics.give_ups = request.policy.apex == apex;
    return run;
  };
  methods.is_safe = [](const ExactProblem&) { return true; };
  return methods;
}

TEST_CASE("alarms: in a safe problem what is given up under apex=suspended is a grave finding") {
  std::vector<Policy> asked;
  const UnitResult result = RunWith(Audited(), {GivesUpUnder(Apex::kSuspended, asked), {}});
  const Tally& tally = OnlyTally(result);
  const AgreementTally& agreement = result.record.agreement.at(2);
  CHECK(agreement.safety_decided == tally.audited);
  CHECK(agreement.safe == tally.audited);
  CHECK(agreement.safe_gave_up == tally.audited);
  CHECK(agreement.safe_gave_up_no_ties == tally.audited);
  CHECK(MetOf(result, "disagreement-of-methods-safe-give-up-2c") == tally.audited);
  CHECK(agreement.disagreements == tally.audited);
  CHECK(KindsKept(result).contains(std::string(kDisagreementOfMethods)));
  // Once as the campaign says, and of audited problems once more with this switch and no other changed.
  CHECK(static_cast<std::int64_t>(asked.size()) == kTried + tally.audited);
  const Policy suspended = ParsePolicy("apex=suspended");
  CHECK(std::count(asked.begin(), asked.end(), suspended) == tally.audited);
  CHECK(std::count(asked.begin(), asked.end(), Policy{}) == kTried);
}

TEST_CASE("alarms: what is given up under apex=kept, or in an unsafe problem, is no finding") {
  std::vector<Policy> asked;
  const UnitResult kept = RunWith(Audited(), {GivesUpUnder(Apex::kKept, asked), {}});
  CHECK(kept.record.agreement.at(2).safe_gave_up == 0);
  CHECK(kept.record.agreement.at(2).disagreements == 0);
  for (const std::optional<bool> safe : {std::optional(false), std::optional<bool>()}) {
    ExactMethods methods = GivesUpUnder(Apex::kSuspended, asked);
    methods.is_safe = [safe](const ExactProblem&) { return safe; };
    const UnitResult result = RunWith(Audited(), {methods, {}});
    CHECK(result.record.agreement.at(2).safe == 0);
    CHECK(result.record.agreement.at(2).safe_gave_up == 0);
    CHECK(result.record.agreement.at(2).safety_decided == OnlyTally(result).audited);
  }
}

TEST_CASE("alarms: with ties a safe problem may give up: counted, and no finding") {
  // Two equal contacts; the second is satisfied with the first, to the bit.
  const ExactProblem twins = MakeProblem({1, 1}, {{1, 0, 1, 0}, {0, 1, 0, 1}, {1, 0, 1, 0}, {0, 1, 0, 1}},
                                         {-1, Rational(1, 2), -1, Rational(1, 2)});
  ExactMethods methods;
  methods.published = [&twins](const ExactProblem& problem, const Request& request) {
    ExactRun run = RunExact(problem, request);
    if (request.policy.apex != Apex::kSuspended) return run;
    run = RunExact(twins, request);
    run.verdict.statistics.give_ups = 1;
    return run;
  };
  methods.is_safe = [](const ExactProblem&) { return true; };
  const UnitResult result = RunWith(Audited(), {methods, {}});
  const AgreementTally& agreement = result.record.agreement.at(2);
  CHECK(agreement.safe_gave_up == OnlyTally(result).audited);
  CHECK(agreement.safe_gave_up_no_ties == 0);
  CHECK(agreement.disagreements == 0);
}

TEST_CASE("alarms: the largest problems whose safety is decided, and the smallest whose is not") {
  std::vector<Policy> asked;
  const ExactMethods methods = GivesUpUnder(Apex::kSuspended, asked);
  const UnitResult last = RunWith(Audited(GeneratorId::kSmall, kMostContactsEnumerated), {methods, {}});
  const UnitResult next = RunWith(Audited(GeneratorId::kSmall, kMostContactsEnumerated + 1), {methods, {}});
  CHECK(last.record.agreement.at(kMostContactsEnumerated).safety_decided == OnlyTally(last).audited);
  CHECK(last.record.agreement.at(kMostContactsEnumerated).enumerated == kTried);
  CHECK(next.record.agreement.at(kMostContactsEnumerated + 1).safety_decided == 0);
  CHECK(next.record.agreement.at(kMostContactsEnumerated + 1).enumerated == 0);
}

TEST_CASE("alarms: a finding under another policy is named after it") {
  Campaign campaign = Audited();
  campaign.policies = {ParsePolicy("ties=contacts")};
  const UnitResult result = RunWith(campaign, {PublishedEndsIn(Outcome::kLimit), {}});
  CHECK(MetOf(result, "limit-2c@ties=contacts") == kTried);
  for (const Finding& finding : result.candidates) CHECK(finding.policy == "ties=contacts");
}

}  // namespace
}  // namespace stiction
