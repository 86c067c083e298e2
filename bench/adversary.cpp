// SPDX-License-Identifier: Apache-2.0
// bench --suite adversary: the optimizers side by side, each objective with the same number of evaluations.
//
// An optimizer runs as in a campaign: units one after the other, each starting from the best of those before. A
// value is that of an exact problem. `gain` says how many times worse for the solver an optimizer's best is
// than the best of random problems: the quotient of the values, or 10^difference where they are logarithms. A
// loop that random problems never met counts as a gain of "inf".

#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <iostream>
#include <limits>
#include <set>

#include "bench/progress.h"
#include "bench/suite.h"
#include "bench/table.h"
#include "corpus/exit_code.h"
#include "search/adversary/optimized_unit.h"
#include "search/signature.h"

namespace stiction {
namespace {

struct Trials {
  std::string_view objective, generator;
  int contacts;
  MuChoice mu;
  std::int64_t evaluations;
};

// About as long each: what is run exactly for every candidate has fewer.
constexpr std::array kTrials = {
    Trials{"steps", "psd", 4, {1, 1}, 24000},
    Trials{"steps-per-contact", "psd", 3, {1, 1}, 24000},
    Trials{"zero-steps", "integers", 4, {1, 1}, 24000},
    Trials{"zero-run", "integers", 4, {1, 1}, 24000},
    Trials{"give-ups", "psd", 4, {1, 1}, 24000},
    Trials{"memory", "psd", 4, {1, 1}, 24000},
    Trials{"scans", "psd", 4, {1, 1}, 24000},
    Trials{"period", "psd", 3, {1, 1}, 24000},
    Trials{"start", "psd", 3, {1, 1}, 24000},
    Trials{"distance", "psd", 2, {1, 4}, 24000},
    Trials{"pivot", "psd", 3, {1, 1}, 24000},
    Trials{"bits", "psd", 3, {1, 1}, 4000},
    Trials{"condition", "psd", 2, {1, 1}, 24000},
    Trials{"friction", "scenes", 4, {1, 1}, 24000},
    Trials{"rounding", "psd", 3, {1, 1}, 4000},
    Trials{"policies", "psd", 2, {1, 1}, 600},
    Trials{"ipopt", "psd", 2, {1, 1}, 300},
    Trials{"folds", "psd", 4, {1, 1}, 16000},
    Trials{"descents", "psd", 4, {1, 1}, 16000},
    Trials{"pieces", "psd", 4, {1, 1}, 16000},
    Trials{"solutions", "psd", 3, {1, 1}, 300},
    Trials{"margin", "psd", 2, {1, 1}, 24000},
    Trials{"radius", "psd", 2, {1, 1}, 8000},
};
constexpr int kUnits = 4;
constexpr std::size_t kParents = 8;

double ProcessorSeconds() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Outcomes {
  std::optional<double> best;
  double seconds = 0;
  std::int64_t evaluations = 0, confirmations = 0, denied = 0;
  std::set<std::string> loops;  // signatures
};

Outcomes RunTrials(const Trials& trials, const OptimizerRow& optimizer, const BenchOptions& o) {
  Optimization optimization;
  optimization.objective = FindObjective(trials.objective);
  optimization.like = {*FindGenerator(trials.generator), trials.contacts, trials.mu, false, {}};
  optimization.palette = {trials.mu};
  optimization.limits = Campaign().limits;
  optimization.evaluations =
      std::max<std::int64_t>(1, std::min(o.problems.value_or(trials.evaluations), trials.evaluations) / kUnits);
  Outcomes outcomes;
  std::vector<Assessed> best;  // of all units
  const double before = ProcessorSeconds();
  for (int unit = 0; unit < kUnits; ++unit) {
    optimization.seed = ProblemSeed(o.seed, static_cast<std::uint64_t>(unit), 0);
    const Optimized optimized = optimizer.run(optimization);
    outcomes.evaluations += optimized.evaluations;
    outcomes.confirmations += optimized.confirmations;
    outcomes.denied += optimized.denied;
    for (const Assessed& loop : optimized.loops) {
      const ExactProblem problem = ExactOf(loop.candidate);
      outcomes.loops.insert(
          Signature(problem, RunExact(problem, {optimization.policy, {}, optimization.limits})));
    }
    for (const Assessed& elite : optimized.elites) {
      if (elite.worth.value && (!outcomes.best || *elite.worth.value > *outcomes.best))
        outcomes.best = elite.worth.value;
    }
    best.insert(best.end(), optimized.elites.begin(), optimized.elites.end());
    std::stable_sort(best.begin(), best.end(),
                     [](const Assessed& left, const Assessed& right) { return right.worth < left.worth; });
    if (best.size() > kParents) best.resize(kParents);
    optimization.parents.clear();
    for (const Assessed& elite : best) optimization.parents.push_back(elite.candidate);
    progress::Done();
  }
  outcomes.seconds = ProcessorSeconds() - before;
  return outcomes;
}

// Empty where neither has a value.
std::optional<double> Gain(const Objective& objective, std::optional<double> best,
                           std::optional<double> random) {
  if (!best) return random ? std::optional<double>(0) : std::nullopt;
  if (!random) return std::numeric_limits<double>::infinity();
  if (objective.unit == "decades") return std::pow(10, *best - *random);
  if (objective.sign < 0) return *best == 0 && *random == 0 ? 1 : *random / *best;
  return *random == 0 ? (*best == 0 ? 1 : std::numeric_limits<double>::infinity()) : *best / *random;
}

Json Rounded3(std::optional<double> x) {
  if (!x) return "-";
  if (std::isinf(*x)) return "inf";
  return ParseJson(fmt::format("{:.3g}", *x), "a number");
}

}  // namespace

int BenchAdversary(const BenchOptions& o) {
  BenchTable table{"adversary", fmt::format("The best of each optimizer, seed {}", o.seed)};
  std::map<std::string, int> doubled;
  progress::Expect(kTrials.size());
  for (const Trials& trials : kTrials) {
    progress::Begin(std::string(trials.objective), static_cast<std::int64_t>(Optimizers().size()) * kUnits);
    const Objective& objective = *FindObjective(trials.objective);
    Json row = {{"objective", trials.objective},
                {"problems", fmt::format("{} {}", trials.generator, trials.contacts)},
                {"to be", objective.sign > 0 ? "high" : "low"}};
    const Outcomes random = RunTrials(trials, *FindOptimizer("random"), o);
    row["evaluations"] = random.evaluations;
    const auto add = [&](const OptimizerRow& optimizer, const Outcomes& outcomes) {
      const std::string name(optimizer.name);
      row[name] = outcomes.best ? Rounded3(objective.sign * *outcomes.best) : Json("-");
      row[name + " s"] = Rounded3(outcomes.seconds);
      row[name + " loops/h"] =
          std::llround(static_cast<double>(outcomes.loops.size()) / std::max(outcomes.seconds, 1e-9) * 3600);
      if (name == "random") return;
      const auto gain = Gain(objective, outcomes.best, random.best);
      row[name + " gain"] = Rounded3(gain);
      doubled[name] += gain && *gain >= 2;
    };
    add(*FindOptimizer("random"), random);
    for (const OptimizerRow& optimizer : Optimizers()) {
      if (optimizer.name != "random") add(optimizer, RunTrials(trials, optimizer, o));
    }
    table.rows.push_back(std::move(row));
  }
  progress::Clear();
  if (o.json) {
    std::cout << JsonText(table.rows) << "\n";
    return kExitDone;
  }
  Print(table);
  for (const auto& [name, count] : doubled)
    fmt::print("{}: at least twice as bad for the solver as random in {} of {} objectives\n", name, count,
               kTrials.size());
  return kExitDone;
}

}  // namespace stiction
