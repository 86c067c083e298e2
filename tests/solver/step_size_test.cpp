// SPDX-License-Identifier: Apache-2.0
// The step size: each limit of the table in readings.md, part 3. All numbers are exact in every scalar.

#include "solver/published/step_size.ipp"

#include <catch2/catch.hpp>

#include "solver/linear/direction.ipp"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;
using enum IndexSet;

// A step of a problem of which only the couplings to the driven variable matter.
struct Case {
  std::vector<std::vector<Rational>> A;
  std::vector<Rational> f, a;
  std::vector<IndexSet> sets;
  int driven = 0;
  DriveGoal goal = DriveGoal::kEstablish;
  Ties ties = Ties::kSets;
};

// Contacts with mu = 1, f = 0, all in `none`; N1 is driven, and a far limit away.
Case FarCase(int contacts) {
  const int rows = 2 * contacts;
  Case c;
  c.A.assign(rows, std::vector<Rational>(rows, 0));
  for (int i = 0; i < rows; ++i) c.A[i][i] = i == 0 ? 8 : 1;
  c.f.assign(rows, 0);
  c.a.assign(rows, 0);
  c.a[0] = -1024;
  c.sets.assign(rows, kNone);
  return c;
}

void Couple(Case& c, int row, const Rational& value) { c.A[row][0] = c.A[0][row] = value; }

template <class Scalar>
Step<Scalar> Find(const Case& c) {
  const ContactProblem<Scalar> problem =
      As<Scalar>(MakeProblem(std::vector<Rational>(c.f.size() / 2, 1), c.A, c.a));
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(problem.contacts);
  ContactState<Scalar, Eigen::Dynamic> state;
  state.f.resize(problem.rows());
  state.a.resize(problem.rows());
  for (int i = 0; i < problem.rows(); ++i) {
    state.f[i] = To<Scalar>(c.f[i]);
    state.a[i] = To<Scalar>(c.a[i]);
  }
  state.sets = c.sets;
  const Scale<Scalar> scale = MakeScale(problem, Tolerances{});
  const bool normal = layout.IsNormal(c.driven);
  const int sign = normal                       ? 1
                   : c.goal == DriveGoal::kZero ? -Sign(state.f[c.driven])
                                                : -Sign(state.a[c.driven]);
  DirectionSystem<Scalar, Eigen::Dynamic> direction;
  StepSize<Scalar, Eigen::Dynamic> step_size;
  direction.Start(problem);
  step_size.Resize(problem.rows());
  using System = DirectionSystem<Scalar, Eigen::Dynamic>;
  REQUIRE(direction.Solve(problem, layout, c.sets, c.driven, sign, scale) == System::Status::kRegular);
  return step_size.Find(problem, layout, state, direction, c.driven, c.goal, c.ties, scale);
}

template <class Scalar>
void CheckLimit(const Case& c, const Rational& s, int limiting, IndexSet wants) {
  const Step<Scalar> step = Find<Scalar>(c);
  CHECK(step.s == To<Scalar>(s));
  CHECK(step.limiting == limiting);
  CHECK(Name(step.wants) == Name(wants));
}

const Rational kHalf(1, 2);

// A maintained variable of contact 2: its set, how it is coupled to N1, its fN, fF or a, what it wants.
struct Maintained {
  const char* what;
  int row;
  IndexSet set, wants;
  Rational coupling;  // of `coupled_row`: > 0 makes its force fall, or its acceleration grow
  int coupled_row;
  Rational f_n, f_f, a;  // at a distance of 1/2 from the limit
};

const std::vector<Maintained>& MaintainedRows() {
  static const std::vector<Maintained> table = {
      {"C: fN falls to zero", 2, kClamped, kSeparating, 1, 2, kHalf, 0, 0},
      {"NC: aN falls to zero", 2, kSeparating, kClamped, -1, 2, 0, 0, kHalf},
      {"CF: fF grows to mu fN", 3, kSticking, kAtUpper, -1, 3, 1, kHalf, 0},
      {"CF: fF falls to -mu fN", 3, kSticking, kAtLower, 1, 3, 1, -kHalf, 0},
      {"CF: mu fN falls to fF", 3, kSticking, kAtUpper, 1, 2, 1, kHalf, 0},
      {"CF: -mu fN grows to fF", 3, kSticking, kAtLower, 1, 2, 1, -kHalf, 0},
      {"NC+: aF grows to zero", 3, kAtUpper, kSticking, 1, 3, 1, 1, -kHalf},
      {"NC-: aF falls to zero", 3, kAtLower, kSticking, -1, 3, 1, -1, kHalf},
  };
  return table;
}

Case MaintainedCase(const Maintained& m, const Rational& gap) {
  Case c = FarCase(2);
  Couple(c, m.coupled_row, m.coupling);
  c.sets[2] = m.row == 3 ? kClamped : m.set;
  if (m.row == 3) c.sets[3] = m.set;
  // At distance `gap` instead of 1/2.
  const Rational closer = kHalf - gap;
  c.f[2] = m.set == kClamped ? Rational(m.f_n - closer) : m.f_n;
  c.f[3] = m.set == kSticking ? Rational(m.f_f + (m.f_f > 0 ? closer : -closer)) : m.f_f;
  if (m.a != 0) c.a[m.row] = m.a > 0 ? Rational(m.a - closer) : Rational(m.a + closer);
  return c;
}

TEMPLATE_TEST_CASE("step size: every maintained variable limits the step where its row of the table says", "",
                   float, double, Rational) {
  for (const Maintained& m : MaintainedRows()) {
    CAPTURE(m.what);
    CheckLimit<TestType>(MaintainedCase(m, kHalf), kHalf, m.row, m.wants);
  }
}

TEMPLATE_TEST_CASE("step size: a variable that stands at its limit and must go on gives a zero step", "", float,
                   double, Rational) {
  for (const Maintained& m : MaintainedRows()) {
    CAPTURE(m.what);
    CheckLimit<TestType>(MaintainedCase(m, 0), 0, m.row, m.wants);
  }
}

TEMPLATE_TEST_CASE("step size: a variable that moves away from its limit, or is in no set, does not limit", "",
                   float, double, Rational) {
  for (const Maintained& m : MaintainedRows()) {
    CAPTURE(m.what);
    for (const bool opposite : {true, false}) {
      Case c = MaintainedCase(m, 0);
      if (opposite && m.set == kSticking && m.coupled_row == 3)
        c.f[3] = -c.f[3];  // at the other bound: leaves it
      if (opposite && (m.set != kSticking || m.coupled_row == 2))
        Couple(c, m.coupled_row, Rational(-m.coupling));
      if (!opposite) c.sets[2] = c.sets[3] = m.row == 3 ? kSuspended : kNone;
      const Step<TestType> step = Find<TestType>(c);
      if (opposite && m.set == kSticking && m.coupled_row == 3) {
        CHECK(step.s == To<TestType>(2));  // across the whole cone
      } else {
        CHECK(step.limiting == 0);
      }
    }
  }
}

TEMPLATE_TEST_CASE("step size: the driven normal stops where its acceleration is zero", "", float, double,
                   Rational) {
  Case c = FarCase(1);
  c.a[0] = -4;
  CheckLimit<TestType>(c, kHalf, 0, kClamped);
}

TEMPLATE_TEST_CASE("step size: driven friction stops at aF = 0, at its bound, or at aF = 0 if at both", "",
                   float, double, Rational) {
  for (const int sign : {1, -1}) {  // of fF
    CAPTURE(sign);
    Case c = FarCase(1);
    c.driven = 1;
    c.sets[0] = kClamped;
    c.a[0] = 0;
    c.f[0] = 4;
    c.a[1] = Rational(-sign, 2);
    CheckLimit<TestType>(c, kHalf, 1, kSticking);
    c.f[0] = Rational(1, 4);
    CheckLimit<TestType>(c, Rational(1, 4), 1, sign > 0 ? kAtUpper : kAtLower);
    c.f[0] = kHalf;
    CheckLimit<TestType>(c, kHalf, 1, kSticking);
    c.f[0] = 0;
    CheckLimit<TestType>(c, 0, 1, sign > 0 ? kAtUpper : kAtLower);
  }
}

TEMPLATE_TEST_CASE("step size: driven friction meets its bound sooner while its normal force falls", "", float,
                   double, Rational) {
  Case c = FarCase(1);
  c.driven = 1;
  c.A = {{1, 1}, {1, 2}};  // dfN = -1
  c.sets[0] = kClamped;
  c.f[0] = 1;
  c.a = {0, -1024};
  CheckLimit<TestType>(c, kHalf, 1, kAtUpper);
}

TEMPLATE_TEST_CASE("step size: driven friction meets its bound in any unit of mass", "", float, double,
                   Rational) {
  for (const int sign : {1, -1}) {  // of fF; the bound moves by newtons per newton, whatever A is
    Case c = FarCase(1);
    c.driven = 1;
    const Rational unit(std::int64_t{1} << 60);
    c.A = {{unit, 0}, {0, unit}};
    c.sets[0] = kClamped;
    c.f[0] = 1;
    c.a = {0, Rational(-4 * sign * unit)};
    CheckLimit<TestType>(c, 1, 1, sign > 0 ? kAtUpper : kAtLower);
  }
}

TEMPLATE_TEST_CASE("step size: friction driven to zero stops there and nowhere before", "", float, double,
                   Rational) {
  for (const int sign : {1, -1}) {
    Case c = FarCase(1);
    c.driven = 1;
    c.goal = DriveGoal::kZero;
    c.sets[0] = kClamped;
    c.f = {Rational(1, 4), Rational(sign, 2)};  // outside its bound
    c.a = {0, Rational(sign, 4)};               // aF = 0 after half of the step
    CheckLimit<TestType>(c, kHalf, 1, kNone);
  }
}

TEMPLATE_TEST_CASE("step size: without a limit it is a ray", "", float, double, Rational) {
  Case c = FarCase(2);
  c.A[0][0] = 0;
  CHECK(Find<TestType>(c).limiting == -1);
  c.A[0][0] = -1;
  CHECK(Find<TestType>(c).limiting == -1);
}

// Contact 2 in NC, contact 3 in C, contact 4 in C; all limit at s = 1/2.
Case TiedCase() {
  Case c = FarCase(4);
  c.sets[2] = kSeparating;
  Couple(c, 2, -1);
  c.a[2] = kHalf;
  for (const int row : {4, 6}) {
    c.sets[row] = kClamped;
    Couple(c, row, 1);
    c.f[row] = kHalf;
  }
  return c;
}

TEMPLATE_TEST_CASE("step size: ties=sets takes C before NC, ties=contacts the first row", "", float, double,
                   Rational) {
  Case c = TiedCase();
  CheckLimit<TestType>(c, kHalf, 4, kSeparating);
  CHECK(Find<TestType>(c).order_matters);
  c.ties = Ties::kContacts;
  CheckLimit<TestType>(c, kHalf, 2, kClamped);
  CHECK(Find<TestType>(c).order_matters);
}

TEMPLATE_TEST_CASE("step size: steps that differ by less than the tolerance tie, over inexact scalars", "",
                   float, double, Rational) {
  // The tolerance is max abs(b) / max A_ii = 128 times 1e-10, or over float times 8 epsilon.
  const bool coarse = sizeof(TestType) == sizeof(float);
  const Rational less = coarse ? Rational(1, 1L << 20) : Rational(1, 1L << 36);
  const Rational more = coarse ? Rational(1, 1L << 12) : Rational(1, 1L << 25);
  Case c = TiedCase();
  c.a[2] = kHalf - less;  // NC before C
  CHECK(Find<TestType>(c).limiting == (kIsExact<TestType> ? 2 : 4));
  c.a[2] = kHalf - more;
  CHECK(Find<TestType>(c).limiting == 2);
}

TEMPLATE_TEST_CASE("step size: within a set the lowest row limits, and the tie rules agree", "", float, double,
                   Rational) {
  Case c = TiedCase();
  c.sets[2] = kNone;
  CheckLimit<TestType>(c, kHalf, 4, kSeparating);
  CHECK_FALSE(Find<TestType>(c).order_matters);
}

TEMPLATE_TEST_CASE("step size: ties=sets takes friction in the order CF, NC-, NC+ after normals", "", float,
                   double, Rational) {
  Case c = FarCase(5);
  const auto add = [&c](int contact, IndexSet set, const Rational& coupling, const Rational& f_f,
                        const Rational& a) {
    const int normal = 2 * contact;
    c.sets[normal] = kClamped;
    c.f[normal] = 1;
    c.sets[normal + 1] = set;
    Couple(c, normal + 1, coupling);
    c.f[normal + 1] = f_f;
    c.a[normal + 1] = a;
  };
  add(1, kAtUpper, 1, 1, -kHalf);
  add(2, kAtLower, -1, -1, kHalf);
  add(3, kSticking, -1, kHalf, 0);
  c.sets[8] = kSeparating;
  Couple(c, 8, -1);
  c.a[8] = kHalf;
  for (const int expected : {8, 7, 5, 3}) {
    CHECK(Find<TestType>(c).limiting == expected);
    c.sets[expected] = kNone;
  }
}

TEMPLATE_TEST_CASE("step size: the driven variable comes before all others of a tie", "", float, double,
                   Rational) {
  Case c = TiedCase();
  c.a[0] = -3;  // da = 8 - 1 - 1
  for (const Ties ties : {Ties::kSets, Ties::kContacts}) {
    c.ties = ties;
    CheckLimit<TestType>(c, kHalf, 0, kClamped);
    CHECK_FALSE(Find<TestType>(c).order_matters);
  }
}

}  // namespace
}  // namespace stiction
