// SPDX-License-Identifier: Apache-2.0
// Solutions in space: certificates of (21), (22) and of Coulomb's law up to a bound.

#include "certify/exact/space.h"

#include <catch2/catch.hpp>

#include "certify/claims/certificate.h"
#include "certify/claims/existence.h"
#include "certify/exact/exact.h"
#include "certify/exact/lemke_space.h"
#include "certify/exact/solve.h"
#include "certify/exact/verify_solution.h"
#include "corpus/json.h"
#include "solver/complete/polygon_errors.h"
#include "solver/lemke/lemke.h"
#include "solver/problem/errors.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

ExactProblem OneContact(Rational mu, std::vector<Rational> b) {
  ExactProblem problem;
  problem.dimension = 3;
  problem.contacts = {{ContactKind::kStatic, mu, {}}};
  problem.A = Matrix({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  problem.b = Vector(b);
  return problem;
}

ExactProblem RandomInSpace(int n, int index) {
  static const std::vector<Rational> palette = {Rational(1, 5), Rational(1, 2), 1, 2, 5};
  Choices choices(index);
  ExactProblem problem;
  problem.dimension = 3;
  for (int i = 0; i < n; ++i)
    problem.contacts.push_back({ContactKind::kStatic, palette[choices.Integer(0, 4)], {}});
  const bool definite = index % 2 == 0;
  const int columns = definite ? 3 * n : 1 + index % 6;
  ExactMatrix J(3 * n, columns);
  for (Rational& x : J.reshaped()) x = choices.Integer(-5, 5);
  problem.A = J * J.transpose();
  ExactVector y(columns);
  for (Rational& x : y) x = choices.Integer(-5, 5);
  problem.b = J * y;
  if (definite) {
    for (int i = 0; i < 3 * n; ++i) problem.A(i, i) += 1;
  }
  return problem;
}

TEST_CASE("verify in space: (21), (22) leave the direction of slip free, Coulomb does not") {
  const ExactProblem problem = OneContact(Rational(1, 2), {-1, 3, 4});
  const auto weak = [&](std::vector<Rational> f) { return FindViolation(problem, Vector(f)).value_or(""); };
  const auto coulomb = [&](std::vector<Rational> f, Rational c) {
    return FindViolation(problem, Vector(f), FrictionLaw::kCoulomb, c).value_or("");
  };
  const std::vector<Rational> exact = {1, Rational(-3, 10), Rational(-2, 5)}, turned = {1, Rational(-1, 2), 0};
  CHECK(weak(exact) == "");
  CHECK(coulomb(exact, 1) == "");
  CHECK(weak(turned) == "");
  CHECK(coulomb(turned, 1).find("(fF.aF)^2 >= c^2 mu^2 fN^2 aF.aF") != std::string::npos);
  // aF = (5/2, 4): the cosine is 5 / sqrt(89) = 0.529999...
  CHECK(coulomb(turned, Rational(529, 1000)) == "");
  CHECK(coulomb(turned, Rational(531, 1000)) != "");
  CHECK(weak({1, Rational(-1, 4), 0}).find("aF = 0 or abs(fF) = mu fN") != std::string::npos);
  CHECK(weak({1, Rational(1, 2), 0}).find("fF.aF <= 0") != std::string::npos);
  CHECK(weak({1, -1, 0}).find("fF.fF <= mu^2 fN^2") != std::string::npos);
  CHECK(coulomb({1, -1, 0}, Rational(1, 2)).find("fF.fF <= mu^2 fN^2") != std::string::npos);
  CHECK(weak({2, 0, 0}).find("fN aN = 0") != std::string::npos);
  CHECK(weak({0, 0, 0}).find("aN >= 0") != std::string::npos);
  CHECK(weak({-1, 0, 0}).find("fN >= 0") != std::string::npos);
}

TEST_CASE("verify in space: bilateral and sliding contacts") {
  ExactProblem problem = OneContact(Rational(1, 2), {-1, 3, 4});
  problem.contacts[0].kind = ContactKind::kSliding;
  problem.contacts[0].slip = {Rational(3, 5), Rational(4, 5)};
  CHECK(!FindViolation(problem, Vector({1, Rational(-3, 10), Rational(-2, 5)})));
  CHECK(FindViolation(problem, Vector({1, Rational(3, 10), Rational(2, 5)})));
  ExactProblem held;
  held.dimension = 3;
  held.contacts = {{ContactKind::kBilateral, 0, {}}};
  held.A = Matrix({{1}});
  held.b = Vector({1});
  CHECK(!FindViolation(held, Vector({-1})));
  CHECK(FindViolation(held, Vector({0})));
}

TEST_CASE("coulomb bound: rounded down, to eight digits of its distance from one") {
  const ExactProblem problem = OneContact(Rational(1, 2), {-1, 3, 4});
  CHECK(CoulombBound(problem, Vector({1, Rational(-3, 10), Rational(-2, 5)})) == Rational(1));
  const auto bound = CoulombBound(problem, Vector({1, Rational(-1, 2), 0}));
  REQUIRE(bound);
  CHECK(*bound * *bound * 89 <= 25);  // cosine 5 / sqrt(89)
  CHECK((*bound + Rational(1, 128)) * (*bound + Rational(1, 128)) * 89 > 25);
  CHECK(!CoulombBound(problem, Vector({0, 0, 0})));
}

TEST_CASE("space: the polygon alone proves its inner radius") {
  for (int index = 0; index < 60; ++index) {
    CAPTURE(index);
    const ExactProblem problem = RandomInSpace(1 + index % 2, 1000 + index);
    for (const int sides : {4, 8, 16}) {
      const FrictionPolygon<Rational> polygon(sides);
      const ExactAnswer run =
          RunSpace(problem, RationalPolygons(problem.contacts.size(), polygon), Limits{}).answer;
      REQUIRE(run.outcome == Outcome::kSolved);
      const auto bound = CoulombBound(problem, run.f);
      REQUIRE(bound);
      // Rounded down by at most 1/128 of the distance from one.
      const Rational least = (1 + *bound * 127) / 128 + Rational(1, 64);
      CHECK(least * least >= InnerRadiusSquared(polygon));
    }
  }
}

// A run that is traced is one over rationals throughout.
TEST_CASE("space: complete driving over balls ends as over rationals, by as many pieces") {
  int edges = 0, moved = 0;
  for (int index = 0; index < 60; ++index) {
    CAPTURE(index);
    const ExactProblem problem = RandomInSpace(1 + index % 4, 2000 + index);
    const RationalPolygons polygons(problem.contacts.size(), FrictionPolygon<Rational>(8));
    Trace<Rational> trace;
    const OnPolygons exact = RunSpace(problem, polygons, Limits{}, &trace);
    const OnPolygons run = RunSpace(problem, polygons, Limits{});
    CHECK(run.answer.outcome == exact.answer.outcome);
    CHECK(run.answer.counters == exact.answer.counters);
    CHECK(run.answer.f == exact.answer.f);
    CHECK(run.answer.a == exact.answer.a);
    CHECK(run.word == exact.word);
    CHECK(run.polygons.size() == polygons.size());
    for (const LawCell& cell : run.word) edges += cell.law == Law::kEdge;
    moved += !run.answer.f.isZero(0);
  }
  CHECK(edges > 5);
  CHECK(moved > 30);
}

TEST_CASE("lemke in space: the law on polygons, exactly") {
  for (int index = 0; index < 90; ++index) {
    CAPTURE(index);
    const ExactProblem problem = RandomInSpace(1 + index % 3, index);
    for (const int sides : {4, 8}) {
      const RationalPolygons polygons(problem.contacts.size(), FrictionPolygon<Rational>(sides));
      LemkeAlgorithm<Rational> lemke;
      REQUIRE(lemke.Run(problem, polygons).outcome == Outcome::kSolved);
      CHECK(PolygonErrorOf(problem, polygons, lemke.f(), lemke.a()) == 0);
      CHECK(lemke.a() == Accelerations(problem, lemke.f()));
      if (problem.contacts.size() == 1) {
        const ExactAnswer driven = RunSpace(problem, polygons, Limits{}).answer;
        CHECK(PolygonErrorOf(problem, polygons, driven.f, driven.a) == 0);
      }
    }
  }
}

TEST_CASE("lemke in space: what solves the law on polygons, and what does not") {
  const ExactProblem problem = OneContact(Rational(1, 2), {-1, 3, 4});
  const RationalPolygons polygons(1, FrictionPolygon<Rational>(4));
  const auto residual = [&](std::vector<Rational> f) {
    return PolygonErrorOf(problem, polygons, Vector(f), Accelerations(problem, Vector(f)));
  };
  CHECK(residual({1, 0, Rational(-1, 2)}) == 0);
  CHECK(residual({1, Rational(-1, 2), 0}) > 0);
  CHECK(residual({1, 0, Rational(-1, 4)}) > 0);
  CHECK(residual({2, 0, Rational(-1, 2)}) > 0);
  CHECK(residual({0, 0, 0}) > 0);
  LemkeAlgorithm<Rational> lemke;
  Trace<Rational> trace;
  REQUIRE(lemke.Run(problem, polygons, &trace).outcome == Outcome::kSolved);
  CHECK(lemke.f() == Vector({1, 0, Rational(-1, 2)}));
  CHECK(trace.pivots.back().f == lemke.f());
  std::string names;
  for (const auto& pivot : trace.pivots) names += pivot.entering + ">" + pivot.leaving + " ";
  CHECK(names == "z0>a3.1 f3.1>a2.1 f2.1>m1 l1>f2.1 a2.1>aN1 fN1>z0 ");
}

// It is where Newton's method begins; the gate judges what that finds.
TEST_CASE("lemke in space: over doubles nearly all answers are right") {
  LemkeAlgorithm<double> lemke({}, Cover::kUnits);
  int solved = 0;
  for (int index = 0; index < 90; ++index) {
    CAPTURE(index);
    const ContactProblem<double> problem = As<double>(RandomInSpace(1 + index % 3, index));
    const std::vector<FrictionPolygon<double>> polygons(problem.contacts.size(), FrictionPolygon<double>(8));
    const RunEnd<> verdict = lemke.Run(problem, polygons);
    if (verdict.outcome != Outcome::kSolved) continue;
    solved += PolygonErrorOf(problem, polygons, lemke.f(), lemke.a()) <= 1e-9;
  }
  CHECK(solved >= 80);
}

TEST_CASE("space: modes are linear equations, free unknowns as guessed") {
  ExactProblem problem;
  problem.dimension = 3;
  problem.contacts.assign(2, {ContactKind::kStatic, 1, {}});
  problem.A = ExactMatrix::Zero(6, 6);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) problem.A(i, j) = i % 3 == j % 3 ? 1 : 0;
  }
  problem.b = Vector({-2, 0, 0, -2, 0, 0});
  const SpaceMode stick = {Law::kInside, {0, 0}};
  const auto f = SolveModes(problem, {stick, stick}, Vector({1, 0, 0, Rational(1, 3), 0, 0}));
  REQUIRE(f);
  CHECK(*f == Vector({Rational(5, 3), 0, 0, Rational(1, 3), 0, 0}));
  problem.b[3] = -3;  // the same contact cannot have two accelerations
  CHECK(!SolveModes(problem, {stick, stick}, Vector({1, 0, 0, 1, 0, 0})));
}

TEST_CASE("space: b out of range ends in a ray, or is solved all the same") {
  ExactProblem wedge = OneContact(1, {-1, 0, 0});
  wedge.A = Matrix({{1, -1, 0}, {-1, 1, 0}, {0, 0, 1}});
  const ExactAnswer stuck = SolveInSpace(wedge, {.law = FrictionLaw::kBaraff});
  CHECK(stuck.outcome == Outcome::kRay);
  CHECK(stuck.ray.size() == 3);
  CHECK(SolveInSpace(wedge, {.law = FrictionLaw::kBaraff}, SpaceEngine::kLemke).outcome == Outcome::kRay);
  // Touching, it has forces that pull its friction against its slip: nothing without directions refutes it.
  CHECK(RefuteInSpace(wedge).end == EnumerationEnd::kOpen);
  CHECK_FALSE(DecideExistence(wedge, {.law = FrictionLaw::kBaraff}).certificate);
  wedge.contacts[0].mu = Rational(1, 2);
  const ExactAnswer solved = SolveInSpace(wedge, {.law = FrictionLaw::kBaraff});
  REQUIRE(solved.outcome == Outcome::kSolved);
  CHECK(solved.f == Vector({2, 1, 0}));
  CHECK(DecideExistence(wedge, {.law = FrictionLaw::kBaraff}).certificate);
}

TEST_CASE("space: modes near forces are told in units of each direction, however large A is in the others") {
  ExactProblem next_to_corner = OneContact(Rational(4095), {-31250, 0, 1});
  next_to_corner.A = Matrix({{2147483647, 1, 0}, {1, 1, 0}, {0, 0, 1}});
  ExactProblem on_edge = OneContact(Rational(333333), {-126976, 0, 1});
  on_edge.A = Matrix({{62277025792, 0, 0}, {0, 1, 1}, {0, 1, 2}});
  for (const ExactProblem& problem : {next_to_corner, on_edge}) {
    for (const SpaceEngine engine : {SpaceEngine::kComplete, SpaceEngine::kLemke}) {
      const ExactAnswer answer = SolveInSpace(problem, {}, engine);
      CHECK(answer.Solved());
      CHECK(answer.counters[Counter::kRefinements] == 0);
    }
  }
}

TEST_CASE("space: that there is no solution is proved word by word, or not at all") {
  // aN = fN - mu fF.u - 1 for the first contact, and of the second -1/2 while the first does not touch.
  ExactProblem problem;
  problem.dimension = 3;
  problem.contacts = {{ContactKind::kStatic, 1, {}}, {ContactKind::kStatic, Rational(1, 2), {}}};
  problem.A = ExactMatrix::Zero(6, 6);
  problem.A.row(0) = Vector({-5, 3, -4, 0, 0, 0}).transpose();
  problem.b = Vector({-1, 0, 0, 1, 0, 0});
  const Enumeration first = RefuteInSpace(problem);
  REQUIRE(first.ProvesNoSolution());
  CHECK(first.programs > 1);  // a polygon of eight sides does not do
  CHECK(CheckCertificate(NoSolutionCertificate(problem, first), "here").accepted);
  problem.A.row(0) = Vector({-4, 3, -4, 0, 0, 0}).transpose();  // and now f0 (5 - 4) = 1 has an answer
  CHECK(RefuteInSpace(problem).end == EnumerationEnd::kOpen);

  // Two words of four by one contact, the others by both.
  problem.A = ExactMatrix::Zero(6, 6);
  problem.A(0, 0) = problem.A(3, 0) = 1;
  problem.A(3, 3) = -1;
  problem.b = Vector({-1, 0, 0, -2, 0, 0});
  const Enumeration words = RefuteInSpace(problem);
  REQUIRE(words.ProvesNoSolution());
  CHECK(words.refuted.size() > 1);
  CHECK(CheckCertificate(NoSolutionCertificate(problem, words), "here").accepted);
  for (const std::int64_t budget : {0, 1}) {
    CHECK(RefuteInSpace(problem, {.limits = {.programs = budget}}).end == EnumerationEnd::kLimit);
  }
  CHECK(RefuteInSpace(problem, {}, [](const Enumeration&) { return false; }).end == EnumerationEnd::kStopped);
  CHECK_THROWS_AS(RefuteInSpace(ThreeSolutions()), InputError);
}

// A contact that nothing can lift beside two that press: u has ones in normal rows and in some tangents.
ExactProblem DeadNormal(const Rational& free) {
  ExactProblem problem;
  problem.dimension = 3;
  problem.contacts.assign(3, {ContactKind::kStatic, 1, {}});
  const ExactVector u = Vector({1, 0, 0, 1, 0, 1, 0, 1, 0});
  problem.A = 2 * u * u.transpose();
  problem.A(8, 8) = 2;
  problem.b = Vector({-1, 0, Rational(1, 2), -1, 0, Rational(1, 3), free, Rational(1, 4), 0});
  return problem;
}

TEST_CASE("space: a solution out of range(A) is found near doubles, where paths end in rays") {
  CHECK(!IsInRange(DeadNormal(0)));
  for (const FrictionLaw law : {FrictionLaw::kBaraff, FrictionLaw::kCoulomb}) {
    const ExactProblem problem = DeadNormal(0);
    CHECK(SolveInSpace(problem, {.law = law}).outcome == Outcome::kRay);
    const ExactAnswer near = SolveNearFast(problem, {.law = law});
    REQUIRE(near.outcome == Outcome::kSolved);
    CHECK(!FindViolation(problem, near.f));
    CHECK(CoulombBound(problem, near.f).value() > 1 - Rational(1, 1 << 20));
    const ClaimAnswer existence = DecideExistence(problem, {.law = law});
    CHECK(existence.method == "fast");
    CHECK(existence.certificate->at("claim") ==
          (law == FrictionLaw::kCoulomb ? "coulomb-solution" : "solution-exists"));
    CHECK(DecideExistence(DeadNormal(Rational(-1, 10)), {.law = law}).certificate->at("claim") ==
          "no-solution");
  }
  CHECK(SolveNearFast(DeadNormal(Rational(-1, 10)), {.law = FrictionLaw::kBaraff}).outcome ==
        Outcome::kUndecided);
}

TEST_CASE("space: altered certificates are rejected") {
  ExactProblem problem;
  ExactAnswer solution;
  for (int index = 0; !solution.bound || *solution.bound == 0 || *solution.bound == 1;
       index += 2) {  // the first that slips
    problem = RandomInSpace(2, index);
    solution = SolveInSpace(problem, {});
  }
  const Json good = CoulombCertificate(problem, solution.f, *solution.bound);
  REQUIRE(CheckCertificate(good, "here").accepted);
  const auto rejects = [&good](auto alter) {
    Json bad = good;
    alter(bad);
    return !CheckCertificate(bad, "here").accepted;
  };
  for (const char* bound : {"0", "-1/2", "2", "1"}) {
    CAPTURE(bound);
    CHECK(rejects([&](Json& c) { c["witness"]["bound"] = bound; }));
  }
  CHECK(rejects([](Json& c) { c["witness"].erase("bound"); }));
  CHECK(rejects([](Json& c) { c["claim"] = "solution-exists"; }));
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(rejects([&](Json& c) { c["witness"]["a"][i] = "17"; }));
    CHECK(rejects([&](Json& c) { c["witness"]["f"][i] = "17"; }));
    CHECK(rejects([&](Json& c) { c["problem"]["b"][i] = "17/3"; }));
  }
}

}  // namespace
}  // namespace stiction
