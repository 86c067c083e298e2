// SPDX-License-Identifier: Apache-2.0
#include "search/units/examiner.h"

#include <fmt/format.h>

#include "certify/claims/agreement.h"
#include "certify/exact/published_space.h"
#include "certify/exact/verify_solution.h"
#include "corpus/record/kinds.h"
#include "search/units/signature.h"

namespace stiction {
namespace {

bool IsOneIn(std::uint64_t draw, std::int64_t every) { return draw % static_cast<std::uint64_t>(every) == 0; }

bool IsUnsure(const Verdict& verdict) {
  return verdict.outcome == Outcome::kUndecided && verdict.reason == kUnsureSign;
}

}  // namespace

void Examiner::RunAgain(std::int64_t index, std::size_t policy, Outcome inexact, bool wrong, bool suspected) {
  const auto [problem, drawn] = DrawAgain(index);
  const Place place = {index, policy, inexact, drawn};
  // The first rung seldom tells what rounding did not.
  const Rung first = suspected ? Rung::kDoubleDouble : Rung::kDouble;
  const Rungs rungs = {first, Rung::kExact, /*with_rationals=*/false};
  if (Decide(place, problem, Filter(problem, policy, rungs), suspected) == Outcome::kSolved)
    collector_.FindOfDoubles(place, wrong, problem);
}

void Examiner::RunCertified(std::int64_t index, std::size_t policy, bool audit) {
  const bool exact = campaign_.arithmetic == Arithmetic::kExact;
  const auto [problem, drawn] = DrawAgain(index);
  const OnRung filtered = Filter(problem, policy, {exact ? Rung::kExact : Rung::kDouble, Rung::kExact});
  const Verdict& verdict = filtered.verdict;
  collector_.Count(policy, drawn, verdict);
  const bool suspected = verdict.outcome != Outcome::kSolved;
  const Place place = {index, policy, verdict.outcome, drawn};
  if (audit || (exact && suspected)) {
    Examine(place, problem, exact ? nullptr : &verdict, suspected);
  } else if (suspected) {
    Decide(place, problem, filtered, suspected);
  }
}

void Examiner::RunOverIntervals(std::int64_t index, std::size_t policy, const Verdict& inexact, bool wrong,
                                bool suspected) {
  const auto [problem, drawn] = DrawAgain(index);
  const InexactAnswer answer = RunInSpace(problem, policy);
  const Outcome proved = answer.outcome;
  const Place place = {index, policy, inexact.outcome, drawn};
  collector_.CountVerdict(place, proved, suspected);
  CompareInSpace(place, proved, problem);
  if (proved == Outcome::kSolved) {
    collector_.FindOfDoubles(place, wrong, problem);
  } else if (proved != Outcome::kUndecided) {
    collector_.Find(place, proved, Name(proved),
                    CountsSignature(collector_.task().contacts, proved, answer.period), problem);
  } else if (inexact.outcome == Outcome::kCycle) {
    collector_.Find(place, proved, Name(proved),
                    "undecided-" + CountsSignature(collector_.task().contacts, inexact.outcome, inexact.period),
                    problem);
  }
}

Regenerated Examiner::DrawAgain(std::int64_t index) {
  const Spending spending(collector_.meter(), &ProcessorTime::generation);
  return Regenerate(campaign_, collector_.task(), collector_.unit(), index);
}

InexactAnswer Examiner::RunInSpace(const ExactProblem& problem, std::size_t policy) {
  const Spending spending(collector_.meter(), &ProcessorTime::exact);
  return methods_.published_in_space(problem, RequestOf(policy));
}

ExactRun Examiner::RunExactly(const ExactProblem& problem, std::size_t policy) {
  const Spending spending(collector_.meter(), &ProcessorTime::exact);
  return methods_.published(problem, RequestOf(policy));
}

Request Examiner::RequestOf(std::size_t policy) const {
  return {.policy = campaign_.policies[policy], .limits = campaign_.limits};
}

std::uint64_t Examiner::DrawOf(std::int64_t index) const {
  return Mix(ProblemSeed(campaign_.seed, static_cast<std::uint64_t>(collector_.unit()),
                         static_cast<std::uint64_t>(index)));
}

bool Examiner::IsDrawn(std::uint64_t draw) const {
  return IsOneIn(draw, campaign_.complete_every) || IsOneIn(draw, campaign_.lemke_every) ||
         IsOneIn(draw, campaign_.enumerate_every);
}

OnRung Examiner::Filter(const ExactProblem& problem, std::size_t policy, const Rungs& rungs) {
  const Spending spending(collector_.meter(), &ProcessorTime::filtered);
  const OnRung filtered = methods_.filtered(problem, RequestOf(policy), rungs);
  const Rung rung = IsUnsure(filtered.verdict) ? Rung::kExact : filtered.rung;
  if (campaign_.arithmetic != Arithmetic::kExact) ++collector_.tally(policy).rungs[static_cast<int>(rung)];
  return filtered;
}

Outcome Examiner::Decide(const Place& place, const ExactProblem& problem, const OnRung& filtered,
                         bool suspected) {
  const Verdict& verdict = filtered.verdict;
  const bool certified = filtered.by_balls && verdict.outcome != Outcome::kUndecided;
  const bool drawn = !suspected || IsDrawn(DrawOf(place.index));
  if (drawn || !certified) return Examine(place, problem, certified ? &verdict : nullptr, suspected, drawn);
  collector_.CountVerdict(place, verdict.outcome, suspected);
  if (verdict.outcome != Outcome::kSolved) Confirm(place, problem, filtered);
  return verdict.outcome;
}

void Examiner::Confirm(const Place& place, const ExactProblem& problem, const OnRung& filtered) {
  const Verdict& verdict = filtered.verdict;
  const Spending spending(collector_.meter(), &ProcessorTime::compared);
  const Request request = {
      .policy = campaign_.policies[place.policy], .limits = campaign_.limits, .trace = true};
  const bool is_told = !filtered.pivots.empty();
  const auto pivots = is_told ? filtered.pivots : RunEnclosed("baraff", problem, request, filtered.rung).pivots;
  if (!FindUnsolved(place, verdict, pivots, problem)) return;
  // Records have an entry of what is compared beyond double-doubles, as where rationals decide.
  if (filtered.rung == Rung::kExact) collector_.agreement();
  const ExactAnswer complete = methods_.complete_filtered(problem, campaign_.limits);
  CompareAnswers(place, verdict.outcome, problem, {{complete, AnswerBy("baraff", verdict.outcome)}, {}});
}

Outcome Examiner::Examine(const Place& place, const ExactProblem& problem, const Verdict* filtered,
                          bool suspected, bool drawn) {
  const ExactRun run = RunExactly(problem, place.policy);
  const Outcome exact = run.verdict.outcome;
  collector_.CountVerdict(place, exact, suspected);
  if (filtered != nullptr) CompareFiltered(place, *filtered, run, problem);
  const bool is_new = exact != Outcome::kSolved && FindUnsolved(place, run.verdict, run.trace.pivots, problem);
  if (!drawn && !is_new) return exact;
  Compare(place, run, problem,
          /*with_lemke=*/!suspected && campaign_.arithmetic == Arithmetic::kDouble);
  if (!suspected && !collector_.generator().HasOtherKinds()) CheckSafety(place, run, problem);
  return exact;
}

template <class Scalar>
bool Examiner::FindUnsolved(const Place& place, const Verdict& verdict,
                            const std::vector<Pivot<Scalar>>& pivots, const ExactProblem& problem) {
  const Outcome outcome = verdict.outcome;
  const bool safe_cycle = outcome == Outcome::kCycle && IsSafe(problem);
  std::string signature = safe_cycle ? "safe-" : "";
  if (IsLoop(outcome)) {
    const LoopFacts loop = FactsOfLoop(problem, verdict, pivots);
    signature += loop.signature;
    collector_.CountLoop(loop, collector_.Named(signature, place.policy));
  } else {
    signature += Signature(problem, verdict, pivots);
  }
  return collector_.Find(place, outcome, safe_cycle ? kSafeCycle : Name(outcome), std::move(signature),
                         problem);
}

void Examiner::CompareFiltered(const Place& place, const Verdict& filtered, const ExactRun& run,
                               const ExactProblem& problem) {
  const Verdict& exact = run.verdict;
  if (filtered.outcome == exact.outcome && filtered.start == exact.start && filtered.period == exact.period &&
      filtered.statistics == exact.statistics)
    return;
  collector_.FindDisagreementOfMethods(
      place, exact.outcome,
      {"filtered-baraff",
       fmt::format("filtered, the published algorithm ends {} after {} steps; over rationals {} after {}",
                   Name(filtered.outcome), filtered.statistics.steps, Name(exact.outcome),
                   exact.statistics.steps)},
      problem, {{AnswerBy("baraff", exact.outcome, run.f)}, {}});
}

void Examiner::CompareInSpace(const Place& place, Outcome published, const ExactProblem& problem) {
  const Spending spending(collector_.meter(), &ProcessorTime::compared);
  const ExactAnswer complete = methods_.complete_in_space(problem, campaign_.limits);
  const bool wrong = complete.Solved() && FindViolation(problem, complete.f);
  collector_.CountExistence(complete, wrong);
  if (!wrong && complete.outcome != Outcome::kRay) return;
  const std::string what = wrong ? "complete-wrong" : fmt::format("complete-{}", Name(complete.outcome));
  collector_.FindDisagreementOfMethods(
      place, published, {what, "complete driving on polygons ended without forces that meet (21) and (22)"},
      problem, {{AnswerBy("complete", complete.outcome, complete.f)}, {}});
}

void Examiner::Compare(const Place& place, const ExactRun& published, const ExactProblem& problem,
                       bool with_lemke) {
  const Spending spending(collector_.meter(), &ProcessorTime::compared);
  Answers answers{{methods_.complete(problem, campaign_.limits),
                   AnswerBy("baraff", published.verdict.outcome, published.f)},
                  {}};
  AgreementTally& tally = collector_.agreement();
  const bool promised = collector_.PromisesSolution();
  const std::uint64_t draw = DrawOf(place.index);
  if (with_lemke || IsOneIn(draw, campaign_.lemke_every)) {
    answers.methods.push_back(methods_.lemke(problem, campaign_.limits));
    tally.compared += promised;
  }
  if (collector_.task().contacts <= campaign_.enumerate_contacts && IsOneIn(draw, campaign_.enumerate_every)) {
    answers.modes = methods_.modes(problem);
    if (promised) collector_.CountModes(tally, problem, *answers.modes);
  }
  CompareAnswers(place, published.verdict.outcome, problem, answers);
}

void Examiner::CompareAnswers(const Place& place, Outcome published, const ExactProblem& problem,
                              const Answers& answers) {
  const auto disagreement = FindDisagreement(problem, answers);  // looks at the solution of `complete` first
  if (collector_.PromisesSolution())
    collector_.CountExistence(answers.methods.front(), disagreement && disagreement->what == "complete-wrong");
  if (disagreement) collector_.FindDisagreementOfMethods(place, published, *disagreement, problem, answers);
}

bool Examiner::IsSafe(const ExactProblem& problem) {
  const Spending spending(collector_.meter(), &ProcessorTime::compared);
  return methods_.is_safe(problem) == true;
}

void Examiner::CheckSafety(const Place& place, const ExactRun& published, const ExactProblem& problem) {
  const Spending spending(collector_.meter(), &ProcessorTime::compared);
  if (collector_.task().contacts > kMostContactsEnumerated) return;
  AgreementTally& tally = collector_.agreement();
  ++tally.safety_decided;
  if (methods_.is_safe(problem) != true) return;
  ++tally.safe;
  Policy policy = published.policy;
  policy.apex = Apex::kSuspended;
  const ExactRun run = methods_.published(problem, {.policy = policy, .limits = campaign_.limits});
  if (run.verdict.statistics.give_ups == 0) return;
  ++tally.safe_gave_up;
  if (HasTies(problem, run)) return;
  ++tally.safe_gave_up_no_ties;
  collector_.FindDisagreementOfMethods(
      place, published.verdict.outcome,
      {"safe-give-up", fmt::format("the problem is safe and the run without ties, yet {} gives up {} times",
                                   PolicyName(policy), run.verdict.statistics.give_ups)},
      problem, {{AnswerBy("baraff", run.verdict.outcome, run.f)}, {}});
}

}  // namespace stiction
