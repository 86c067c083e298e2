// SPDX-License-Identifier: Apache-2.0
// Tests of search/generators/games.cpp, over rationals, with ==.

#include <catch2/catch.hpp>
#include <set>

#include "certify/exact/properties.h"
#include "certify/exact/verify_solution.h"
#include "search/generators/generators.h"
#include "tests/methods.h"
#include "tests/search/recorded.h"

namespace stiction {
namespace {

[[maybe_unused]] const bool kRecordedGame = AddRecorded({
    {"game", 0xc5224daaa1118f2f, 0xe8f652c8a7909bec, 0xf1f095554a5c527a},
});

ExactProblem DrawGame(int strategies, std::uint64_t index,
                      const std::vector<MuChoice>& palette = {{1, 2}, {1, 1}, {5, 1}}) {
  Choices choices(index);
  ExactProblem problem;
  Generate(GeneratorId::kGame, strategies, palette, choices, problem);
  return problem;
}

}  // namespace

TEST_CASE("game: solutions are symmetric equilibria of its costs, and every contact slips") {
  for (int n = 1; n <= 4; ++n) {
    for (std::uint64_t index = 0; index < 20; ++index) {
      CAPTURE(n, index);
      const ExactProblem problem = DrawGame(n, index);
      CHECK(IsSymmetric(problem));
      CHECK(std::holds_alternative<LdltFactors>(DecideDefinite(problem.A)));
      const Rational e = -problem.b[0];
      ExactMatrix M(n, n);
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          M(i, j) = (problem.A(2 * i, 2 * j) + problem.contacts[j].mu * problem.A(2 * i, 2 * j + 1)) / e;
      for (const Rational& cost : M.reshaped()) CHECK((cost >= 1 && cost <= 2));
      const ExactAnswer answer = SolveExactly(problem, {.method = "complete"});
      REQUIRE(answer.Solved());
      ExactVector x(n);
      for (int i = 0; i < n; ++i) {
        x[i] = answer.f[2 * i];
        CHECK(answer.f[2 * i + 1] == problem.contacts[i].mu * x[i]);
        CHECK(answer.a[2 * i + 1] < 0);
      }
      const ExactVector slack = M * x - ExactVector::Constant(n, Rational(1));
      for (int i = 0; i < n; ++i) {
        CHECK((x[i] >= 0 && slack[i] >= 0));
        CHECK(x[i] * slack[i] == 0);
      }
    }
  }
}

TEST_CASE("game: all kinds are drawn, and without friction problems are definite as well") {
  std::set<bool> symmetric;
  for (std::uint64_t index = 0; index < 20; ++index) {
    const ExactProblem problem = DrawGame(3, index, {{0, 1}});
    CHECK(std::holds_alternative<LdltFactors>(DecideDefinite(problem.A)));
    const ExactMatrix Q = problem.A(std::vector{0, 2, 4}, std::vector{1, 3, 5});
    symmetric.insert(Q == Q.transpose());
  }
  CHECK(symmetric.size() == 2);
}

}  // namespace stiction
