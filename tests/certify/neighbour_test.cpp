// SPDX-License-Identifier: Apache-2.0
// Neighbours of a problem: forces that are called solved solve one exactly; what is altered, in the forces or
// in the neighbour, is refused. A small sample of bench --suite gate besides.

#include "certify/exact/neighbour.h"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "bench/dials.h"
#include "certify/exact/verify_solution.h"
#include "certify/request/solve_in.h"
#include "corpus/rounded.h"
#include "tests/judge.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

const Gate kGate = GateOf<double>();

bool Passes(const ExactProblem& problem, const std::vector<Rational>& f,
            FrictionLaw law = FrictionLaw::kCoulomb, const Gate& gate = kGate) {
  return !FindMiss(problem, Vector(f), law, gate);
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

TEST_CASE("neighbour: in the plane each condition that is missed is refused") {
  for (const FrictionLaw law : {FrictionLaw::kCoulomb, FrictionLaw::kBaraff}) {
    const auto passes = [law](const std::vector<Rational>& f) { return Passes(Slipping(), f, law); };
    CHECK(passes({2, 1}));
    CHECK_FALSE(passes({-1, 0}));     // pulls
    CHECK_FALSE(passes({0, 0}));      // sinks
    CHECK_FALSE(passes({3, 0}));      // presses and separates
    CHECK_FALSE(passes({2, 2}));      // beyond the limit
    CHECK_FALSE(passes({2, kHalf}));  // slips below its limit
    CHECK_FALSE(passes({2, -1}));     // drives the slip
  }
  const ExactProblem separates = Alone(ContactKind::kStatic, 2, {2, 3}, {4, -9});
  CHECK(Passes(separates, {0, 0}));
  CHECK_FALSE(Passes(separates, {0, 3}));
}

TEST_CASE("neighbour: in space each condition that is missed is refused, by either law") {
  for (const FrictionLaw law : {FrictionLaw::kCoulomb, FrictionLaw::kBaraff}) {
    const auto passes = [law](const std::vector<Rational>& f) { return Passes(SlippingInSpace(), f, law); };
    CHECK(passes({2, k3of5, k4of5}));
    CHECK_FALSE(passes({-1, 0, 0}));
    CHECK_FALSE(passes({0, 0, 0}));
    CHECK_FALSE(passes({3, 0, 0}));
    CHECK_FALSE(passes({2, k4of5, k4of5}));
    CHECK_FALSE(passes({2, kHalf, kHalf}));
    CHECK_FALSE(passes({2, -k3of5, -k4of5}));
    CHECK(passes({2, 1, 0}) == (law == FrictionLaw::kBaraff));  // askew
  }
}

TEST_CASE("neighbour: sliding, bilateral and frictionless contacts have conditions of their own") {
  ExactProblem slides = Alone(ContactKind::kSliding, kHalf, {2, 3}, {-4, -9});
  slides.contacts[0].slip[0] = 1;
  CHECK(Passes(slides, {2, -1}));
  for (const auto& f : std::vector<std::vector<Rational>>{{2, 1}, {2, 0}, {0, 0}, {3, Rational(-3, 2)}})
    CHECK_FALSE(Passes(slides, f));
  ExactProblem in_space = Alone(ContactKind::kSliding, kHalf, {2, 3, 3}, {-4, 0, 0});
  in_space.contacts[0].slip = {k3of5, k4of5};
  CHECK(Passes(in_space, {2, -k3of5, -k4of5}));
  CHECK_FALSE(Passes(in_space, {2, -k4of5, -k3of5}));
  const ExactProblem hangs = Alone(ContactKind::kBilateral, 0, {2}, {6});
  CHECK(Passes(hangs, {-3}));
  CHECK_FALSE(Passes(hangs, {0}));
  const ExactProblem smooth = Alone(ContactKind::kFrictionless, 0, {2}, {-4});
  CHECK(Passes(smooth, {2}));
  CHECK_FALSE(Passes(smooth, {-1}));
  CHECK_FALSE(Passes(smooth, {1}));
}

// |b| = 4: accelerations are in units of 4, but for what theta adds.
TEST_CASE("neighbour: the bound is where it says") {
  const ExactProblem rests = Alone(ContactKind::kStatic, kHalf, {2, 3}, {-4, 0});
  const Rational eps(kGate.eps);
  CHECK(Passes(rests, {2 - Rational(19, 10) * eps, 0}));
  CHECK_FALSE(Passes(rests, {2 - Rational(21, 10) * eps, 0}));
  CHECK(Passes(rests, {2 + Rational(19, 10) * eps, 0}));
  CHECK_FALSE(Passes(rests, {2 + Rational(21, 10) * eps, 0}));
}

TEST_CASE("neighbour: one that differs by more than it may, or is not solved, is refused") {
  const ExactProblem problem = Slipping();
  const ExactVector f = Vector({2, 1});
  const Neighbour near = MakeNeighbour(problem, f, FrictionLaw::kCoulomb, kGate);
  const auto refused = [&](auto change) {
    Neighbour altered = near;
    change(altered);
    return CheckNeighbour(problem, f, FrictionLaw::kCoulomb, kGate, altered).has_value();
  };
  CHECK_FALSE(refused([](Neighbour&) {}));
  const Rational most(kGate.eps), little(kGate.tau), more(Rational(3, 2));
  CHECK(refused([&](Neighbour& n) { n.problem.A(0, 0) *= 1 + more * little; }));
  CHECK(refused([&](Neighbour& n) { n.problem.A(0, 1) = little; }));  // where A is zero
  CHECK(refused([&](Neighbour& n) { n.problem.b[0] *= 1 + more * most; }));
  CHECK(refused([&](Neighbour& n) { n.problem.b[1] *= 1 + more * most; }));
  CHECK(refused([&](Neighbour& n) { n.problem.contacts[0].mu *= 1 + more * most; }));
  CHECK(refused([&](Neighbour& n) { n.problem.b[0] *= 1 + most / 2; }));  // near, and not solved
  CHECK(refused([&](Neighbour& n) { n.f[0] *= 1 + most; }));
  CHECK(refused([&](Neighbour& n) { n.f.setZero(); }));
}

// A body between two walls that both press: normal forces (jam, jam) do no work. 1 N of friction each holds it.
TEST_CASE("neighbour: a jam does not soften it, however large") {
  const ExactProblem jam =
      MakeProblem({1, 1}, {{2, 0, -2, 0}, {0, 2, 0, 2}, {-2, 0, 2, 0}, {0, 2, 0, 2}}, {0, -4, 0, -4});
  const Rational less = 1 - Rational(1, 1000);
  for (const char* press : {"2", "1e3", "1e6", "1e12", "1e24"}) {
    CAPTURE(press);
    const Rational f = Number(press);
    CHECK(Passes(jam, {f, 1, f, 1}, FrictionLaw::kCoulomb, Gate{}));
    CHECK_FALSE(Passes(jam, {f, less, f, less}));
    CHECK_FALSE(Passes(jam, {f, 0, f, 0}));
  }
}

TEST_CASE("neighbour: of problems of the dials of the gate, nothing that is called solved is refused") {
  int solved = 0;
  for (const Source& source : DialSources(Dials::kGate, {})) {
    if (source.is_large) continue;
    const ExactProblem problem = source.make(/*seed=*/7, /*index=*/0);
    for (const std::string method : {"auto", "fast", "complete", "lemke", "baraff"}) {
      for (const Arithmetic arithmetic : {Arithmetic::kFloat, Arithmetic::kDouble}) {
        CAPTURE(source.family, source.setting, method, Name(arithmetic));
        Request request = {.method = method, .arithmetic = arithmetic, .confirm = false};
        request.limits.drives = request.limits.pivots = 1000;
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
