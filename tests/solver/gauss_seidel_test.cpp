// SPDX-License-Identifier: Apache-2.0
// Gauss-Seidel over the contacts: what one contact does, what sweeps come to, and where they do not.

#include "solver/numeric/gauss_seidel.h"

#include <catch2/catch.hpp>

#include "certify/request/quad.h"
#include "search/generators/generators.h"
#include "solver/solve.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

Answer<double> BySweeps(const ContactProblem<double>& problem, std::int64_t most = 10000) {
  Request request{.method = "gauss-seidel"};
  request.limits.pivots = most;
  return Solve(problem, request);
}

ContactProblem<double> OneInPlane(double mu, double qN, double qF) {
  return {2, {{ContactKind::kStatic, mu, {}}}, Eigen::Matrix2d::Identity(), Eigen::Vector2d(qN, qF)};
}

}  // namespace

TEST_CASE("gauss-seidel: one planar contact in one sweep: it parts, sticks, slips to both sides") {
  struct Case {
    double mu, qN, qF, fN, fF;
  };
  for (const Case& c : {Case{0.5, 3, 4, 0, 0}, Case{0.5, -10, 4, 10, -4}, Case{0.5, -10, 8, 10, -5},
                        Case{0.5, -10, -8, 10, 5}, Case{0, -10, 8, 10, 0}}) {
    CAPTURE(c.mu, c.qN, c.qF);
    const Answer<double> answer = BySweeps(OneInPlane(c.mu, c.qN, c.qF), 1);
    REQUIRE(answer.Solved());
    CHECK(answer.counters[Counter::kSweeps] == (c.fN > 0 ? 1 : 0));
    CHECK(answer.f[0] == Approx(c.fN));
    CHECK(answer.f[1] == Approx(c.fF));
  }
}

TEST_CASE("gauss-seidel: solves most small problems of the plane and of space, over every scalar") {
  int solved = 0, tried = 0;
  for (const GeneratorId id : {GeneratorId::kPsd, GeneratorId::kSpace}) {
    for (std::uint64_t index = 0; index < 100; ++index) {
      Choices choices(index);
      ContactProblem<double> problem;
      Generate(id, 3, kDefaultPalette, choices, problem);
      const Answer<double> answer = BySweeps(problem);
      ++tried;
      solved += answer.Solved() ? 1 : 0;
      if (!answer.Solved()) CHECK(answer.reason != "");
      if (index != 0) continue;
      const Request request{.method = "gauss-seidel"};
      const auto singles =
          Solve(Converted<float>(problem, [](double x) { return static_cast<float>(x); }), request);
      const auto wide = Solve(Converted<Quad>(problem, [](double x) { return Quad(x); }), request);
      CHECK(singles.Solved() == answer.Solved());
      CHECK(wide.Solved() == answer.Solved());
    }
  }
  CHECK(solved > tried / 2);
}

TEST_CASE("gauss-seidel: its limit is one of sweeps, and it stops where nothing moves") {
  // Two contacts that press on each other through a matrix of condition 2,000: sweeps are slow.
  ContactProblem<double> slow{2,
                              {{ContactKind::kFrictionless, 0, {}}, {ContactKind::kFrictionless, 0, {}}},
                              Eigen::Matrix2d{{1, 0.999}, {0.999, 1}},
                              Eigen::Vector2d(-1, -0.9995)};
  Request few{.method = "gauss-seidel"};
  few.limits.pivots = 5;
  const Answer<double> early = RunGaussSeidel(slow, few);  // the gate would refine it
  CHECK(early.outcome == Outcome::kUndecided);
  CHECK(early.reason == "too many sweeps");
  CHECK(early.counters[Counter::kSweeps] == 5);
  CHECK(BySweeps(slow).Solved());
  // Nothing can push back.
  ContactProblem<double> without{
      2, {{ContactKind::kFrictionless, 0, {}}}, Eigen::MatrixXd::Zero(1, 1), Eigen::VectorXd::Constant(1, -1)};
  const Answer<double> idle = BySweeps(without);
  CHECK(idle.outcome == Outcome::kUndecided);
  CHECK(idle.reason == "sweeps move nothing");
}

}  // namespace stiction
