// SPDX-License-Identifier: Apache-2.0
// Parents of an optimized search: sums of smaller problems, what a search drew, problems of any origin.

#include "search/adversary/parents.h"

#include <catch2/catch.hpp>

#include "corpus/formats/read_problem.h"
#include "corpus/rounded.h"
#include "search/adversary/objective.h"
#include "search/units/regenerate.h"
#include "solver/published/published.ipp"
#include "tests/support.h"

namespace stiction {
namespace {

constexpr GeneratorId kSums[] = {GeneratorId::kIntegers, GeneratorId::kPsd};

Candidate DrawnAsParent(GeneratorId generator, int contacts, std::uint64_t seed) {
  return RandomCandidate({generator, contacts, {2, 3}, false, {}}, seed);
}

void RequireSideBySide(const ExactProblem& sum, const ExactProblem& left, const ExactProblem& right) {
  const int n = left.rows(), m = right.rows();
  REQUIRE(sum.rows() == n + m);
  REQUIRE(sum.A.topLeftCorner(n, n) == left.A);
  REQUIRE(sum.A.bottomRightCorner(m, m) == right.A);
  REQUIRE(sum.A.topRightCorner(n, m).isZero());
  REQUIRE(sum.b.head(n) == left.b);
  REQUIRE(sum.b.tail(m) == right.b);
  for (const auto& contact : sum.contacts) REQUIRE(contact.mu == left.contacts.front().mu);
}

TEST_CASE("parents: a direct sum is two problems side by side") {
  for (const GeneratorId generator : kSums) {
    int sums = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const Candidate left = DrawnAsParent(generator, 1 + static_cast<int>(seed % 3), seed);
      const Candidate right = DrawnAsParent(generator, 2, 100 + seed);
      const auto sum = DirectSum(left, right);
      if (!sum) continue;  // b = J y beside b = A x
      ++sums;
      RequireSideBySide(ExactOf(*sum), ExactOf(left), ExactOf(right));
    }
    CHECK(sums >= (generator == GeneratorId::kPsd ? 20 : 5));
  }
}

TEST_CASE("parents: there is no sum of different generators, of bodies, or of too many contacts") {
  CHECK_FALSE(DirectSum(DrawnAsParent(GeneratorId::kPsd, 2, 1), DrawnAsParent(GeneratorId::kIntegers, 2, 1)));
  CHECK_FALSE(DirectSum(DrawnAsParent(GeneratorId::kScenes, 2, 1), DrawnAsParent(GeneratorId::kScenes, 2, 2)));
  CHECK_FALSE(DirectSum(DrawnAsParent(GeneratorId::kPsd, 5, 1), DrawnAsParent(GeneratorId::kPsd, 4, 1)));
  CHECK(DirectSum(DrawnAsParent(GeneratorId::kPsd, 4, 1), DrawnAsParent(GeneratorId::kPsd, 4, 1)));
}

TEST_CASE("parents: smaller candidates are made as large, beside each other or beside a random one") {
  for (const GeneratorId generator : kSums) {
    const Candidate like{generator, 5, {2, 3}, false, {}};
    const Candidate three = DrawnAsParent(generator, 3, 1), four = DrawnAsParent(generator, 4, 2);
    const auto alone = Enlarged({four}, like, 7);
    REQUIRE(alone.size() == 1);
    CHECK(alone.front().contacts == 5);
    CHECK(ExactOf(alone.front()).A.topLeftCorner(8, 8) == ExactOf(four).A);
    CHECK(Enlarged({four}, like, 7) == alone);
    CHECK_FALSE(Enlarged({four}, like, 8) == alone);
    const auto both = Enlarged({three, DrawnAsParent(generator, 2, 3)}, like, 7);
    REQUIRE(both.size() == 2);
    CHECK(ExactOf(both.front()).A.topLeftCorner(6, 6) == ExactOf(three).A);
    CHECK(Enlarged({DrawnAsParent(generator, 5, 1), DrawnAsParent(generator, 6, 1)}, like, 7).empty());
  }
}

TEST_CASE("parents: what a search drew is the same problem as a candidate, under one friction coefficient") {
  Campaign campaign;
  campaign.generators = {GeneratorId::kIntegers, GeneratorId::kScenes, GeneratorId::kConditioned};
  int exact = 0;
  for (std::int64_t unit = 0; unit < 40; ++unit) {
    const ExactProblem drawn = Regenerate(campaign, unit, 3).problem;
    const ExactProblem again = ExactOf(CandidateOf(campaign, unit, 3));
    CHECK(again.contacts.front().mu == drawn.contacts.front().mu);
    const Task task = TaskOf(Schedule(campaign), unit);
    if (task.generator == GeneratorId::kScenes) continue;  // friction is part of nothing else
    CHECK(again.A == drawn.A);
    CHECK(again.b == drawn.b);
    ++exact;
  }
  CHECK(exact > 20);
}

TEST_CASE("parents: a problem of any origin has one of psd near it, which ends alike") {
  const ExactProblem loop =
      ReadProblem(std::string(STICTION_SCENES) + "/../two-contact-cycle-every-policy-period-4.json").problem;
  const Candidate near = NearPsd(loop, "p");
  CHECK(near.mu == MuChoice{2, 1});
  PublishedAlgorithm<double> algorithm;
  const auto end = [&](const ContactProblem<double>& problem) { return algorithm.Run(problem); };
  const Verdict one = end(Rounded<double>(loop)), other = end(RoundedOf(near, nullptr));
  CHECK(one.outcome == Outcome::kCycle);
  CHECK(other.outcome == Outcome::kCycle);
  CHECK(other.period == one.period);
}

TEST_CASE("parents: what has no candidate near it is refused with what was expected") {
  ExactProblem problem = ExactOf(DrawnAsParent(GeneratorId::kIntegers, 2, 1));
  problem.contacts[1].kind = ContactKind::kSliding;
  CHECK_THROWS_WITH(NearPsd(problem, "p.json"), Catch::Contains("p.json") && Catch::Contains("sliding") &&
                                                    Catch::Contains("static contacts"));
  problem.dimension = 3;
  CHECK_THROWS_WITH(NearPsd(problem, "p.json"), Catch::Contains("in space"));
}

}  // namespace
}  // namespace stiction
