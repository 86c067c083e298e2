// SPDX-License-Identifier: Apache-2.0
// The gate: what is called a solution solves exactly a problem whose numbers differ by as little as it says; it
// does not depend on the units of contacts, on mu, or on forces that are zero; and what is right to the last
// digit passes.

#include "solver/problem/gate.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "corpus/rounded.h"
#include "solver/problem/lenient.h"
#include "solver/problem/row_scale.h"
#include "solver/solve.h"
#include "tests/judge.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

double ErrorAt(const ExactProblem& problem, const Eigen::VectorXd& f) {
  return BoundErrors(Rounded<double>(problem), FrictionLaw::kCoulomb, f, GateOf<double>()).Largest();
}
constexpr double kEps = 1e-8;

// Two contacts of a body between two walls that both press: forces (1, 1) along the normals do no work.
ExactProblem Jam(const Rational& load) {
  ExactProblem problem =
      MakeProblem({1, 1}, {{2, 0, -2, 0}, {0, 2, 0, 2}, {-2, 0, 2, 0}, {0, 2, 0, 2}}, {0, 0, 0, 0});
  problem.b[1] = problem.b[3] = -load;
  return problem;
}

// The same problem in other units of each contact: D A D, D b, D^-1 f, D by powers of two.
struct OtherUnits {
  std::vector<int> exponents;  // by row

  OtherUnits(const ExactProblem& problem, Choices& choices, int most) {
    for (const auto& contact : problem.contacts) {
      const int exponent = static_cast<int>(choices.Integer(-most, most));
      exponents.insert(exponents.end(), contact.HasFrictionRows() ? problem.dimension : 1, exponent);
    }
  }
  ContactProblem<double> operator()(ContactProblem<double> problem) const {
    for (int i = 0; i < problem.rows(); ++i) {
      for (int j = 0; j < problem.rows(); ++j)
        problem.A(i, j) = std::ldexp(problem.A(i, j), exponents[i] + exponents[j]);
      problem.b[i] = std::ldexp(problem.b[i], exponents[i]);
    }
    return problem;
  }
  Eigen::VectorXd Forces(Eigen::VectorXd f) const {
    for (int i = 0; i < f.size(); ++i) f[i] = std::ldexp(f[i], -exponents[i]);
    return f;
  }
};

// Two problems side by side, whose contacts A does not couple, or by numbers of this size.
ExactProblem SideBySide(const ExactProblem& one, const ExactProblem& other, const Rational& coupling) {
  ExactProblem both = one;
  const int n = one.rows(), m = other.rows();
  both.contacts.insert(both.contacts.end(), other.contacts.begin(), other.contacts.end());
  both.A = ExactMatrix::Constant(n + m, n + m, Rational(0));
  both.A.topLeftCorner(n, n) = one.A;
  both.A.bottomRightCorner(m, m) = other.A;
  both.A(0, n) = both.A(n, 0) = coupling;
  both.b = ExactVector(n + m);
  both.b.head(n) = one.b;
  both.b.tail(m) = other.b;
  return both;
}

TEST_CASE("gate: it and the outcomes are the same in other units of every contact") {
  int solved = 0;
  for (const GeneratorId id : {GeneratorId::kPsd, GeneratorId::kBodies, GeneratorId::kBilateral,
                               GeneratorId::kSliding, GeneratorId::kSpace}) {
    for (int index = 0; index < Few(60); ++index) {
      Choices choices(1000 + index);
      const ExactProblem problem = Random<Rational>(id, 1 + index % 4, index);
      const ContactProblem<double> given = Rounded<double>(problem);
      const OtherUnits units(problem, choices, index % 2 == 0 ? 26 : 120);  // masses 1 : 10^16, and beyond
      for (const char* method : {"auto", "fast", "complete", "lemke", "baraff"}) {
        CAPTURE(Row(id).name, index, method);
        const Answer<double> answer = Solve(given, {.method = method}),
                             same = Solve(units(given), {.method = method});
        CHECK(same.outcome == answer.outcome);
        CHECK(same.counters == answer.counters);
        if (answer.f.size() != given.rows() || !answer.f.allFinite()) continue;
        REQUIRE(same.f.size() == given.rows());
        CHECK((same.f - units.Forces(answer.f)).cwiseAbs().maxCoeff() == 0);
        CHECK(same.errors->acceleration == answer.errors->acceleration);
        CHECK(same.errors->force == answer.errors->force);
        CHECK(same.errors->backward == answer.errors->backward);
        CHECK(same.errors->amplification == answer.errors->amplification);
        CHECK(same.errors->contact == answer.errors->contact);
        solved += answer.Solved();
      }
    }
  }
  CHECK(solved > Few(600));
}

TEST_CASE("gate: a light contact does not blind it to a heavy one, far apart or coupled") {
  const ExactProblem rests = MakeProblem({1}, {{2, 0}, {0, 3}}, {-4, 0});
  for (int exponent = 0; exponent <= 54; exponent += 3) {
    CAPTURE(exponent);
    ExactProblem heavy = rests;
    for (auto& x : heavy.A.reshaped()) x = Rational(ToDouble(x) * std::ldexp(1.0, -exponent));
    for (const Rational& coupling : {Rational(0), Rational(std::ldexp(1.0, -exponent - 2))}) {
      const ExactProblem both = SideBySide(rests, heavy, coupling);
      CHECK(ErrorAt(both, Eigen::Vector4d(2, 0, 0, 0)) > 0.25);  // the heavy one falls
      if (coupling == 0) CHECK(ErrorAt(both, Eigen::Vector4d(2, 0, std::ldexp(2.0, exponent), 0)) < 1e-15);
      const Answer<double> answer = Solve(Rounded<double>(both));
      CHECK(answer.Solved());
      CHECK(answer.f[2] == Approx(std::ldexp(2.0, exponent)).epsilon(1e-3 + 0.5 * (coupling != 0)));
    }
  }
}

TEST_CASE("gate: whatever mu is, free fall is no solution, and rest is one") {
  for (const double mu : {1e-16, 1e-8, 1.0, 1e8, 1e12, 1e16, std::numeric_limits<double>::infinity()}) {
    CAPTURE(mu);
    ContactProblem<double> problem = As<double>(MakeProblem({1}, {{2, 0}, {0, 3}}, {-4, 0}));
    problem.contacts[0].mu = mu;
    const auto error = [&problem](double fN, double fF) {
      return BoundErrors(problem, FrictionLaw::kCoulomb, Eigen::VectorXd(Eigen::Vector2d(fN, fF)),
                         GateOf<double>())
          .Largest();
    };
    CHECK(error(0, 0) == Approx(1));    // aN = -4 of 4
    CHECK(error(1, 0) == Approx(0.5));  // aN = -2 of 4
    CHECK(error(2, 0) < 1e-15);
    problem.b[1] = -3;  // friction of 1 N holds it, if mu allows that
    CHECK((error(2, 1) < 1e-15) == (mu >= 1));
    CHECK((error(2, 2 * mu < 1 ? 2 * mu : 1) < 1e-15));
    problem.b[0] = 4;  // it separates, so that there is no friction, however large mu is
    CHECK(error(0, 0) < 1e-15);
    CHECK(error(std::min(1e-17, 1 / mu), 1) > 0.1);
  }
}

TEST_CASE("gate: forces that only press against each other lend eight of their roundings") {
  for (const double jam : {4.0, 1e6, 1e12}) {
    CAPTURE(jam);
    CHECK(ErrorAt(Jam(4), Eigen::Vector4d(jam, 0, jam, 0)) > 0.5);  // friction of 1 N each would hold it
    CHECK((ErrorAt(Jam(4), Eigen::Vector4d(1 + jam, 1, 1 + jam, 1)) < kEps));
  }
  const Errors<double> errors = BoundErrors(Rounded<double>(Jam(4)), FrictionLaw::kCoulomb,
                                            Eigen::VectorXd(Eigen::Vector4d(1e6, 1, 1e6, 1)), GateOf<double>());
  CHECK(errors.amplification > 1e5);
}

// ---- Attacks: forces that are wrong by all of what acts, and problems that would excuse them ---------------

ExactProblem Contacts(const std::vector<Contact<Rational>>& contacts,
                      const std::vector<std::vector<Rational>>& A, const std::vector<Rational>& b) {
  ExactProblem problem = MakeProblem(std::vector<Rational>(contacts.size(), 0), {}, {});
  problem.contacts = contacts;
  problem.b = Vector(b);
  problem.A.resize(problem.rows(), problem.rows());
  for (int i = 0; i < problem.rows(); ++i)
    for (int j = 0; j < problem.rows(); ++j) problem.A(i, j) = A[i][j];
  return problem;
}
const Contact<Rational> kSmooth = {ContactKind::kFrictionless, 0, {}};
Contact<Rational> Sliding(const Rational& mu) {
  return {ContactKind::kSliding, mu, {Rational(1), Rational(0)}};
}
Contact<Rational> Static(const Rational& mu) { return {ContactKind::kStatic, mu, {}}; }

TEST_CASE("gate: a neighbour without force, however heavily loaded, does not hold up a contact") {
  const Rational tenth = Rational(1, 10);
  const ExactProblem shadow =
      Contacts({kSmooth, kSmooth, kSmooth}, {{1, tenth, 0}, {tenth, 1, tenth}, {0, tenth, 1}},
               {Number("-2.3e-5"), Number("5e5"), Number("-3.7e7")});
  CHECK(ErrorAt(shadow, Eigen::Vector3d(0, 0, 3.7e7 - 1e-9)) > 0.9);
  for (const char* method : {"complete", "lemke", "baraff", "fast", "auto"}) {
    CAPTURE(method);
    const Answer<double> answer = Solve(Rounded<double>(shadow), {.method = method});
    CHECK(answer.Solved());
    if (answer.Solved()) CHECK(answer.f[0] == Approx(2.3e-5).epsilon(1e-2));
  }
}

TEST_CASE("gate: a contact that parts holds up nothing, by friction or by many small forces") {
  const ExactProblem feather =
      Contacts({Sliding(1), kSmooth}, {{1, 0, 0}, {0, 1, -1}, {0, -1, 1}}, {Number("1e9"), 0, -9});
  CHECK(ErrorAt(feather, Eigen::Vector3d(9, -9, 0)) > 0.1);
  CHECK(ErrorAt(feather, Eigen::Vector3d(0, 0, 9)) < 1e-15);
  const ExactProblem pulled =
      Contacts({Sliding(1), kSmooth, kSmooth}, {{1, 0, 1, 0}, {0, 1, 0, 1}, {1, 0, 1, 0}, {0, 1, 0, 1}},
               {Number("-1e9"), 0, Number("-1e9"), -8});
  CHECK(ErrorAt(pulled, Eigen::Vector4d(-8, 8, 1e9 + 8, 0)) > 0.1);
  const int n = 100;  // on one body, each within what no row notices
  const double small = 0.999 * kEps;
  std::vector<Rational> b(n + 1, 10);
  b[0] = -1;
  const ExactProblem many =
      Contacts(std::vector<Contact<Rational>>(n + 1, kSmooth),
               std::vector<std::vector<Rational>>(n + 1, std::vector<Rational>(n + 1, 1)), b);
  Eigen::VectorXd f = Eigen::VectorXd::Constant(n + 1, small);
  f[0] = 1 - n * small;
  CHECK(ErrorAt(many, f) > 50 * kEps);
}

TEST_CASE("gate: no friction is lent by a normal force that is zero, or by one that does not reach its row") {
  const ExactProblem steep = Contacts({Static(Number("1e12"))}, {{1, 100}, {100, 10001}}, {-100, 0});
  CHECK(ErrorAt(steep, Eigen::Vector2d(0, 1)) > 0.1);
  CHECK(Solve(Rounded<double>(steep)).Solved());
  for (const double press : {1e3, 1e9, 7e13}) {  // between two walls; friction carries nearly all of the weight
    CAPTURE(press);
    const ExactProblem clamped =
        Contacts({Static(1), kSmooth}, {{1, 0, -1}, {0, 1, 0}, {-1, 0, 1}}, {0, -1, 0});
    CHECK(ErrorAt(clamped, Eigen::Vector3d(press, 1 - 1e-7, press)) > 5 * kEps);
    CHECK(ErrorAt(clamped, Eigen::Vector3d(press, 1, press)) < kEps);
  }
}

TEST_CASE("gate: over float a stack does not sink, and what is right to the last digit passes") {
  const int n = 50;
  ExactProblem stack =
      Contacts(std::vector<Contact<Rational>>(n, kSmooth),
               std::vector<std::vector<Rational>>(n, std::vector<Rational>(n, 0)), std::vector<Rational>(n, 0));
  for (int i = 0; i < n; ++i) {
    stack.A(i, i) = i == 0 ? 1 : 2;
    if (i > 0) stack.A(i, i - 1) = stack.A(i - 1, i) = -1;
  }
  stack.b[0] = -10;  // unit masses; all but the lowest contact are driven by forces alone
  Eigen::VectorXd right(n), sinks(n);
  for (int i = 0; i < n; ++i) {
    right[i] = 10 * (n - i);
    sinks[i] = right[i] * (1 - 1e-6 * (i + 1));
  }
  const Gate gate = GateOf<float>();
  CHECK(gate.tau < gate.eps);
  const auto problem = Rounded<double>(stack);
  CHECK(BoundErrors(problem, FrictionLaw::kCoulomb, right, gate).Largest() < gate.eps / 2);
  CHECK(BoundErrors(problem, FrictionLaw::kCoulomb, sinks, gate).Largest() > gate.eps);
}

TEST_CASE("gate: noise that methods leave is taken away before it asks") {
  int refused = 0, tried = 0;
  for (int n = 1; n <= 40; ++n) {  // a stack of boxes of one contact each, pushed by noise of 1e-12
    ExactProblem stack = Contacts(std::vector<Contact<Rational>>(n, Static(Rational(1, 2))),
                                  std::vector<std::vector<Rational>>(2 * n, std::vector<Rational>(2 * n, 0)),
                                  std::vector<Rational>(2 * n, 0));
    for (int i = 0; i < 2 * n; ++i) {
      stack.A(i, i) = i < 2 ? 1 : 2;
      if (i > 1) stack.A(i, i - 2) = stack.A(i - 2, i) = -1;
    }
    stack.b[0] = -10;
    stack.b[1] = 1;
    const ContactProblem<double> problem = Rounded<double>(stack);
    Answer<double> answer;
    answer.law = FrictionLaw::kCoulomb;
    answer.outcome = Outcome::kSolved;
    answer.f.resize(2 * n);
    Choices choices(n);
    for (int i = 0; i < n; ++i) {
      answer.f[2 * i] = 10 * (n - i) * (1 + 1e-12 * static_cast<double>(choices.Integer(-4, 4)));
      answer.f[2 * i + 1] = -(n - i) * (1 + 1e-12 * static_cast<double>(choices.Integer(-4, 4)));
    }
    refused += ErrorAt(stack, answer.f) > kEps;
    JudgeAnswer(problem, kEps, answer);
    CHECK(answer.Solved());
    ++tried;
  }
  CHECK(refused > tried / 2);  // it is needed
}

// ---- Who is accused -----------------------------------------------------------------------------------------

double LenientErrorAt(const ExactProblem& problem, const Eigen::VectorXd& f) {
  const ContactProblem<double> rounded = Rounded<double>(problem);
  const Eigen::VectorXd a = rounded.A * f + rounded.b;
  return MeasureLeniently(rounded, FrictionLaw::kCoulomb, f, a).error;
}

TEST_CASE("lenient: noise is taken off accelerations, not cut off, so an error grows from zero with them") {
  // A = 1, f such that a = A f + b is what is to be seen.
  constexpr double kNoise = 1e-3;
  const auto error = [&](const std::vector<double>& a, const std::vector<double>& f) {
    const int dimension = static_cast<int>(f.size());
    ContactProblem<double> problem;
    problem.dimension = dimension;
    problem.contacts = {{ContactKind::kStatic, 0.5, {0, 0}}};
    problem.A = Eigen::MatrixXd::Identity(dimension, dimension);
    const Eigen::VectorXd forces = Eigen::Map<const Eigen::VectorXd>(f.data(), dimension),
                          of = Eigen::Map<const Eigen::VectorXd>(a.data(), dimension);
    problem.b = of - forces;
    LenientUnits<double> units;
    return MeasureLeniently(problem, FrictionLaw::kCoulomb, forces, of, units, kNoise).error;
  };
  for (const double more : {0.0, 1e-6, 1e-4}) {
    CAPTURE(more);
    const double a = kNoise + more;
    CHECK(error({a, 0}, {1, 0}) <= 1.1 * more);
    CHECK(error({0, a}, {1, 0.1}) <= 1.1 * more);
    CHECK(error({a, 0}, {1, 0}) >= 0.5 * more);
    CHECK(error({0, a}, {1, 0.1}) >= 0.5 * more);
  }
  // A slip of three times the noise may be off its friction by the angle that noise makes, and by no more.
  const auto slip = [&](double across) { return error({0, -3 * kNoise, across}, {1, 0.5, 0}); };
  CHECK(slip(kNoise) <= 1e-15);
  CHECK(slip(-kNoise) <= 1e-15);
  CHECK(slip(1.1 * kNoise) > 1e-5);
  CHECK(error({0, 3 * kNoise, 0}, {1, 0.5, 0}) > 1e-3);  // a slip along its friction
}

TEST_CASE("lenient: friction that is off by a little of the force at its contact accuses nobody") {
  const ExactProblem alone = MakeProblem({1}, {{1, 0}, {0, 1}}, {-1, 0});
  CHECK(LenientErrorAt(alone, Eigen::Vector2d(1, 1e-12)) < 1e-11);
  int solved = 0;
  for (const GeneratorId id :
       {GeneratorId::kPsd, GeneratorId::kBodies, GeneratorId::kBilateral, GeneratorId::kSliding}) {
    for (int index = 0; index < Few(60); ++index) {
      CAPTURE(Row(id).name, index);
      Choices choices(index);
      const ExactProblem problem = Unrounded(Rounded<double>(Random<Rational>(id, 1 + index % 4, index)));
      const ExactAnswer answer = SolveExactly(problem, {.method = "complete"});
      if (answer.outcome != Outcome::kSolved) continue;
      Eigen::VectorXd f = answer.f.unaryExpr([](const Rational& x) { return ToDouble(x); });
      int row = 0;
      for (const auto& contact : problem.contacts) {
        const int count = RowsOf(contact, 2);
        const double largest = f.segment(row, count).cwiseAbs().maxCoeff();
        for (int end = row + count; row < end; ++row)
          if (contact.kind != ContactKind::kSliding) f[row] += 1e-12 * largest * choices.Integer(-1, 1);
      }
      CHECK(LenientErrorAt(problem, f) < 1e-10);
      ++solved;
    }
  }
  CHECK(solved > Few(150));
}

TEST_CASE("lenient: free fall, a pull and friction that pushes are accused whatever is beside them") {
  const ExactProblem alone = MakeProblem({1}, {{2, 0}, {0, 3}}, {-4, -3});
  CHECK(LenientErrorAt(alone, Eigen::Vector2d(0, 0)) == Approx(1));
  CHECK(LenientErrorAt(alone, Eigen::Vector2d(2, -1)) > 0.1);
  CHECK(LenientErrorAt(MakeProblem({1}, {{2, 0}, {0, 3}}, {4, 0}), Eigen::Vector2d(-2, 0)) > 0.4);
  const ExactProblem both = SideBySide(alone, MakeProblem({1}, {{1, 0}, {0, 1}}, {Number("-1e9"), 0}), 0);
  CHECK(LenientErrorAt(both, Eigen::Vector4d(0, 0, 1e9, 0)) == Approx(1));
}

// ---- Neighbours ---------------------------------------------------------------------------------------------

// The judge is written apart from it, condition by condition.
// Forces of 0.8 N that cancel but for 1e-10 of what they do: the second contact slips, slowly beside them.
TEST_CASE("gate: in the plane the direction of a slip is a sign, which rounding does not turn") {
  ContactProblem<double> problem;
  problem.contacts = {{ContactKind::kStatic, 1, {}}, {ContactKind::kStatic, 1, {}}};
  problem.A.resize(4, 4);
  problem.A << 17180655628, -17180000251, -8589737976, -17180393474,  //
      -17180000251, 17179344917, 8589410317, 17179738118,             //
      -8589737976, 8589410317, 4294574094, 8589606907,                //
      -17180393474, 17179738118, 8589606907, 17180131346;
  problem.b = Eigen::Vector4d(-655374, 655333, 327658, 655357);
  for (const char* method : {"fast", "complete", "baraff"}) {
    const Answer<double> answer = Solve(problem, {.method = method});
    CHECK(answer.Solved());
    CHECK(answer.errors->Largest() <= kEps);
  }
}

TEST_CASE("gate: a number that is not finite, and rounding beyond the bound, are never let pass") {
  const ContactProblem<double> problem = As<double>(MakeProblem({1}, {{2, 0}, {0, 3}}, {-4, 0}));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (int row = 0; row < 2; ++row) {
      Eigen::VectorXd f = Eigen::Vector2d(2, 0);
      f[row] = bad;
      CHECK_FALSE(BoundErrors(problem, FrictionLaw::kCoulomb, f, GateOf<double>()).Largest() < 1e300);
    }
  }
  for (const double size : {0x1p-1070, 0x1p-600, 0x1p600, 0x1p900}) {  // products that leave the range
    ContactProblem<double> scaled = As<double>(MakeProblem({1}, {{2, 0}, {0, 3}}, {-4, 0}));
    scaled.b *= size;
    CHECK(BoundErrors(scaled, FrictionLaw::kCoulomb, Eigen::VectorXd(Eigen::Vector2d(2 * size, 0)),
                      GateOf<double>())
              .Largest() < 1e-15);
    CHECK(
        BoundErrors(scaled, FrictionLaw::kCoulomb, Eigen::VectorXd(Eigen::Vector2d(size, 0)), GateOf<double>())
            .Largest() == Approx(0.5));
  }
}

TEST_CASE("gate: a number times a power of two is what ldexp makes of it, also where it leaves the range") {
  for (const double x : {1.0, -1.7, 0x1.fffffffffffffp1023, 0x1.8p-1022, 5e-324, 0x1.0000000000001p-1022})
    for (int e = -2200; e <= 2200; ++e) {
      const double product = TimesPowerOfTwo(x, e);
      if (product != std::ldexp(x, e)) FAIL("2^" << e << " times " << x);
    }
}

}  // namespace
}  // namespace stiction
