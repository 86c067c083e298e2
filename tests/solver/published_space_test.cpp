// SPDX-License-Identifier: Apache-2.0
// The published algorithm in space (readings.md, 8): examples by hand, planar problems in space, random ones.

#include "certify/exact/published_space.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "certify/request/solve_in.h"
#include "solver/problem/errors.h"
#include "solver/published/published.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

constexpr Slip kSlips[] = {Slip::kLiteral, Slip::kRedirect};

Request Reading(Slip slip) { return {.policy = {.slip = slip}}; }

ExactProblem InSpace(const std::vector<Rational>& mu, const std::vector<std::vector<Rational>>& A,
                     const std::vector<Rational>& b) {
  ExactProblem problem = MakeProblem(mu, A, b);
  problem.dimension = 3;
  return problem;
}

ExactProblem OneContact(const Rational& mu, const std::vector<Rational>& b) {
  return InSpace({mu}, {{2, 0, 0}, {0, 1, 0}, {0, 0, 1}}, b);
}

struct Ended {
  Verdict verdict;
  Counters counters;
  SpaceTrace<double> trace;
  Eigen::VectorXd f, a;
};

Ended Run(const ExactProblem& problem, const Request& request) {
  PublishedInSpace<double> algorithm(request);
  Ended ended;
  const auto rounded = As<double>(problem);
  ended.verdict = algorithm.Run(rounded, &ended.trace);
  ended.counters = algorithm.counters();
  ended.f = algorithm.f();
  ended.a = rounded.A * ended.f + rounded.b;
  CHECK((ended.a - algorithm.a()).norm() <= 1e-9 * (1 + rounded.b.norm()));
  return ended;
}

void CheckNear(const Eigen::VectorXd& found, const std::vector<double>& expected) {
  REQUIRE(found.size() == static_cast<int>(expected.size()));
  for (int i = 0; i < found.size(); ++i) CHECK(found[i] == Approx(expected[i]).margin(1e-12));
}

void CheckForces(const Ended& ended, const std::vector<double>& f) {
  CHECK(ended.verdict.outcome == Outcome::kSolved);
  CheckNear(ended.f, f);
}

// ---- One contact -----------------------------------------------------------------------------

TEST_CASE("space: a contact pushed less than its limit sticks, x established before y") {
  for (const Slip slip : kSlips) {
    const Ended ended = Run(OneContact(2, {-2, -1, 1}), Reading(slip));
    CheckForces(ended, {1, 1, -1});
    REQUIRE(ended.trace.size() == 3);
    CheckNear(ended.trace[1].f, {1, 1, 0});
    CHECK(ended.trace[2].sets ==
          std::vector<IndexSet>{IndexSet::kClamped, IndexSet::kSticking, IndexSet::kSticking});
    CHECK(ended.verdict.statistics.drives == 3);
  }
}

TEST_CASE("space: at its limit in x a contact is done, and y is not driven") {
  const Ended ended = Run(OneContact(Rational(1, 2), {-2, 1, -1}), {});
  CheckForces(ended, {1, -0.5, 0});  // fF.aF = -1/4, though aF = (1/2, -1) is not opposite to it
  CHECK(ended.trace.back().sets ==
        std::vector<IndexSet>{IndexSet::kClamped, IndexSet::kAtUpper, IndexSet::kNone});
  CHECK(ended.verdict.statistics.drives == 2);
}

TEST_CASE("space: the circle (23) ends the drive of y") {
  const Ended ended = Run(OneContact(Rational(5, 4), {-2, -1, -1}), {});
  CheckForces(ended, {1, 1, 0.75});
  CHECK(ended.trace.back().s == Approx(0.75));
  CHECK(ended.trace.back().sets[1] == IndexSet::kAtUpper);
}

TEST_CASE("space: with ax = 0 from the start only y is driven, with aF = 0 nothing is") {
  CHECK(Run(OneContact(2, {-2, 0, 1}), {}).verdict.statistics.drives == 2);
  CheckForces(Run(OneContact(2, {-2, 0, 1}), {}), {1, 0, -1});
  CHECK(Run(OneContact(2, {-2, 0, 0}), {}).verdict.statistics.drives == 1);
}

// Sticking at f = (5/4, 3/5, 0), contact 1 is moved by contact 2 along (5/4 - s/4, 3/5, 4 s/5), which meets its
// circle at s = 1.
TEST_CASE("space: a sticking contact leaves by the quadratic step (23) and keeps its direction") {
  const ExactProblem problem = InSpace({1, -1},
                                       {{1, 0, 0, Rational(1, 4)},
                                        {0, 1, 0, 0},
                                        {0, 0, 1, Rational(-4, 5)},
                                        {Rational(1, 4), 0, Rational(-4, 5), 3}},
                                       {Rational(-5, 4), Rational(-3, 5), 0, -10});
  for (const Slip slip : kSlips) {
    const Ended ended = Run(problem, Reading(slip));
    REQUIRE(ended.trace.size() >= 4);
    const Pivot<double>& leaves = ended.trace[ended.trace.size() - 2];
    CHECK(leaves.limiting == 1);
    CHECK(leaves.from == IndexSet::kSticking);
    CHECK(leaves.to == IndexSet::kAtUpper);
    CHECK(leaves.s == Approx(1));
    CheckNear(leaves.f, {1, 0.6, 0.8, 1});
    CHECK(ended.verdict.outcome == Outcome::kSolved);
    CHECK(ended.f[2] / ended.f[1] == Approx(4.0 / 3));
    CHECK(std::hypot(ended.f[1], ended.f[2]) == Approx(ended.f[0]));
  }
}

// While contact 3 is driven, fN of contact 2 in C and aN of contact 1 in NC reach zero at s = 1.
TEST_CASE("space: ties follow the switch") {
  const ExactProblem problem = InSpace({-1, -1, -1}, {{1, 0, -1}, {0, 1, 1}, {-1, 1, 10}}, {1, -1, -100});
  Request request;
  request.policy.admit = Admit::kEager;
  for (const Ties ties : {Ties::kSets, Ties::kContacts}) {
    request.policy.ties = ties;
    const Ended ended = Run(problem, request);
    REQUIRE(ended.trace.size() > 2);
    CHECK(ended.trace[1].s == Approx(1));
    CHECK(ended.trace[1].limiting == (ties == Ties::kSets ? 1 : 0));
  }
}

// ---- Two readings of the recorded direction ---------------------------------------------------

// Contact 1 slips with d = (-1, 0) while fN of contact 2 is driven, and ax of contact 1 reaches zero at 2/3 of
// the way, with ay = 1.
ExactProblem Turning() {
  return InSpace({1, 1},
                 {{4, 0, 0, -1, 0, 0},
                  {0, 3, 0, 0, 0, 0},
                  {0, 0, 1, 0, 0, 0},
                  {-1, 0, 0, 3, 0, 0},
                  {0, 0, 0, 0, 2, 0},
                  {0, 0, 0, 0, 0, 1}},
                 {-2, 2, 1, -2, -1, 0});
}

TEST_CASE("space: slip=literal passes d.aF = 0, and drives the contact anew once the sets are full") {
  const Ended ended = Run(Turning(), Reading(Slip::kLiteral));
  CHECK(ended.trace[2].s == Approx(10.0 / 11));
  CHECK(ended.counters[Counter::kBreaks] == 1);
  CHECK(ended.counters[Counter::kRedirects] == 0);
  // To zero, then x until ax = 0, then y until the circle.
  CheckForces(ended, {8.0 / 11, -2.0 / 3, -std::sqrt(92.0) / 33, 10.0 / 11, 0.5, 0});
}

TEST_CASE("space: slip=redirect gives the contact up at d.aF = 0 and drives it against its acceleration") {
  const Ended ended = Run(Turning(), Reading(Slip::kRedirect));
  CHECK(ended.trace[2].s == Approx(2.0 / 3));
  CHECK(ended.trace[2].limiting == 1);
  CHECK(ended.trace[2].to == IndexSet::kNone);
  CHECK(ended.counters[Counter::kRedirects] == 1);
  CHECK(ended.counters[Counter::kBreaks] == 0);
  CHECK(ended.verdict.statistics.give_ups == 0);
  const double along = -8 / (11 * std::sqrt(5.0));
  CheckForces(ended, {8.0 / 11, 2 * along, along, 10.0 / 11, 0.5, 0});
}

TEST_CASE(
    "space: literally, forces of a definite static problem can be driven without end, intervals prove it") {
  const ExactProblem problem = InSpace({2, 2},
                                       {{2, 0, 0, -1, 0, 1},
                                        {0, 3, 0, 1, 0, 0},
                                        {0, 0, 1, 0, 0, 0},
                                        {-1, 1, 0, 4, 2, -1},
                                        {0, 0, 0, 2, 4, 0},
                                        {1, 0, 0, -1, 0, 2}},
                                       {-2, -2, 2, 0, 2, 1});
  CHECK(Run(problem, Reading(Slip::kLiteral)).verdict.outcome == Outcome::kRay);
  CHECK(RunIntervalsInSpace(problem, Reading(Slip::kLiteral)).outcome == Outcome::kRay);
  CHECK(RunIntervalsInSpace(problem, Reading(Slip::kRedirect)).outcome == Outcome::kSolved);
}

// Run again over quad where doubles do not solve.
InexactAnswer SolveInDoubles(const ExactProblem& problem, Request request) {
  request.method = "baraff";
  request.arithmetic = Arithmetic::kDouble;
  request.trace = true;
  return std::get<InexactAnswer>(SolveIn(problem, request).answer);
}

TEST_CASE("space: both readings loop on a definite problem: a suspicion, over intervals proved") {
  const ExactProblem problem = InSpace({3, 3},
                                       {{3, 0, 0, 0, 0, 1},
                                        {0, 3, 1, 0, 1, -1},
                                        {0, 1, 3, -1, 1, 0},
                                        {0, 0, -1, 2, 0, 0},
                                        {0, 1, 1, 0, 3, 0},
                                        {1, -1, 0, 0, 0, 3}},
                                       {-1, 2, 0, -1, -2, 1});
  for (const Slip slip : kSlips) {
    const Verdict verdict = Run(problem, Reading(slip)).verdict;
    CHECK(verdict.outcome == Outcome::kCycle);
    const InexactAnswer again = SolveInDoubles(problem, Reading(slip));
    CHECK(again.arithmetic == Arithmetic::kDouble);  // as asked, though it was run again
    CHECK(again.outcome == Outcome::kCycle);
    CHECK(again.start == verdict.start);
    CHECK(again.period == verdict.period);
    const InexactAnswer proved = RunIntervalsInSpace(problem, Reading(slip));
    CHECK(proved.outcome == Outcome::kCycle);
    CHECK(proved.period == verdict.period);
  }
}

// ---- Planar problems in space ------------------------------------------------------------------

// x for the friction of the plane; y has rows of its own, and nothing moves it.
ExactProblem Embedded(const ExactProblem& planar) {
  ExactProblem problem = planar;
  problem.dimension = 3;
  const int n = static_cast<int>(planar.contacts.size());
  problem.A = ExactMatrix::Constant(3 * n, 3 * n, Rational(0));
  problem.b = ExactVector::Constant(3 * n, Rational(0));
  const auto place = [](int row) { return row / 2 * 3 + row % 2; };
  for (int i = 0; i < 2 * n; ++i) {
    problem.b[place(i)] = planar.b[i];
    for (int j = 0; j < 2 * n; ++j) problem.A(place(i), place(j)) = planar.A(i, j);
  }
  for (int contact = 0; contact < n; ++contact)
    problem.A(3 * contact + 2, 3 * contact + 2) = planar.A(2 * contact + 1, 2 * contact + 1);
  return problem;
}

// Whether a friction variable goes from NC- through CF to NC+, or back, by a step of length zero or right after
// one. In space that is back to the set that it came from, NCF, and looks like a bounce.
bool PassesThroughSticking(const Trace<Rational>& trace) {
  for (std::size_t i = 0; i < trace.pivots.size(); ++i) {
    const Pivot<Rational>& first = trace.pivots[i];
    if (LimitSign(first.from) == 0) continue;
    for (std::size_t k = i + 1; k < trace.pivots.size() && trace.pivots[k].drive == first.drive; ++k) {
      const Pivot<Rational>& pivot = trace.pivots[k];
      if (pivot.limiting != first.limiting || LimitSign(pivot.wanted) != -LimitSign(first.from)) continue;
      if (pivot.s == 0 || trace.pivots[k - 1].s == 0) return true;
    }
  }
  return false;
}

// False if the plane has a distinction that space has not.
bool CheckAsInThePlane(const ExactProblem& planar, const Policy& policy) {
  CAPTURE(PolicyName(policy));
  const ExactRun plane = RunExact(planar, {.policy = policy});
  const Verdict& expected = plane.verdict;
  if (PassesThroughSticking(plane.trace)) return false;
  const Ended ended = Run(Embedded(planar), {.policy = policy});
  CHECK(ended.verdict.outcome == expected.outcome);
  CHECK(ended.verdict.start == expected.start);
  CHECK(ended.verdict.period == expected.period);
  CHECK(ended.verdict.statistics == expected.statistics);
  CHECK(ended.counters[Counter::kRedirects] == 0);
  CHECK(ended.counters[Counter::kBreaks] == 0);
  for (int i = 0; i < planar.rows(); ++i)
    CHECK(ended.f[i / 2 * 3 + i % 2] == Approx(ToDouble(plane.f[i])).margin(1e-6));
  return true;
}

// With the readings that are built for space.
Policy RandomReading(Choices& choices) {
  Policy policy = RandomPolicy(choices);
  policy.file = File::kNo;
  policy.apex = Apex::kKept;
  policy.slip = kSlips[choices.Integer(0, 1)];
  return policy;
}

TEST_CASE("space: a planar problem takes the steps that it takes in the plane, under every policy") {
  Choices choices(56);
  int compared = 0;
  for (int k = 0; k < 600; ++k) {
    const GeneratorId ids[] = {GeneratorId::kIntegers, GeneratorId::kPsd, GeneratorId::kSmall};
    compared += CheckAsInThePlane(Random<Rational>(ids[k % 3], 1 + k % 4, k), RandomReading(choices));
  }
  CHECK(compared >= 560);
}

TEST_CASE("space: intervals take the steps of exact arithmetic, bounces too, or are undecided") {
  int bounced = 0, decided = 0;
  for (int k = 0; k < 2000; ++k) {
    const ExactProblem planar = Random<Rational>(GeneratorId::kIntegers, 2 + k % 3, k);
    if (PublishedAlgorithm<double>().Run(As<double>(planar)).statistics.bounces == 0) continue;
    const ExactRun plane = RunExact(planar, {});
    const InexactAnswer verdict = RunIntervalsInSpace(Embedded(planar), {});
    ++bounced;
    if (verdict.outcome == Outcome::kUndecided || PassesThroughSticking(plane.trace)) continue;
    ++decided;
    CAPTURE(k);
    CHECK(verdict.outcome == plane.verdict.outcome);
    CountersOf(plane.verdict.statistics).ForEach([&](Counter c, std::int64_t value) {
      CAPTURE(Name(c));
      CHECK(verdict.counters[c] == value);
    });
  }
  CHECK(bounced >= 15);
  CHECK(decided >= bounced / 2);
}

TEST_CASE("space: what loops in the plane loops in space") {
  Choices choices(57);
  int compared = 0;
  for (const Slip slip : kSlips) {
    Policy policy;
    policy.slip = slip;
    CHECK(CheckAsInThePlane(ReferenceProblem(), policy));
    for (const CyclingSeed& seed : CyclingSeeds()) compared += CheckAsInThePlane(Cycling(seed), policy);
  }
  CHECK(compared >= static_cast<int>(CyclingSeeds().size()));
  for (const CyclingSeed& seed : CyclingSeeds()) CheckAsInThePlane(Cycling(seed), RandomReading(choices));
}

TEST_CASE("space: loops of the plane are proved there, where no sign is a tie") {
  int proved = 0;
  for (const CyclingSeed& seed : CyclingSeeds()) {
    const ExactProblem planar = Cycling(seed);
    const ExactRun plane = RunExact(planar, {});
    const InexactAnswer verdict = RunIntervalsInSpace(Embedded(planar), {});
    if (verdict.outcome == Outcome::kUndecided) continue;
    ++proved;
    CHECK(verdict.outcome == Outcome::kCycle);
    CHECK(verdict.period == plane.verdict.period);
    CHECK(verdict.start >= plane.verdict.start);
  }
  CHECK(proved > 0);
}

// ---- Random problems -----------------------------------------------------------------------------

ExactProblem RandomInSpace(int contacts, std::uint64_t index) {
  Choices choices(ProblemSeed(56, contacts, index));
  const int rows = 3 * contacts, columns = rows + 1;
  ExactMatrix J(rows, columns), w(columns, 1);
  for (auto& entry : J.reshaped()) entry = choices.Integer(-1000, 1000);
  for (auto& entry : w.reshaped()) entry = choices.Integer(-1000, 1000);
  const Rational mu[] = {Rational(1, 5), Rational(1, 2), 1, 2, 5};
  ExactProblem problem;
  problem.dimension = 3;
  problem.contacts.assign(contacts, {ContactKind::kStatic, mu[index % 5], {}});
  if (index % 4 == 3) problem.contacts.back().kind = ContactKind::kFrictionless;
  const int kept = RowCount(problem.contacts, 3);
  problem.A = (J * J.transpose()).eval().topLeftCorner(kept, kept);
  problem.b = (J * w).eval().topRows(kept);
  return problem;
}

TEST_CASE("space: solved means (15), (21), (22), over doubles and over intervals") {
  Choices choices(58);
  int solved = 0, proved = 0;
  for (int k = 0; k < 400; ++k) {
    const ExactProblem problem = RandomInSpace(1 + k % 4, k);
    const Request request{.policy = RandomReading(choices)};
    CAPTURE(k, PolicyName(request.policy));
    const Ended ended = Run(problem, request);
    const InexactAnswer enclosed = RunIntervalsInSpace(problem, request);
    if (ended.verdict.outcome == Outcome::kSolved) {
      ++solved;
      CHECK(WeakErrorOf(As<double>(problem), ended.f, ended.a) < 1e-9);
    }
    if (enclosed.outcome == Outcome::kUndecided) continue;
    ++proved;
    CHECK(enclosed.outcome == ended.verdict.outcome);
    if (enclosed.outcome == Outcome::kCycle) continue;  // perhaps proved by another run, with more bits
    CHECK(enclosed.counters == ended.counters);
    for (int i = 0; i < problem.rows(); ++i) {
      CHECK(enclosed.f_enclosed[i].low <= enclosed.f_enclosed[i].high);
      CHECK(ended.f[i] == Approx((enclosed.f_enclosed[i].low + enclosed.f_enclosed[i].high) / 2).margin(1e-9));
    }
  }
  CHECK(solved >= 380);
  CHECK(proved >= 380);
}

// ---- Frames --------------------------------------------------------------------------------------

// Friction of all contacts in the axes (c, s), (-s, c) h; h = -1 mirrors.
ExactProblem InAxes(const ExactProblem& problem, const Rational& c, const Rational& s, int h, ExactMatrix& Q) {
  Q = ExactMatrix::Constant(problem.rows(), problem.rows(), Rational(0));
  int row = 0;
  for (const auto& contact : problem.contacts) {
    Q(row, row) = 1;
    if (contact.HasFrictionRows()) {
      Q(row + 1, row + 1) = c;
      Q(row + 1, row + 2) = s;
      Q(row + 2, row + 1) = -s * h;
      Q(row + 2, row + 2) = c * h;
    }
    row += contact.HasFrictionRows() ? 3 : 1;
  }
  ExactProblem other = problem;
  other.A = Q * problem.A * Q.transpose();
  other.b = Q * problem.b;
  return other;
}

Eigen::VectorXd TurnedBack(const ExactMatrix& Q, const Eigen::VectorXd& f) {
  return Q.unaryExpr([](const Rational& x) { return ToDouble(x); }).transpose() * f;
}

TEST_CASE("space: turned axes may lead elsewhere, and there too to a solution") {
  int differ = 0, both = 0;
  for (int k = 0; k < 200; ++k) {
    const ExactProblem problem = RandomInSpace(1 + k % 3, k);
    ExactMatrix Q;
    const ExactProblem turned = InAxes(problem, Rational(3, 5), Rational(4, 5), 1, Q);
    for (const Slip slip : kSlips) {
      const Ended here = Run(problem, Reading(slip)), there = Run(turned, Reading(slip));
      if (here.verdict.outcome != Outcome::kSolved || there.verdict.outcome != Outcome::kSolved) continue;
      ++both;
      const auto rounded = As<double>(problem);
      const Eigen::VectorXd f = TurnedBack(Q, there.f), a = rounded.A * f + rounded.b;
      CHECK(WeakErrorOf(rounded, f, a) < 1e-9);
      differ += (f - here.f).norm() > 1e-6 * (1 + f.norm());
    }
  }
  CHECK(both >= 380);
  CHECK(differ >= 40);
}

TEST_CASE("space: mirrored axes change nothing, and what sticks does not ask for axes") {
  for (int k = 0; k < 100; ++k) {
    const ExactProblem problem = RandomInSpace(1 + k % 3, k);
    ExactMatrix Q;
    const ExactProblem mirrored = InAxes(problem, -1, 0, k % 2 == 0 ? 1 : -1, Q);
    for (const Slip slip : kSlips) {
      const Ended here = Run(problem, Reading(slip)), there = Run(mirrored, Reading(slip));
      CHECK(here.verdict.outcome == there.verdict.outcome);
      CHECK(here.verdict.statistics == there.verdict.statistics);
      CHECK((TurnedBack(Q, there.f) - here.f).norm() < 1e-8 * (1 + here.f.norm()));
    }
  }
  ExactMatrix Q;
  const ExactProblem turned = InAxes(OneContact(2, {-2, -1, 1}), Rational(3, 5), Rational(4, 5), 1, Q);
  CheckNear(TurnedBack(Q, Run(turned, {}).f), {1, 1, -1});
}

// ---- How runs end --------------------------------------------------------------------------------

TEST_CASE("space: no contacts, budgets, and what is no number") {
  ExactProblem none = NoContacts();
  none.dimension = 3;
  CHECK(Run(none, {}).verdict.outcome == Outcome::kSolved);
  const Verdict verdict = PublishedInSpace<double>({.limits = {.drives = 2}}).Run(As<double>(Turning()));
  CHECK(verdict.outcome == Outcome::kLimit);
  CHECK(verdict.reason == "drives");
  ContactProblem<double> broken = As<double>(Turning());
  broken.A(0, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK(PublishedInSpace<double>().Run(broken).outcome == Outcome::kUndecided);
}

// ---- Bilateral and sliding contacts: 4.5, 6 ----------------------------------------------------

TEST_CASE("space: bilateral contacts leave the steps of the rest as they are") {
  for (const char* slip : {"slip=literal", "slip=redirect"}) {
    const Request request{.policy = ParsePolicy(slip)};
    const ExactProblem problem = Turning(), bordered = Bordered(problem);
    const InexactAnswer plain = SolveInDoubles(problem, request);
    const InexactAnswer run = SolveInDoubles(bordered, request);
    CHECK(run.outcome == plain.outcome);
    CHECK(run.counters == plain.counters);
    CHECK(run.residual() < 1e-12);
    REQUIRE(run.pivots.size() == plain.pivots.size());
    const Eigen::MatrixXd A = As<double>(bordered).A;
    const Eigen::VectorXd b = As<double>(bordered).b;
    CHECK(run.first_f.norm() > 0.5);
    CHECK(std::abs((A * run.first_f + b)[0]) < 1e-12);
    for (std::size_t k = 0; k < run.pivots.size(); ++k) {
      const Pivot<double>& pivot = run.pivots[k];
      CHECK(pivot.s == plain.pivots[k].s);
      CHECK(pivot.driven == plain.pivots[k].driven + 1);
      CHECK((pivot.a - A * pivot.f - b).norm() < 1e-9);
      CHECK((pivot.da - A * pivot.df).norm() < 1e-9);
      CHECK(std::abs(pivot.a[0]) < 1e-12);
      CHECK(pivot.sets.front() == IndexSet::kClamped);
      CHECK(pivot.sets.back() == IndexSet::kClamped);
      REQUIRE(pivot.recorded.size() == bordered.contacts.size());
      for (std::size_t i = 0; i < problem.contacts.size(); ++i)
        CHECK(pivot.recorded[i + 1] == plain.pivots[k].recorded[i]);
    }
  }
}

TEST_CASE("space: the recorded direction is that of the friction force in NCF") {
  int recorded = 0;
  const InexactAnswer run = SolveInDoubles(Turning(), {});
  const auto layout = [] {
    RowLayout<Eigen::Dynamic> result;
    result.Assign(Turning().contacts, 3);
    return result;
  }();
  Eigen::VectorXd f = run.first_f;
  for (const Pivot<double>& pivot : run.pivots) {
    f += pivot.s * pivot.df;
    CHECK((pivot.f - f).norm() < 1e-9);
    for (int i = 0; i < layout.ContactCount(); ++i) {
      const int row = layout.NormalRowOf(i) + 1;
      const auto& d = pivot.recorded[i];
      if (pivot.sets[row] != IndexSet::kAtUpper) continue;
      ++recorded;
      CHECK(std::hypot(d[0], d[1]) == Approx(1));
      CHECK(d[0] * f[row + 1] - d[1] * f[row] == Approx(0).margin(1e-9));
      CHECK(d[0] * f[row] + d[1] * f[row + 1] >= -1e-12);
    }
  }
  CHECK(recorded > 0);
}

TEST_CASE("space: of loops that doubles suspect intervals prove most, and deny none", "[slow]") {
  int suspected = 0, proved = 0;
  for (int k = 0; k < 4000; ++k) {
    const ExactProblem problem = RandomInSpace(2 + k % 2, 5 * (k / 2) + 2 + k % 3);  // mu 1, 2, 5
    for (const Slip slip : kSlips) {
      const Ended ended = Run(problem, Reading(slip));
      if (ended.verdict.outcome != Outcome::kCycle) continue;
      ++suspected;
      const InexactAnswer verdict = RunIntervalsInSpace(problem, Reading(slip));
      CAPTURE(k, static_cast<int>(slip));
      CHECK((verdict.outcome == Outcome::kCycle || verdict.outcome == Outcome::kUndecided));
      if (verdict.outcome != Outcome::kCycle) continue;
      ++proved;
      CHECK(verdict.period == ended.verdict.period);
    }
  }
  CHECK(suspected >= 30);
  CHECK(proved >= 4 * suspected / 5);
}

TEST_CASE("space: a sliding contact has friction against its slip, and can have an infinite step") {
  ExactProblem problem = InSpace({1}, {{4, 2, 0}, {2, 4, 1}, {0, 1, 3}}, {-3, 1, 2});
  problem.contacts[0] = {ContactKind::kSliding, 1, {Rational(3, 5), Rational(4, 5)}};
  const InexactAnswer run = SolveInDoubles(problem, {});
  CHECK(run.outcome == Outcome::kSolved);  // aN = (4 - 6/5) fN - 3
  CHECK(run.f[0] == Approx(15.0 / 14));
  CHECK(run.f[1] == Approx(-9.0 / 14));
  CHECK(run.f[2] == Approx(-12.0 / 14));
  CHECK(run.residual() < 1e-12);
  const InexactAnswer proved = RunIntervalsInSpace(problem, {});
  CHECK(proved.outcome == Outcome::kSolved);
  for (int row = 0; row < 3; ++row) {
    CHECK(proved.f_enclosed[row].low <= run.f[row] + 1e-12);
    CHECK(proved.f_enclosed[row].high >= run.f[row] - 1e-12);
  }
  problem.contacts[0].mu = 4;  // aN = (4 - 24/5) fN - 3
  const InexactAnswer ray = RunIntervalsInSpace(problem, {});
  CHECK(ray.outcome == Outcome::kRay);
  REQUIRE(ray.ray.size() == 3);
  CHECK(ray.ray[1] == Approx(-12.0 / 5));
  CHECK(ray.ray[2] == Approx(-16.0 / 5));
}

TEST_CASE("space: bilateral contacts that no forces hold are singular") {
  ExactProblem problem = MakeProblem({-1, -1}, {{1, 2}, {2, 4}}, {1, 3});
  for (auto& contact : problem.contacts) contact.kind = ContactKind::kBilateral;
  problem.dimension = 3;
  CHECK(SolveInDoubles(problem, {}).outcome == Outcome::kSingular);
  const InexactAnswer run = RunIntervalsInSpace(problem, {});
  CHECK(run.outcome == Outcome::kSingular);
  CHECK(run.a_enclosed[1].low == 3);
}

TEST_CASE("weak residual: bilateral and sliding contacts") {
  ExactProblem exact = InSpace({1}, {{2, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {-2, 0, 0});
  exact.contacts[0] = {ContactKind::kSliding, Rational(1, 2), {Rational(0), Rational(1)}};
  auto problem = As<double>(exact);
  problem.contacts[0].slip = {0, 1};
  const auto residual = [&problem](const std::vector<double>& f) {
    const Eigen::VectorXd forces = Eigen::Map<const Eigen::VectorXd>(f.data(), static_cast<int>(f.size()));
    return WeakErrorOf(problem, forces, Eigen::VectorXd(problem.A * forces + problem.b));
  };
  CHECK(residual({1, 0, -0.5}) == 0);
  CHECK(residual({1, 0, 0.5}) == Approx(2));  // of mu fN
  CHECK(residual({1, 0.25, -0.5}) == Approx(0.5));
  problem.contacts.assign(1, {ContactKind::kBilateral, 0, {}});
  problem.A = Eigen::MatrixXd::Constant(1, 1, 2);
  problem.b = Eigen::VectorXd::Constant(1, 2);
  CHECK(residual({-1}) == 0);
  CHECK(residual({0}) == Approx(1));
}

TEST_CASE("space: the readings that are built") {
  CHECK(PublishedReadsInSpace(ParsePolicy("slip=redirect,scan=highest,ties=contacts")));
  for (const char* policy : {"slip=polygon", "file=yes", "apex=suspended"})
    CHECK_FALSE(PublishedReadsInSpace(ParsePolicy(policy)));
  CHECK(PublishedHandlesInSpace(Turning()));
  CHECK_FALSE(PublishedHandlesInSpace(ReferenceProblem()));
}

TEST_CASE("weak residual: zero at a solution, the size of what is broken elsewhere") {
  const auto problem = As<double>(OneContact(Rational(1, 2), {-2, 1, -1}));
  const auto residual = [&](std::vector<double> f) {
    const Eigen::VectorXd forces = Eigen::Map<Eigen::VectorXd>(f.data(), 3);
    const Eigen::VectorXd a = problem.A * forces + problem.b;
    return WeakErrorOf(problem, forces, a);
  };
  CHECK(residual({1, -0.5, 0}) == 0);
  CHECK(residual({1, -0.75, 0}) == Approx(0.5));                     // outside the circle, by half of mu fN
  CHECK(residual({1, -0.25, 0}) == Approx(0.5));                     // inside, though aF /= 0
  CHECK(residual({1, 0.5, 0}) > 0.5);                                // along its acceleration
  CHECK(residual({0.75, -0.375, 0}) == Approx(0.25).epsilon(1e-3));  // aN = -1/2 of 2
}

}  // namespace
}  // namespace stiction
