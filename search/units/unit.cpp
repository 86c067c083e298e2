// SPDX-License-Identifier: Apache-2.0
#include "search/units/unit.h"

#include <fmt/format.h>

#include <map>
#include <tuple>

#include "certify/claims/agreement.h"
#include "certify/exact/enumerate.h"
#include "certify/exact/exact.h"
#include "certify/exact/filtered.h"
#include "certify/exact/published_space.h"
#include "certify/exact/space.h"
#include "certify/exact/verify_solution.h"
#include "corpus/record/kinds.h"
#include "corpus/record/scene_file.h"
#include "search/generators/generators.h"
#include "search/generators/scenes.h"
#include "search/lanes/batch.h"
#include "search/units/signature.h"
#include "search/units/work_meter.h"
#include "solver/problem/gate.h"
#include "solver/problem/reduction.h"
#include "solver/published/published.ipp"
#include "solver/published/published_space.h"

namespace stiction {
namespace {

constexpr double kWrongAnswer = 1e-6;  // error (solver/problem/errors.h)

ProblemFile FileOf(const Campaign& campaign, std::int64_t unit, std::int64_t index,
                   const ExactProblem& problem) {
  const Task task = TaskOf(Schedule(campaign), unit);
  const std::string generator(Row(task.generator).name);
  ProblemFile file;
  file.name = fmt::format("{}-{}-{}", generator, unit, index);
  file.problem = problem;
  file.origin = Json{{"generator", generator},
                     {"campaign_seed", std::to_string(campaign.seed)},
                     {"unit", unit},
                     {"index", index}};
  Choices choices(
      ProblemSeed(campaign.seed, static_cast<std::uint64_t>(unit), static_cast<std::uint64_t>(index)));
  if (auto scene = GenerateScene(task.generator, task.contacts, SurroundingsOf(campaign), choices)) {
    scene->name = file.name;
    SceneFile scene_file;
    scene_file.scene = *std::move(scene);
    file.scene = ToJson(scene_file);
  }
  return file;
}

// The problem with this number, over rationals.
struct Regenerated {
  ExactProblem problem;
  Drawn drawn;
};

Regenerated RegenerateDrawn(const Campaign& campaign, std::int64_t unit, std::int64_t index) {
  const Task task = TaskOf(Schedule(campaign), unit);
  Choices choices(
      ProblemSeed(campaign.seed, static_cast<std::uint64_t>(unit), static_cast<std::uint64_t>(index)));
  Regenerated made;
  made.drawn = Generate<Rational, Eigen::Dynamic>(task.generator, task.contacts, SurroundingsOf(campaign),
                                                  choices, made.problem);
  return made;
}

// The strata of a tally, by numbers instead of names.
class Strata {
 public:
  Strata(const Campaign& campaign, const Task& task)
      : campaign_(campaign),
        ranks_(Row(task.generator).dimension * task.contacts + 1),
        strata_((campaign.palette.size() + 1) * static_cast<std::size_t>(ranks_)) {}

  Stratum& At(const Drawn& drawn) {
    return strata_[static_cast<std::size_t>((drawn.friction - Drawn::kMixed) * ranks_ + drawn.rank)];
  }
  void AddTo(Tally& tally) const {
    for (std::size_t i = 0; i < strata_.size(); ++i) {
      if (strata_[i].problems == 0) continue;
      const int friction = static_cast<int>(i) / ranks_ + Drawn::kMixed;
      tally.strata[{NameOf(friction), static_cast<int>(i) % ranks_}].Merge(strata_[i]);
    }
  }

 private:
  std::string NameOf(int friction) const {
    if (friction == Drawn::kMixed) return kMixedFriction;
    const MuChoice& mu = campaign_.palette[static_cast<std::size_t>(friction)];
    return ToString(Rational(mu.numerator) / Rational(mu.denominator));
  }

  const Campaign& campaign_;
  int ranks_;
  std::vector<Stratum> strata_;  // rank by rank of the mixed, then of each friction of the palette
};

// What one unit collects while it runs.
class Collector {
 public:
  Collector(const Campaign& campaign, const ExactMethods& methods, const Task& task, std::int64_t unit)
      : campaign_(campaign),
        methods_(methods),
        task_(task),
        unit_(unit),
        strata_(campaign.policies.size(), Strata(campaign, task)) {
    result_.problems = UnitProblems(campaign, task);
    for (const Policy& policy : campaign.policies) {
      const TallyKey key{std::string(Row(task.generator).name), task.contacts, PolicyName(policy), "baraff",
                         std::string(Name(campaign.arithmetic))};
      tallies_.push_back(&result_.record.tallies[key]);
    }
  }

  Tally& tally(std::size_t policy) { return *tallies_[policy]; }
  void Count(std::size_t policy, const Drawn& drawn, const Verdict& verdict) {
    tallies_[policy]->Count(verdict);
    strata_[policy].At(drawn).Count(verdict);
  }

  // A problem that is looked at again. `suspected`: the inexact run did not end in a verified solution.
  // Certified signs decide; what they leave open, what is audited, and a few of the others are examined over
  // rationals.
  void RunAgain(std::int64_t index, std::size_t policy, Outcome inexact, bool wrong, bool suspected) {
    const auto [problem, drawn] = Regenerate(index);
    const Place place = {index, policy, inexact, drawn};
    // The first rung seldom tells what rounding did not.
    const Rung first = suspected ? Rung::kDoubleDouble : Rung::kDouble;
    if (Decide(place, problem, Filter(problem, policy, {first, Rung::kDoubleDouble}), suspected) ==
        Outcome::kSolved)
      FindOfDoubles(place, wrong, problem);
  }

  // Problem `index` where the campaign asks for certified signs from the start.
  void RunCertified(std::int64_t index, std::size_t policy, bool audit) {
    const bool exact = campaign_.arithmetic == Arithmetic::kExact;
    const auto [problem, drawn] = Regenerate(index);
    const OnRung filtered = Filter(problem, policy, {exact ? Rung::kExact : Rung::kDouble, Rung::kExact});
    const Verdict& verdict = filtered.verdict;
    Count(policy, drawn, verdict);
    const bool suspected = verdict.outcome != Outcome::kSolved;
    const Place place = {index, policy, verdict.outcome, drawn};
    if (audit || (exact && suspected)) {
      Examine(place, problem, exact ? nullptr : &verdict, suspected);
    } else if (suspected) {
      Decide(place, problem, filtered, suspected);
    }
  }

  // The same in space, over intervals: `undecided` is a verdict, which makes no finding unless doubles suspect
  // a loop.
  void RunOverIntervals(std::int64_t index, std::size_t policy, const Verdict& inexact, bool wrong,
                        bool suspected) {
    const auto [problem, drawn] = Regenerate(index);
    const InexactAnswer answer = RunInSpace(problem, policy);
    const Outcome proved = answer.outcome;
    const Place place = {index, policy, inexact.outcome, drawn};
    CountVerdict(place, proved, suspected);
    CompareInSpace(place, proved, problem);
    if (proved == Outcome::kSolved) {
      FindOfDoubles(place, wrong, problem);
    } else if (proved != Outcome::kUndecided) {
      Find(place, proved, Name(proved), CountsSignature(task_.contacts, proved, answer.period), problem);
    } else if (inexact.outcome == Outcome::kCycle) {
      Find(place, proved, Name(proved),
           "undecided-" + CountsSignature(task_.contacts, inexact.outcome, inexact.period), problem);
    }
  }

  WorkMeter& meter() { return meter_; }
  UnitResult Take() {
    for (std::size_t policy = 0; policy < tallies_.size(); ++policy) strata_[policy].AddTo(*tallies_[policy]);
    result_.time = meter_.Read();
    return std::move(result_);
  }

 private:
  // Where an exact run comes from.
  struct Place {
    std::int64_t index;
    std::size_t policy;
    Outcome inexact;
    Drawn drawn;
  };

  Regenerated Regenerate(std::int64_t index) {
    const Spending spending(meter_, &ProcessorTime::generation);
    return RegenerateDrawn(campaign_, unit_, index);
  }

  InexactAnswer RunInSpace(const ExactProblem& problem, std::size_t policy) {
    const Spending spending(meter_, &ProcessorTime::exact);
    return methods_.published_in_space(problem, OptionsOf(policy));
  }

  ExactRun RunExactly(const ExactProblem& problem, std::size_t policy) {
    const Spending spending(meter_, &ProcessorTime::exact);
    return methods_.published(problem, OptionsOf(policy));
  }

  PublishedOptions OptionsOf(std::size_t policy) const {
    return {campaign_.policies[policy], {}, campaign_.limits};
  }

  // What a problem is drawn by for the methods that run on a few only.
  std::uint64_t DrawOf(std::int64_t index) const {
    return Mix(
        ProblemSeed(campaign_.seed, static_cast<std::uint64_t>(unit_), static_cast<std::uint64_t>(index)));
  }
  static bool IsOneIn(std::uint64_t draw, std::int64_t every) {
    return draw % static_cast<std::uint64_t>(every) == 0;
  }
  bool IsDrawn(std::uint64_t draw) const {
    return IsOneIn(draw, campaign_.complete_every) || IsOneIn(draw, campaign_.lemke_every) ||
           IsOneIn(draw, campaign_.enumerate_every);
  }

  OnRung Filter(const ExactProblem& problem, std::size_t policy, const Rungs& rungs) {
    const Spending spending(meter_, &ProcessorTime::filtered);
    const OnRung filtered = methods_.filtered(problem, OptionsOf(policy), rungs);
    const Rung rung = IsUnsure(filtered.verdict) ? Rung::kExact : filtered.rung;
    if (campaign_.arithmetic != Arithmetic::kExact) ++tallies_[policy]->rungs[static_cast<int>(rung)];
    return filtered;
  }
  static bool IsUnsure(const Verdict& verdict) {
    return verdict.outcome == Outcome::kUndecided && verdict.reason == kUnsureSign;
  }

  // The outcome in exact arithmetic: that of certified signs, or of a run over rationals.
  Outcome Decide(const Place& place, const ExactProblem& problem, const OnRung& filtered, bool suspected) {
    const Verdict& verdict = filtered.verdict;
    const bool certified = filtered.rung != Rung::kExact && verdict.outcome != Outcome::kUndecided;
    const bool drawn = !suspected || IsDrawn(DrawOf(place.index));
    if (drawn || !certified) return Examine(place, problem, certified ? &verdict : nullptr, suspected, drawn);
    CountVerdict(place, verdict.outcome, suspected);
    if (verdict.outcome != Outcome::kSolved) Confirm(place, problem, filtered);
    return verdict.outcome;
  }

  // What is not solved, by certified signs: complete driving must solve it.
  void Confirm(const Place& place, const ExactProblem& problem, const OnRung& filtered) {
    const Verdict& verdict = filtered.verdict;
    const Spending spending(meter_, &ProcessorTime::compared);
    const ExactAnswer complete = methods_.complete_filtered(problem, campaign_.limits);
    CompareAnswers(place, verdict.outcome, problem, {{complete, AnswerBy("baraff", verdict.outcome)}, {}});
    const SolveOptions options = {.policy = campaign_.policies[place.policy], .limits = campaign_.limits};
    const InexactAnswer run = RunEnclosed("baraff", problem, options, filtered.rung, KeepTrace::kYes);
    FindUnsolved(place, verdict, run.pivots, problem);
  }

  // Runs exactly, counts, compares; returns the exact outcome. `filtered`: what was said with certified signs,
  // null if nothing. What is solved and not drawn, other methods do not see.
  Outcome Examine(const Place& place, const ExactProblem& problem, const Verdict* filtered, bool suspected,
                  bool drawn = true) {
    const ExactRun run = RunExactly(problem, place.policy);
    const Outcome exact = run.verdict.outcome;
    CountVerdict(place, exact, suspected);
    if (filtered != nullptr) CompareFiltered(place, *filtered, run, problem);
    if (exact == Outcome::kSolved && !drawn) return exact;
    Compare(place, run, problem, /*with_lemke=*/!suspected && campaign_.arithmetic == Arithmetic::kDouble);
    if (!suspected && !Row(task_.generator).HasOtherKinds()) CheckSafety(place, run, problem);
    if (exact == Outcome::kSolved) return exact;
    FindUnsolved(place, run.verdict, run.trace.pivots, problem);
    return exact;
  }

  template <class Scalar>
  void FindUnsolved(const Place& place, const Verdict& verdict, const std::vector<Pivot<Scalar>>& pivots,
                    const ExactProblem& problem) {
    const Outcome outcome = verdict.outcome;
    const bool safe_cycle = outcome == Outcome::kCycle && IsSafe(problem);
    std::string signature = safe_cycle ? "safe-" : "";
    if (IsLoop(outcome)) {
      const LoopFacts loop = FactsOfLoop(problem, verdict, pivots);
      signature += loop.signature;
      CountLoop(loop, Named(signature, place.policy));
    } else {
      signature += Signature(problem, verdict, pivots);
    }
    Find(place, outcome, safe_cycle ? kSafeCycle : Name(outcome), std::move(signature), problem);
  }

  void CountLoop(const LoopFacts& loop, const std::string& signature) {
    LoopTally& tally = result_.record.loops[loop.contacts];
    ++tally.loops;
    tally.drives += loop.drives;
    tally.steps += loop.steps;
    tally.zero_steps += loop.zero_steps;
    tally.without_zero_steps += loop.zero_steps == 0;
    tally.of_zero_steps_alone += loop.zero_steps == loop.steps;
    ++tally.by_zero_steps[static_cast<int>(loop.zero_steps)];
    if (!loop.named) result_.record.words[signature].Add(Mix(loop.word));
  }

  // Certified signs are those of rationals: the same end after the same steps.
  void CompareFiltered(const Place& place, const Verdict& filtered, const ExactRun& run,
                       const ExactProblem& problem) {
    const Verdict& exact = run.verdict;
    if (filtered.outcome == exact.outcome && filtered.start == exact.start && filtered.period == exact.period &&
        filtered.statistics == exact.statistics)
      return;
    FindDisagreementOfMethods(
        place, exact.outcome,
        {"filtered-baraff",
         fmt::format("filtered, the published algorithm ends {} after {} steps; over rationals {} after {}",
                     Name(filtered.outcome), filtered.statistics.steps, Name(exact.outcome),
                     exact.statistics.steps)},
        problem, {{AnswerBy("baraff", exact.outcome, run.state.f)}, {}});
  }

  // Complete driving on polygons ends in a solution of its own law, which is proved; that more corners lead to
  // one of (21), (22) is not.
  void CompareInSpace(const Place& place, Outcome published, const ExactProblem& problem) {
    const Spending spending(meter_, &ProcessorTime::compared);
    const ExactAnswer complete = methods_.complete_in_space(problem, campaign_.limits);
    const bool wrong = complete.Solved() && FindWeakViolation(problem, complete.f);
    CountExistence(complete, wrong);
    if (!wrong && complete.outcome != Outcome::kRay) return;
    const std::string what = wrong ? "complete-wrong" : fmt::format("complete-{}", Name(complete.outcome));
    FindDisagreementOfMethods(
        place, published, {what, "complete driving on polygons ended without forces that meet (21) and (22)"},
        problem, {{AnswerBy("complete", complete.outcome, complete.f)}, {}});
  }

  void CountVerdict(const Place& place, Outcome exact, bool suspected) {
    Tally& tally = *tallies_[place.policy];
    Stratum& stratum = strata_[place.policy].At(place.drawn);
    if (suspected) {
      ++tally.verdicts[static_cast<int>(place.inexact)][static_cast<int>(exact)];
      ++stratum.exact[static_cast<int>(exact)];
      return;
    }
    if (exact == Outcome::kUndecided) return;
    const bool misjudged = exact != place.inexact;
    ++tally.audited;
    ++stratum.audited;
    tally.misjudged += misjudged;
    stratum.misjudged += misjudged;
  }

  // Of a problem that is solved exactly.
  void FindOfDoubles(const Place& place, bool wrong, const ExactProblem& problem) {
    // What leaves before a run leaves it over doubles.
    if (!Row(task_.generator).exact_in_double || Row(task_.generator).HasOtherKinds()) return;
    if (wrong) {
      Find(place, Outcome::kSolved, "wrong-answer", fmt::format("wrong-answer-{}c", task_.contacts), problem);
    } else if (place.inexact != Outcome::kSolved) {
      Find(place, Outcome::kSolved, "disagreement",
           fmt::format("disagreement-{}-solved-{}c", Name(place.inexact), task_.contacts), problem);
    }
  }

  // Holds the methods against each other. All generators promise A positive semidefinite and b in range(A), as
  // FindDisagreement requires; that there is a solution is counted where none slides. Lemke's method where
  // asked for, otherwise by lot.
  void Compare(const Place& place, const ExactRun& published, const ExactProblem& problem, bool with_lemke) {
    const Spending spending(meter_, &ProcessorTime::compared);
    Answers answers{{methods_.complete(problem, campaign_.limits),
                     AnswerBy("baraff", published.verdict.outcome, published.state.f)},
                    {}};
    AgreementTally& tally = result_.record.agreement[task_.contacts];
    const bool promised = PromisesSolution();
    const std::uint64_t draw = DrawOf(place.index);
    if (with_lemke || IsOneIn(draw, campaign_.lemke_every)) {
      answers.methods.push_back(methods_.lemke(problem, campaign_.limits));
      tally.compared += promised;
    }
    if (task_.contacts <= kMostContactsEnumerated && IsOneIn(draw, campaign_.enumerate_every)) {
      answers.modes = methods_.modes(problem);
      if (promised) CountModes(tally, problem, *answers.modes);
    }
    CompareAnswers(place, published.verdict.outcome, problem, answers);
  }

  // The answer of complete driving is the first.
  void CompareAnswers(const Place& place, Outcome published, const ExactProblem& problem,
                      const Answers& answers) {
    const auto disagreement = FindDisagreement(problem, answers);  // looks at the solution of `complete` first
    if (PromisesSolution())
      CountExistence(answers.methods.front(), disagreement && disagreement->what == "complete-wrong");
    if (disagreement) FindDisagreementOfMethods(place, published, *disagreement, problem, answers);
  }
  bool PromisesSolution() const { return Row(task_.generator).other_kind != ContactKind::kSliding; }

  void FindDisagreementOfMethods(const Place& place, Outcome published, const Disagreement& disagreement,
                                 const ExactProblem& problem, const Answers& answers) {
    ++result_.record.agreement[task_.contacts].disagreements;
    Find(place, published, kDisagreementOfMethods,
         fmt::format("{}-{}-{}c", kDisagreementOfMethods, disagreement.what, task_.contacts), problem,
         Json{{"disagreement", disagreement.reason}, {"answers", AnswersToJson(answers)}});
  }

  void CountExistence(const ExactAnswer& complete, bool wrong) {
    ExistenceTally& tally = result_.record.existence[task_.contacts];
    ++tally.problems;
    tally.solved += complete.Solved() && !wrong;
    tally.pieces += ValueOf(complete.counters, "pieces");
    tally.with_folds += ValueOf(complete.counters, "folds") > 0;
    tally.with_descents += ValueOf(complete.counters, "descents") > 0;
    tally.with_ties += ValueOf(complete.counters, "ties") > 0;
  }

  static void CountModes(AgreementTally& tally, const ExactProblem& problem, const Enumeration& modes) {
    ++tally.enumerated;
    if (modes.end != EnumerationEnd::kComplete) return;
    const SolutionCount count = CountSolutions(problem, modes);
    tally.continua += count.continuum;
    tally.regular += count.regular;
    tally.signs_not_one += count.regular && count.signs != 1;
    ++tally.words[count.words];
    if (count.regular) ++tally.solutions[count.words];
  }

  bool IsSafe(const ExactProblem& problem) {
    const Spending spending(meter_, &ProcessorTime::compared);
    return methods_.is_safe(problem) == true;
  }

  // In a safe problem nothing is given up under apex=suspended, unless there are ties.
  void CheckSafety(const Place& place, const ExactRun& published, const ExactProblem& problem) {
    const Spending spending(meter_, &ProcessorTime::compared);
    if (task_.contacts > kMostContactsEnumerated) return;
    AgreementTally& tally = result_.record.agreement[task_.contacts];
    ++tally.safety_decided;
    if (methods_.is_safe(problem) != true) return;
    ++tally.safe;
    Policy policy = published.policy;
    policy.apex = Apex::kSuspended;
    const ExactRun run = methods_.published(problem, {policy, {}, campaign_.limits});
    if (run.verdict.statistics.give_ups == 0) return;
    ++tally.safe_gave_up;
    if (HasTies(problem, run)) return;
    ++tally.safe_gave_up_no_ties;
    FindDisagreementOfMethods(
        place, published.verdict.outcome,
        {"safe-give-up", fmt::format("the problem is safe and the run without ties, yet {} gives up {} times",
                                     PolicyName(policy), run.verdict.statistics.give_ups)},
        problem, {{AnswerBy("baraff", run.verdict.outcome, run.state.f)}, {}});
  }

  // A signature as the store has it.
  std::string Named(std::string signature, std::size_t number) const {
    const Policy& policy = campaign_.policies[number];
    if (!(policy == Policy{})) signature += "@" + PolicyName(policy);
    return signature;
  }

  void Find(const Place& place, Outcome exact, std::string_view kind, std::string signature,
            const ExactProblem& problem, const Json& facts = nullptr) {
    const Policy& policy = campaign_.policies[place.policy];
    signature = Named(std::move(signature), place.policy);
    if (++result_.record.signatures[signature] > 1) return;
    const bool full =
        static_cast<std::int64_t>(result_.candidates.size()) >= campaign_.representatives_per_unit;
    if (full && !IsGrave(kind)) return;
    Finding finding;
    finding.signature = std::move(signature);
    finding.kind = kind;
    finding.unit = unit_;
    finding.index = place.index;
    finding.generator = Row(task_.generator).name;
    finding.contacts = task_.contacts;
    finding.policy = PolicyName(policy);
    finding.inexact_outcome = Name(place.inexact);
    finding.exact_outcome = Name(exact);
    finding.problem = ToJson(FileOf(campaign_, unit_, place.index, problem)).dump();
    if (!facts.is_null()) finding.facts = facts.dump();
    result_.candidates.push_back(std::move(finding));
  }

  const Campaign& campaign_;
  const ExactMethods& methods_;
  const Task& task_;
  std::int64_t unit_;
  WorkMeter meter_;
  UnitResult result_;
  std::vector<Tally*> tallies_;
  std::vector<Strata> strata_;  // of each policy
};

// draw(choices) for problem after problem of a unit, then attempt(index, policy, audit) under every policy.
template <class Draw, class Attempt>
void TryAll(const Campaign& campaign, std::int64_t unit, const Task& task, WorkMeter& meter, Draw draw,
            Attempt attempt) {
  SampledDraws draws;
  const std::int64_t problems = UnitProblems(campaign, task);
  std::int64_t until_audit = 1;  // the first problem is audited
  for (std::int64_t index = 0; index < problems; ++index) {
    Choices choices(
        ProblemSeed(campaign.seed, static_cast<std::uint64_t>(unit), static_cast<std::uint64_t>(index)));
    draws(index, [&] { draw(choices); });
    const bool audit = --until_audit == 0;
    if (audit) until_audit = campaign.audit_every;
    for (std::size_t policy = 0; policy < campaign.policies.size(); ++policy) attempt(index, policy, audit);
  }
  meter.Attribute(&ProcessorTime::generation, draws.Nanoseconds(problems));
}

struct Judgement {
  bool wrong = false;      // called solved, with forces that are no solution
  bool suspected = false;  // not a verified solution
};

// Counts a run over doubles. error() is the largest of its forces.
template <class Error>
Judgement Judge(Collector& collector, std::size_t policy, const Drawn& drawn, const Verdict& verdict,
                Error error) {
  collector.Count(policy, drawn, verdict);
  const bool solved = verdict.outcome == Outcome::kSolved;
  const bool wrong = solved && !(error() <= kWrongAnswer);
  collector.tally(policy).wrong += wrong;
  return {wrong, !solved || wrong};
}

// Problems of a fixed number of contacts.
class SizedKernel {
 public:
  virtual ~SizedKernel() = default;
  virtual void Run(std::int64_t unit, const Task& task, Collector& collector) = 0;
};

// Rows: two for each contact, or dynamic, where bilateral and sliding contacts leave the problem before a run
// (solver/problem/reduction.h).
template <int Rows>
class Kernel final : public SizedKernel {
 public:
  Kernel(const Campaign& campaign, const UnitSolvers& solvers) : campaign_(campaign), solvers_(solvers) {
    for (const Policy& policy : campaign.policies) {
      algorithms_.emplace_back(PublishedOptions{policy, {}, campaign.limits});
    }
    const bool batched = Rows == kBatchRows && campaign.policies.size() == 1 && !solvers.distort &&
                         IsBatched(algorithms_.front().options());
    if (batched && solvers.lanes != InstructionSet::kNone)
      batch_ = std::make_unique<Batch>(solvers.lanes, algorithms_.front().options());
  }

  void Run(std::int64_t unit, const Task& task, Collector& collector) override {
    const Surroundings surroundings = SurroundingsOf(campaign_);
    if constexpr (Rows == kBatchRows) {
      if (batch_ != nullptr) return RunBatched(unit, task, surroundings, collector);
    }
    bool reduced = true;
    const auto draw = [&](Choices& choices) {
      drawn_ = Generate<double, Rows>(task.generator, task.contacts, surroundings, choices, problem_);
      if constexpr (Rows == Eigen::Dynamic) {
        whole_ = problem_;
        reduction_.emplace(whole_);
        reduced = reduction_->end() == ReductionEnd::kReduced;
        if (reduced) problem_ = reduction_->problem();
      }
    };
    TryAll(campaign_, unit, task, collector.meter(), draw,
           [&](std::int64_t index, std::size_t policy, bool audit) {
             if (reduced)
               Try(index, policy, audit, collector);
             else
               Refuse(index, policy, collector);
           });
  }

 private:
  using Vector = typename ContactProblem<double, Rows>::Vector;

  // The same, many problems at once; what leaves the lanes is run by itself.
  void RunBatched(std::int64_t unit, const Task& task, const Surroundings& surroundings, Collector& collector) {
    const std::int64_t problems = UnitProblems(campaign_, task);
    for (std::int64_t first = 0; first < problems; first += kBlockProblems) {
      const int count = static_cast<int>(std::min<std::int64_t>(kBlockProblems, problems - first));
      DrawBlock(unit, task, surroundings, first, count, collector);
      batch_->Run(count);
      for (int i = 0; i < count; ++i) {
        const std::int64_t index = first + i;
        const bool audit = index % campaign_.audit_every == 0;
        drawn_ = batch_->DrawnOf(i);
        if (batch_->IsLeft(i)) {
          batch_->Get(i, problem_);
          Try(index, 0, audit, collector);
        } else {
          Conclude(batch_->VerdictOf(i), index, 0, audit, collector, [&] { return batch_->Error(i); });
        }
      }
    }
  }

  void DrawBlock(std::int64_t unit, const Task& task, const Surroundings& surroundings, std::int64_t first,
                 int count, Collector& collector) {
    const Spending spending(collector.meter(), &ProcessorTime::generation);
    const auto u = static_cast<std::uint64_t>(unit);
    if (IsDrawnInLanes(task.generator))
      return batch_->Draw(task.generator, surroundings.palette, campaign_.seed, u, first, count);
    for (int i = 0; i < count; ++i) {
      Choices choices(ProblemSeed(campaign_.seed, u, static_cast<std::uint64_t>(first + i)));
      const Drawn drawn =
          Generate<double, Rows>(task.generator, task.contacts, surroundings, choices, problem_);
      batch_->Put(i, problem_, drawn);
    }
  }

  // A problem that bilateral and sliding contacts cannot leave over doubles: exact arithmetic decides.
  void Refuse(std::int64_t index, std::size_t policy, Collector& collector) {
    Verdict verdict;
    verdict.outcome = Outcome::kSingular;
    collector.Count(policy, drawn_, verdict);
    collector.RunAgain(index, policy, verdict.outcome, /*wrong=*/false, /*suspected=*/true);
  }

  void Try(std::int64_t index, std::size_t policy, bool audit, Collector& collector) {
    Verdict verdict = algorithms_[policy].Run(problem_);
    const Vector* f = &algorithms_[policy].state().f;
    Vector distorted;
    if (solvers_.distort) {
      distorted = *f;
      solvers_.distort(verdict, {distorted.data(), static_cast<std::size_t>(distorted.size())});
      f = &distorted;
    }
    Conclude(verdict, index, policy, audit, collector, [&] { return Error(*f); });
  }

  template <class ErrorOf>
  void Conclude(const Verdict& verdict, std::int64_t index, std::size_t policy, bool audit,
                Collector& collector, ErrorOf error) {
    const auto [wrong, suspected] = Judge(collector, policy, drawn_, verdict, error);
    if (suspected || audit) collector.RunAgain(index, policy, verdict.outcome, wrong, suspected);
  }

  // Of f alone: the accelerations are computed anew. Of the whole problem, whose A is symmetric.
  double Error(const Vector& f) {
    if constexpr (Rows == Eigen::Dynamic) {
      const Vector forces = reduction_->Forces(f), a = whole_.A * forces + whole_.b;
      return MeasureErrors(whole_, FrictionLaw::kCoulomb, forces, a, units_, 0.0).Largest();
    }
    Vector a = problem_.b;
    const int rows = problem_.rows();
    for (int i = 0; i < rows; ++i) {
      double sum = problem_.b[i];
      for (int j = 0; j < rows; ++j) sum += problem_.A(i, j) * f[j];
      a[i] = sum;
    }
    return MeasureErrors(problem_, FrictionLaw::kCoulomb, f, a, units_, 0.0).Largest();
  }

  const Campaign& campaign_;
  const UnitSolvers& solvers_;
  std::vector<PublishedAlgorithm<double, Rows>> algorithms_;
  ContactProblem<double, Rows> problem_;
  ContactProblem<double> whole_;                // of other kinds, before reduction
  std::optional<Reduction<double>> reduction_;  // likewise
  Units<double> units_;
  Drawn drawn_;
  std::unique_ptr<Batch> batch_;  // null: problems are run one by one
};

// Problems that are decided with certified signs from the start.
class CertifiedKernel final : public SizedKernel {
 public:
  explicit CertifiedKernel(const Campaign& campaign) : campaign_(campaign) {}

  void Run(std::int64_t unit, const Task& task, Collector& collector) override {
    TryAll(
        campaign_, unit, task, collector.meter(), [](Choices&) {},
        [&](std::int64_t index, std::size_t policy, bool audit) {
          collector.RunCertified(index, policy, audit);
        });
  }

 private:
  const Campaign& campaign_;
};

// Problems of space.
class SpaceKernel final : public SizedKernel {
 public:
  SpaceKernel(const Campaign& campaign, const UnitSolvers& solvers) : campaign_(campaign), solvers_(solvers) {}

  void Run(std::int64_t unit, const Task& task, Collector& collector) override {
    const auto draw = [&](Choices& choices) {
      drawn_ = Generate(task.generator, task.contacts, SurroundingsOf(campaign_), choices, problem_);
    };
    TryAll(campaign_, unit, task, collector.meter(), draw,
           [&](std::int64_t index, std::size_t policy, bool audit) { Try(index, policy, audit, collector); });
  }

 private:
  void Try(std::int64_t index, std::size_t policy, bool audit, Collector& collector) {
    algorithm_.options() = {campaign_.policies[policy], {}, campaign_.limits};
    const PublishedSpaceVerdict end = algorithm_.Run(problem_);
    Verdict verdict = {end.outcome, end.reason, end.statistics, end.start, end.period};
    ContactProblem<double>::Vector f = algorithm_.f();
    if (solvers_.distort) solvers_.distort(verdict, {f.data(), static_cast<std::size_t>(f.size())});
    const auto [wrong, suspected] = Judge(collector, policy, drawn_, verdict, [&] {
      return BoundErrors(problem_, FrictionLaw::kBaraff, f.cast<long double>()).Largest();
    });
    if (suspected || audit) collector.RunOverIntervals(index, policy, verdict, wrong, suspected);
  }

  const Campaign& campaign_;
  const UnitSolvers& solvers_;
  PublishedInSpace<double> algorithm_;
  ContactProblem<double> problem_;
  Drawn drawn_;
};

std::unique_ptr<SizedKernel> MakeKernel(const Campaign& campaign, const UnitSolvers& solvers,
                                        const Task& task) {
  if (Row(task.generator).InSpace()) return std::make_unique<SpaceKernel>(campaign, solvers);
  if (campaign.arithmetic != Arithmetic::kDouble) return std::make_unique<CertifiedKernel>(campaign);
  if (Row(task.generator).HasOtherKinds()) return std::make_unique<Kernel<Eigen::Dynamic>>(campaign, solvers);
  switch (task.contacts) {
    case 1:
      return std::make_unique<Kernel<2>>(campaign, solvers);
    case 2:
      return std::make_unique<Kernel<4>>(campaign, solvers);
    case 3:
      return std::make_unique<Kernel<6>>(campaign, solvers);
    case 4:
      return std::make_unique<Kernel<8>>(campaign, solvers);
    case 5:
      return std::make_unique<Kernel<10>>(campaign, solvers);
    case 6:
      return std::make_unique<Kernel<12>>(campaign, solvers);
    case 7:
      return std::make_unique<Kernel<14>>(campaign, solvers);
    case 8:
      return std::make_unique<Kernel<16>>(campaign, solvers);
    default:
      throw InputError(
          fmt::format("campaign: found {} contacts, expected 1 to {}", task.contacts, kMaxContacts));
  }
}

}  // namespace

struct UnitRunner::Implementation {
  Implementation(const Campaign& c, const UnitSolvers& s) : campaign(c), solvers(s), schedule(Schedule(c)) {}

  Campaign campaign;
  UnitSolvers solvers;
  std::vector<Task> schedule;
  std::map<std::tuple<int, int, bool>, std::unique_ptr<SizedKernel>>
      kernels;  // contacts, dimension, other kinds
};

UnitRunner::UnitRunner(const Campaign& campaign, const UnitSolvers& solvers)
    : implementation_(std::make_unique<Implementation>(campaign, solvers)) {}
UnitRunner::~UnitRunner() = default;

UnitResult UnitRunner::Run(std::int64_t unit) {
  Implementation& self = *implementation_;
  const Task task = TaskOf(self.schedule, unit);
  const GeneratorRow& row = Row(task.generator);
  std::unique_ptr<SizedKernel>& kernel = self.kernels[{task.contacts, row.dimension, row.HasOtherKinds()}];
  if (kernel == nullptr) kernel = MakeKernel(self.campaign, self.solvers, task);
  Collector collector(self.campaign, self.solvers.exact, task, unit);
  kernel->Run(unit, task, collector);
  return collector.Take();
}

ProblemFile RegenerateFile(const Campaign& campaign, std::int64_t unit, std::int64_t index) {
  return FileOf(campaign, unit, index, RegenerateExactly(campaign, unit, index));
}

ExactProblem RegenerateExactly(const Campaign& campaign, std::int64_t unit, std::int64_t index) {
  return RegenerateDrawn(campaign, unit, index).problem;
}

}  // namespace stiction
