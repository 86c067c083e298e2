// SPDX-License-Identifier: Apache-2.0
// Lemke's method: all problems of the paper's assumptions are solved; what rays mean; pivots.

#include "solver/lemke/lemke.h"

#include <catch2/catch.hpp>

#include "certify/exact/enumerate.h"
#include "certify/exact/verify_solution.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// Positive definite, numbers so large that ties are improbable, one mu of a list or one per contact, b_N
// negative with probability 3/5.
ExactProblem DrawDefinite(int contacts, std::uint64_t seed) {
  Choices choices(seed);
  const int rows = 2 * contacts;
  const std::vector<Rational> palette = {0, Rational(1, 5), Rational(1, 2), 1, 2, 5, 10};
  std::vector<std::vector<Rational>> J(rows), A(rows, std::vector<Rational>(rows));
  std::vector<Rational> b, mu;
  const std::int64_t common = choices.Integer(0, 7);
  for (int i = 0; i < contacts; ++i) mu.push_back(palette[common < 7 ? common : choices.Integer(0, 6)]);
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < rows; ++k) J[i].push_back(choices.Integer(-1000, 1000));
    b.push_back(choices.Integer(-1000, 1000));
    if (i % 2 == 0 && choices.Integer(0, 4) < 3) b[i] = -abs(b[i]);
  }
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < rows; ++j) {
      for (int k = 0; k < rows; ++k) A[i][j] += J[i][k] * J[j][k];
      if (i == j) A[i][j] += 1;
    }
  }
  return MakeProblem(mu, A, b);
}

// 1/p of row p in every number, so that each row of the tableau has a unit of its own.
ExactProblem OfFractions(int contacts, std::uint64_t seed) {
  ExactProblem problem = DrawDefinite(contacts, seed);
  for (auto& contact : problem.contacts) contact.mu += Rational(1, 7);
  for (int i = 0; i < problem.rows(); ++i) {
    problem.b[i] /= 2 * i + 3;
    for (int j = 0; j < problem.rows(); ++j) problem.A(i, j) /= (2 * i + 3) * (2 * j + 3);
  }
  return problem;
}

TEST_CASE("lemke: every step of a path over fractions leads from one point to the next") {
  LemkeAlgorithm<Rational> lemke;
  int entering_accelerations = 0;
  for (std::uint64_t index = 0; index < 40; ++index) {
    const ExactProblem problem = OfFractions(3, index);
    Trace<Rational> trace;
    REQUIRE(lemke.Run(problem, &trace).outcome == Outcome::kSolved);
    ExactVector before = ExactVector::Zero(problem.rows());
    for (const Pivot<Rational>& pivot : trace.pivots) {
      INFO("problem " << index << ": " << pivot.entering << " enters, " << pivot.leaving << " leaves");
      CHECK(pivot.f == before + pivot.s * pivot.df);
      CHECK(pivot.a == Accelerations(problem, pivot.f));
      entering_accelerations += pivot.entering[0] == 'a' && Sign(pivot.s) > 0;
      before = pivot.f;
    }
    CHECK_FALSE(FindViolation(problem, lemke.f()));
    CHECK(Sign(trace.pivots.back().cover) == 0);
  }
  CHECK(entering_accelerations > 20);
}

// Two balls: z0 = 6, then z0 = 4 beside f2 = 2/10, which has three bits in lowest terms.
TEST_CASE("lemke: a budget of bits is one of numbers in lowest terms") {
  ExactProblem problem = MakeProblem({0}, {{6, 0}, {0, 10}}, {-4, -6});
  problem.contacts.assign(2, {ContactKind::kFrictionless, 0, {}});
  for (const int bits : {2, 3}) {
    const RunEnd<> verdict = LemkeAlgorithm<Rational>({.limits = {.bits = bits}}).Run(problem);
    CHECK(verdict.outcome == (bits == 2 ? Outcome::kLimit : Outcome::kSolved));
    CHECK(verdict.reason == (bits == 2 ? "bits" : ""));
  }
}

TEST_CASE("lemke: with a covering vector in the units of the problem the path does not depend on units") {
  LemkeAlgorithm<Rational> lemke({}, Cover::kUnits);
  for (std::uint64_t index = 0; index < 30; ++index) {
    const ExactProblem problem = Random<Rational>(GeneratorId::kIntegers, 3, index);
    const RunEnd<> verdict = lemke.Run(problem);
    REQUIRE(verdict.outcome == Outcome::kSolved);
    CHECK_FALSE(FindViolation(problem, lemke.f()));
    const ExactVector f = lemke.f();
    ExactProblem other = problem;  // masses in units of 1/7, lengths of 3
    for (int i = 0; i < problem.rows(); ++i) {
      other.b[i] *= 3;
      for (int j = 0; j < problem.rows(); ++j) other.A(i, j) *= 7;
    }
    CHECK(lemke.Run(other).statistics[Counter::kPivots] == verdict.statistics[Counter::kPivots]);
    for (int i = 0; i < problem.rows(); ++i) CHECK(lemke.f()[i] == f[i] * 3 / 7);
  }
}

TEST_CASE("lemke: the cycling reference problem and the two-contact cycle of the theory are solved") {
  LemkeAlgorithm<Rational> lemke;
  CHECK(lemke.Run(ReferenceProblem()).outcome == Outcome::kSolved);
  CHECK(lemke.f() == Vector({1, Rational(-6, 7), Rational(25, 14), Rational(-25, 14)}));
  const ExactProblem cycle =
      MakeProblem({10, 3}, {{6, 2, 5, 5}, {2, 6, 7, 3}, {5, 7, 10, 7}, {5, 3, 7, 10}}, {-7, 9, 1, 9});
  const RunEnd<> verdict = lemke.Run(cycle);
  CHECK(verdict.outcome == Outcome::kSolved);
  CHECK(verdict.statistics[Counter::kPivots] == 6);
  CHECK(lemke.f() ==
        Vector({Rational(169, 212), Rational(-845, 106), Rational(5383, 636), Rational(-3073, 636)}));
}

TEST_CASE("lemke: of rows that tie for the first pivot the last leaves, and z0 leaves as soon as it can") {
  const auto run = [](const ExactProblem& problem) {
    LemkeAlgorithm<Rational> lemke;
    Trace<Rational> trace;
    REQUIRE(lemke.Run(problem, &trace).outcome == Outcome::kSolved);
    return trace.pivots;
  };
  // Unit vectors tell equal quotients apart: the last is the lexicographically smallest.
  CHECK(run(MakeProblem({-1, -1}, {{1, 0}, {0, 1}}, {-1, -1})).front().leaving == "aN2");
  // One push lets both contacts rest: the second comes to rest with z0.
  const auto pivots = run(MakeProblem({-1, -1}, {{2, 1}, {1, 1}}, {-2, -1}));
  CHECK(pivots.size() == 2);
  CHECK(pivots.back().leaving == "z0");
}

TEST_CASE("lemke: no contacts, nothing to do, and a zero matrix") {
  LemkeAlgorithm<Rational> lemke;
  CHECK(lemke.Run(NoContacts()).outcome == Outcome::kSolved);
  const RunEnd<> open = lemke.Run(MakeProblem({1}, {{1, 0}, {0, 1}}, {1, 0}));
  CHECK(open.outcome == Outcome::kSolved);
  CHECK(open.statistics[Counter::kPivots] == 0);
  CHECK(lemke.Run(MakeProblem({1}, {{0, 0}, {0, 0}}, {-1, 0})).outcome == Outcome::kRay);
  CHECK(lemke.ray() == Vector({1, 0}));
  LemkeAlgorithm<double> rounded;
  CHECK(rounded.Run(As<double>(NoSolution())).outcome == Outcome::kRay);
}

TEST_CASE("lemke: a spent budget is the outcome limit") {
  LemkeAlgorithm<Rational> lemke({.limits = {.pivots = 2}});
  const RunEnd<> verdict = lemke.Run(ReferenceProblem());
  CHECK(verdict.outcome == Outcome::kLimit);
  CHECK(verdict.reason == "pivots");
  CHECK(verdict.statistics[Counter::kPivots] == 2);
}

// b is drawn anywhere: (H) can fail, and then the direction of a ray shows it.
TEST_CASE("lemke: a ray shows that b is not in range(A), it can end a problem that has a solution") {
  LemkeAlgorithm<Rational> lemke;
  int rays = 0, solvable = 0;
  for (std::uint64_t index = 0; index < 400; ++index) {
    ExactProblem problem = Random<Rational>(GeneratorId::kSmall, 2, index);
    Choices choices(index);
    for (int i = 0; i < problem.rows(); ++i) problem.b[i] = choices.Integer(-3, 3);
    if (lemke.Run(problem).outcome == Outcome::kSolved) {
      CHECK_FALSE(FindViolation(problem, lemke.f()));
      continue;
    }
    ++rays;
    const ExactVector& v = lemke.ray();
    Rational product = 0;
    for (int i = 0; i < problem.rows(); ++i) {
      Rational image = 0;
      for (int j = 0; j < problem.rows(); ++j) image += problem.A(i, j) * v[j];
      CHECK(image == 0);
      product += problem.b[i] * v[i];
    }
    CHECK(product < 0);
    for (int i = 0; i < 2; ++i) CHECK(abs(v[2 * i + 1]) <= problem.contacts[i].mu * v[2 * i]);
    CHECK_FALSE(IsInRange(problem));
    solvable += !EnumerateModes(problem, {}, UntilSolved).solutions.empty();
  }
  CAPTURE(rays, solvable);
  CHECK(rays > 20);
  CHECK(solvable > 0);
  CHECK(solvable < rays);
}

TEST_CASE("lemke: a stuck problem that solves itself with f = 0 needs no pivot though (H) fails") {
  LemkeAlgorithm<Rational> lemke;
  const ExactProblem problem = MakeProblem({2}, {{1, -1}, {-1, 1}}, {1, -2});
  CHECK(lemke.Run(problem).outcome == Outcome::kSolved);
  CHECK_FALSE(FindViolation(problem, lemke.f()));
}

// E_n with a friction of its own for every contact, which no normal force feels.
ExactProblem WithDecoupledFriction(const ExactProblem& normals, const Rational& b_t) {
  const int n = normals.rows();
  ExactProblem problem;
  problem.contacts.assign(n, {ContactKind::kStatic, 0, {}});
  problem.A = ExactMatrix::Identity(2 * n, 2 * n);
  problem.b = ExactVector::Constant(2 * n, b_t);
  for (int i = 0; i < n; ++i) {
    problem.b[2 * i] = normals.b[i];
    for (int j = 0; j < n; ++j) problem.A(2 * i, 2 * j) = normals.A(i, j);
  }
  return problem;
}

// 2^n + 2n, which is the count with free tangential accelerations that are not zero.
TEST_CASE("lemke: the exponential family is exponential here too") {
  LemkeAlgorithm<Rational> lemke;
  for (int n = 2; n <= 8; ++n) {
    const ExactProblem normals = ExponentialFamily(n);
    CHECK(lemke.Run(normals).statistics[Counter::kPivots] == (1 << n));
    CHECK(lemke.Run(WithDecoupledFriction(normals, 0)).statistics[Counter::kPivots] == (1 << n));
    CHECK(lemke.Run(WithDecoupledFriction(normals, 1)).statistics[Counter::kPivots] == (1 << n) + 2 * n);
  }
}

TEST_CASE("lemke: mean pivots on random problems are those of the notes, within a fifth") {
  LemkeAlgorithm<Rational> lemke;
  for (const auto& [contacts, mean] : {std::pair(2, 6.34), std::pair(3, 9.56), std::pair(4, 13.06)}) {
    std::int64_t pivots = 0;
    for (std::uint64_t index = 0; index < 200; ++index) {
      const RunEnd<> verdict = lemke.Run(DrawDefinite(contacts, index));
      REQUIRE(verdict.outcome == Outcome::kSolved);
      pivots += verdict.statistics[Counter::kPivots];
    }
    CHECK(static_cast<double>(pivots) / 200 == Approx(mean).epsilon(0.2));
  }
}

}  // namespace
}  // namespace stiction
