// SPDX-License-Identifier: Apache-2.0
// bench --suite gate: of what is called solved over inexact numbers, how much misses a condition by more than
// the stated bound (none may), and how much is left undecided?
//
// Problems are those of gate_dials.h, so many at each setting of each dial, and a fifth as many of large ones.
// Every method runs in every inexact arithmetic that it is built for in the dimension but intervals, with
// limits that are counted, and nothing runs again to confirm it. Answers called solved are judged over
// rationals (certify/exact/judge.h) on the problem that the arithmetic was given: rounded to float, or to
// double for all others.
//
//   refused    a number of the problem is not one of the arithmetic's; not a run
//   runs       all others; each ends in one of the outcomes below
//   solved     called so
//   wrong      of these: a condition of the law that the answer names is missed by more than kSolvedResidual,
//              times 1 + 2^-30, in units of what acts there; or forces are missing
//   undecided  called so: no answer
//   other      ray, cycle, stall, singular, limit, no-solution
//
// A problem is a function of seed, dial, setting and index. Exit 1 where one answer is wrong.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/gate_dials.h"
#include "bench/progress.h"
#include "bench/rungs.h"
#include "bench/suite.h"
#include "bench/table.h"
#include "certify/exact/judge.h"
#include "certify/exact/solve.h"
#include "corpus/exit_code.h"

namespace stiction {
namespace {

constexpr std::int64_t kLargeFraction = 5;
constexpr std::int64_t kMostSteps = 2000;  // drives, pivots
constexpr std::size_t kExamples = 50;

// ---- Runs ----------------------------------------------------------------------------------------

struct GateRow {
  std::string_view method;
  Arithmetic arithmetic;
};

std::vector<GateRow> GateRows(int dimension) {
  using enum Arithmetic;
  std::vector<GateRow> rows;
  for (const std::string_view method : {"auto", "fast", "complete", "lemke", "baraff", "proximal"}) {
    for (const Arithmetic arithmetic : {kFloat, kDouble, kLongDouble, kQuad, kFiltered})
      if (Refusal(method, dimension, arithmetic).empty()) rows.push_back({method, arithmetic});
  }
  return rows;
}

// What the arithmetic is given; null where it does not hold a number.
const ExactProblem* GivenTo(Arithmetic arithmetic, const RungProblem& problem) {
  const bool narrow = arithmetic == Arithmetic::kFloat;
  const bool holds = narrow ? problem.in_float().has_value() : problem.in_double().has_value();
  return holds ? &problem.Given(narrow ? Arithmetic::kFloat : Arithmetic::kDouble) : nullptr;
}

std::optional<std::string> MissOf(const ExactProblem& given, const ExactVector& f, FrictionLaw law,
                                  double bound) {
  if (f.size() != given.rows()) return "there are no forces";
  return FindMiss(given, f, law, Rational(bound) * (1 + Rational(1, 1 << 30)));
}

// What an answer called solved misses; empty if nothing. An exact answer promises to miss nothing.
std::optional<std::string> MissOf(const ExactProblem& given, Arithmetic arithmetic, const Solution& solution) {
  if (const auto* exact = std::get_if<ExactAnswer>(&solution.answer))
    return MissOf(given, exact->f, exact->law, 0);
  const auto& answer = std::get<InexactAnswer>(solution.answer);
  if (!answer.f.allFinite()) return "a force is not finite";
  const double bound = arithmetic == Arithmetic::kFloat ? kSolvedResidual<float> : kSolvedResidual<double>;
  return MissOf(given, answer.f.unaryExpr([](double x) { return Rational(x); }), answer.law, bound);
}

SolveRequest RequestOf(const GateRow& row) {
  SolveRequest request;
  request.method = row.method;
  request.arithmetic = row.arithmetic;
  request.options.limits.drives = request.options.limits.pivots = kMostSteps;
  request.confirm = false;
  return request;
}

// ---- Counts --------------------------------------------------------------------------------------

struct GateCounts {
  std::array<std::int64_t, kOutcomeCount + 1> outcomes = {};
  std::int64_t wrong = 0, refused = 0;

  std::int64_t Of(Outcome outcome) const { return outcomes[static_cast<int>(outcome)]; }
  std::int64_t Runs() const {
    std::int64_t runs = 0;
    for (const std::int64_t count : outcomes) runs += count;
    return runs;
  }
  void Add(const GateCounts& more) {
    for (std::size_t i = 0; i < outcomes.size(); ++i) outcomes[i] += more.outcomes[i];
    wrong += more.wrong;
    refused += more.refused;
  }
};

struct GateCell {
  const Source* source;
  int dimension;
  GateRow row;
  GateCounts counts;
};

struct GateRun {
  std::vector<GateCell> cells;
  Json wrong = Json::array();
};

Json WrongJson(const GateCell& cell, std::int64_t index, const std::string& miss, const ExactProblem& given) {
  return {{"dial", cell.source->family},    {"setting", cell.source->setting},         {"index", index},
          {"method", cell.row.method},      {"arithmetic", Name(cell.row.arithmetic)}, {"miss", miss},
          {"problem", ProblemToJson(given)}};
}

// One problem in one cell.
void RunOne(const RungProblem& problem, std::int64_t index, GateCell& cell, Json& wrong) {
  const ExactProblem* given = GivenTo(cell.row.arithmetic, problem);
  if (given == nullptr) {
    ++cell.counts.refused;
    return;
  }
  const Solution solution = SolveIn(*given, RequestOf(cell.row));
  ++cell.counts.outcomes[static_cast<int>(solution.outcome())];
  if (solution.outcome() != Outcome::kSolved) return;
  const auto miss = MissOf(*given, cell.row.arithmetic, solution);
  if (!miss) return;
  ++cell.counts.wrong;
  if (wrong.size() < kExamples) wrong.push_back(WrongJson(cell, index, *miss, *given));
}

void RunSource(const Source& source, std::int64_t problems, std::uint64_t seed, GateRun& run) {
  const int dimension = source.make(seed, 0).dimension;
  std::vector<GateCell> cells;
  for (const GateRow& row : GateRows(dimension)) cells.push_back({&source, dimension, row, {}});
  for (std::int64_t index = 0; index < problems; ++index) {
    const RungProblem problem(source.make(seed, index));
    for (GateCell& cell : cells) RunOne(problem, index, cell, run.wrong);
    progress::Done();
  }
  run.cells.insert(run.cells.end(), cells.begin(), cells.end());
}

GateRun RunGate(const std::vector<Source>& sources, std::int64_t problems, std::uint64_t seed) {
  GateRun run;
  progress::Expect(sources.size());
  for (const Source& source : sources) {
    const std::int64_t some = source.is_large ? std::max<std::int64_t>(1, problems / kLargeFraction) : problems;
    progress::Begin(fmt::format("{} at {}", source.family, source.setting), some);
    RunSource(source, some, seed, run);
  }
  progress::Clear();
  return run;
}

// ---- Tables --------------------------------------------------------------------------------------

double Percent(std::int64_t part, std::int64_t of) {
  return of == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(of);
}

Json TableRow(const std::string& key, const std::string& name, const GateCounts& counts) {
  const std::int64_t runs = counts.Runs(), solved = counts.Of(Outcome::kSolved),
                     undecided = counts.Of(Outcome::kUndecided);
  return {{key, name},
          {"runs", runs},
          {"solved", solved},
          {"wrong", counts.wrong},
          {"undecided %", Percent(undecided, runs)},
          {"other %", Percent(runs - solved - undecided, runs)},
          {"refused", counts.refused}};
}

// Cells of the same name together, in the order in which the names come.
BenchTable TableBy(const std::string& key, const GateRun& run,
                   const std::function<std::string(const GateCell&)>& name_of) {
  std::vector<std::pair<std::string, GateCounts>> sums;
  for (const GateCell& cell : run.cells) {
    const std::string name = name_of(cell);
    auto sum = std::find_if(sums.begin(), sums.end(), [&name](auto& s) { return s.first == name; });
    if (sum == sums.end()) sum = sums.insert(sums.end(), {name, {}});
    sum->second.Add(cell.counts);
  }
  BenchTable table{"gate-by-" + key, "By " + key, Json::array()};
  for (const auto& [name, counts] : sums) table.rows.push_back(TableRow(key, name, counts));
  return table;
}

Json CellJson(const GateCell& cell) {
  Json json = {{"dial", cell.source->family},
               {"dimension", cell.dimension},
               {"setting", cell.source->setting},
               {"method", cell.row.method},
               {"arithmetic", Name(cell.row.arithmetic)},
               {"runs", cell.counts.Runs()},
               {"wrong", cell.counts.wrong},
               {"refused", cell.counts.refused}};
  for (int i = 0; i <= kOutcomeCount; ++i)
    json[std::string(Name(static_cast<Outcome>(i)))] = cell.counts.outcomes[i];
  return json;
}

void PrintForPeople(const GateRun& run, const GateCounts& all) {
  Print(TableBy("dial", run, [](const GateCell& cell) { return cell.source->family; }));
  Print(TableBy("method", run, [](const GateCell& cell) {
    return fmt::format("{}, {}", cell.row.method, cell.dimension == 2 ? "plane" : "space");
  }));
  Print(
      TableBy("arithmetic", run, [](const GateCell& cell) { return std::string(Name(cell.row.arithmetic)); }));
  for (const Json& wrong : run.wrong)
    fmt::print("{} at {}, index {}: {} over {}: {}\n", wrong["dial"].get<std::string>(),
               wrong["setting"].get<int>(), wrong["index"].get<std::int64_t>(),
               wrong["method"].get<std::string>(), wrong["arithmetic"].get<std::string>(),
               wrong["miss"].get<std::string>());
  fmt::print("\n{} runs, {} called solved, {} of them wrong\n", all.Runs(), all.Of(Outcome::kSolved),
             all.wrong);
}

}  // namespace

int BenchGate(const BenchOptions& o) {
  const std::vector<Source> sources = GateSources(o.families);
  const GateRun run = RunGate(sources, o.problems.value_or(25), o.seed);
  GateCounts all;
  Json cells = Json::array();
  for (const GateCell& cell : run.cells) {
    all.Add(cell.counts);
    cells.push_back(CellJson(cell));
  }
  if (o.json) {
    std::cout << JsonText({{"cells", cells}, {"wrong", run.wrong}}) << "\n";
  } else {
    PrintForPeople(run, all);
  }
  return all.wrong == 0 ? kExitDone : kExitNotSo;
}

}  // namespace stiction
