// SPDX-License-Identifier: Apache-2.0
// The judge over rationals: it names the condition that forces miss, lets exact solutions pass with no bound at
// all, and depends neither on the units of contacts, nor on mu, nor on forces that do no work. A small sample
// of bench --suite gate besides.

#include "certify/exact/judge.h"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "bench/dials.h"
#include "certify/request/solve_in.h"
#include "corpus/rounded.h"
#include "tests/judge.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

const Rational kBound(1, 100'000'000);

// What the judge says of the forces, without its "contact 1: "; empty if nothing.
std::string Said(const ExactProblem& problem, const std::vector<Rational>& f,
                 FrictionLaw law = FrictionLaw::kCoulomb, const Rational& bound = kBound) {
  const std::string miss = FindMiss(problem, Vector(f), law, bound).value_or("");
  const std::string first = "contact 1: ";
  return miss.rfind(first, 0) == 0 ? miss.substr(first.size()) : miss;
}

ExactProblem Alone(ContactKind kind, const Rational& mu, const std::vector<Rational>& diagonal,
                   const std::vector<Rational>& b) {
  const int rows = static_cast<int>(b.size());
  ExactProblem problem;
  problem.dimension = rows == 3 ? 3 : 2;
  problem.contacts = {{kind, mu, {}}};
  problem.A = Vector(diagonal).asDiagonal();
  problem.b = Vector(b);
  return problem;
}

// It presses with 2 N, and friction holds less than it must.
ExactProblem Slipping() { return Alone(ContactKind::kStatic, Rational(1, 2), {2, 3}, {-4, -9}); }
ExactProblem SlippingInSpace() { return Alone(ContactKind::kStatic, Rational(1, 2), {2, 3, 3}, {-4, -9, -12}); }
const Rational k3of5(3, 5), k4of5(4, 5), kHalf(1, 2);

TEST_CASE("judge: in the plane it names the condition that is missed") {
  for (const FrictionLaw law : {FrictionLaw::kCoulomb, FrictionLaw::kBaraff}) {
    const auto said = [law](const std::vector<Rational>& f) { return Said(Slipping(), f, law); };
    CHECK(said({2, 1}) == "");
    CHECK(said({-1, 0}) == "it pulls");
    CHECK(said({0, 0}) == "it accelerates inward");
    CHECK(said({3, 0}) == "it presses, and separates");
    CHECK(said({2, 2}) == "friction is beyond its limit");
    CHECK(said({2, kHalf}) == "it slips, and friction is below its limit");
    CHECK(said({2, 0}) == "it slips, and friction is below its limit");
    CHECK(said({2, -1}) == "friction does not oppose the slip");
  }
  const ExactProblem holds = Alone(ContactKind::kStatic, 2, {2, 3}, {-4, -9});
  CHECK(Said(holds, {2, 3}) == "");
  CHECK(Said(holds, {2, 4}) == "friction does not oppose the slip");
  CHECK(Said(holds, {2, 0}) == "it slips, and friction is below its limit");
  const ExactProblem separates = Alone(ContactKind::kStatic, 2, {2, 3}, {4, -9});
  CHECK(Said(separates, {0, 0}) == "");
  CHECK(Said(separates, {0, 3}) == "friction is beyond its limit");
}

TEST_CASE("judge: in space it names the condition that is missed, by either law") {
  const auto said = [](const std::vector<Rational>& f, FrictionLaw law) {
    return Said(SlippingInSpace(), f, law);
  };
  for (const FrictionLaw law : {FrictionLaw::kCoulomb, FrictionLaw::kBaraff}) {
    CHECK(said({2, k3of5, k4of5}, law) == "");
    CHECK(said({-1, 0, 0}, law) == "it pulls");
    CHECK(said({0, 0, 0}, law) == "it accelerates inward");
    CHECK(said({3, 0, 0}, law) == "it presses, and separates");
    CHECK(said({2, k4of5, k4of5}, law) == "friction is beyond its limit");
    CHECK(said({2, kHalf, kHalf}, law) == "it slips, and friction is below its limit");
    CHECK(said({2, 0, 0}, law) == "it slips, and friction is below its limit");
  }
  const std::vector<Rational> aside = {2, 1, 0}, along = {2, -k3of5, -k4of5};
  CHECK(said(aside, FrictionLaw::kCoulomb) == "friction does not oppose the slip");
  CHECK(said(aside, FrictionLaw::kBaraff) == "");
  CHECK(said(along, FrictionLaw::kCoulomb) == "friction does not oppose the slip");
  CHECK(said(along, FrictionLaw::kBaraff) == "friction drives the slip");
}

TEST_CASE("judge: sliding, bilateral and frictionless contacts have conditions of their own") {
  ExactProblem slides = Alone(ContactKind::kSliding, kHalf, {2, 3}, {-4, -9});
  slides.contacts[0].slip[0] = 1;
  CHECK(Said(slides, {2, -1}) == "");
  CHECK(Said(slides, {2, 1}) == "friction is not that of its slip");
  CHECK(Said(slides, {2, 0}) == "friction is not that of its slip");
  CHECK(Said(slides, {0, 0}) == "it accelerates inward");
  CHECK(Said(slides, {3, Rational(-3, 2)}) == "it presses, and separates");
  ExactProblem in_space = Alone(ContactKind::kSliding, kHalf, {2, 3, 3}, {-4, 0, 0});
  in_space.contacts[0].slip = {k3of5, k4of5};
  CHECK(Said(in_space, {2, -k3of5, -k4of5}) == "");
  CHECK(Said(in_space, {2, -k4of5, -k3of5}) == "friction is not that of its slip");
  const ExactProblem hangs = Alone(ContactKind::kBilateral, 0, {2}, {6});
  CHECK(Said(hangs, {-3}) == "");
  CHECK(Said(hangs, {0}) == "it moves");
  const ExactProblem smooth = Alone(ContactKind::kFrictionless, 0, {2}, {-4});
  CHECK(Said(smooth, {2}) == "");
  CHECK(Said(smooth, {-1}) == "it pulls");
  CHECK(Said(smooth, {1}) == "it accelerates inward");
}

TEST_CASE("judge: it names the contact") {
  const ExactProblem both = Decoupled(Slipping(), Slipping());
  CHECK(FindMiss(both, Vector({2, 1, 2, 1}), FrictionLaw::kCoulomb, kBound).value_or("") == "");
  CHECK(FindMiss(both, Vector({2, 1, 0, 0}), FrictionLaw::kCoulomb, kBound) ==
        "contact 2: it accelerates inward");
}

// |b| = 4 and root of A f'Af = 4: accelerations are in units of 8.
TEST_CASE("judge: the bound is where it says") {
  const ExactProblem rests = Alone(ContactKind::kStatic, kHalf, {2, 3}, {-4, 0});
  const auto said = [&rests](const Rational& f) { return Said(rests, {f, 0}); };
  CHECK(said(2 - Rational(3) * kBound) == "");
  CHECK(said(2 - Rational(5) * kBound) == "it accelerates inward");
  CHECK(said(2 + Rational(3) * kBound) == "");
  CHECK(said(2 + Rational(5) * kBound) == "it presses, and separates");
}

TEST_CASE("judge: exact solutions pass without a bound, and changed ones do not pass") {
  int solved = 0, refused = 0;
  for (const GeneratorId id : {GeneratorId::kPsd, GeneratorId::kBodies, GeneratorId::kBilateral}) {
    for (int index = 0; index < Few(60); ++index) {
      CAPTURE(Row(id).name, index);
      const ExactProblem problem = Random<Rational>(id, 1 + index % 3, index);
      const ExactAnswer answer = SolveExactly(problem, {.method = "complete"});
      if (answer.outcome != Outcome::kSolved) continue;
      ++solved;
      REQUIRE(FindMiss(problem, answer.f, answer.law, 0).value_or("") == "");
      ExactVector f = answer.f;
      f[0] += Rational(1, 1000);
      refused += FindMiss(problem, f, answer.law, kBound).has_value();
    }
  }
  CHECK(solved > Few(150));
  CHECK(refused > solved / 2);  // some have many solutions
}

// D A D, D b, D^-1 f.
TEST_CASE("judge: it says the same in other units of every contact") {
  int missed = 0, passed = 0;
  for (const GeneratorId id : {GeneratorId::kPsd, GeneratorId::kBodies, GeneratorId::kSpace}) {
    for (int index = 0; index < Few(40); ++index) {
      Choices choices(index);
      const ExactProblem problem = Unrounded(Rounded<double>(Random<Rational>(id, 1 + index % 3, index)));
      const Answer<double> answer = Solve(Rounded<double>(problem), "fast");
      if (!answer.f.allFinite()) continue;
      std::vector<Rational> D;
      for (std::size_t i = 0; i < problem.contacts.size(); ++i)
        D.resize(D.size() + problem.dimension, Rational(std::ldexp(1.0, choices.Integer(-60, 60))));
      ExactProblem other = InUnits(problem, D);
      for (std::size_t i = 0; i < problem.contacts.size(); ++i) other.contacts[i].mu = problem.contacts[i].mu;
      for (int r = 0; r < problem.rows(); ++r)
        for (int c = 0; c < problem.rows(); ++c) other.A(r, c) = problem.A(r, c) * D[r] * D[c];
      for (int k = 0; k < 6; ++k) {
        CAPTURE(Row(id).name, index, k);
        ExactVector f = answer.f.unaryExpr([](double x) { return Rational(x); }), in_units = f;
        for (int r = 0; r < f.size(); ++r) {
          f[r] += Rational(std::ldexp(static_cast<double>(choices.Integer(-k, k)), -6 * k));
          in_units[r] = f[r] / D[r];
        }
        const auto miss = FindMiss(problem, f, FrictionLaw::kCoulomb, kBound);
        CHECK(FindMiss(other, in_units, FrictionLaw::kCoulomb, kBound) == miss);
        (miss ? missed : passed) += 1;
      }
    }
  }
  CHECK(missed > Few(100));
  CHECK(passed > Few(100));
}

TEST_CASE("judge: a light contact does not blind it to a heavy one") {
  const ExactProblem rests = MakeProblem({1}, {{2, 0}, {0, 3}}, {-4, 0});
  for (int exponent = 0; exponent <= 60; exponent += 6) {
    CAPTURE(exponent);
    const Rational inverse_mass = Rational(std::ldexp(1.0, -exponent));
    ExactProblem heavy = rests;
    heavy.A *= inverse_mass;
    ExactProblem both = Decoupled(rests, heavy);
    CHECK(Said(both, {2, 0, 2 / inverse_mass, 0}) == "");
    CHECK(Said(both, {2, 0, 0, 0}) == "contact 2: it accelerates inward");
    both.A(0, 2) = both.A(2, 0) = inverse_mass / 4;  // coupled
    CHECK(Said(both, {2, 0, 0, 0}) == "contact 2: it accelerates inward");
  }
}

TEST_CASE("judge: whatever mu is, free fall is refused and rest is not") {
  for (const char* mu : {"1e-16", "1e-8", "1", "1e8", "1e16", "1e100"}) {
    CAPTURE(mu);
    const ExactProblem plane = Alone(ContactKind::kStatic, Number(mu), {2, 3}, {-4, 0}),
                       space = Alone(ContactKind::kStatic, Number(mu), {2, 3, 3}, {-4, 0, 0});
    for (const FrictionLaw law : {FrictionLaw::kCoulomb, FrictionLaw::kBaraff}) {
      CHECK(Said(plane, {2, 0}, law, 0) == "");
      CHECK(Said(plane, {0, 0}, law) == "it accelerates inward");
      CHECK(Said(space, {2, 0, 0}, law, 0) == "");
      CHECK(Said(space, {0, 0, 0}, law) == "it accelerates inward");
    }
  }
}

// A body between two walls that both press: normal forces (jam, jam) do no work. 1 N of friction each holds it.
TEST_CASE("judge: a jam does not soften it, however large") {
  const ExactProblem jam =
      MakeProblem({1, 1}, {{2, 0, -2, 0}, {0, 2, 0, 2}, {-2, 0, 2, 0}, {0, 2, 0, 2}}, {0, -4, 0, -4});
  const Rational less = 1 - Rational(1, 1000);
  for (const char* press : {"2", "1e3", "1e6", "1e12", "1e24"}) {
    CAPTURE(press);
    const Rational f = Number(press);
    CHECK(Said(jam, {f, 1, f, 1}, FrictionLaw::kCoulomb, 0) == "");
    CHECK(Said(jam, {f, less, f, less}) == "it slips, and friction is below its limit");
    CHECK(Said(jam, {f, 0, f, 0}) == "it slips, and friction is below its limit");
    CHECK(Said(jam, {f, 1, f + 1, 1}) == "it accelerates inward");
  }
}

// Nearly a jam: fN = 1/3 does so little work that b is nearly nothing.
TEST_CASE("judge: nothing is no solution of what nearly jams") {
  for (int k = 0; k <= 30; k += 3) {
    CAPTURE(k);
    const Rational e = Number("1e-" + std::to_string(k));
    const ExactProblem nearly = MakeProblem({1}, {{e, e / 2}, {e / 2, 1}}, {-e / 3, -e / 6});
    CHECK(Said(nearly, {Rational(1, 3), 0}, FrictionLaw::kCoulomb, 0) == "");
    CHECK(Said(nearly, {0, 0}) == "it accelerates inward");
  }
}

TEST_CASE("judge: of problems of the dials of the gate, nothing that is called solved is refused") {
  int solved = 0;
  for (const Source& source : DialSources(Dials::kGate, {})) {
    if (source.is_large) continue;
    const ExactProblem problem = source.make(/*seed=*/7, /*index=*/0);
    for (const std::string method : {"auto", "fast", "complete", "lemke", "baraff"}) {
      for (const Arithmetic arithmetic : {Arithmetic::kFloat, Arithmetic::kDouble}) {
        CAPTURE(source.family, source.setting, method, Name(arithmetic));
        SolveRequest request = {.method = method, .arithmetic = arithmetic, .confirm = false};
        request.options.limits.drives = request.options.limits.pivots = 1000;
        try {
          const Solution solution = SolveIn(problem, request);
          CHECK(FaultOf(problem, request, solution) == "");
          solved += solution.outcome() == Outcome::kSolved;
        } catch (const RangeError&) {  // a number that the arithmetic does not hold
        }
      }
    }
  }
  CHECK(solved > 500);
}

}  // namespace
}  // namespace stiction
