// SPDX-License-Identifier: Apache-2.0
// Statistics of a campaign: counters that merge by addition, in any order.

#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <concepts>
#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "corpus/json_text.h"
#include "solver/problem/solution.h"

namespace stiction {

// What is counted together.
struct TallyKey {
  std::string generator;
  int contacts = 0;
  std::string policy;
  std::string method = "baraff";
  std::string arithmetic = "double";

  auto operator<=>(const TallyKey&) const = default;
};

SharedJson ToJson(const TallyKey& key);

// visit(mine, theirs) for every counter of two statistics.
template <class Visit>
void ForEachFieldOfTwo(Statistics& mine, const Statistics& theirs, const Visit& visit) {
  std::array<std::int64_t*, sizeof(Statistics) / sizeof(std::int64_t)> left;
  std::size_t n = 0;
  ForEachField(mine, [&](const char*, const char*, std::int64_t& value) { left[n++] = &value; });
  n = 0;
  ForEachField(theirs, [&](const char*, const char*, std::int64_t value) { visit(*left[n++], value); });
}

// The part of a tally with one friction coefficient and one rank.
struct StratumKey {
  std::string friction;  // of all contacts, "1/2"; kMixedFriction where they differ
  int rank = 0;          // what rank(A) is at most, as the generator has it

  auto operator<=>(const StratumKey&) const = default;
};
inline constexpr const char* kMixedFriction = "mixed";

struct Stratum {
  using Outcomes = std::array<std::int64_t, kOutcomeCount>;

  std::int64_t problems = 0;
  std::int64_t steps = 0;
  std::int64_t zero_steps = 0;
  std::int64_t audited = 0;
  std::int64_t misjudged = 0;
  Outcomes outcomes = {};  // as the inexact run ended
  Outcomes exact = {};     // of those run again exactly on a suspicion

  void Count(const Verdict& verdict) {
    ++problems;
    steps += verdict.statistics.steps;
    zero_steps += verdict.statistics.zero_steps;
    ++outcomes[static_cast<int>(verdict.outcome)];
  }
  void Merge(const Stratum& other);
  bool operator==(const Stratum&) const = default;
};

// Runs of one method in one inexact arithmetic, and what exact runs of the same problems said.
struct Tally {
  static constexpr int kBins = 64;  // of steps per problem: 0, 1, ..., 62, and 63 or more
  using Outcomes = std::array<std::int64_t, kOutcomeCount>;

  std::int64_t problems = 0;
  Outcomes outcomes = {};                             // as the inexact run ended
  std::array<Outcomes, kOutcomeCount> verdicts = {};  // [inexact][exact] of the problems run again exactly
  std::int64_t audited = 0;                           // run again exactly without a suspicion, as a sample
  std::int64_t misjudged = 0;                         // of these, with another exact outcome
  std::array<std::int64_t, kRungCount> rungs = {};    // that decided, of the filtered runs
  std::int64_t wrong = 0;  // called solved with an error above the bound of the gate, or not a number
  std::int64_t with_zero_steps = 0;
  std::int64_t with_give_ups = 0;
  Statistics sums;
  Statistics maxima;
  std::array<std::int64_t, kBins> steps = {};
  std::map<StratumKey, Stratum> strata;  // counts of their own: Count leaves them alone

  // One run; inline because it stands on the search's hot path.
  void Count(const Verdict& verdict) {
    const Statistics& s = verdict.statistics;
    ++problems;
    ++outcomes[static_cast<int>(verdict.outcome)];
    with_zero_steps += s.zero_steps > 0;
    with_give_ups += s.give_ups > 0;
    ++steps[s.steps < kBins ? s.steps : kBins - 1];
    Add(s, s);
  }
  void Merge(const Tally& other);
  bool operator==(const Tally&) const = default;

 private:
  void Add(const Statistics& more_sums, const Statistics& more_maxima) {
    ForEachFieldOfTwo(sums, more_sums, [](std::int64_t& mine, std::int64_t theirs) { mine += theirs; });
    ForEachFieldOfTwo(maxima, more_maxima,
                      [](std::int64_t& mine, std::int64_t theirs) { mine = std::max(mine, theirs); });
  }
};

Json ToJson(const Tally& tally);

// Complete driving on the problems that were given to it, by number of contacts: those that the published
// algorithm did not solve, audits, and drawn ones.
struct ExistenceTally {
  std::int64_t problems = 0;
  std::int64_t solved = 0;  // with a solution that stood exact verification
  std::int64_t pieces = 0;
  std::int64_t with_folds = 0;
  std::int64_t with_descents = 0;
  std::int64_t with_ties = 0;

  bool operator==(const ExistenceTally&) const = default;
};

// Methods held against each other (certify/claims/agreement.h), by number of contacts.
struct AgreementTally {
  std::int64_t compared = 0;       // published algorithm, complete driving and Lemke's method side by side
  std::int64_t enumerated = 0;     // of these, with all contact modes tried
  std::int64_t disagreements = 0;  // counted once per problem
  std::int64_t continua = 0;       // enumerated, with a mode word that has more than one solution
  std::int64_t regular = 0;        // enumerated, and every solution stands inside one mode word, alone
  std::int64_t signs_not_one = 0;  // regular, and the signs of the reduced determinants do not sum to 1
  std::int64_t safety_decided = 0;
  std::int64_t safe = 0;                  // all reduced determinants positive
  std::int64_t safe_gave_up = 0;          // safe, and given up something under apex=suspended
  std::int64_t safe_gave_up_no_ties = 0;  // the same, though no step had a tie: a disagreement
  std::map<int, std::int64_t> words;      // enumerated problems by mode words that have solutions
  std::map<int, std::int64_t> solutions;  // regular problems by solutions

  bool operator==(const AgreementTally&) const = default;
};

// Loops in exact arithmetic, with the steps of length zero in their periods, by number of contacts in the
// period.
struct LoopTally {
  std::int64_t loops = 0;
  std::int64_t drives = 0;
  std::int64_t steps = 0;
  std::int64_t zero_steps = 0;
  std::int64_t without_zero_steps = 0;
  std::int64_t of_zero_steps_alone = 0;
  std::map<int, std::int64_t> by_zero_steps;  // loops by how many zero steps their period has

  bool operator==(const LoopTally&) const = default;
};

// The counter that records of older versions do not have: they did not count it.
inline constexpr const char* kNotInOlderRecords = "neither";

// Problems given to a solver under test (search/under_test/), counted together: `spread` is the power of ten
// below the ratio of the largest to the smallest entry of A's diagonal, which the ratio of masses makes.
struct UnderTestKey {
  std::string generator;
  int contacts = 0;
  std::string friction;  // of all contacts, "1/2"; kMixedFriction where they differ
  int rank = 0;          // what rank(A) is at most, as the generator has it
  int spread = 0;

  auto operator<=>(const UnderTestKey&) const = default;
};

// What came of them. Failures by kind (corpus/record/kinds.h), each problem once, but `leak`, which may stand
// beside another.
struct UnderTestTally {
  std::int64_t problems = 0;
  std::int64_t passed = 0;  // called solved, with forces within the accuracy that the solver states
  std::int64_t crash = 0;
  std::int64_t hang = 0;
  std::int64_t not_finite = 0;
  std::int64_t silent_wrong = 0;
  std::int64_t refused_solvable = 0;
  std::int64_t refused = 0;   // given up, and no solution of the solver's law is known
  std::int64_t unjudged = 0;  // called solved, and what the law asks for is not known
  std::int64_t leak = 0;
  std::int64_t misses_coulomb = 0;  // passed by its own law, and further than its accuracy from Coulomb's
  std::int64_t neither = 0;         // passed, and not solved by the strict gate (solver/problem/errors.h)

  bool operator==(const UnderTestTally&) const = default;
};

// How many different words (search/units/signature.h) the loops of a group have. Of their hashes the smallest
// kMost are kept, in order: up to there the number is exact, beyond it follows from how dense they are (the k
// smallest of N uniform numbers). What a union keeps does not depend on the order in which it was made.
class WordSketch {
 public:
  static constexpr std::size_t kMost = 64;

  void Add(std::uint64_t hash);
  void Merge(const WordSketch& other);
  bool IsExact() const { return hashes_.size() < kMost; }
  double Count() const;  // standard error beyond kMost: a factor of 1 +- 1 / sqrt(kMost - 2)
  const std::vector<std::uint64_t>& hashes() const { return hashes_; }

  bool operator==(const WordSketch&) const = default;

 private:
  std::vector<std::uint64_t> hashes_;  // ascending
};

template <class T, class Tally>
concept TallyOf = std::same_as<std::remove_cvref_t<T>, Tally>;

// visit(name, counter)
template <TallyOf<ExistenceTally> Tally, class Visit>
void ForEachCounter(Tally&& tally, Visit visit) {
  visit("problems", tally.problems);
  visit("solved", tally.solved);
  visit("pieces", tally.pieces);
  visit("with_folds", tally.with_folds);
  visit("with_descents", tally.with_descents);
  visit("with_ties", tally.with_ties);
}

template <TallyOf<AgreementTally> Tally, class Visit>
void ForEachCounter(Tally&& tally, Visit visit) {
  visit("compared", tally.compared);
  visit("enumerated", tally.enumerated);
  visit("disagreements", tally.disagreements);
  visit("continua", tally.continua);
  visit("regular", tally.regular);
  visit("signs_not_one", tally.signs_not_one);
  visit("safety_decided", tally.safety_decided);
  visit("safe", tally.safe);
  visit("safe_gave_up", tally.safe_gave_up);
  visit("safe_gave_up_no_ties", tally.safe_gave_up_no_ties);
}

template <TallyOf<LoopTally> Tally, class Visit>
void ForEachCounter(Tally&& tally, Visit visit) {
  visit("loops", tally.loops);
  visit("drives", tally.drives);
  visit("steps", tally.steps);
  visit("zero_steps", tally.zero_steps);
  visit("without_zero_steps", tally.without_zero_steps);
  visit("of_zero_steps_alone", tally.of_zero_steps_alone);
}

template <TallyOf<UnderTestTally> Tally, class Visit>
void ForEachCounter(Tally&& tally, Visit visit) {
  visit("problems", tally.problems);
  visit("passed", tally.passed);
  visit("crash", tally.crash);
  visit("hang", tally.hang);
  visit("not_finite", tally.not_finite);
  visit("silent_wrong", tally.silent_wrong);
  visit("refused_solvable", tally.refused_solvable);
  visit("refused", tally.refused);
  visit("unjudged", tally.unjudged);
  visit("leak", tally.leak);
  visit("misses_coulomb", tally.misses_coulomb);
  visit(kNotInOlderRecords, tally.neither);
}

template <class Tally>
void AddCounters(Tally& sums, const Tally& tally) {
  std::vector<std::int64_t> theirs;
  ForEachCounter(tally, [&theirs](const char*, std::int64_t value) { theirs.push_back(value); });
  auto next = theirs.begin();
  ForEachCounter(sums, [&next](const char*, std::int64_t& mine) { mine += *next++; });
}

// All that a unit, a block or a whole campaign counts.
struct Record {
  std::map<TallyKey, Tally> tallies;
  std::map<std::string, std::int64_t> signatures;  // findings by signature
  std::map<int, ExistenceTally> existence;         // by contacts
  std::map<int, AgreementTally> agreement;         // by contacts
  std::map<int, LoopTally> loops;                  // by contacts in the period
  std::map<std::string, WordSketch> words;         // of groups whose signature has no word, by signature
  std::map<UnderTestKey, UnderTestTally> under_test;

  void Merge(const Record& other);
  // visit(key, tally)
  template <class Visit>
  void ForEachTally(const Visit& visit) const {
    for (const auto& [key, tally] : tallies) visit(key, tally);
  }
  bool operator==(const Record&) const = default;
};

// The same record always has the same text.
std::string Serialize(const Record& record);
// `source` names the text in errors. InputError for what Serialize does not write, and for counts beyond 2^48.
Record ParseRecord(const std::string& text, const std::string& source = "record");

}  // namespace stiction
