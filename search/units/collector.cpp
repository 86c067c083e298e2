// SPDX-License-Identifier: Apache-2.0
#include "search/units/collector.h"

#include <fmt/format.h>

#include "certify/claims/agreement.h"
#include "certify/exact/enumerate.h"
#include "corpus/record/kinds.h"
#include "corpus/record/problem_file.h"
#include "search/units/regenerate.h"

namespace stiction {

Collector::Collector(const Campaign& campaign, const Task& task, std::int64_t unit)
    : campaign_(campaign), task_(task), unit_(unit), strata_(campaign.policies.size(), Strata(campaign, task)) {
  result_.problems = UnitProblems(campaign, task, unit);
  for (const Policy& policy : campaign.policies) {
    const TallyKey key{std::string(generator().name), task.contacts, PolicyName(policy), "baraff",
                       std::string(Name(campaign.arithmetic))};
    tallies_.push_back(&result_.record.tallies[key]);
  }
}

UnitResult Collector::Take() {
  for (std::size_t policy = 0; policy < tallies_.size(); ++policy) strata_[policy].AddTo(*tallies_[policy]);
  result_.time = meter_.Read();
  return std::move(result_);
}

void Collector::CountVerdict(const Place& place, Outcome exact, bool suspected) {
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

void Collector::CountLoop(const LoopFacts& loop, const std::string& signature) {
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

void Collector::CountExistence(const Answer<Rational>& complete, bool wrong) {
  ExistenceTally& tally = result_.record.existence[task_.contacts];
  ++tally.problems;
  tally.solved += complete.Solved() && !wrong;
  tally.pieces += complete.counters[Counter::kPieces];
  tally.with_folds += complete.counters[Counter::kFolds] > 0;
  tally.with_descents += complete.counters[Counter::kDescents] > 0;
  tally.with_ties += complete.counters[Counter::kTies] > 0;
}

void Collector::CountModes(AgreementTally& tally, const ExactProblem& problem, const Enumeration& modes) {
  ++tally.enumerated;
  if (modes.end != EnumerationEnd::kComplete) return;
  const SolutionCount count = CountSolutions(problem, modes);
  tally.continua += count.continuum;
  tally.regular += count.regular;
  tally.signs_not_one += count.regular && count.signs != 1;
  ++tally.words[count.words];
  if (count.regular) ++tally.solutions[count.words];
}

void Collector::FindOfDoubles(const Place& place, bool wrong, const ExactProblem& problem) {
  // What leaves before a run leaves it over doubles.
  if (!Row(task_.generator).exact_in_double || Row(task_.generator).HasOtherKinds()) return;
  if (wrong) {
    Find(place, Outcome::kSolved, "wrong-answer", fmt::format("wrong-answer-{}c", task_.contacts), problem);
  } else if (place.inexact != Outcome::kSolved) {
    Find(place, Outcome::kSolved, "disagreement",
         fmt::format("disagreement-{}-solved-{}c", Name(place.inexact), task_.contacts), problem);
  }
}

void Collector::FindDisagreementOfMethods(const Place& place, Outcome published,
                                          const Disagreement& disagreement, const ExactProblem& problem,
                                          const Answers& answers) {
  ++result_.record.agreement[task_.contacts].disagreements;
  const SharedJson facts = {{"disagreement", disagreement.reason}, {"answers", AnswersToJson(answers)}};
  Find(place, published, kDisagreementOfMethods,
       fmt::format("{}-{}-{}c", kDisagreementOfMethods, disagreement.what, task_.contacts), problem, facts);
}

bool Collector::Find(const Place& place, Outcome exact, std::string_view kind, std::string signature,
                     const ExactProblem& problem, const SharedJson& facts) {
  signature = Named(std::move(signature), place.policy);
  if (++result_.record.signatures[signature] > 1) return false;
  const bool full = static_cast<std::int64_t>(result_.candidates.size()) >= campaign_.representatives_per_unit;
  if (full && !IsGrave(kind)) return true;
  Finding finding = FindingAt(campaign_, task_, unit_, place.index, place.policy);
  finding.signature = std::move(signature);
  finding.kind = kind;
  finding.inexact_outcome = Name(place.inexact);
  finding.exact_outcome = Name(exact);
  finding.problem = JsonText(ToJson(FileOf(campaign_, unit_, place.index, problem)));
  if (facts) finding.facts = JsonText(facts);
  result_.candidates.push_back(std::move(finding));
  return true;
}

std::string Collector::Named(std::string signature, std::size_t number) const {
  const Policy& policy = campaign_.policies[number];
  if (!(policy == Policy{})) signature += "@" + PolicyName(policy);
  return signature;
}

}  // namespace stiction
