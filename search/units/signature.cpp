// SPDX-License-Identifier: Apache-2.0
#include "search/units/signature.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "solver/problem/check.h"

namespace stiction {
namespace {

constexpr std::size_t kMostContactsWithWord = 2;

template <class Scalar>
using Steps = std::vector<const Pivot<Scalar>*>;

// Names of one reading of the period: contacts by first appearance, tangents by their first limit.
class Naming {
 public:
  explicit Naming(const RowLayout<Eigen::Dynamic>& layout) : layout_(layout) {}

  std::string Variable(int row) {
    const int contact = layout_.ContactOf(row);
    const int number = static_cast<int>(names_.try_emplace(contact, names_.size()).first->second);
    return std::to_string(number) + (layout_.IsNormal(row) ? "N" : "F");
  }

  const char* Set(int row, IndexSet set) {
    const int sign = LimitSign(set);
    if (sign == 0) return Name(set);
    const int turn = turns_.try_emplace(layout_.ContactOf(row), sign).first->second;
    return sign * turn > 0 ? "+" : "-";
  }

 private:
  const RowLayout<Eigen::Dynamic>& layout_;
  std::map<int, std::size_t> names_;
  std::map<int, int> turns_;
};

template <class Scalar>
std::string Word(const Steps<Scalar>& period, std::size_t first, const RowLayout<Eigen::Dynamic>& layout) {
  Naming naming(layout);
  std::string word;
  for (std::size_t k = 0; k < period.size(); ++k) {
    const Pivot<Scalar>& step = *period[(first + k) % period.size()];
    word += naming.Variable(step.driven);
    if (step.goal == DriveGoal::kZero) word += '0';
    word += step.s == 0 ? "=" : ">";
    word += naming.Variable(step.limiting);
    word += fmt::format(":{}/{} ", naming.Set(step.limiting, step.from), naming.Set(step.limiting, step.to));
  }
  return word;
}

// The steps of the first period.
template <class Scalar>
Steps<Scalar> Period(const Verdict& verdict, const std::vector<Pivot<Scalar>>& pivots) {
  Steps<Scalar> period;
  for (std::size_t k = 0; k < pivots.size(); ++k) {
    const bool inside = verdict.outcome == Outcome::kCycle ? pivots[k].drive > verdict.start
                                                           : static_cast<std::int64_t>(k) >= verdict.start;
    if (inside) period.push_back(&pivots[k]);
  }
  return period;
}

std::uint64_t Hash(std::string_view text) {  // FNV-1a
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash;
}

template <class Scalar>
std::string SmallestWord(const Verdict& verdict, const Steps<Scalar>& period,
                         const RowLayout<Eigen::Dynamic>& layout) {
  std::string smallest;
  for (std::size_t first = 0; first < period.size(); ++first) {
    const std::size_t before = (first + period.size() - 1) % period.size();
    const bool starts_drive = period[first]->drive != period[before]->drive || period.size() == 1;
    if (verdict.outcome == Outcome::kCycle && !starts_drive && verdict.period > 1) continue;
    std::string word = Word(period, first, layout);
    if (smallest.empty() || word < smallest) smallest = std::move(word);
  }
  return smallest;
}

template <class Scalar>
LoopFacts CountsOf(const Verdict& verdict, const Steps<Scalar>& period,
                   const RowLayout<Eigen::Dynamic>& layout) {
  LoopFacts facts;
  std::set<int> contacts;
  for (const Pivot<Scalar>* step : period) {
    contacts.insert({layout.ContactOf(step->driven), layout.ContactOf(step->limiting)});
    facts.zero_steps += step->s == 0;
  }
  facts.contacts = static_cast<int>(contacts.size());
  facts.drives = verdict.outcome == Outcome::kCycle ? verdict.period : 1;
  facts.steps = static_cast<std::int64_t>(period.size());
  facts.named = contacts.size() <= kMostContactsWithWord;
  facts.signature =
      fmt::format("{}-{}c-{}d-{}s", Name(verdict.outcome), facts.contacts, facts.drives, facts.steps);
  return facts;
}

// The words of many contacts are long: only where they are asked for.
template <class Scalar>
LoopFacts FactsOf(const ExactProblem& problem, const Verdict& verdict, const std::vector<Pivot<Scalar>>& pivots,
                  bool always_with_word) {
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(problem.contacts);
  const Steps<Scalar> period = Period(verdict, pivots);
  LoopFacts facts = CountsOf(verdict, period, layout);
  if (facts.named || always_with_word) facts.word = Hash(SmallestWord(verdict, period, layout));
  if (facts.named) facts.signature += fmt::format("-{:016x}", facts.word);
  return facts;
}

}  // namespace

std::string LoopWord(const ExactProblem& problem, const ExactRun& run) {
  STICTION_CHECK(IsLoop(run.verdict.outcome), "only loops have a word");
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(problem.contacts);
  return SmallestWord(run.verdict, Period(run.verdict, run.trace.pivots), layout);
}

std::string CountsSignature(std::size_t contacts, Outcome outcome, std::int64_t period) {
  if (!IsLoop(outcome)) return fmt::format("{}-{}c", Name(outcome), contacts);
  return fmt::format("{}-{}c-{}d", Name(outcome), contacts, period);
}

template <class Scalar>
LoopFacts FactsOfLoop(const ExactProblem& problem, const Verdict& verdict,
                      const std::vector<Pivot<Scalar>>& pivots) {
  STICTION_CHECK(IsLoop(verdict.outcome), "only loops have a period");
  return FactsOf(problem, verdict, pivots, /*always_with_word=*/true);
}

template LoopFacts FactsOfLoop(const ExactProblem&, const Verdict&, const std::vector<Pivot<Rational>>&);
template LoopFacts FactsOfLoop(const ExactProblem&, const Verdict&, const std::vector<Pivot<double>>&);

template <class Scalar>
std::string Signature(const ExactProblem& problem, const Verdict& verdict,
                      const std::vector<Pivot<Scalar>>& pivots) {
  if (!IsLoop(verdict.outcome))
    return CountsSignature(problem.contacts.size(), verdict.outcome, verdict.period);
  return FactsOf(problem, verdict, pivots, /*always_with_word=*/false).signature;
}

template std::string Signature(const ExactProblem&, const Verdict&, const std::vector<Pivot<Rational>>&);
template std::string Signature(const ExactProblem&, const Verdict&, const std::vector<Pivot<double>>&);

std::string Signature(const ExactProblem& problem, const ExactRun& run) {
  return Signature(problem, run.verdict, run.trace.pivots);
}

}  // namespace stiction
