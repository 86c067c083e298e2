// SPDX-License-Identifier: Apache-2.0
// Suite `space`: the readings of section 5.6 on the same random problems. Counts and outcomes.
//
//   A = J J', b = J w    J 3n x columns, entries of J and w uniform integers in [-1000, 1000]
//
// so that A is positive semidefinite and b in its range: `definite` has 3 n + 1 columns, `one body` has 6, and
// its A is singular for three contacts and more. Problem `index` has mu = kFrictions[index mod 5] at all
// contacts. All numbers are exact doubles.
//
// Suspicions  doubles suspect a cycle where a rounded state stands again. It is run again over long double,
//             rounded a million times finer: there it `recurs` (same start, same period), or the run only
//             `approaches` a loop (a later start, or another period), or it is `refuted`.
// Polygon     slip=polygon is complete driving on polygons of eight sides, exact: its steps are pieces. `on an
//             edge` counts runs whose polygon's solution has a contact that slips with abs(fF) < mu fN, which
//             the paper's conditions exclude; certify/exact/space.h then turns it into a solution of them, for
//             which polygons may need more corners (`refined`).

#include "certify/exact/space.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iostream>

#include "bench/measure.h"
#include "bench/progress.h"
#include "bench/suite.h"
#include "bench/table.h"
#include "certify/exact/published_space.h"
#include "certify/exact/verify_solution.h"
#include "corpus/exit_code.h"
#include "search/choices.h"

namespace stiction {
namespace {

constexpr int kEntry = 1000;
constexpr double kWrongAnswer = 1e-6;  // the largest error
constexpr std::array<std::array<int, 2>, 5> kFrictions = {{{1, 5}, {1, 2}, {1, 1}, {2, 1}, {5, 1}}};

constexpr std::array kReadings = {Slip::kLiteral, Slip::kRedirect, Slip::kPolygon};
constexpr int kSides = 8;

struct Family {
  const char* name;
  int least_contacts;
  int (*columns)(int contacts);
};
constexpr std::array kFamilies = {Family{"definite", 1, [](int contacts) { return 3 * contacts + 1; }},
                                  Family{"one body", 3, [](int) { return 6; }}};

ExactProblem MakeProblem(int columns, int contacts, std::uint64_t seed, std::int64_t index) {
  Choices choices(ProblemSeed(seed, 100 * contacts + columns, index));
  const int rows = 3 * contacts;
  using Integers = Eigen::Matrix<std::int64_t, Eigen::Dynamic, Eigen::Dynamic>;
  Integers J(rows, columns), w(columns, 1);
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < columns; ++k) J(i, k) = choices.Integer(-kEntry, kEntry);
  }
  for (int k = 0; k < columns; ++k) w(k) = choices.Integer(-kEntry, kEntry);
  const auto exact = [](std::int64_t x) { return Rational(x); };
  const auto [numerator, denominator] = kFrictions[index % kFrictions.size()];
  ExactProblem problem;
  problem.dimension = 3;
  problem.contacts.assign(contacts, {ContactKind::kStatic, Rational(numerator, denominator), {}});
  problem.A = Integers(J * J.transpose()).unaryExpr(exact);
  problem.b = Integers(J * w).unaryExpr(exact);
  return problem;
}

// ---- Counting ------------------------------------------------------------------------------------

struct Count {
  std::int64_t problems = 0, solved = 0, wrong = 0, ray = 0, limit = 0, undecided = 0, singular = 0;
  std::int64_t recurs = 0, approaches = 0, refuted = 0;  // suspected cycles
  std::int64_t breaks = 0, redirects = 0, give_ups = 0;  // runs in which there was one
  std::vector<std::int64_t> steps;                       // of solved runs
  std::int64_t proved_solved = 0, proved_ray = 0, proved_loop = 0, unsure = 0,
               differ = 0;                // by intervals, or exactly
  std::int64_t on_edge = 0, refined = 0;  // slip=polygon
};

constexpr std::array kCounters = {
    &Count::problems,    &Count::solved,    &Count::wrong,    &Count::ray,           &Count::limit,
    &Count::undecided,   &Count::singular,  &Count::recurs,   &Count::approaches,    &Count::refuted,
    &Count::breaks,      &Count::redirects, &Count::give_ups, &Count::proved_solved, &Count::proved_ray,
    &Count::proved_loop, &Count::unsure,    &Count::differ,   &Count::on_edge,       &Count::refined};

void Add(const Count& count, Count& sum) {
  for (const auto counter : kCounters) sum.*counter += count.*counter;
  sum.steps.insert(sum.steps.end(), count.steps.begin(), count.steps.end());
}

void CountSuspicion(const Suspicion& suspected, const InexactAnswer& again, Count& count) {
  if (again.outcome != Outcome::kCycle) {
    ++count.refuted;
  } else if (again.start == suspected.start && again.period == suspected.period) {
    ++count.recurs;
  } else {
    ++count.approaches;
  }
}

// `first`: over doubles.
void CountRounded(const Solution& solution, const Suspicion& first, Count& count) {
  const auto& answer = std::get<InexactAnswer>(solution.answer);
  const auto counted = [&first](std::string_view name) { return ValueOf(first.counters, name); };
  ++count.problems;
  count.breaks += counted("breaks") > 0;
  count.redirects += counted("redirects") > 0;
  count.give_ups += counted("give_ups") > 0;
  switch (first.outcome) {
    case Outcome::kSolved:
      ++count.solved;
      count.wrong += !(first.errors && first.errors->Largest() <= kWrongAnswer);
      count.steps.push_back(counted("steps"));
      break;
    case Outcome::kCycle:
      CountSuspicion(first, answer, count);
      break;
    case Outcome::kRay:
      ++count.ray;
      break;
    case Outcome::kSingular:
      ++count.singular;
      break;
    case Outcome::kLimit:
      ++count.limit;
      break;
    default:
      ++count.undecided;
      break;
  }
}

bool StartsWith(const std::vector<Counter>& all, const std::vector<Counter>& first) {
  return all.size() >= first.size() && std::equal(first.begin(), first.end(), all.begin());
}

// What intervals prove must be what doubles did.
void CountIntervals(const PublishedSpaceVerdict& proved, const Suspicion& rounded, Count& count) {
  const bool decided = proved.outcome != Outcome::kUndecided && proved.outcome != Outcome::kLimit;
  count.proved_solved += proved.outcome == Outcome::kSolved;
  count.proved_ray += proved.outcome == Outcome::kRay;
  count.proved_loop += proved.outcome == Outcome::kCycle;
  count.unsure += !decided;
  // A loop is proved at its first state without memory that stands again, later than doubles suspect it.
  const bool alike = proved.outcome == Outcome::kCycle
                         ? proved.period == rounded.period
                         : StartsWith(rounded.counters, CountersOf(proved.statistics));
  count.differ += decided && (proved.outcome != rounded.outcome || !alike);
}

// Static contacts alone.
bool BreaksOpposition(const SpaceRun& run) {
  bool breaks = false;
  for (Eigen::Index row = 0; row < run.f.size(); row += 3)
    breaks |= run.f[row + 1] * run.a[row + 1] + run.f[row + 2] * run.a[row + 2] > 0;
  return breaks;
}

Count CountPolygon(const ExactProblem& problem) {
  const RationalPolygons polygons(problem.contacts.size(), FrictionPolygon<Rational>(kSides));
  const SpaceRun run = RunSpace(problem, polygons, Limits{});
  SpaceOptions options;
  options.sides = kSides;
  const SpaceSolution solution = SolveInSpace(problem, options);
  const bool solved = solution.outcome == Outcome::kSolved;
  Count count;
  count.problems = 1;
  count.solved = count.proved_solved = solved;
  count.ray = count.proved_ray = solution.outcome == Outcome::kRay;
  count.limit = solution.outcome == Outcome::kLimit;
  count.undecided = solution.outcome == Outcome::kUndecided;
  count.breaks = BreaksOpposition(run);
  count.on_edge = run.verdict.outcome == Outcome::kSolved && FindWeakViolation(problem, run.f).has_value();
  count.refined = solution.refinements > 0;
  if (solved) {
    count.wrong = FindWeakViolation(problem, solution.f).has_value();
    count.steps.push_back(solution.statistics.pieces);
  }
  return count;
}

Count CountProblem(const ExactProblem& problem, Slip slip) {
  if (slip == Slip::kPolygon) return CountPolygon(problem);
  PublishedOptions options;
  options.policy.slip = slip;
  SolveRequest request{.method = "baraff", .arithmetic = Arithmetic::kDouble};
  request.options.policy = options.policy;
  const Solution solution = SolveIn(problem, request);
  const Suspicion first =
      solution.suspected ? *solution.suspected : SuspicionOf(std::get<InexactAnswer>(solution.answer));
  Count count;
  CountRounded(solution, first, count);
  CountIntervals(RunIntervalsInSpace(problem, options).verdict, first, count);
  return count;
}

// ---- Tables --------------------------------------------------------------------------------------

Json RowOf(Json row, const Count& count) {
  const Average steps = AverageOf(count.steps);
  row.update({{"problems", count.problems},
              {"solved", count.solved},
              {"wrong", count.wrong},
              {"recurs", count.recurs},
              {"approaches", count.approaches},
              {"refuted", count.refuted},
              {"ray", count.ray},
              {"limit", count.limit},
              {"singular", count.singular},
              {"undecided", count.undecided},
              {"breaks (21)", count.breaks},
              {"redirects", count.redirects},
              {"gives up", count.give_ups},
              {"steps, mean", steps.mean},
              {"most", steps.most},
              {"proved solved", count.proved_solved},
              {"proved ray", count.proved_ray},
              {"proved loop", count.proved_loop},
              {"unsure", count.unsure},
              {"differ", count.differ},
              {"on an edge", count.on_edge},
              {"refined", count.refined}});
  return row;
}

std::string NameOf(Slip slip) {
  Policy policy;
  policy.slip = slip;
  return PolicyName(policy);
}

std::string NameOf(const std::array<int, 2>& mu) {
  return mu[1] == 1 ? fmt::format("{}", mu[0]) : fmt::format("{}/{}", mu[0], mu[1]);
}

}  // namespace

int BenchSpace(const BenchOptions& options) {
  const std::int64_t problems = options.problems.value_or(2000);
  const std::vector<int> sizes = options.contacts.empty() ? std::vector<int>{1, 2, 3, 4} : options.contacts;
  BenchTable by_size{
      "sizes",
      "readings of section 5.6: outcomes over doubles, and what intervals prove of them; slip=polygon "
      "exactly"};
  BenchTable by_friction{"friction", "the same by friction coefficient, all sizes"};
  std::array<std::array<Count, kFrictions.size()>, kReadings.size()> of_friction;
  std::int64_t bad = 0;
  progress::Expect(kFamilies.size() * sizes.size());
  for (const Family& family : kFamilies) {
    for (const int contacts : sizes) {
      if (contacts < family.least_contacts) continue;
      progress::Begin(fmt::format("{}, {} contacts", family.name, contacts), problems);
      std::array<Count, kReadings.size()> of_size;
      for (std::int64_t index = 0; index < problems; ++index) {
        const ExactProblem problem = MakeProblem(family.columns(contacts), contacts, options.seed, index);
        progress::Done();
        for (std::size_t r = 0; r < kReadings.size(); ++r) {
          const Count count = CountProblem(problem, kReadings[r]);
          Add(count, of_size[r]);
          Add(count, of_friction[r][index % kFrictions.size()]);
          bad += count.wrong + count.differ;
        }
      }
      for (std::size_t r = 0; r < kReadings.size(); ++r) {
        by_size.rows.push_back(RowOf(
            {{"family", family.name}, {"contacts", contacts}, {"policy", NameOf(kReadings[r])}}, of_size[r]));
      }
    }
  }
  for (std::size_t r = 0; r < kReadings.size(); ++r) {
    for (std::size_t m = 0; m < kFrictions.size(); ++m) {
      by_friction.rows.push_back(
          RowOf({{"policy", NameOf(kReadings[r])}, {"mu", NameOf(kFrictions[m])}}, of_friction[r][m]));
    }
  }
  progress::Clear();
  if (options.json) {
    std::cout << JsonText({{"suite", "space"},
                           {"seed", options.seed},
                           {"problems", problems},
                           {by_size.name, by_size.rows},
                           {by_friction.name, by_friction.rows}})
              << "\n";
  } else {
    Print(by_size);
    Print(by_friction);
  }
  return bad == 0 ? kExitDone : kExitNotSo;
}

}  // namespace stiction
