// SPDX-License-Identifier: Apache-2.0
// Collector: what one unit counts and finds while it runs.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "corpus/json_text.h"
#include "search/campaign.h"
#include "search/generators/generators.h"
#include "search/units/signature.h"
#include "search/units/unit.h"
#include "search/units/work_meter.h"
#include "solver/problem/answer.h"

namespace stiction {

struct Answers;       // certify/claims/agreement.h
struct Disagreement;  // certify/claims/agreement.h
struct Enumeration;   // certify/exact/enumerate.h

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
      tally.strata[{NameOf(campaign_, friction), static_cast<int>(i) % ranks_}].Merge(strata_[i]);
    }
  }
  // Of a friction as Drawn has it.
  static std::string NameOf(const Campaign& campaign, int friction) {
    if (friction == Drawn::kMixed) return kMixedFriction;
    const MuChoice& mu = campaign.palette[static_cast<std::size_t>(friction)];
    return ToString(Rational(mu.numerator) / Rational(mu.denominator));
  }

 private:
  const Campaign& campaign_;
  int ranks_;
  std::vector<Stratum> strata_;  // rank by rank of the mixed, then of each friction of the palette
};

class Collector {
 public:
  // A run of a problem that exact arithmetic looks at again.
  struct Place {
    std::int64_t index;
    std::size_t policy;
    Outcome inexact;
    Drawn drawn;
  };

  Collector(const Campaign& campaign, const Task& task, std::int64_t unit);

  const Campaign& campaign() const { return campaign_; }
  const Task& task() const { return task_; }
  const GeneratorRow& generator() const { return Row(task_.generator); }
  std::int64_t unit() const { return unit_; }
  WorkMeter& meter() { return meter_; }
  Tally& tally(std::size_t policy) { return *tallies_[policy]; }
  AgreementTally& agreement() { return result_.record.agreement[task_.contacts]; }
  bool PromisesSolution() const { return generator().other_kind != ContactKind::kSliding; }

  void Count(std::size_t policy, const Drawn& drawn, const Verdict& verdict) {
    tallies_[policy]->Count(verdict);
    strata_[policy].At(drawn).Count(verdict);
  }
  void CountVerdict(const Place& place, Outcome exact, bool suspected);
  void CountLoop(const LoopFacts& loop, const std::string& signature);
  void CountExistence(const Answer<Rational>& complete, bool wrong);
  static void CountModes(AgreementTally& tally, const ExactProblem& problem, const Enumeration& modes);
  // Of a problem that is solved exactly.
  void FindOfDoubles(const Place& place, bool wrong, const ExactProblem& problem);
  void FindDisagreementOfMethods(const Place& place, Outcome published, const Disagreement& disagreement,
                                 const ExactProblem& problem, const Answers& answers);
  // Whether it is the first with this signature in the unit.
  bool Find(const Place& place, Outcome exact, std::string_view kind, std::string signature,
            const ExactProblem& problem, const SharedJson& facts = {});
  // A signature as the store has it.
  std::string Named(std::string signature, std::size_t number) const;

  UnitResult Take();

 private:
  const Campaign& campaign_;
  const Task& task_;
  std::int64_t unit_;
  WorkMeter meter_;
  UnitResult result_;
  std::vector<Tally*> tallies_;
  std::vector<Strata> strata_;  // of each policy
};

}  // namespace stiction
