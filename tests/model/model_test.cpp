// SPDX-License-Identifier: Apache-2.0
// Problems drawn anew, as many as STICTION_MODEL says (by default what takes twenty seconds), from
// STICTION_MODEL_SEED on, through every method and arithmetic; what is false is shrunk and printed. And that it
// finds what once was false.

#include "tests/model/model.h"

#include <catch2/catch.hpp>
#include <cstdlib>

#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

std::int64_t Asked(const char* name, std::int64_t usual) {
  const char* text = std::getenv(name);
  return text == nullptr ? usual : std::atoll(text);
}

TEST_CASE("model: every method in every arithmetic says nothing false of problems drawn at random") {
  const std::int64_t problems = Asked("STICTION_MODEL", Few(1200)), seed = Asked("STICTION_MODEL_SEED", 1);
  int faults = 0;
  for (std::int64_t index = 0; index < problems && faults < 5; ++index) {
    Choices choices(ProblemSeed(static_cast<std::uint64_t>(seed), 0, static_cast<std::uint64_t>(index)));
    const ExactProblem problem = DrawProblem(choices, index % 4 == 3 ? 3 : 2);
    std::string fault = FaultInForms(problem);
    if (fault.empty()) fault = FaultIn(problem);
    if (fault.empty()) continue;
    ++faults;
    FAIL_CHECK("problem " << index << " of seed " << seed << ": " << Shrunk(problem, fault));
  }
}

// The checks themselves: answers altered as programs once were wrong.
TEST_CASE("model: an answer that proves a falsehood, or is exact of another problem, is seen") {
  const ExactProblem problem =
      MakeProblem({-1, -1}, {{Rational(25, 81), Rational(10, 27)}, {Rational(10, 27), Rational(4, 9)}},
                  {Rational(-10, 9), Rational(-4, 3)});
  const Truth truth = TruthOf(problem);
  REQUIRE(truth.is_known);
  REQUIRE(truth.solvable);
  const Request request = RequestFor("enumerate", Arithmetic::kDouble, FrictionLaw::kCoulomb);
  ExactAnswer none;
  none.outcome = Outcome::kNoSolution;
  CHECK(KindOf(FaultOfAnswer(problem, truth, request, {.answer = none})) == "falsehood");
  InexactAnswer rounded;
  rounded.outcome = Outcome::kNoSolution;
  CHECK(KindOf(FaultOfAnswer(problem, truth, request, {.answer = rounded})) == "rounded");
  ExactAnswer other;
  other.outcome = Outcome::kSolved;
  other.f = Vector({1, 1});
  other.a = Vector({0, 0});
  CHECK(KindOf(FaultOfAnswer(problem, truth, request, {.answer = other})) == "inexact");
  InexactAnswer sinks;
  sinks.outcome = Outcome::kSolved;
  sinks.arithmetic = Arithmetic::kDouble;
  sinks.f = Eigen::Vector2d(0, 0);
  CHECK(KindOf(FaultOfAnswer(problem, truth, request, {.answer = sinks})) == "gate");
  sinks.outcome = Outcome::kUndecided;
  sinks.arithmetic = Arithmetic::kQuad;
  CHECK(KindOf(FaultOfAnswer(problem, truth, request, {.answer = sinks})) == "name");
}

}  // namespace
}  // namespace stiction
