// SPDX-License-Identifier: Apache-2.0
// Runs of the whole grid: policies share a run only if they take the same steps. Runs with bilateral and
// sliding contacts: told in the terms of the whole problem.

#include "certify/exact/exact.h"

#include <array>
#include <catch2/catch.hpp>
#include <set>

#include "certify/claims/certificate.h"
#include "certify/exact/verify_solution.h"
#include "corpus/json.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// Every policy of the grid run by itself, against the class that speaks for it.
void CheckAgainstBruteForce(const ExactProblem& problem) {
  std::set<std::string> seen;
  int k = 0;
  for (const PolicyClass& equal : RunPolicies(problem, PlanarGrid(), {})) {
    for (const Policy& policy : equal.policies) {
      CAPTURE(PolicyName(policy), PolicyName(equal.policies.front()));
      CHECK(seen.insert(PolicyName(policy)).second);
      if (testing::Short() && k++ % 8 != 0) continue;
      const Verdict verdict = RunExact(problem, {.policy = policy}).verdict;
      REQUIRE(verdict.outcome == equal.verdict.outcome);
      REQUIRE(verdict.start == equal.verdict.start);
      REQUIRE(verdict.period == equal.verdict.period);
      REQUIRE(verdict.statistics == equal.verdict.statistics);
    }
  }
  CHECK(seen.size() == PlanarGrid().size());
}

TEST_CASE("policy classes: on problems that cycle the grid ends as it does policy by policy", "[slow]") {
  CheckAgainstBruteForce(ReferenceProblem());
  for (const CyclingSeed& seed : CyclingSeeds()) {
    CAPTURE(seed.index);
    CheckAgainstBruteForce(Cycling(seed));
  }
}

TEST_CASE("policy classes: on other problems too", "[slow]") {
  CheckAgainstBruteForce(GiveUpProblem());
  CheckAgainstBruteForce(NoContacts());
  CheckAgainstBruteForce(NoSolution());
  for (const int index : {2104, 2202, 2458}) {  // where the order of ties matters
    CheckAgainstBruteForce(Random<Rational>(GeneratorId::kSmall, 3, index));
  }
  for (int index = 0; index < 30; ++index) {
    CAPTURE(index);
    const auto id = index % 2 == 0 ? GeneratorId::kSmall : GeneratorId::kDuplicates;
    CheckAgainstBruteForce(Random<Rational>(id, 2 + index % 2, index));
  }
}

TEST_CASE("policy classes: all end in an outcome if each does") {
  const std::vector<Policy> cycling = {Policy{}, ParsePolicy("ties=contacts"), ParsePolicy("resume=round")};
  CHECK(AllEndIn(Outcome::kCycle, ReferenceProblem(), cycling, {}));
  CHECK_FALSE(AllEndIn(Outcome::kCycle, ReferenceProblem(), PlanarGrid(), {}));
  CHECK(AllEndIn(Outcome::kSolved, ThreeSolutions(), PlanarGrid(), {}));
  CHECK(AllEndIn(Outcome::kSolved, ReferenceProblem(), {}, {}));
}

// readings.md, 7: each drive ends with another clamped set, ties or not, whatever is given up on the way.
TEST_CASE("exact runs: without friction every policy solves within 2^n - 1 drives, degenerate or not") {
  // safe-tie-yet-given-up of the corpus.
  const ExactProblem tie =
      MakeProblem({-1, -1, -1}, {{20, -10, -2}, {-10, 20, 20}, {-2, 20, 40}}, {2, -20, -100});
  const Verdict verdict = RunExact(tie, {.policy = ParsePolicy("apex=suspended")}).verdict;
  CHECK(verdict.outcome == Outcome::kSolved);
  CHECK(verdict.statistics.give_ups == 1);
  CHECK(verdict.statistics.drives == 4);
  for (int index = 0; index < 150; ++index) {
    const int contacts = 2 + index % 4;
    Choices choices(ProblemSeed(1994, 77, static_cast<std::uint64_t>(index)));
    // A = J J', b = J y of rank at most two, of entries -1, 0, 1.
    std::vector<std::vector<Rational>> A(contacts, std::vector<Rational>(contacts));
    std::vector<Rational> b(contacts);
    std::vector<std::array<std::int64_t, 2>> J(contacts);
    const std::array<std::int64_t, 2> y = {choices.Integer(-1, 1), choices.Integer(-1, 1)};
    for (auto& row : J) row = {choices.Integer(-1, 1), choices.Integer(-1, 1)};
    for (int i = 0; i < contacts; ++i) {
      b[i] = J[i][0] * y[0] + J[i][1] * y[1];
      for (int j = 0; j < contacts; ++j) A[i][j] = J[i][0] * J[j][0] + J[i][1] * J[j][1];
    }
    const ExactProblem problem = MakeProblem(std::vector<Rational>(contacts, -1), A, b);
    for (const PolicyClass& equal : RunPolicies(problem, PlanarGrid(), {})) {
      CAPTURE(index, PolicyName(equal.policies.front()));
      CHECK(equal.verdict.outcome == Outcome::kSolved);
      CHECK(equal.verdict.statistics.drives < (1 << contacts));
    }
  }
}

TEST_CASE("variables are named by kind and contact, counted from one") {
  const ExactProblem problem = MakeProblem({-1, 1}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0});
  CHECK(VariableNames(problem) == std::vector<std::string>{"N1", "N2", "F2"});
}

// What every kind of contact keeps at every step of a run: 4.5 and (24).
void CheckKinds(const ExactProblem& problem, const ExactVector& f, const ExactVector& a,
                const std::vector<IndexSet>& sets) {
  REQUIRE(a == problem.A * f + problem.b);
  const auto layout = LayoutOf(problem);
  for (int i = 0; i < layout.ContactCount(); ++i) {
    const Contact<Rational>& contact = problem.contacts[i];
    const int row = layout.NormalRowOf(i);
    if (contact.kind == ContactKind::kBilateral) {
      CHECK(a[row] == 0);
      CHECK(sets[row] == IndexSet::kClamped);
    } else if (contact.kind == ContactKind::kSliding) {
      CHECK(f[row + 1] == -contact.mu * contact.slip[0] * f[row]);
      CHECK(sets[row + 1] == IndexSet::kNone);
    }
    if (sets[row] == IndexSet::kClamped) CHECK(a[row] == 0);
    if (sets[row] == IndexSet::kSeparating) CHECK(f[row] == 0);
  }
}

TEST_CASE("runs with bilateral and sliding contacts: every step in the terms of the whole problem") {
  int ends[kOutcomeCount] = {}, steps = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    CAPTURE(seed);
    const ExactProblem problem = RandomMixed(seed, seed % 2 == 0);
    Choices choices(seed);
    const ExactRun run = RunExact(problem, {.policy = RandomPolicy(choices)});
    ++ends[static_cast<int>(run.verdict.outcome)];
    ExactVector f = run.initial_f;
    for (const Pivot<Rational>& pivot : run.trace.pivots) {
      REQUIRE(pivot.da == problem.A * pivot.df);
      f += pivot.s * pivot.df;
      REQUIRE(pivot.f == f);
      CheckKinds(problem, pivot.f, pivot.a, pivot.sets);
      CHECK(problem.contacts[LayoutOf(problem).ContactOf(pivot.driven)].kind != ContactKind::kBilateral);
      ++steps;
    }
    CHECK(run.f == f);
    CHECK(run.a == problem.A * f + problem.b);
    if (run.verdict.outcome == Outcome::kSolved) CHECK_FALSE(FindViolation(problem, f));
  }
  CHECK(ends[static_cast<int>(Outcome::kSolved)] > 80);
  CHECK(ends[static_cast<int>(Outcome::kRay)] > 0);
  CHECK(steps > 150);
}

TEST_CASE("runs with bilateral contacts: steps and loops of what they leave, under every policy") {
  const ExactProblem problem = ReferenceProblem(), bordered = Bordered(problem);
  const auto classes = RunPolicies(problem, PlanarGrid(), {}), again = RunPolicies(bordered, PlanarGrid(), {});
  REQUIRE(classes.size() == again.size());
  for (std::size_t k = 0; k < classes.size(); ++k) {
    CHECK(classes[k].policies == again[k].policies);
    CHECK(classes[k].verdict.outcome == again[k].verdict.outcome);
    CHECK(classes[k].verdict.statistics == again[k].verdict.statistics);
  }
  const Request round = {.policy = ParsePolicy("resume=round")};
  const ExactRun plain = RunExact(problem, round), run = RunExact(bordered, round);
  CHECK(run.policy == round.policy);
  CHECK(run.last_driven_contact == plain.last_driven_contact + 1);
  CHECK(run.initial_f[0] == Rational(3, 2));
  CHECK(run.initial_f[5] == 0);  // depends on the first
  REQUIRE(run.trace.pivots.size() == plain.trace.pivots.size());
  for (std::size_t k = 0; k < run.trace.pivots.size(); ++k) {
    CHECK(run.trace.pivots[k].s == plain.trace.pivots[k].s);
    CHECK(run.trace.pivots[k].driven == plain.trace.pivots[k].driven + 1);
    CHECK(run.trace.pivots[k].limiting == plain.trace.pivots[k].limiting + 1);
  }
}

TEST_CASE("runs with bilateral contacts: a certificate of a cycle speaks of the whole problem") {
  const ExactProblem bordered = Bordered(ReferenceProblem());
  Json certificate = CycleCertificate(bordered, {Policy{}}, {});
  REQUIRE(certificate.is_object());
  Json& state = certificate["witness"]["runs"][0]["state"];
  CHECK(state["sets"]["N1"] == "C");
  CHECK(state["sets"]["N4"] == "C");
  CHECK(CheckCertificate(certificate, "test").accepted);
  state["f"][0] = "1/1000";
  CHECK_FALSE(CheckCertificate(certificate, "test").accepted);
}

TEST_CASE("bilateral contacts that no forces hold: singular before the first step") {
  ExactProblem problem = MakeProblem({-1, -1}, {{1, 2}, {2, 4}}, {1, 3});
  for (auto& contact : problem.contacts) contact.kind = ContactKind::kBilateral;
  const ExactRun run = RunExact(problem, {});
  CHECK(run.verdict.outcome == Outcome::kSingular);
  CHECK(run.verdict.reason == "no forces keep the bilateral constraints");
  CHECK(run.trace.pivots.empty());
  CHECK(run.a == problem.b);
  CHECK(RunPolicies(problem, PlanarGrid(), {}).size() == 1);
  CHECK(CycleCertificate(problem, {Policy{}}, {})->is_null());
}

}  // namespace
}  // namespace stiction
