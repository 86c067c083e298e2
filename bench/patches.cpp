// SPDX-License-Identifier: Apache-2.0
// Suite `patches`: ways to change the published algorithm, from the cheapest on, and how often each still
// fails.
//
//   published     give-up=first, previous, second: what is given up differs, nothing else (readings.md)
//   fold          where the determinant turns, the driven force goes back; where it is zero again the run
//                 fails: complete driving without its descents
//   lemke         at the first give-up the problem is handed to Lemke's method
//   complete      complete driving
//
// Runs are over doubles. A cycle there, or another end than `solved`, is run again exactly, and counts as a
// failure if it fails there too; of `fold` a descent is one, of `lemke` an end of Lemke's method without a
// solution.

#include <fmt/format.h>

#include <iostream>

#include "bench/progress.h"
#include "bench/suite.h"
#include "bench/table.h"
#include "certify/exact/exact.h"
#include "corpus/exit_code.h"
#include "corpus/intervals.h"

namespace stiction {
namespace {

constexpr std::array kGiveUps = {GiveUp::kFirst, GiveUp::kPrevious, GiveUp::kSecond};

struct Count {
  std::int64_t problems = 0;
  std::array<std::int64_t, kGiveUps.size()> published{};  // failures, exact
  std::int64_t gave_up = 0;                               // under the first rule
  std::int64_t folded = 0, fold_only = 0;                 // exact where doubles fail
  std::int64_t lemke = 0, complete = 0;
};

class Patches {
 public:
  Patches(GeneratorId generator, int contacts, std::uint64_t seed)
      : generator_(generator), contacts_(contacts), seed_(seed) {
    for (const GiveUp rule : kGiveUps) {
      Policy policy;
      policy.give_up = rule;
      policies_.push_back(policy);
      published_.emplace_back(PublishedOptions{policy, {}, Limits{1000, 10000, 100000}});
    }
  }

  Count Run(std::int64_t problems) {
    progress::Begin(fmt::format("{}, {} contacts", Row(generator_).name, contacts_), problems);
    for (std::int64_t index = 0; index < problems; ++index) Try(index);
    return count_;
  }

 private:
  template <class Scalar>
  void Make(std::int64_t index, ContactProblem<Scalar>& problem) const {
    Choices choices(
        ProblemSeed(seed_, static_cast<std::uint64_t>(contacts_), static_cast<std::uint64_t>(index)));
    Generate<Scalar, Eigen::Dynamic>(generator_, contacts_, kDefaultPalette, choices, problem);
  }

  void Try(std::int64_t index) {
    ++count_.problems;
    progress::Done();
    Make(index, problem_);
    bool gave_up = false;
    for (std::size_t k = 0; k < policies_.size(); ++k) {
      const Verdict verdict = published_[k].Run(problem_);
      if (k == 0) gave_up = verdict.statistics.give_ups > 0 || verdict.outcome != Outcome::kSolved;
      if (verdict.outcome == Outcome::kSolved) continue;
      const ExactRun run = RunExact(Exact(index), {policies_[k], {}, Limits{1000, 10000, 100000}});
      count_.published[k] += run.verdict.outcome != Outcome::kSolved;
    }
    const CompleteVerdict complete = complete_.Run(problem_);
    CompleteStatistics statistics = complete.statistics;
    if (complete.outcome != Outcome::kSolved) {
      const CompleteRun run = RunComplete(Exact(index), {});
      statistics = run.verdict.statistics;
      count_.complete += run.verdict.outcome != Outcome::kSolved;
    }
    count_.folded += statistics.folds > 0;
    count_.fold_only += statistics.descents > 0;
    if (!gave_up) return;
    ++count_.gave_up;
    if (lemke_.Run(problem_).outcome == Outcome::kSolved) return;
    count_.lemke += RunLemke(Exact(index), {}).verdict.outcome != Outcome::kSolved;
  }

  ExactProblem Exact(std::int64_t index) const {
    ExactProblem problem;
    Make(index, problem);
    return problem;
  }

  GeneratorId generator_;
  int contacts_;
  std::uint64_t seed_;
  std::vector<Policy> policies_;
  std::vector<PublishedAlgorithm<double>> published_;
  CompleteDriving<double> complete_;
  LemkeAlgorithm<double> lemke_;
  ContactProblem<double> problem_;
  Count count_;
};

Json RowOf(GeneratorId generator, int contacts, const Count& count) {
  const auto rate = [&count](std::int64_t failures) { return RateText(failures, count.problems); };
  return {{"generator", Row(generator).name},
          {"contacts", contacts},
          {"problems", count.problems},
          {"gives up", ShareText(count.gave_up, count.problems)},
          {"folds", ShareText(count.folded, count.problems)},
          {"first", rate(count.published[0])},
          {"previous", rate(count.published[1])},
          {"second", rate(count.published[2])},
          {"fold", rate(count.fold_only)},
          {"lemke", rate(count.lemke)},
          {"complete", rate(count.complete)}};
}

}  // namespace

int BenchPatches(const BenchOptions& options) {
  const std::int64_t problems = options.problems.value_or(100000);
  const std::vector<int> sizes = options.contacts.empty() ? std::vector<int>{2, 3, 4, 5} : options.contacts;
  std::vector<GeneratorId> generators = {GeneratorId::kPsd, GeneratorId::kIntegers, GeneratorId::kConditioned,
                                         GeneratorId::kBodies, GeneratorId::kScenes};
  if (options.generator) generators = {*options.generator};
  progress::Expect(generators.size() * sizes.size());
  BenchTable table{"patches", "failures in a million problems, with exact intervals at 95 %, of each way"};
  for (const GeneratorId generator : generators) {
    for (const int contacts : sizes)
      table.rows.push_back(
          RowOf(generator, contacts, Patches(generator, contacts, options.seed).Run(problems)));
  }
  progress::Clear();
  if (options.json)
    std::cout << JsonText({{"suite", "patches"}, {"seed", options.seed}, {"rows", table.rows}}) << "\n";
  else
    Print(table);
  return kExitDone;
}

}  // namespace stiction
