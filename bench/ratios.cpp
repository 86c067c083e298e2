// SPDX-License-Identifier: Apache-2.0
// bench --suite ratios: what certified outcomes cost beside doubles, and what staged suspicions save a search.
//
// Certified outcomes: the same run over doubles and over the rungs of filtered arithmetic, bare, with memory
// kept and numbers converted before. Nondegenerate: the run over rationals meets no tie, which is told by
// rationals, not by the rungs: HasTies for the published algorithm, no perturbation consulted for complete
// driving. A problem's time is that of all rungs it was tried on. Searches: units of a campaign as it is, and
// with every suspicion examined over rationals, in processor time.

#include <fmt/format.h>

#include <iostream>

#include "bench/family.h"
#include "bench/measure.h"
#include "bench/progress.h"
#include "bench/suite.h"
#include "bench/table.h"
#include "certify/claims/agreement.h"
#include "certify/exact/dependent_rows.h"
#include "certify/exact/exact.h"
#include "certify/exact/filtered.h"
#include "certify/exact/wide_ball.h"
#include "corpus/exit_code.h"
#include "corpus/intervals.h"
#include "corpus/json_text.h"
#include "corpus/rounded.h"
#include "corpus/stopwatch.h"
#include "search/unit.h"
#include "solver/complete/complete.ipp"
#include "solver/published/published.ipp"

namespace stiction {
namespace {

template <class Scalar>
using Published = PublishedAlgorithm<Scalar>;
template <class Scalar>
using Complete = CompleteDriving<Scalar>;

constexpr int kRepeats = 5;  // the least of so many times is a run's

template <class Run>
double LeastSeconds(Run run) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kRepeats; ++k) {
    const Stopwatch watch;
    run();
    least = std::min(least, watch.Seconds());
  }
  return least;
}

template <class Number>
ContactProblem<Ball<Number>> Balls(const ExactProblem& problem) {
  return Converted<Ball<Number>>(problem, &BallAround<Number>);
}

// One problem over doubles, certified, and over rationals.
struct Costs {
  double in_double = 0, certified = 0, exact = 0;
  Rung rung = Rung::kExact;
  bool nondegenerate = false;
};

bool MeetsNoTie(const ExactProblem& problem, Published<Rational>& exact) {
  (void)exact;
  return !HasTies(problem, RunExact(problem, {}));
}
bool MeetsNoTie(const ExactProblem& problem, Complete<Rational>& exact) {
  return exact.Run(problem).statistics.ties == 0;
}

template <class Algorithm, class Problem>
bool Decides(Algorithm& algorithm, const Problem& problem) {
  try {
    algorithm.Run(problem);
    return true;
  } catch (const UnsureSign&) {
    return false;
  }
}

template <template <class> class Method>
class Rival {
 public:
  Costs Run(const BenchProblem& problem) {
    progress::Done();
    Costs costs;
    costs.nondegenerate = MeetsNoTie(problem.exact, exact_);
    costs.in_double = LeastSeconds([&] { double_.Run(problem.rounded); });
    costs.exact = LeastSeconds([&] { exact_.Run(problem.exact); });
    const auto narrow = Balls<double>(problem.exact);
    bool decided = false;
    costs.certified = LeastSeconds([&] { decided = Decides(narrow_, narrow); });
    costs.rung = Rung::kDouble;
    if (decided) return costs;
    const auto wide = Balls<dd_real>(problem.exact);
    costs.certified += LeastSeconds([&] {
      ExactDependentRows rows(problem.exact);
      wide_.KnowDependentRows(&rows);
      decided = Decides(wide_, wide);
    });
    costs.rung = Rung::kDoubleDouble;
    if (decided) return costs;
    costs.certified += costs.exact;
    costs.rung = Rung::kExact;
    return costs;
  }

 private:
  Method<double> double_;
  Method<NarrowBall> narrow_;
  Method<WideBall> wide_;
  Method<Rational> exact_;
};

constexpr std::array kFamilies = {GeneratorId::kIntegers,    GeneratorId::kPsd,    GeneratorId::kNearDegenerate,
                                  GeneratorId::kConditioned, GeneratorId::kBodies, GeneratorId::kScenes};

std::string NameOf(std::optional<GeneratorId> generator) {
  return generator ? std::string(Row(*generator).name) : "definite";
}

Json SpreadJson(const std::vector<double>& values) {
  const Spread s = SpreadOf(values);
  return {s.least, s.median, s.most};
}

// A line of the table: all problems, or the nondegenerate ones, of one family or of all.
Json Line(const std::string& method, int contacts, const std::string& family, const std::vector<Costs>& all,
          bool nondegenerate) {
  std::vector<double> certified, exact;
  std::int64_t to_rationals = 0, problems = 0;
  for (const Costs& costs : all) {
    if (nondegenerate && !costs.nondegenerate) continue;
    ++problems;
    certified.push_back(costs.certified / costs.in_double);
    exact.push_back(costs.exact / costs.in_double);
    to_rationals += costs.rung == Rung::kExact;
  }
  return {{"method", method},
          {"contacts", contacts},
          {"family", family},
          {"problems", fmt::format("{}{}", problems, nondegenerate ? " nondegenerate" : "")},
          {"certified / double", SpreadJson(certified)},
          {"exact / double", SpreadJson(exact)},
          {"needed rationals", ShareText(to_rationals, problems)}};
}

template <template <class> class Method>
void AddLines(const std::string& method, int contacts, const BenchOptions& o, Json& rows) {
  progress::Begin(fmt::format("{}, {} contacts", method, contacts),
                  static_cast<std::int64_t>(1 + kFamilies.size()) * o.problems.value_or(200));
  Rival<Method> rival;
  std::vector<Costs> together;
  Json by_family = Json::array();
  std::vector<std::optional<GeneratorId>> families = {std::nullopt};
  families.insert(families.end(), kFamilies.begin(), kFamilies.end());
  for (const auto& family : families) {
    std::vector<Costs> costs;
    for (std::int64_t index = 0; index < o.problems.value_or(200); ++index)
      costs.push_back(rival.Run(MakeBenchProblem(family, contacts, o.seed, index)));
    by_family.push_back(Line(method, contacts, NameOf(family), costs, true));
    by_family.push_back(Line(method, contacts, NameOf(family), costs, false));
    together.insert(together.end(), costs.begin(), costs.end());
  }
  rows.push_back(Line(method, contacts, "all", together, true));
  for (Json& line : by_family) rows.push_back(std::move(line));
}

// Problems a second of processor time, by pairs of units: staged, and every suspicion over rationals.
Json SearchLine(GeneratorId generator, int contacts, const BenchOptions& o) {
  progress::Begin(fmt::format("searches, {}, {} contacts", Row(generator).name, contacts), o.repeat + 1);
  Campaign campaign;
  campaign.seed = o.seed;
  campaign.generators = {generator};
  campaign.contacts = {contacts};
  campaign.unit_problems = 40000;
  const std::int64_t problems = UnitProblems(campaign, {generator, contacts});
  UnitSolvers unstaged;
  unstaged.exact.filtered = [](const ExactProblem& problem, const PublishedOptions& options, const Rungs&) {
    return RunPublishedFiltered(problem, options, {Rung::kExact, Rung::kExact});
  };
  Campaign examined = campaign;
  examined.complete_every = 1;
  UnitRunner staged(campaign), before(examined, unstaged);
  std::vector<double> rates, ratios;
  for (int run = 0; run <= o.repeat; ++run) {
    const Stopwatch one;
    staged.Run(run);
    const double seconds = one.Seconds();
    progress::Done();
    const Stopwatch other;
    before.Run(run);
    if (run == 0) continue;
    rates.push_back(static_cast<double>(problems) / seconds);
    ratios.push_back(other.Seconds() / seconds);
  }
  return {{"generator", Row(generator).name},
          {"contacts", contacts},
          {"problems a second", SpreadJson(rates)},
          {"times as many as over rationals", SpreadJson(ratios)}};
}

}  // namespace

int BenchRatios(const BenchOptions& o) {
  const std::vector<int> sizes = o.contacts.empty() ? std::vector<int>{2, 4, 6, 8} : o.contacts;
  BenchTable outcomes{"certified", "Certified outcomes, times of doubles: median (least - most)",
                      Json::array()};
  BenchTable searches{"searches", "Searches, processor time: median (least - most)", Json::array()};
  progress::Expect(4 * sizes.size());
  for (const int contacts : sizes) {
    AddLines<Complete>("complete", contacts, o, outcomes.rows);
    AddLines<Published>("baraff", contacts, o, outcomes.rows);
  }
  for (const GeneratorId generator : {GeneratorId::kConditioned, GeneratorId::kNearDegenerate}) {
    for (const int contacts : sizes) searches.rows.push_back(SearchLine(generator, contacts, o));
  }
  progress::Clear();
  if (o.json) {
    std::cout << JsonText({{"certified", outcomes.rows}, {"searches", searches.rows}}) << "\n";
  } else {
    Print(outcomes);
    Print(searches);
  }
  return kExitDone;
}

}  // namespace stiction
