// SPDX-License-Identifier: Apache-2.0
// Rest: where accelerations are not unique, the solution that has none.

#include "certify/exact/rest.h"

#include <catch2/catch.hpp>

#include "certify/exact/enumerate.h"
#include "certify/exact/hypothesis.h"
#include "certify/exact/verify_solution.h"
#include "certify/request/solve_in.h"
#include "solver/problem/gate.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// What `solve` says over rationals.
ExactAnswer Solved(const ExactProblem& problem) { return std::get<ExactAnswer>(SolveIn(problem, {}).answer); }

// By forces f, whatever they accelerate.
std::optional<ExactVector> AtRest(const ExactProblem& problem, const ExactVector& f) {
  const auto rest = ForcesAtRest(problem, f, Accelerations(problem, f));
  return rest ? std::optional(rest->f) : std::nullopt;
}

TEST_CASE("rest: the contact with three solutions rests in one of them") {
  const ExactProblem problem = ThreeSolutions();
  for (const ExactVector& moving : {Vector({0, 0}), Vector({1, -1})})
    CHECK(AtRest(problem, moving) == Vector({3, -2}));
  CHECK(!AtRest(problem, Vector({3, -2})));
  ExactProblem slippery = problem;
  slippery.contacts[0].mu = Rational(3, 5);  // less than 2 / 3
  CHECK(!AtRest(slippery, Vector({0, 0})));
  const ExactAnswer answer = Solved(problem);
  CHECK(answer.f == Vector({3, -2}));
  CHECK(answer.a.isZero());
}

TEST_CASE("rest: every group of contacts by itself") {
  const ExactProblem problem = Decoupled(ThreeSolutions(), MakeProblem({1}, {{1, 0}, {0, 1}}, {1, 0}));
  CHECK(AtRest(problem, Vector({0, 0, 0, 0})) == Vector({3, -2, 0, 0}));  // the second one separates
  const ExactProblem twice = Decoupled(ThreeSolutions(), ThreeSolutions());
  CHECK(AtRest(twice, Vector({0, 0, 1, -1})) == Vector({3, -2, 3, -2}));
  CHECK(AtRest(twice, Vector({3, -2, 0, 0})) == Vector({3, -2, 3, -2}));
  ExactProblem sliding = twice;
  sliding.contacts[0] = {ContactKind::kSliding, 1, {1, 0}};
  CHECK(AtRest(sliding, Vector({0, 0, 0, 0})) == Vector({0, 0, 3, -2}));
}

TEST_CASE("rest: in the plane it is found if and only if some word sticks everywhere") {
  int rests = 0, moves = 0, told = 0;
  for (int index = 0; index < Few(400); ++index) {
    CAPTURE(index);
    const auto id = index % 2 == 0 ? GeneratorId::kSmall : GeneratorId::kDuplicates;
    const ExactProblem problem = Random<Rational>(id, 1 + index % 3, index);
    bool can_rest = false;
    for (const WordSolution& solution : EnumerateModes(problem).solutions)
      can_rest |= std::ranges::all_of(solution.word,
                                      [](Mode mode) { return mode == Mode::kStick || mode == Mode::kTouch; }) &&
                  Accelerations(problem, solution.f).isZero();
    const ExactAnswer answer = Solved(problem);
    REQUIRE(answer.Solved());
    if (can_rest) CHECK(answer.a.isZero());
    if (answer.moves_elsewhere) CHECK(!FindViolation(problem, answer.f));
    for (const Arithmetic arithmetic : {Arithmetic::kFiltered, Arithmetic::kDouble}) {
      CAPTURE(arithmetic);
      const Solution solution = SolveIn(problem, {.arithmetic = arithmetic});
      if (const auto* rounded = std::get_if<InexactAnswer>(&solution.answer); rounded != nullptr && can_rest) {
        REQUIRE(rounded->Solved());
        CHECK(rounded->a.cwiseAbs().maxCoeff() < 1e-9);
        told += rounded->moves_elsewhere;
      }
    }
    ++(can_rest ? rests : moves);
  }
  CHECK(told > Few(10));
  CHECK(rests > Few(30));
  CHECK(moves > Few(30));
}

// Two contacts opposite to each other, each pressed with n on a body that t draws along a tangent.
ExactProblem Pinched(const Rational& mu, const Rational& n, const Rational& x, const Rational& y) {
  ExactProblem problem;
  problem.dimension = 3;
  problem.contacts.assign(2, {ContactKind::kStatic, mu, {}});
  problem.A = ExactMatrix::Zero(6, 6);
  for (const auto& [i, j] : {std::pair{0, 0}, {3, 3}}) problem.A(i, j) = 1;
  for (const int k : {1, 2})
    problem.A(k, k) = problem.A(k + 3, k + 3) = problem.A(k, k + 3) = problem.A(k + 3, k) = 1;
  problem.b = Vector({-n, x, y, -n, x, y});
  return problem;
}

TEST_CASE("rest: over doubles by forces that doubles find, where rounding leaves none that are exact") {
  int rests = 0;
  for (int index = 0; index < Few(400); ++index) {
    CAPTURE(index);
    const auto problem = Random<double>(GeneratorId::kBodies, 2, index);
    const Solution solution = SolveDoubles(problem, {.arithmetic = Arithmetic::kDouble});
    const auto& answer = std::get<InexactAnswer>(solution.answer);
    if (!answer.Solved() || !answer.moves_elsewhere) continue;
    ++rests;
    CHECK(BoundErrors(problem, FrictionLaw::kCoulomb, answer.f, GateOf<double>()).Largest() <= 1e-8);
  }
  CHECK(rests > Few(400) / 40);  // 1 in 100 have exact ones
}

TEST_CASE("rest: in space up to the circle, past the corners of the first polygon") {
  // fN = 5 at each contact, which the circle lets hold 10 in all: (6, -8) is at its edge.
  const ExactProblem edge = Pinched(1, 5, -6, 8);
  const auto rest = AtRest(edge, Vector({5, 0, 0, 5, 0, 0}));
  REQUIRE(rest);
  CHECK(Accelerations(edge, *rest).isZero());
  CHECK(!FindConeViolation(edge, *rest));
  CHECK(!FindViolation(edge, *rest, FrictionLaw::kCoulomb, 1));
  CHECK(AtRest(Pinched(1, 5, Rational(-59, 10), Rational(79, 10)), Vector({5, 0, 0, 5, 0, 0})));
  CHECK(!AtRest(Pinched(1, 5, Rational(-61, 10), 8), Vector({5, 0, 0, 5, 0, 0})));
  CHECK(!AtRest(Pinched(1, 5, 0, Rational(101, 10)), Vector({5, 0, 0, 5, 0, 0})));
}

}  // namespace
}  // namespace stiction
