// SPDX-License-Identifier: Apache-2.0
// Suite `sliding`: the published algorithm where contacts slide (section 6), policy `paper`. Counts and
// outcomes.
//
// Problems of the search's generators whose last contacts slide, each to one side or the other, with the
// friction coefficients that they were drawn with. A stays symmetric and semidefinite; after (24) the matrix
// that the algorithm sees is not. Runs are over doubles; a cycle there is run again exactly, and whether the
// problem has a solution, and what the rest of the grid makes of it, is decided exactly.

#include <fmt/format.h>

#include <iostream>

#include "bench/progress.h"
#include "bench/suite.h"
#include "bench/table.h"
#include "certify/claims/existence.h"
#include "certify/exact/exact.h"
#include "corpus/exit_code.h"
#include "solver/problem/reduction.h"
#include "solver/published/published.ipp"

namespace stiction {
namespace {

struct Count {
  std::int64_t outcomes[kOutcomeCount] = {};  // over doubles
  std::int64_t refuted = 0;                   // cycles over doubles that are none
  std::int64_t solvable = 0, without = 0;     // exact cycles: with a solution; certified to have none
  std::int64_t every_policy = 0;              // exact cycles under the whole grid
};

struct Family {
  GeneratorId generator;
  int contacts;
  int sliding;
};

template <class Scalar>
ContactProblem<Scalar> MakeProblem(const Family& family, std::uint64_t seed, std::int64_t index) {
  Choices choices(ProblemSeed(seed, 10 * family.contacts + family.sliding, static_cast<std::uint64_t>(index)));
  ContactProblem<Scalar> problem;
  Generate<Scalar, Eigen::Dynamic>(family.generator, family.contacts, kDefaultPalette, choices, problem);
  for (int i = family.contacts - family.sliding; i < family.contacts; ++i) {
    problem.contacts[i].kind = ContactKind::kSliding;
    problem.contacts[i].slip[0] = Scalar(choices.Integer(0, 1) == 0 ? 1 : -1);
  }
  return problem;
}

void CountCycle(const ExactProblem& problem, Count& count) {
  if (RunExact(problem, {}).verdict.outcome != Outcome::kCycle) {
    ++count.refuted;
    return;
  }
  const Json certificate = DecideExistence(problem, {}).certificate;
  count.solvable += !certificate.is_null() && certificate["claim"] == "solution-exists";
  count.without += !certificate.is_null() && certificate["claim"] == "no-solution";
  count.every_policy += AllEndIn(Outcome::kCycle, problem, PlanarGrid(), {});
}

Count CountFamily(const Family& family, std::uint64_t seed, std::int64_t problems) {
  PublishedAlgorithm<double> algorithm;
  Count count;
  for (std::int64_t index = 0; index < problems; ++index) {
    const Reduction<double> reduction(MakeProblem<double>(family, seed, index));
    const Outcome outcome = algorithm.Run(reduction.problem()).outcome;
    ++count.outcomes[static_cast<int>(outcome)];
    if (outcome == Outcome::kCycle) CountCycle(MakeProblem<Rational>(family, seed, index), count);
    progress::Done();
  }
  return count;
}

Json RowOf(const Family& family, const Count& count) {
  Json row = {
      {"generator", Row(family.generator).name}, {"contacts", family.contacts}, {"sliding", family.sliding}};
  for (int i = 0; i < kOutcomeCount; ++i) row[std::string(kOutcomeNames[i])] = count.outcomes[i];
  row.update({{"refuted", count.refuted},
              {"with a solution", count.solvable},
              {"without", count.without},
              {"every policy", count.every_policy}});
  return row;
}

}  // namespace

int BenchSliding(const BenchOptions& options) {
  const std::int64_t problems = options.problems.value_or(200000);
  const std::vector<int> sizes = options.contacts.empty() ? std::vector<int>{1, 2, 3} : options.contacts;
  std::vector<GeneratorId> generators = {GeneratorId::kIntegers, GeneratorId::kSmall};
  if (options.generator) generators = {*options.generator};
  progress::Expect(generators.size() * sizes.size());
  BenchTable table{"sliding",
                   "section 6: outcomes over doubles where contacts slide; of cycles, what is exact"};
  for (const GeneratorId generator : generators) {
    for (const int contacts : sizes) {
      progress::Begin(fmt::format("{}, {} contacts", Row(generator).name, contacts), contacts * problems);
      for (int sliding = 1; sliding <= contacts; ++sliding) {
        const Family family = {generator, contacts, sliding};
        table.rows.push_back(RowOf(family, CountFamily(family, options.seed, problems)));
      }
    }
  }
  progress::Clear();
  if (options.json) {
    std::cout << JsonText({{"suite", "sliding"},
                           {"seed", options.seed},
                           {"problems", problems},
                           {"rows", table.rows}})
              << "\n";
  } else {
    Print(table);
  }
  return kExitDone;
}

}  // namespace stiction
