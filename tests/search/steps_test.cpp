// SPDX-License-Identifier: Apache-2.0
// Tests of search/generators/steps.cpp.

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "corpus/exact_problem.h"
#include "search/generators/generators.h"
#include "tests/methods.h"
#include "tests/search/recorded.h"

namespace stiction {
namespace {

[[maybe_unused]] const bool kRecordedSteps = AddRecorded({
    {"steps", 0x446ad6d65d75225d, 0xadf3ca5a8c53f35a, 0x2de13698491c3f5f},
});

// After friction: the world, how far apart masses are, step size, sweeps, Baumgarte's term, number of steps;
// then what the world asks for.
ExactProblem StepOf(int contacts, const std::vector<std::int64_t>& after_friction) {
  std::vector<std::int64_t> sequence = {0, 0};
  sequence.insert(sequence.end(), after_friction.begin(), after_friction.end());
  ExactProblem problem;
  Choices choices = Choices::Replay(sequence);
  Generate(GeneratorId::kSteps, contacts, kDefaultPalette, choices, problem);
  return problem;
}

constexpr int kStack = 0;
constexpr float kLongStep = 1.0F / 30;

TEST_CASE("steps: the first step of a box that stands on a point is that of the closed form, in floats") {
  // 1/2 m wide, 1/4 m high, of 1 kg.
  const ExactProblem problem = StepOf(1, {kStack, 0, 0, 0, 0, 1});
  const float gyration = (0.25F * 0.25F + 0.125F * 0.125F) / 3;
  const Rational inverse_inertia(double{1 / gyration});
  CHECK(problem.A(0, 0) == 1);
  CHECK(problem.A(0, 1) == 0);
  CHECK(problem.A(1, 1) == 1 + inverse_inertia / 64);
  CHECK(problem.b[0] == Rational(double{kLongStep * -10.0F}));
  CHECK(problem.b[1] == 0);
}

TEST_CASE("steps: what sweeps have brought to rest falls by what gravity makes in one step") {
  for (int steps = 1; steps <= 12; ++steps) {
    for (const int contacts : {1, 2, 4}) {
      INFO(steps << " steps, " << contacts << " contacts");
      const ExactProblem problem = StepOf(contacts, {kStack, 0, 0, 4, 0, steps});
      for (int i = 0; i < contacts; ++i) {
        const bool on_floor = i < 2;
        CHECK(ToDouble(problem.b[2 * i]) == Approx(on_floor ? -10 * kLongStep : 0).margin(2e-2));
        CHECK(std::abs(ToDouble(problem.b[2 * i + 1])) < 2e-2);
      }
    }
  }
}

TEST_CASE("steps: masses are up to 10^4 apart, and no velocity runs away") {
  double least = 1, most = 1, fastest = 0;
  for (std::uint64_t index = 0; index < 400; ++index) {
    CAPTURE(index);
    ExactProblem problem;
    Choices choices(index);
    Generate(GeneratorId::kSteps, 4, kDefaultPalette, choices, problem);
    for (int i = 0; i < problem.rows(); ++i) {
      REQUIRE(problem.A(i, i) > 0);
      least = std::min(least, ToDouble(problem.A(i, i)));
      most = std::max(most, ToDouble(problem.A(i, i)));
      fastest = std::max(fastest, std::abs(ToDouble(problem.b[i])));
    }
  }
  CHECK(least < 1e-3);
  CHECK(most > 1);
  CHECK(fastest < 1000);
  CHECK(fastest > 1);
}

TEST_CASE("steps: the same world after more steps has other problems, and few sweeps leave velocities") {
  const auto unfinished = [](int sweeps) {
    double speed = 0;
    for (int steps = 2; steps <= 12; ++steps) {
      const ExactProblem problem =
          StepOf(8, {kStack, 8, 0, sweeps, 0, steps, 20, 30, 5, 0, 0, 40, 20, -5, 8, 0, 32, 20});
      for (int i = 2; i < 8; ++i) speed = std::max(speed, std::abs(ToDouble(problem.b[2 * i])));
    }
    return speed;
  };
  CHECK(unfinished(0) > unfinished(4));
  CHECK(StepOf(2, {kStack, 0, 0, 0, 0, 2}).b != StepOf(2, {kStack, 0, 0, 0, 0, 3}).b);
}

TEST_CASE("steps: the published algorithm loops on some of them, which complete driving solves") {
  for (const std::uint64_t index : {430, 846}) {
    CAPTURE(index);
    ExactProblem problem;
    Choices choices(ProblemSeed(1, 8, index));
    Generate(GeneratorId::kSteps, 8, kDefaultPalette, choices, problem);
    CHECK(SolveExactly(problem, {.method = "baraff"}).outcome == Outcome::kCycle);
    CHECK(SolveExactly(problem, {.method = "complete"}).outcome == Outcome::kSolved);
  }
}

}  // namespace
}  // namespace stiction
