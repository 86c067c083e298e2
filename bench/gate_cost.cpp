// SPDX-License-Identifier: Apache-2.0
// bench --suite gate-cost: what it costs to judge forces, beside LU of the same A: every answer pays it.
//
// Problems A = J J' + I, J square, of integers up to 1000, b up to 10^6; forces of the fast method, which the
// gate lets pass. A time is that of a block of problems, one after another, the less of wall-clock time and
// processor time; LU (Eigen, partial pivoting, with one solve) and the gate take turns at blocks.

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <iostream>

#include "bench/output.h"
#include "bench/suite.h"
#include "corpus/exit_code.h"
#include "corpus/input_error.h"
#include "corpus/json_text.h"
#include "corpus/order_statistics.h"
#include "corpus/stopwatch.h"
#include "search/generators/choices.h"
#include "solver/numeric/fast.h"
#include "solver/problem/gate.h"

namespace stiction {
namespace {

struct Judged {
  ContactProblem<double> problem;
  Eigen::VectorXd f;
};

ContactProblem<double> Definite(int contacts, Choices& choices) {
  constexpr std::array kFrictions = {0.0, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0};
  const auto draw = [&choices](int rows, int columns, int most) -> Eigen::MatrixXd {
    return Eigen::MatrixXd::NullaryExpr(rows, columns,
                                        [&] { return static_cast<double>(choices.Integer(-most, most)); });
  };
  ContactProblem<double> problem;
  for (int i = 0; i < contacts; ++i)
    problem.contacts.push_back(
        {ContactKind::kStatic, kFrictions[choices.Integer(0, kFrictions.size() - 1)], {}});
  const Eigen::MatrixXd J = draw(2 * contacts, 2 * contacts, 1000);
  problem.A = J * J.transpose();
  problem.A.diagonal().array() += 1;
  problem.b = draw(2 * contacts, 1, 1000000);
  return problem;
}

std::vector<Judged> SolvedProblems(int contacts, std::int64_t count, std::uint64_t seed) {
  FastSolver<double> fast;
  std::vector<Judged> solved;
  for (std::int64_t index = 0; index < count; ++index) {
    Choices choices(ProblemSeed(seed, static_cast<std::uint64_t>(contacts), static_cast<std::uint64_t>(index)));
    ContactProblem<double> problem = Definite(contacts, choices);
    if (fast.Run(problem).outcome == Outcome::kSolved) solved.push_back({std::move(problem), fast.f()});
  }
  return solved;
}

// Microseconds a problem.
template <class Call>
double MicrosecondsOf(const std::vector<Judged>& problems, Call call) {
  const Stopwatch watch;
  for (const Judged& judged : problems) call(judged);
  return 1e6 * watch.Seconds() / static_cast<double>(problems.size());
}

SharedJson Row(int contacts, const BenchOptions& options) {
  const std::int64_t most = contacts <= 10 ? 400 : contacts <= 30 ? 100 : 20;
  const auto problems = SolvedProblems(contacts, std::min(options.problems.value_or(most), most), options.seed);
  if (problems.empty())
    throw InputError(
        fmt::format("bench: gate-cost: found no problem of {} contacts that the fast method solves, expected "
                    "more --problems",
                    contacts));
  constexpr int kTurns = 50;
  progress::Begin(fmt::format("turns at {} contacts", contacts), kTurns);
  Eigen::PartialPivLU<Eigen::MatrixXd> lu;
  GateMeter<double> meter;
  const Gate gate = GateOf<double>();
  [[maybe_unused]] volatile double kept = 0;  // so that nothing is left out
  std::int64_t passed = 0;
  std::vector<double> lus, gates, ratios;
  for (int turn = 0; turn < kTurns; ++turn) {
    lus.push_back(MicrosecondsOf(problems, [&](const Judged& judged) {
      lu.compute(judged.problem.A);
      kept = lu.solve(judged.problem.b)[0];
    }));
    passed = 0;
    gates.push_back(MicrosecondsOf(problems, [&](const Judged& judged) {
      passed += BoundErrors(judged.problem, FrictionLaw::kCoulomb, judged.f, gate, meter).Largest() <= gate.eps;
    }));
    ratios.push_back(gates.back() / lus.back());
    progress::Done(1);
  }
  progress::Clear();
  const Quartiles ratio = QuartilesOf(ratios);
  return {{"contacts", contacts},
          {"problems", problems.size()},
          {"passed", passed},
          {"lu us", QuartilesOf(lus).median},
          {"gate us", QuartilesOf(gates).median},
          {"gate/lu", ratio.median},
          {"gate/lu at 90 %", ratio.ninety}};
}

}  // namespace

int BenchGateCost(const BenchOptions& options) {
  const std::vector<int> sizes = options.contacts.empty() ? std::vector<int>{3, 10, 30, 100} : options.contacts;
  progress::Expect(sizes.size());
  BenchTable table{"gate-cost", "microseconds a problem of the plane: LU of A with one solve, and the gate"};
  for (const int contacts : sizes) table.rows.push_back(Row(contacts, options));
  if (options.json) {
    std::cout << JsonText(
                     SharedJson{{"suite", options.suite}, {"seed", options.seed}, {table.name, table.rows}})
              << "\n";
  } else {
    Print(table);
  }
  return kExitDone;
}

}  // namespace stiction
