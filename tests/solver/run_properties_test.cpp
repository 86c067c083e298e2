// SPDX-License-Identifier: Apache-2.0
// What holds of every run: random problems, random policies.

#include <catch2/catch.hpp>
#include <map>

#include "certify/exact/verify_solution.h"
#include "search/units/signature.h"
#include "solver/published/published.ipp"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

constexpr std::array<GeneratorId, 3> kKinds = {GeneratorId::kIntegers, GeneratorId::kSmall,
                                               GeneratorId::kDuplicates};

// visit(problem, policy) for `count` random pairs, then for the problems that cycle.
template <class Visit>
void ForEachPair(int count, Visit visit) {
  for (int index = 0; index < count; ++index) {
    Choices choices(index);
    CAPTURE(index);
    visit(Random<Rational>(kKinds[index % 3], 1 + index % 4, index), RandomPolicy(choices));
  }
  for (const CyclingSeed& seed : CyclingSeeds()) {
    CAPTURE(seed.index);
    for (const char* policy : {"paper", "resume=round", "resume=round,admit=eager", "file=yes,apex=suspended",
                               "give-up=previous", "give-up=second,drop=variable"}) {
      visit(Cycling(seed), ParsePolicy(policy));
    }
  }
}

// ---- Every step ------------------------------------------------------------------------------

// Whether the variable of `row` keeps what its set asks for (readings.md, 1).
bool IsLegal(const ExactProblem& problem, const RowLayout<Eigen::Dynamic>& layout, const Pivot<Rational>& pivot,
             int row) {
  const Rational &f = pivot.f[row], &a = pivot.a[row];
  const Rational bound = layout.IsNormal(row)
                             ? Rational(0)
                             : Rational(problem.contacts[layout.ContactOf(row)].mu * pivot.f[row - 1]);
  switch (pivot.sets[row]) {
    case IndexSet::kClamped:
      return a == 0 && f >= 0;
    case IndexSet::kSeparating:
      return f == 0 && a >= 0;
    case IndexSet::kSticking:
      return a == 0 && abs(f) <= bound;
    case IndexSet::kAtUpper:
      return f == bound && a <= 0;
    case IndexSet::kAtLower:
      return f == -bound && a >= 0;
    case IndexSet::kSuspended:
      return f == 0;
    case IndexSet::kNone:
      return true;
  }
  return false;
}

TEST_CASE("run: at every step a = A f + b, s >= 0, and what is maintained is legal") {
  int steps = 0, give_ups = 0;
  ForEachPair(6000, [&](const ExactProblem& problem, const Policy& policy) {
    const auto layout = LayoutOf(problem);
    const ExactRun run = RunExact(problem, {.policy = policy});
    ExactVector f = problem.b;
    for (Rational& x : f) x = 0;
    for (const Pivot<Rational>& pivot : run.trace.pivots) {
      CAPTURE(PolicyName(policy), pivot.drive, pivot.driven, pivot.limiting);
      REQUIRE(pivot.s >= 0);
      REQUIRE(abs(pivot.df[pivot.driven]) == 1);
      for (int i = 0; i < problem.rows(); ++i) f[i] += pivot.s * pivot.df[i];
      REQUIRE(pivot.f == f);
      REQUIRE(pivot.a == Accelerations(problem, f));
      REQUIRE(pivot.sets[pivot.limiting] == pivot.to);
      REQUIRE(pivot.to == (pivot.gave_up ? IndexSet::kNone : pivot.wanted));
      for (int row = 0; row < problem.rows(); ++row) REQUIRE(IsLegal(problem, layout, pivot, row));
      ++steps;
      give_ups += pivot.gave_up;
    }
    CHECK(run.f == f);
  });
  CHECK(steps > 6000);
  CHECK(give_ups > 30);
}

// Whether the policy gives a variable up that wants back (5.4, 5.5).
bool GivesUp(GiveUp rule, bool zero, bool zero_before) {
  return rule == GiveUp::kFirst ? zero : rule == GiveUp::kPrevious ? zero_before : zero && zero_before;
}

TEST_CASE("run: a variable is given up exactly when the policy says so, and the counters count the trace") {
  ForEachPair(6000, [&](const ExactProblem& problem, const Policy& policy) {
    const ExactRun run = RunExact(problem, {.policy = policy});
    Statistics counted;
    std::map<int, IndexSet> left;  // in the present drive; of the variables that limited a step
    bool zero_before = false;
    std::int64_t zero_run = 0;
    const Pivot<Rational>* before = nullptr;
    for (const Pivot<Rational>& pivot : run.trace.pivots) {
      CAPTURE(PolicyName(policy), pivot.drive, pivot.limiting);
      if (before == nullptr || pivot.drive != before->drive) {
        left.clear();
        zero_before = false;
        zero_run = 0;
        before = nullptr;
      }
      const bool zero = pivot.s == 0;
      const auto known = left.find(pivot.limiting);
      const bool wants_back =
          pivot.limiting != pivot.driven && known != left.end() && known->second == pivot.wanted;
      REQUIRE(pivot.gave_up == (wants_back && GivesUp(policy.give_up, zero, zero_before)));
      // Sets that changed in this step, partners included.
      for (int row = 0; row < problem.rows(); ++row) {
        const IndexSet old = row == pivot.limiting ? pivot.from
                             : before != nullptr   ? before->sets[row]
                                                   : pivot.sets[row];
        if (old != pivot.sets[row]) left[row] = old;
      }
      ++counted.steps;
      counted.zero_steps += zero;
      zero_run = zero ? zero_run + 1 : 0;
      counted.longest_zero_run = std::max(counted.longest_zero_run, zero_run);
      counted.bounces += wants_back && zero;
      counted.give_ups += pivot.gave_up;
      counted.pivots += pivot.from != pivot.to;
      counted.drives = pivot.drive;
      zero_before = zero;
      before = &pivot;
    }
    const Statistics& statistics = run.verdict.statistics;
    counted.singular_directions = statistics.singular_directions;
    counted.outer_scans = statistics.outer_scans;
    CHECK(counted == statistics);
    CHECK(statistics.outer_scans <= statistics.drives + 1);
  });
}

// ---- How runs end ----------------------------------------------------------------------------

// What recurs at the top of the main loop, before its sweep.
struct OuterState {
  std::vector<IndexSet> sets;
  ExactVector f;
  int contact;  // driven last, where the policy remembers it; otherwise -1

  bool operator==(const OuterState& other) const {
    return sets == other.sets && f == other.f && contact == other.contact;
  }
};

OuterState StateAfter(std::int64_t drives, const ExactProblem& problem, const ExactRun& run) {
  OuterState state{std::vector<IndexSet>(problem.rows(), IndexSet::kNone), problem.b, -1};
  for (Rational& x : state.f) x = 0;
  for (const Pivot<Rational>& pivot : run.trace.pivots) {
    if (pivot.drive > drives) break;
    const bool remembered = run.policy.resume == Resume::kRound;
    state = {pivot.sets, pivot.f, remembered ? LayoutOf(problem).ContactOf(pivot.driven) : -1};
  }
  return state;
}

TEST_CASE("run: a solution meets the conditions, a cycle returns to its state and to no other before") {
  std::map<Outcome, int> outcomes;
  ForEachPair(8000, [&](const ExactProblem& problem, const Policy& policy) {
    CAPTURE(PolicyName(policy));
    const ExactRun run = RunExact(problem, {.policy = policy});
    const Verdict& verdict = run.verdict;
    ++outcomes[verdict.outcome];
    if (verdict.outcome == Outcome::kSolved) CHECK(FindViolation(problem, run.f) == std::nullopt);
    if (verdict.outcome != Outcome::kCycle) return;
    CHECK(verdict.statistics.drives == verdict.start + verdict.period);
    CHECK(StateAfter(verdict.start, problem, run) == StateAfter(verdict.statistics.drives, problem, run));
    if (policy.rezero == Rezero::kContinue) return;  // there two drives can stand between two looks
    for (std::int64_t later = 0; later < verdict.statistics.drives; ++later) {
      for (std::int64_t drives = 0; drives < later; ++drives) {
        CHECK_FALSE(StateAfter(drives, problem, run) == StateAfter(later, problem, run));
      }
    }
  });
  CHECK(outcomes[Outcome::kSolved] > 7000);
  CHECK(outcomes[Outcome::kCycle] >= static_cast<int>(CyclingSeeds().size()));
  CHECK(outcomes[Outcome::kRay] == 0);  // impossible for b in range(A)
}

TEST_CASE("run: no drive ever stalls under any policy, and none is unlimited (readings.md 6)") {
  const auto no_stall = [](const ExactProblem& problem) {
    for (const PolicyClass& equal : RunPolicies(problem, PlanarGrid(), {})) {
      CAPTURE(PolicyName(equal.policies.front()));
      CHECK(equal.verdict.outcome != Outcome::kStall);
      CHECK(equal.verdict.outcome != Outcome::kRay);
    }
  };
  for (int index = 0; index < 400; ++index) {
    CAPTURE(index);
    no_stall(Random<Rational>(kKinds[index % 3], 2 + index % 3, index));
  }
  for (const CyclingSeed& seed : CyclingSeeds()) no_stall(Cycling(seed));
}

// ---- Equivalent problems ---------------------------------------------------------------------

// Runs take the same steps: limiting variables, sets, and lengths up to the unit of the driven force.
void CheckSameSteps(const ExactRun& run, const ExactRun& other, const std::vector<Rational>& unit) {
  REQUIRE(other.verdict.outcome == run.verdict.outcome);
  REQUIRE(other.verdict.statistics == run.verdict.statistics);
  REQUIRE(other.verdict.start == run.verdict.start);
  REQUIRE(other.verdict.period == run.verdict.period);
  for (std::size_t k = 0; k < run.trace.pivots.size(); ++k) {
    const Pivot<Rational>&left = run.trace.pivots[k], &right = other.trace.pivots[k];
    REQUIRE(left.driven == right.driven);
    REQUIRE(left.limiting == right.limiting);
    REQUIRE(left.sets == right.sets);
    REQUIRE(right.s * unit[left.driven] == left.s);
  }
  for (std::size_t i = 0; i < unit.size(); ++i) CHECK(other.f[i] * unit[i] == run.f[i]);
}

TEST_CASE("run: scaling b scales the forces and every step, under every policy") {
  ForEachPair(4000, [](const ExactProblem& problem, const Policy& policy) {
    CAPTURE(PolicyName(policy));
    ExactProblem scaled = problem;
    for (Rational& x : scaled.b) x *= Rational(3, 7);
    CheckSameSteps(RunExact(problem, {.policy = policy}), RunExact(scaled, {.policy = policy}),
                   std::vector<Rational>(problem.rows(), Rational(7, 3)));
  });
}

TEST_CASE("run: other units for each force change no step, unless the scan compares accelerations") {
  ForEachPair(4000, [](const ExactProblem& problem, Policy policy) {
    if (policy.scan == Scan::kMostViolated) policy.scan = Scan::kLowest;
    CAPTURE(PolicyName(policy));
    std::vector<Rational> unit;
    for (int i = 0; i < problem.rows(); ++i) unit.push_back(Rational(1 + i % 3) / (1 + i % 2));
    CheckSameSteps(RunExact(problem, {.policy = policy}), RunExact(InUnits(problem, unit), {.policy = policy}),
                   unit);
  });
}

TEST_CASE("run: turning tangents round turns friction round, with ties by contact") {
  ForEachPair(4000, [](const ExactProblem& problem, Policy policy) {
    policy.ties = Ties::kContacts;  // NC- stands before NC+ under ties=sets
    CAPTURE(PolicyName(policy));
    std::vector<Rational> turn;
    for (int i = 0; i < problem.rows(); ++i) turn.push_back(i % 4 == 1 ? -1 : 1);
    const ExactRun run = RunExact(problem, {.policy = policy}),
                   turned = RunExact(InUnits(problem, turn), {.policy = policy});
    REQUIRE(turned.verdict.statistics == run.verdict.statistics);
    REQUIRE(turned.verdict.outcome == run.verdict.outcome);
    for (std::size_t i = 0; i < turn.size(); ++i) CHECK(turned.f[i] * turn[i] == run.f[i]);
  });
}

TEST_CASE("run: contacts in the opposite order, scanned in the opposite order, take the same steps") {
  // Of numbers of many digits no two contacts limit a step together.
  for (int index = 0; index < 300; ++index) {
    CAPTURE(index);
    const ExactProblem problem = Random<Rational>(GeneratorId::kPsd, 2 + index % 3, index);
    std::vector<int> rows;
    const ExactProblem reversed = Reversed(problem, &rows);
    const ExactRun run = RunExact(problem, {});
    const ExactRun other = RunExact(reversed, {.policy = ParsePolicy("scan=highest")});
    REQUIRE(other.verdict.statistics == run.verdict.statistics);
    for (std::size_t i = 0; i < rows.size(); ++i) CHECK(other.f[i] == run.f[rows[i]]);
  }
}

// ---- One algorithm, many forms ---------------------------------------------------------------

template <int Rows>
void CheckFixedSize(GeneratorId id, int count) {
  PublishedAlgorithm<double, Rows> fixed;
  PublishedAlgorithm<double> dynamic;
  for (int index = 0; index < count; ++index) {
    CAPTURE(Rows, index);
    Choices choices(index);
    fixed.request().policy = dynamic.request().policy = RandomPolicy(choices);
    const auto small = Random<double, Rows>(id, Rows / 2, index);
    const auto problem = Random<double>(id, Rows / 2, index);
    const Verdict left = fixed.Run(small), right = dynamic.Run(problem);
    REQUIRE(left.outcome == right.outcome);
    REQUIRE(left.statistics == right.statistics);
    REQUIRE(left.start == right.start);
    REQUIRE(left.period == right.period);
    for (int i = 0; i < Rows; ++i) REQUIRE(fixed.state().f[i] == dynamic.state().f[i]);
  }
}

TEST_CASE("run: fixed sizes and any size give the same verdict, statistics and forces over doubles") {
  for (const GeneratorId id : {GeneratorId::kIntegers, GeneratorId::kNearDegenerate, GeneratorId::kBodies}) {
    CheckFixedSize<2>(id, 1000);
    CheckFixedSize<4>(id, 2000);
    CheckFixedSize<6>(id, 1000);
    CheckFixedSize<8>(id, 500);
  }
}

TEMPLATE_TEST_CASE("run: tracing changes nothing, nor does what the object ran before", "", float, double,
                   Rational) {
  PublishedAlgorithm<TestType> used;
  for (int index = 0; index < 300; ++index) {
    CAPTURE(index);
    Choices choices(index);
    const auto problem = As<TestType>(Random<Rational>(kKinds[index % 3], 1 + index % 4, index));
    const Request request{.policy = RandomPolicy(choices)};
    used.request() = request;
    Trace<TestType> all, consulted;
    consulted.keep_pivots = false;
    PublishedAlgorithm<TestType> traced(request), untraced(request);
    const Verdict expected = untraced.Run(problem);
    for (const Verdict& verdict : {traced.Run(problem, &all), used.Run(problem, &consulted)}) {
      CHECK(verdict.outcome == expected.outcome);
      CHECK(verdict.statistics == expected.statistics);
    }
    CHECK(traced.state().f == untraced.state().f);
    CHECK(used.state().f == untraced.state().f);
    CHECK(all.pivots.size() == static_cast<std::size_t>(expected.statistics.steps));
    CHECK(consulted.pivots.empty());
    CHECK(consulted.consulted == all.consulted);
  }
}

TEMPLATE_TEST_CASE("run: inexact arithmetic agrees with exact arithmetic on small integers", "", double) {
  int agree = 0;
  constexpr int kCount = 1000;
  for (int index = 0; index < kCount; ++index) {
    const ExactProblem problem = Random<Rational>(kKinds[index % 3], 1 + index % 3, index);
    PublishedAlgorithm<TestType> algorithm;
    const Verdict verdict = algorithm.Run(As<TestType>(problem)), exact = RunExact(problem, {}).verdict;
    agree += verdict.outcome == exact.outcome && verdict.statistics == exact.statistics;
  }
  CHECK(agree > kCount * 99 / 100);
}

}  // namespace
}  // namespace stiction
