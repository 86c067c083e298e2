// SPDX-License-Identifier: Apache-2.0
// Loops in space: proofs of both kinds are found, and one that is altered has a fault in its place.

#include "certify/exact/loops_in_space.h"

#include <catch2/catch.hpp>

#include "certify/exact/published_space.h"
#include "tests/support.h"

namespace stiction {
namespace {

using Rows = int[6][6];

ExactProblem TwoContacts(const Rows& A, const int (&b)[6]) {
  ExactProblem problem;
  problem.dimension = 3;
  problem.contacts.assign(2, {ContactKind::kStatic, 3, {}});
  problem.A = ExactMatrix::Constant(6, 6, Rational(0));
  problem.b = ExactVector::Constant(6, Rational(0));
  for (int i = 0; i < 6; ++i) {
    problem.b[i] = b[i];
    for (int j = 0; j < 6; ++j) problem.A(i, j) = A[i][j];
  }
  return problem;
}

// Its sets recur under both slips: corpus/space/cycle-under-both-slips.json.
ExactProblem OfStates() {
  return TwoContacts({{3, 0, 0, 0, 0, 1},
                      {0, 3, 1, 0, 1, -1},
                      {0, 1, 3, -1, 1, 0},
                      {0, 0, -1, 2, 0, 0},
                      {0, 1, 1, 0, 3, 0},
                      {1, -1, 0, 0, 0, 3}},
                     {-1, 2, 0, -1, -2, 1});
}

// Under both slips it never leaves a box.
ExactProblem OfBoxes() {
  return TwoContacts({{7, -1, -4, 1, -3, -2},
                      {-1, 13, 5, 2, 1, 1},
                      {-4, 5, 12, -3, 3, 3},
                      {1, 2, -3, 2, -1, 0},
                      {-3, 1, 3, -1, 8, -1},
                      {-2, 1, 3, 0, -1, 8}},
                     {-1, 2, -2, 1, 2, -3});
}

// Literally read, it never leaves a box, as is known from lines along which f has moved before.
ExactProblem OfLines() {
  ExactProblem problem = TwoContacts({{11, -5, -1, -6, 3, 5},
                                      {-5, 21, 7, 12, 3, -3},
                                      {-1, 7, 16, 6, 0, -2},
                                      {-6, 12, 6, 13, 4, -6},
                                      {3, 3, 0, 4, 12, 2},
                                      {5, -3, -2, -6, 2, 6}},
                                     {-1, 4, 2, 0, 4, 3});
  for (auto& contact : problem.contacts) contact.mu = 1;
  return problem;
}

// Redirected, a contact turns away with an aF that comes nearer and nearer to zero.
ExactProblem OfTurnings() {
  ExactProblem problem = TwoContacts({{7, 1, -1, -2, -5, -2},
                                      {1, 8, -1, -2, -3, -4},
                                      {-1, -1, 8, 3, -1, 3},
                                      {-2, -2, 3, 8, 1, -2},
                                      {-5, -3, -1, 1, 11, 2},
                                      {-2, -4, 3, -2, 2, 7}},
                                     {-1, 2, 3, -3, -3, -1});
  for (auto& contact : problem.contacts) contact.mu = 1;
  return problem;
}

Policy WithSlip(Slip slip) {
  Policy policy;
  policy.slip = slip;
  return policy;
}

std::string FaultyPlace(const ExactProblem& problem, const Policy& policy, const RunInSpace& loop) {
  const auto fault = FindLoopFault(problem, policy, loop);
  return fault ? fault->path : "";
}

RunInSpace Proof(const ExactProblem& problem, const Policy& policy) {
  const auto loop = ProveLoopInSpace(problem, policy, {});
  REQUIRE(loop.has_value());
  return *loop;
}

TEST_CASE("loops in space: proved by sets and by boxes, under both slips") {
  for (const Slip slip : {Slip::kLiteral, Slip::kRedirect}) {
    const Policy policy = WithSlip(slip);
    for (const auto& [problem, is_box] : {std::pair(OfStates(), false), std::pair(OfBoxes(), true)}) {
      const RunInSpace loop = Proof(problem, policy);
      CHECK(loop.IsBox() == is_box);
      CHECK(FaultyPlace(problem, policy, loop).empty());
      const InexactAnswer run = RunIntervalsInSpace(problem, {.policy = policy});
      CHECK(run.outcome == Outcome::kCycle);
      CHECK(run.period == loop.period);
    }
  }
}

TEST_CASE("loops in space: what moved along a line comes back exactly") {
  const Policy literal = WithSlip(Slip::kLiteral);
  RunInSpace loop = Proof(OfLines(), literal);
  CHECK(FaultyPlace(OfLines(), literal, loop).empty());
  ExactProblem other = OfLines();
  other.A(1, 4) += Rational(1, 1000);
  CHECK_FALSE(FaultyPlace(other, literal, loop).empty());
  loop.radii[0] = 1000;
  CHECK_FALSE(FaultyPlace(OfLines(), literal, loop).empty());
}

TEST_CASE("loops in space: a proof that is altered has a fault") {
  const Policy literal = WithSlip(Slip::kLiteral), redirect = WithSlip(Slip::kRedirect);
  for (const Policy& policy : {literal, redirect}) {
    for (const ExactProblem& problem : {OfStates(), OfBoxes()}) {
      const RunInSpace proof = Proof(problem, policy);
      RunInSpace other = proof;
      other.word.pop_back();
      CHECK(FaultyPlace(problem, policy, other) == "word");
      other = proof;
      std::swap(other.word[0], other.word[1]);
      CHECK(FaultyPlace(problem, policy, other) == "word[0]");
      other = proof;
      ++other.start;
      CHECK_FALSE(FaultyPlace(problem, policy, other).empty());
      other = proof;
      ++other.period;
      CHECK_FALSE(FaultyPlace(problem, policy, other).empty());
    }
  }
  CHECK_FALSE(FaultyPlace(OfBoxes(), literal, Proof(OfBoxes(), redirect)).empty());
}

TEST_CASE("loops in space: a box that is altered has a fault in its place") {
  const Policy policy = WithSlip(Slip::kRedirect);
  const RunInSpace box = Proof(OfBoxes(), policy);
  const auto place = [&](const RunInSpace& other) { return FaultyPlace(OfBoxes(), policy, other); };
  RunInSpace other = box;
  other.centre[0] += 3 * box.radii[0];
  CHECK(place(other) == "centre");
  other = box;
  other.radii[0] = 0;
  CHECK(place(other) == "radii[0]");
  other.radii[0] = box.radii[0] / (mpz_class(1) << 200);
  CHECK(place(other) == "centre");  // the run does not come into it
  other.radii[0] = 1000;
  CHECK(place(other) == "bits");  // it has many words
  other = box;
  other.charts[0] = 0;
  CHECK(place(other) == "charts[0]");
  other.charts[0] = -box.charts[0];
  CHECK_FALSE(place(other).empty());
  other = box;
  other.charts.pop_back();
  CHECK(place(other) == "radii");
}

TEST_CASE("loops in space: a run that ends is not proved to loop") {
  ExactProblem problem = OfStates();
  for (auto& contact : problem.contacts) contact.mu = Rational(1, 100);
  for (const Slip slip : {Slip::kLiteral, Slip::kRedirect}) {
    CHECK(RunIntervalsInSpace(problem, {.policy = WithSlip(slip)}).outcome == Outcome::kSolved);
    CHECK_FALSE(ProveLoopInSpace(problem, WithSlip(slip), {}).has_value());
  }
}

TEST_CASE(
    "loops in space: no state recurs where the period moves the first, and different points to different "
    "ones") {
  for (const Slip slip : {Slip::kLiteral, Slip::kRedirect}) {
    const auto loop = ProveEndlessInSpace(OfBoxes(), WithSlip(slip), {});
    REQUIRE(loop.has_value());
    CHECK(loop->endless);
    CHECK(FaultyPlace(OfBoxes(), WithSlip(slip), *loop).empty());
    CHECK_FALSE(ProveEndlessInSpace(OfStates(), WithSlip(slip), {}).has_value());
    RunInSpace other = Proof(OfStates(), WithSlip(slip));
    other.endless = true;
    CHECK(FaultyPlace(OfStates(), WithSlip(slip), other) == "kind");
  }
}

TEST_CASE(
    "loops in space: a contact turns away with less and less, and with nothing at the fixed point alone") {
  const Policy redirect = WithSlip(Slip::kRedirect);
  RunInSpace loop = Proof(OfTurnings(), redirect);
  CHECK(loop.punctured);
  CHECK(FaultyPlace(OfTurnings(), redirect, loop).empty());
  loop.endless = true;
  CHECK(FaultyPlace(OfTurnings(), redirect, loop).empty());
  RunInSpace other = loop;
  other.punctured = false;
  CHECK(FaultyPlace(OfTurnings(), redirect, other) == "bits");
  other = loop;
  other.centre[0] += 3 * loop.radii[0];
  CHECK(FaultyPlace(OfTurnings(), redirect, other) == "centre");
  Policy going_on = redirect;
  going_on.rezero = Rezero::kContinue;
  other = Proof(OfBoxes(), going_on);
  CHECK(other.radii.size() == 2);
  other.punctured = true;
  CHECK(FaultyPlace(OfBoxes(), going_on, other) == "radii");  // both coordinates move
}

// corpus/space/ray-under-slip-literal.json
ExactProblem OfRay() {
  ExactProblem problem = TwoContacts({{2, 0, 0, -1, 0, 1},
                                      {0, 3, 0, 1, 0, 0},
                                      {0, 0, 1, 0, 0, 0},
                                      {-1, 1, 0, 4, 2, -1},
                                      {0, 0, 0, 2, 4, 0},
                                      {1, 0, 0, -1, 0, 2}},
                                     {-2, -2, 2, 0, 2, 1});
  for (auto& contact : problem.contacts) contact.mu = 2;
  return problem;
}

TEST_CASE("rays in space: proved where nothing limits a step, a fault where altered") {
  const Policy literal = WithSlip(Slip::kLiteral), redirect = WithSlip(Slip::kRedirect);
  const auto ray = ProveRayInSpace(OfRay(), literal, {});
  REQUIRE(ray.has_value());
  CHECK(ray->word.size() == 7);
  CHECK_FALSE(FindRayFault(OfRay(), literal, *ray).has_value());
  CHECK_FALSE(ProveRayInSpace(OfRay(), redirect, {}).has_value());    // solved
  CHECK_FALSE(ProveRayInSpace(OfStates(), literal, {}).has_value());  // loops
  const auto place = [](const RunInSpace& other) { return FindRayFault(OfRay(), WithSlip({}), other)->path; };
  RunInSpace other = *ray;
  other.word.pop_back();
  CHECK(place(other) == "word");
  other = *ray;
  std::swap(other.word[1], other.word[2]);
  CHECK(place(other) == "word[1]");
  other = *ray;
  other.word.push_back("N1 N1 C");
  CHECK(place(other) == "word");
  ExactProblem large = OfRay();  // in a row of which no sign is asked
  large.A(5, 0) = Rational(mpz_class(1) << 1000);
  CHECK(FindRayFault(large, literal, *ray)->expected == "more: numbers of A, b and mu are below 2^(bits / 4)");
  const RunInSpace ended = {.bits = 384};
  CHECK(FindRayFault(OfRay(), redirect, *ray)->path == "word[3]");
  CHECK(FindRayFault(OfStates(), literal, ended)->path == "word");
}

}  // namespace
}  // namespace stiction
