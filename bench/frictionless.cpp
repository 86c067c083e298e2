// SPDX-License-Identifier: Apache-2.0
// Suite `frictionless`: section 4 of the paper beside plain elimination, of which it is said to take two to
// three times the time, and beside quadratic programs, than which it is said to be five to ten times faster to
// n = 150.
//
// Problems are those of family.h. Methods take turns problem by problem; ratios are of the same problem.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <iostream>

#include "bench/method.h"
#include "bench/one_thread.h"
#include "bench/plain_gauss.h"
#include "bench/suite.h"
#include "bench/table.h"
#include "certify/linear_system.h"
#include "certify/verify_solution.h"
#include "corpus/exit_code.h"
#include "corpus/stopwatch.h"
#include "solver/numeric/fast.h"
#include "solver/problem/residual.h"

namespace stiction {
namespace {

constexpr double kWrongForces = 1e-6;  // natural residual, relative

// ---- Methods that the suite `methods` does not have --------------------------------------------

// The linear system of all contacts, whose forces may pull: a unit of time, and no method.
Measure RunGauss(PlainGauss& gauss, const BenchProblem& problem) {
  const Stopwatch watch;
  gauss.Solve(problem.rounded.A, problem.rounded.b);
  return {.seconds = watch.Seconds()};
}

Measure RunFastMethod(FastSolver<double>& solver, const BenchProblem& problem) {
  const Stopwatch watch;
  Measure measure{.outcome = solver.Run(problem.rounded).outcome};
  measure.seconds = watch.Seconds();
  const Eigen::VectorXd a = problem.rounded.A * solver.f() + problem.rounded.b;
  measure.wrong = !(NaturalResidual(problem.rounded, solver.f(), a) <= kWrongForces);
  return measure;
}

// Of a problem over integers.
QuadraticProgram ProgramOf(const ExactProblem& problem) {
  QuadraticProgram program;
  for (int i = 0; i < problem.rows(); ++i) {
    program.c.push_back(problem.b[i].get_num());
    auto& row = program.M.emplace_back();
    for (int j = 0; j < problem.rows(); ++j) row.push_back(problem.A(i, j).get_num());
  }
  return program;
}

// CGAL's QP_solver, exact, on a problem over integers; without the proof that A is definite.
Measure RunExactProgram(const BenchProblem& problem) {
  const QuadraticProgram program = ProgramOf(problem.exact);
  const Stopwatch watch;
  const QuadraticEnd end = Minimize(program);
  Measure measure{.outcome = end.bounded ? Outcome::kSolved : Outcome::kRay, .seconds = watch.Seconds()};
  if (!end.bounded) return measure;
  const ExactProblem::Vector f = Eigen::Map<const ExactProblem::Vector>(end.x.data(), problem.exact.rows());
  measure.wrong = FindViolation(problem.exact, f).has_value();
  return measure;
}

// ---- Measuring ---------------------------------------------------------------------------------

enum Column { kGaussColumn, kBaraffColumn, kLemkeColumn, kFastColumn, kIpoptColumn, kExactColumn, kColumns };
constexpr std::array kColumnNames = {"gauss", "baraff", "lemke", "fast", "ipopt", "qp"};

using Runner = std::function<Measure(const BenchProblem&)>;

// In the order of Column.
std::vector<Runner> Runners() {
  std::vector<BenchMethod> methods = FrictionlessMethods();
  return {
      [gauss = PlainGauss()](const auto& problem) mutable { return RunGauss(gauss, problem); },
      methods[kBaraffDouble].run,
      methods[kLemkeDouble].run,
      [solver = FastSolver<double>()](const auto& problem) mutable { return RunFastMethod(solver, problem); },
      [run = methods[kQuadratic].run](const auto& problem) {
        Measure measure = run(problem);
        measure.seconds = measure.library_seconds;
        return measure;
      },
      RunExactProgram};
}

// Measures of one method, by problem.
using Measures = std::vector<Measure>;

std::array<Measures, kColumns> MeasureProblems(std::vector<Runner>& runners, int contacts, std::int64_t count,
                                               std::uint64_t seed) {
  std::array<Measures, kColumns> measures;
  for (std::int64_t index = 0; index < count; ++index) {
    const BenchProblem problem = MakeFrictionless(contacts, seed, index);
    for (int column = 0; column < kColumns; ++column) {
      if (index == 0) runners[column](problem);  // takes its memory
      measures[column].push_back(runners[column](problem));
    }
  }
  return measures;
}

Json QuartilesOfTimes(const Measures& measures) {
  std::vector<double> values;
  for (const Measure& m : measures) values.push_back(1e6 * m.seconds);
  const Quartiles q = QuartilesOf(values);
  return {q.low, q.median, q.high};
}

Json QuartilesOfRatios(const Measures& left, const Measures& right) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < left.size(); ++i) ratios.push_back(left[i].seconds / right[i].seconds);
  const Quartiles q = QuartilesOf(ratios);
  return {q.low, q.median, q.high};
}

Json RowOfSize(int contacts, const std::array<Measures, kColumns>& measures) {
  Json row = {{"contacts", contacts}, {"problems", measures[0].size()}};
  for (int column = kBaraffColumn; column < kColumns; ++column) {
    const auto solved = [](const Measure& m) { return m.Solved(); };
    row[fmt::format("{} solved", kColumnNames[column])] =
        std::count_if(measures[column].begin(), measures[column].end(), solved);
  }
  for (const int column : {kGaussColumn, kBaraffColumn, kIpoptColumn, kExactColumn})
    row[fmt::format("{} us", kColumnNames[column])] = QuartilesOfTimes(measures[column]);
  row["baraff/gauss"] = QuartilesOfRatios(measures[kBaraffColumn], measures[kGaussColumn]);
  for (const int column : {kLemkeColumn, kFastColumn, kIpoptColumn, kExactColumn}) {
    row[fmt::format("{}/baraff", kColumnNames[column])] =
        QuartilesOfRatios(measures[column], measures[kBaraffColumn]);
  }
  return row;
}

// Exact arithmetic makes many contacts slow to solve and to verify.
std::int64_t ProblemsOfSize(int contacts) {
  return contacts <= 12 ? 48 : contacts <= 25 ? 24 : contacts <= 50 ? 8 : 4;
}

}  // namespace

int BenchFrictionless(const BenchOptions& options) {
  const std::vector<int> sizes =
      options.contacts.empty() ? std::vector<int>{3, 6, 12, 25, 50, 100, 150} : options.contacts;
  BenchTable table{
      "frictionless",
      "without friction, microseconds: plain Gauss on A f = -b, section 4, Lemke, fast, inside Ipopt "
      "program (5), and the program exactly by CGAL (qp)"};
  std::vector<Runner> runners = Runners();
  for (const int contacts : sizes) {
    const std::int64_t count = std::min(ProblemsOfSize(contacts), options.problems.value_or(48));
    table.rows.push_back(RowOfSize(contacts, MeasureProblems(runners, contacts, count, options.seed)));
    fmt::print(stderr, "{} contacts: {} problems\n", contacts, count);
  }
  if (options.json) {
    std::cout << JsonText({{"suite", "frictionless"},
                           {"seed", options.seed},
                           {"one_thread", ThreadsJson()},
                           {table.name, table.rows}})
              << "\n";
  } else {
    fmt::print("{}\n", ThreadsText());
    Print(table);
  }
  return kExitDone;
}

}  // namespace stiction
