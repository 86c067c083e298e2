// SPDX-License-Identifier: Apache-2.0
// Tests of search/generators/exceptional.cpp, over rationals, with ==.

#include <catch2/catch.hpp>
#include <set>

#include "certify/exact/linear_equations.h"
#include "certify/exact/verify_solution.h"
#include "search/generators/generators.h"
#include "tests/methods.h"
#include "tests/search/recorded.h"

namespace stiction {
namespace {

[[maybe_unused]] const bool kRecordedExceptional = AddRecorded({
    {"exceptional", 0x010a2469f6661414, 0xdba0e1de9b3fd9e5, 0x0e39e974f08364e5},
});

struct DrawnExceptional {
  ExactProblem problem;
  int beside = 0;  // -1, 0, 1: of u
  int scale = 1;   // 2^k
};

DrawnExceptional MakeExceptionalProblem(int contacts, std::uint64_t index) {
  std::vector<Choice> record;
  Choices choices(index, &record);
  DrawnExceptional made;
  Generate(GeneratorId::kExceptional, contacts, kDefaultPalette, choices, made.problem);
  const std::size_t first = record[0].value == 0 ? 2 : 1 + contacts;  // after friction
  made.beside = static_cast<int>(record[first + 1].value);
  if (made.beside != 0) made.scale = 1 << record[first + 2].value;
  return made;
}

// Of a semidefinite A, 3 x 3: no kernel but one direction.
bool HasRankTwo(const ExactMatrix& A) {
  const auto minor = [&A](int i, int j) -> Rational { return A(i, i) * A(j, j) - A(i, j) * A(j, i); };
  return minor(0, 1) != 0 || minor(0, 2) != 0 || minor(1, 2) != 0;
}

bool Sticks(const ExactVector& f, const Rational& mu) {
  return f[0] >= 0 && f[1] * f[1] + f[2] * f[2] <= mu * mu * f[0] * f[0];
}

}  // namespace

TEST_CASE("exceptional: one contact jams at the boundary of its cone, sticking is a limit, or just not") {
  std::set<int> seen;
  for (std::uint64_t index = 0; index < 300; ++index) {
    CAPTURE(index);
    const DrawnExceptional made = MakeExceptionalProblem(1, index);
    const ExactProblem& problem = made.problem;
    if (!HasRankTwo(problem.A)) continue;
    const Rational& mu = problem.contacts[0].mu;
    // v of a normal part 1, x of none.
    const ExactVector none = ExactVector::Zero(3), ones = ExactVector::Constant(3, Rational(1));
    const auto kernel = SolveEquations(problem.A, none, ones);
    const auto sticking = SolveEquations(problem.A, -problem.b, none);
    REQUIRE((kernel && sticking));
    REQUIRE((*kernel)[0] != 0);
    const ExactVector v = *kernel / (*kernel)[0];
    const ExactVector x = *sticking - (*sticking)[0] * v;
    REQUIRE(problem.A * v == none);
    CHECK(v[1] * v[1] + v[2] * v[2] == mu * mu);
    CHECK(v[1] * x[2] - v[2] * x[1] != 0);
    const Rational u = -(v[1] * x[1] + v[2] * x[2]) / mu;
    CHECK(u * made.scale == made.beside * mu.get_num());
    const Rational far = Rational(1 << 24);
    CHECK(Sticks(x + far * v, mu) == (made.beside > 0));
    CHECK_FALSE(Sticks(x + made.scale / far * v, mu));
    seen.insert(made.beside);
  }
  CHECK(seen == std::set<int>{-1, 0, 1});
}

TEST_CASE("exceptional: there is a solution, of forces that stay bounded") {
  for (int contacts = 1; contacts <= 4; ++contacts) {
    for (std::uint64_t index = 0; index < 6; ++index) {
      CAPTURE(contacts, index);
      const DrawnExceptional made = MakeExceptionalProblem(contacts, index);
      const ExactAnswer answer = SolveExactly(made.problem, {.method = "complete"});
      REQUIRE(answer.Solved());
      for (const Rational& force : answer.f) CHECK(abs(force) < 1000);
    }
  }
}

}  // namespace stiction
