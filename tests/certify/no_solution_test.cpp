// SPDX-License-Identifier: Apache-2.0
// Where it is proved that nothing solves a problem, no method calls forces its solution: also not forces that
// grow along a direction that A does not see, until their rounding hides what acts.

#include <catch2/catch.hpp>

#include "certify/claims/existence.h"
#include "corpus/json.h"
#include "corpus/rounded.h"
#include "solver/solve.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// A = u u' of small integers, one or two contacts; b of small integers, seldom in the range of A.
ExactProblem OfRankOne(std::uint64_t seed) {
  Choices choices(seed);
  ExactProblem problem;
  const int contacts = choices.Integer(1, 2);
  const bool has_friction = choices.Integer(0, 2) > 0;
  const int rows = has_friction ? 2 * contacts : contacts + 1;
  for (int i = 0; i < (has_friction ? contacts : rows); ++i)
    problem.contacts.push_back({has_friction ? ContactKind::kStatic : ContactKind::kFrictionless,
                                has_friction ? Rational(choices.Integer(1, 4), 2) : Rational(0),
                                {}});
  ExactMatrix u(rows, 1);
  problem.b.resize(rows);
  for (int i = 0; i < rows; ++i) {
    u(i, 0) = choices.Integer(-9, 9);
    problem.b[i] = choices.Integer(-5, 5);
  }
  problem.A = u * u.transpose();
  return problem;
}

template <class Scalar>
int CalledSolved(const ExactProblem& problem) {
  int solved = 0;
  for (const auto& method : Methods<Scalar>()) {
    if (!method.In(problem.dimension).run) continue;
    solved += Solve(Rounded<Scalar>(problem), {.method = method.name}).Solved();
  }
  return solved + Solve(Rounded<Scalar>(problem), {.method = kAutomatic}).Solved();
}

TEST_CASE("no solution: what is proved to have none is never called solved") {
  int none = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const ExactProblem problem = OfRankOne(seed);
    const ClaimAnswer existence = DecideExistence(problem, {});
    if (!existence.certificate || existence.certificate->at("claim") != "no-solution") continue;
    ++none;
    CAPTURE(seed);
    CHECK(CalledSolved<double>(problem) == 0);
    CHECK(CalledSolved<float>(problem) == 0);
  }
  CHECK(none > 30);
}

TEST_CASE("no solution: forces of 1e14 that hide what acts are none") {
  const ExactProblem wedge = MakeProblem({2}, {{4, -10}, {-10, 25}}, {-4, 5});
  CHECK(CalledSolved<double>(wedge) == 0);
  // Nor beside another body on which much acts, or which A does not see.
  for (const Rational& mass : {Rational(1), Rational(1, 1000000), Rational(0)}) {
    const ExactProblem both = MakeProblem(
        {2, 1}, {{4, -10, 0, 0}, {-10, 25, 0, 0}, {0, 0, mass, 0}, {0, 0, 0, mass}}, {-4, 5, 1000000, 0});
    CHECK(CalledSolved<double>(both) == 0);
  }
}

}  // namespace
}  // namespace stiction
