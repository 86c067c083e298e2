// SPDX-License-Identifier: Apache-2.0
// bench --suite gate, silent: of what is called solved, how much misses a condition by more than the stated
// bound (none may), and how much is left undecided?
//
// gate    along dials (dials.h) in the plane and in space, so many problems at each setting, and a fifth as
//         many of large ones: every method in every inexact arithmetic that it is built for but intervals
// silent  so many problems in all, one from each dial and generator of the plane in turn, large ones in one
//         round of a hundred; each is given to one method, the methods in turn, in every arithmetic, rationals
//         too. Threads take the rounds as they come: the counts do not depend on them.
//
// Limits are counted, and nothing runs again to confirm it. Answers called solved are judged over rationals
// (certify/exact/neighbour.h) on the problem that the arithmetic was given: as it is for rationals, rounded to
// float, or to double for all others.
//
//   refused    a number of the problem is not one of the arithmetic's; not a run
//   runs       all others; each ends in one of the outcomes below
//   solved     called so
//   wrong      a solved answer is exact for no b, mu and A within eps and tau, by the law that it names, or
//              breaks a condition at all by rationals; or forces are missing; or rationals find no solution
//              where there is one
//   undecided  called so: no answer
//   other      ray, cycle, stall, singular, limit, no-solution
//
// A problem is a function of seed, source and index. Exit 1 where one answer is wrong.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <iostream>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bench/dials.h"
#include "bench/output.h"
#include "bench/suite.h"
#include "certify/exact/neighbour.h"
#include "certify/request/request.h"
#include "corpus/exit_code.h"
#include "corpus/intervals.h"
#include "corpus/json.h"
#include "corpus/record/problem_file.h"
#include "corpus/rounded.h"

namespace stiction {
namespace {

constexpr std::int64_t kLargeFraction = 5, kLargeEvery = 100;
constexpr std::int64_t kMostSteps = 2000;  // drives, pivots
constexpr std::size_t kExamples = 50;

// ---- Runs ----------------------------------------------------------------------------------------

// A method in an arithmetic on problems of a source, and how its runs ended.
struct GateCell {
  const Source* source;
  int dimension;
  std::string_view method;
  Arithmetic arithmetic;
  std::array<std::int64_t, kOutcomeCount + 1> outcomes = {};
  std::int64_t wrong = 0, refused = 0;

  std::int64_t Of(Outcome outcome) const { return outcomes[static_cast<int>(outcome)]; }
  std::int64_t Runs() const { return std::accumulate(outcomes.begin(), outcomes.end(), std::int64_t{0}); }
  void Add(const GateCell& more) {
    for (std::size_t i = 0; i < outcomes.size(); ++i) outcomes[i] += more.outcomes[i];
    wrong += more.wrong;
    refused += more.refused;
  }
};

// Those that are built.
std::vector<GateCell> CellsOf(const Source& source, int dimension, const std::vector<std::string_view>& methods,
                              std::initializer_list<Arithmetic> arithmetics) {
  std::vector<GateCell> cells;
  for (const std::string_view method : methods) {
    for (const Arithmetic arithmetic : arithmetics)
      if (Refusal(method, dimension, arithmetic).empty())
        cells.push_back({&source, dimension, method, arithmetic});
  }
  return cells;
}

std::vector<std::string_view> AllOverDoubles() {
  std::vector<std::string_view> names = {kAutomatic};
  for (const Method<double>& method : Methods<double>()) names.push_back(method.name);
  return names;
}

// A problem as every arithmetic gets it, by that; empty where it does not hold a number.
using Given = std::array<std::optional<ExactProblem>, kArithmeticCount>;

template <class Scalar>
std::optional<ExactProblem> RoundedOnce(const ExactProblem& problem) {
  try {
    return Unrounded(Rounded<Scalar>(problem));
  } catch (const RangeError&) {
    return std::nullopt;
  }
}

Given GivenOf(const ExactProblem& problem) {
  Given given;
  given.fill(RoundedOnce<double>(problem));
  given[static_cast<int>(Arithmetic::kExact)] = problem;
  given[static_cast<int>(Arithmetic::kFloat)] = RoundedOnce<float>(problem);
  return given;
}

std::optional<std::string> MissOf(const ExactProblem& given, const ExactVector& f, FrictionLaw law,
                                  const Gate& gate) {
  if (f.size() != given.rows()) return "there are no forces";
  const double slack = 1 + 1e-9;  // roots round
  return FindMiss(given, f, law, Gate{gate.eps * slack, gate.tau * slack});
}

// What an answer called solved misses; empty if nothing. An exact answer promises to miss nothing.
std::optional<std::string> MissOf(const ExactProblem& given, Arithmetic arithmetic, const Solution& solution) {
  if (const auto* exact = std::get_if<ExactAnswer>(&solution.answer))
    return MissOf(given, exact->f, exact->law, Gate{});
  const auto& answer = std::get<InexactAnswer>(solution.answer);
  if (!answer.f.allFinite()) return "a force is not finite";
  const Gate gate = arithmetic == Arithmetic::kFloat ? GateOf<float>() : GateOf<double>();
  return MissOf(given, answer.f.unaryExpr([](double x) { return Rational(x); }), answer.law, gate);
}

Request RequestOf(const GateCell& cell) {
  Request request;
  request.method = cell.method;
  request.arithmetic = cell.arithmetic;
  request.limits.drives = request.limits.pivots = kMostSteps;
  request.confirm = false;
  return request;
}

Json WrongJson(const GateCell& cell, std::int64_t index, const std::string& miss, const ExactProblem& given) {
  return {{"dial", cell.source->family},    {"setting", cell.source->setting},     {"index", index},
          {"method", cell.method},          {"arithmetic", Name(cell.arithmetic)}, {"miss", miss},
          {"problem", ProblemToJson(given)}};
}

// One problem in one cell.
void RunOne(const Given& problem, std::int64_t index, GateCell& cell, Json& wrong) {
  const std::optional<ExactProblem>& given = problem[static_cast<int>(cell.arithmetic)];
  if (!given) {
    ++cell.refused;
    return;
  }
  const Solution solution = SolveIn(*given, RequestOf(cell));
  const Outcome outcome = solution.outcome();
  ++cell.outcomes[static_cast<int>(outcome)];
  std::optional<std::string> miss;
  if (outcome == Outcome::kSolved) {
    miss = MissOf(*given, cell.arithmetic, solution);
  } else if (outcome == Outcome::kNoSolution && cell.arithmetic == Arithmetic::kExact &&
             cell.source->has_solution) {
    miss = "there is a solution";
  }
  if (!miss) return;
  ++cell.wrong;
  if (wrong.size() < kExamples) wrong.push_back(WrongJson(cell, index, *miss, *given));
}

// ---- Tables --------------------------------------------------------------------------------------

double Percent(std::int64_t part, std::int64_t of) {
  return of == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(of);
}

Json TableRow(const std::string& key, const std::string& name, const GateCell& counts) {
  const std::int64_t runs = counts.Runs(), solved = counts.Of(Outcome::kSolved),
                     undecided = counts.Of(Outcome::kUndecided);
  const auto most = static_cast<double>(std::max<std::int64_t>(runs, 1));
  return {{key, name},
          {"runs", runs},
          {"solved", solved},
          {"wrong", counts.wrong},
          {"wrong in a million, at most", 1e6 * CountInterval(counts.wrong).high / most},
          {"undecided %", Percent(undecided, runs)},
          {"other %", Percent(runs - solved - undecided, runs)},
          {"refused", counts.refused}};
}

// Cells of the same name together, in the order in which the names come.
BenchTable TableBy(const std::string& key, const std::vector<GateCell>& cells,
                   const std::function<std::string(const GateCell&)>& name_of) {
  std::vector<std::pair<std::string, GateCell>> sums;
  for (const GateCell& cell : cells) {
    const std::string name = name_of(cell);
    auto sum = std::find_if(sums.begin(), sums.end(), [&name](auto& s) { return s.first == name; });
    if (sum == sums.end())
      sums.emplace_back(name, cell);
    else
      sum->second.Add(cell);
  }
  BenchTable table{"by-" + key, "By " + key};
  for (const auto& [name, counts] : sums) table.rows.push_back(TableRow(key, name, counts));
  return table;
}

Json CellJson(const GateCell& cell) {
  Json json = {{"dial", cell.source->family},
               {"dimension", cell.dimension},
               {"setting", cell.source->setting},
               {"method", cell.method},
               {"arithmetic", Name(cell.arithmetic)},
               {"runs", cell.Runs()},
               {"wrong", cell.wrong},
               {"refused", cell.refused}};
  for (int i = 0; i <= kOutcomeCount; ++i) json[std::string(Name(static_cast<Outcome>(i)))] = cell.outcomes[i];
  return json;
}

// Cells, wrong answers and tables by what is asked; exit code.
int Report(const BenchOptions& o, const std::vector<GateCell>& cells, const Json& wrong,
           const std::vector<BenchTable>& tables) {
  GateCell all = {};
  Json json = Json::array();
  for (const GateCell& cell : cells) {
    all.Add(cell);
    json.push_back(CellJson(cell));
  }
  progress::Clear();
  if (o.json) {
    std::cout << JsonText({{"cells", json}, {"wrong", wrong}}) << "\n";
  } else {
    for (const BenchTable& table : tables) Print(table);
    for (const Json& one : wrong)
      fmt::print("{} at {}, index {}: {} over {}: {}\n", one["dial"].get<std::string>(),
                 one["setting"].get<int>(), one["index"].get<std::int64_t>(), one["method"].get<std::string>(),
                 one["arithmetic"].get<std::string>(), one["miss"].get<std::string>());
    fmt::print("\n{} runs, {} called solved, {} of them wrong\n", all.Runs(), all.Of(Outcome::kSolved),
               all.wrong);
  }
  return all.wrong == 0 ? kExitDone : kExitNotSo;
}

std::string MethodOf(const GateCell& cell) {
  return fmt::format("{}, {}", cell.method, cell.dimension == 2 ? "plane" : "space");
}
std::string ArithmeticOf(const GateCell& cell) { return std::string(Name(cell.arithmetic)); }

// ---- One method a problem, in threads ------------------------------------------------------------

// Cells, counted over all sources, and wrong answers; each by its place among all problems.
struct SilentCounts {
  std::vector<std::vector<GateCell>> methods;  // cells of each method
  std::map<std::int64_t, Json> wrong;

  void Add(const SilentCounts& more) {
    for (std::size_t m = 0; m < methods.size(); ++m) {
      for (std::size_t i = 0; i < methods[m].size(); ++i) methods[m][i].Add(more.methods[m][i]);
    }
    wrong.insert(more.wrong.begin(), more.wrong.end());
  }
};

SilentCounts NoneOf(const Source& any) {
  using enum Arithmetic;
  SilentCounts counts;
  for (const std::string_view method : {"complete", "lemke", "fast", "baraff"}) {
    counts.methods.push_back(CellsOf(any, 2, {method}, {kFloat, kDouble, kQuad, kFiltered, kExact}));
  }
  return counts;
}

// The rounds that `next` gives, of the first `problems` problems.
void RunRounds(const std::vector<Source>& sources, std::int64_t problems, std::uint64_t seed,
               std::atomic<std::int64_t>& next, SilentCounts& counts) {
  const std::int64_t large = std::count_if(sources.begin(), sources.end(), std::mem_fn(&Source::is_large));
  const std::int64_t others = std::ssize(sources) - large;
  for (;;) {
    const std::int64_t round = next++;
    std::int64_t place = round * others + (round + kLargeEvery - 1) / kLargeEvery * large;
    if (place >= problems) return;
    for (const Source& source : sources) {
      const std::int64_t every = source.is_large ? kLargeEvery : 1;
      if (round % every != 0 || place >= problems) continue;
      const Given problem = GivenOf(source.make(seed, round));
      Json wrong = Json::array();
      for (GateCell& cell : counts.methods[static_cast<std::size_t>(round / every) % counts.methods.size()]) {
        cell.source = &source;
        RunOne(problem, round, cell, wrong);
      }
      if (!wrong.empty()) counts.wrong[place] = wrong.front();
      ++place;
      progress::Done();
    }
  }
}

}  // namespace

int BenchSilent(const BenchOptions& o) {
  std::vector<Source> sources = DialSources(Dials::kLadder, o.families);
  if (o.families.empty()) {
    for (Source& source : GeneratorSources({1, 2, 3, 4})) sources.push_back(std::move(source));
  }
  const std::int64_t problems = o.problems.value_or(20000);
  std::vector<SilentCounts> parts(o.threads, NoneOf(sources.front()));
  std::atomic<std::int64_t> next{0};
  progress::Expect(1);
  progress::Begin("problems", problems);
  {
    std::vector<std::jthread> running;
    for (SilentCounts& part : parts)
      running.emplace_back([&] { RunRounds(sources, problems, o.seed, next, part); });
  }
  for (int thread = 1; thread < o.threads; ++thread) parts[0].Add(parts[thread]);
  std::vector<GateCell> cells;
  for (const auto& method : parts[0].methods) cells.insert(cells.end(), method.begin(), method.end());
  Json wrong = Json::array();
  for (const auto& [place, one] : parts[0].wrong) {
    if (wrong.size() < kExamples) wrong.push_back(one);
  }
  const Source all{.family = "all", .make = {}};
  for (GateCell& cell : cells) cell.source = &all;
  return Report(o, cells, wrong, {TableBy("method and arithmetic", cells, [](const GateCell& cell) {
                  return fmt::format("{} {}", cell.method, ArithmeticOf(cell));
                })});
}

int BenchGate(const BenchOptions& o) {
  using enum Arithmetic;
  const std::vector<Source> sources = DialSources(Dials::kGate, o.families);
  const std::int64_t asked = o.problems.value_or(25);
  std::vector<GateCell> cells;
  Json wrong = Json::array();
  progress::Expect(sources.size());
  for (const Source& source : sources) {
    const std::int64_t problems = source.is_large ? std::max<std::int64_t>(1, asked / kLargeFraction) : asked;
    progress::Begin(fmt::format("{} at {}", source.family, source.setting), problems);
    const int dimension = source.make(o.seed, 0).dimension;
    std::vector<GateCell> of_source =
        CellsOf(source, dimension, AllOverDoubles(), {kFloat, kDouble, kQuad, kFiltered});
    for (std::int64_t index = 0; index < problems; ++index) {
      const Given problem = GivenOf(source.make(o.seed, index));
      for (GateCell& cell : of_source) RunOne(problem, index, cell, wrong);
      progress::Done();
    }
    cells.insert(cells.end(), of_source.begin(), of_source.end());
  }
  return Report(o, cells, wrong,
                {TableBy("dial", cells, [](const GateCell& cell) { return cell.source->family; }),
                 TableBy("method", cells, MethodOf), TableBy("arithmetic", cells, ArithmeticOf)});
}

}  // namespace stiction
