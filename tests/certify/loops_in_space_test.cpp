// SPDX-License-Identifier: Apache-2.0
// Loops in space: proofs of both kinds are found, and one that is altered has a fault in its place.

#include "certify/exact/loops_in_space.h"

#include <catch2/catch.hpp>

#include "certify/exact/published_space.h"
#include "tests/support.h"

namespace stiction {
namespace {

// The loop of corpus/space/cycle-under-both-slips.json.
ExactProblem UnderBothSlips() {
  ExactProblem problem;
  problem.dimension = 3;
  problem.contacts.assign(2, {ContactKind::kStatic, 3, {}});
  problem.A = ExactMatrix::Constant(6, 6, Rational(0));
  const int A[6][6] = {{3, 0, 0, 0, 0, 1},  {0, 3, 1, 0, 1, -1}, {0, 1, 3, -1, 1, 0},
                       {0, 0, -1, 2, 0, 0}, {0, 1, 1, 0, 3, 0},  {1, -1, 0, 0, 0, 3}};
  const int b[6] = {-1, 2, 0, -1, -2, 1};
  problem.b = ExactVector::Constant(6, Rational(0));
  for (int i = 0; i < 6; ++i) {
    problem.b[i] = b[i];
    for (int j = 0; j < 6; ++j) problem.A(i, j) = A[i][j];
  }
  return problem;
}

Policy WithSlip(Slip slip) {
  Policy policy;
  policy.slip = slip;
  return policy;
}

std::string FaultyPlace(const Policy& policy, const LoopInSpace& loop) {
  const auto fault = FindLoopFault(UnderBothSlips(), policy, loop);
  return fault ? fault->place : "";
}

LoopInSpace Proof(const Policy& policy) {
  const auto loop = ProveLoopInSpace(UnderBothSlips(), policy, {});
  REQUIRE(loop.has_value());
  return *loop;
}

TEST_CASE("loops in space: of one problem both slips loop, one by its sets, one in a box") {
  const Policy literal = WithSlip(Slip::kLiteral), redirect = WithSlip(Slip::kRedirect);
  const LoopInSpace states = Proof(literal), box = Proof(redirect);
  CHECK_FALSE(states.IsBox());
  CHECK(box.IsBox());
  CHECK(FaultyPlace(literal, states).empty());
  CHECK(FaultyPlace(redirect, box).empty());
  for (const auto& [policy, loop] : {std::pair(literal, states), std::pair(redirect, box)}) {
    const InexactAnswer run = RunIntervalsInSpace(UnderBothSlips(), {policy, {}, {}});
    CHECK(run.outcome == Outcome::kCycle);
    CHECK(run.period == loop.period);
  }
}

TEST_CASE("loops in space: what is altered has a fault in its place") {
  const Policy literal = WithSlip(Slip::kLiteral), redirect = WithSlip(Slip::kRedirect);
  for (const Policy& policy : {literal, redirect}) {
    const LoopInSpace proof = Proof(policy);
    LoopInSpace other = proof;
    other.word.pop_back();
    CHECK(FaultyPlace(policy, other) == "word");
    other = proof;
    std::swap(other.word[0], other.word[1]);
    CHECK(FaultyPlace(policy, other) == "word[0]");
    other = proof;
    other.bits = 64;
    other.start += 2 * other.period;
    CHECK_FALSE(FaultyPlace(policy, other).empty());
    CHECK_FALSE(FaultyPlace(policy == literal ? redirect : literal, proof).empty());
  }
  const LoopInSpace box = Proof(redirect);
  LoopInSpace other = box;
  other.centre[0] += 3 * box.radii[0];
  CHECK(FaultyPlace(redirect, other) == "centre");
  other = box;
  other.radii[0] = 0;
  CHECK(FaultyPlace(redirect, other) == "radii[0]");
  other.radii[0] = box.radii[0] / (mpz_class(1) << 200);
  CHECK_FALSE(FaultyPlace(redirect, other).empty());
  other.radii[0] = 1000;
  CHECK_FALSE(FaultyPlace(redirect, other).empty());
  other = box;
  other.charts[0] = other.charts[0] == 0 ? 1 : 0;
  CHECK(FaultyPlace(redirect, other) == "charts[0]");
  other = box;
  other.charts.pop_back();
  CHECK(FaultyPlace(redirect, other) == "radii");
}

TEST_CASE("loops in space: a run that ends is not proved to loop") {
  ExactProblem problem = UnderBothSlips();
  for (auto& contact : problem.contacts) contact.mu = Rational(1, 100);
  for (const Slip slip : {Slip::kLiteral, Slip::kRedirect}) {
    CHECK(RunIntervalsInSpace(problem, {WithSlip(slip), {}, {}}).outcome == Outcome::kSolved);
    CHECK_FALSE(ProveLoopInSpace(problem, WithSlip(slip), {}).has_value());
  }
}

}  // namespace
}  // namespace stiction
