// SPDX-License-Identifier: Apache-2.0
// The gate: what is called a solution misses no condition by more than it says, in units of each contact, and
// does not depend on the units of contacts, on mu, or on forces that do no work.

#include "solver/problem/gate.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "corpus/rounded.h"
#include "solver/problem/row_scale.h"
#include "solver/solve.h"
#include "tests/judge.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

double GateOf(const ExactProblem& problem, const Eigen::VectorXd& f) {
  return BoundErrors(Rounded<double>(problem), FrictionLaw::kCoulomb, f.cast<long double>()).Largest();
}

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
        const Answer<double> answer = Solve(given, method), same = Solve(units(given), method);
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
      CHECK(GateOf(both, Eigen::Vector4d(2, 0, 0, 0)) > 0.25);  // the heavy one falls
      if (coupling == 0) CHECK(GateOf(both, Eigen::Vector4d(2, 0, std::ldexp(2.0, exponent), 0)) < 1e-15);
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
      const LongVector f = Eigen::Vector2d(fN, fF).cast<long double>();
      return BoundErrors(problem, FrictionLaw::kCoulomb, f).Largest();
    };
    CHECK(error(0, 0) == Approx(1));        // aN = -4 of 4
    CHECK(error(1, 0) == Approx(1.0 / 3));  // aN = -2 of 4 + 2
    CHECK(error(2, 0) < 1e-15);
    problem.b[1] = -3;  // friction of 1 N holds it, if mu allows that
    CHECK((error(2, 1) < 1e-15) == (mu >= 1));
    CHECK((error(2, 2 * mu < 1 ? 2 * mu : 1) < 1e-15));
    problem.b[0] = 4;  // it separates, so that there is no friction, however large mu is
    CHECK(error(0, 0) < 1e-15);
    CHECK(error(std::min(1e-17, 1 / mu), 1) > 0.1);
  }
}

TEST_CASE("gate: forces that only press against each other make no unit larger") {
  for (const double jam : {4.0, 1e6, 1e12}) {
    CAPTURE(jam);
    CHECK(GateOf(Jam(4), Eigen::Vector4d(jam, 0, jam, 0)) > 0.5);  // friction of 1 N each would hold it
    CHECK((GateOf(Jam(4), Eigen::Vector4d(1 + jam, 1, 1 + jam, 1)) < 1e-6) == (jam < 1e12));
  }
  const Errors<double> errors = BoundErrors(Rounded<double>(Jam(4)), FrictionLaw::kCoulomb,
                                            Eigen::Vector4d(1e6, 1, 1e6, 1).cast<long double>());
  CHECK(errors.amplification > 1e5);
}

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
    const Answer<double> answer = Solve(problem, method);
    CHECK(answer.Solved());
    CHECK(answer.errors->Largest() < 1e-11);
  }
}

TEST_CASE("gate: what it lets pass misses no condition, over rationals") {
  int passed = 0, refused = 0;
  for (const GeneratorId id : {GeneratorId::kPsd, GeneratorId::kNearDegenerate, GeneratorId::kBodies,
                               GeneratorId::kSliding, GeneratorId::kSpace}) {
    for (int index = 0; index < Few(80); ++index) {
      const ExactProblem problem = Unrounded(Rounded<double>(Random<Rational>(id, 1 + index % 3, index)));
      const Answer<double> answer = Solve(Rounded<double>(problem), "fast");
      if (!answer.Solved()) continue;
      Choices choices(index);
      for (int k = 0; k < 12; ++k) {
        CAPTURE(Row(id).name, index, k);
        Eigen::VectorXd f = answer.f;  // a solution, and points near it
        for (double& x : f) x += std::ldexp(static_cast<double>(choices.Integer(-k, k)), -4 * k);
        for (const FrictionLaw law : {FrictionLaw::kCoulomb, FrictionLaw::kBaraff}) {
          const double error = BoundErrors(Rounded<double>(problem), law, f.cast<long double>()).Largest();
          if (!(error < 1e3)) continue;
          const ExactVector exact = f.unaryExpr([](double x) { return Rational(x); });
          const Rational most = Rational(error) * (1 + Rational(1, 1 << 30));
          CHECK(FindMiss(problem, exact, law, most).value_or("") == "");
          ++passed;
          refused += FindMiss(problem, exact, law, Rational(error) / 1000).has_value();
        }
      }
    }
  }
  CHECK(passed > Few(4000));
  CHECK(refused > passed / 2);  // it is not far above what is missed
}

TEST_CASE("gate: a number that is not finite, and rounding beyond the bound, are never let pass") {
  const ContactProblem<double> problem = As<double>(MakeProblem({1}, {{2, 0}, {0, 3}}, {-4, 0}));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (int row = 0; row < 2; ++row) {
      Eigen::VectorXd f = Eigen::Vector2d(2, 0);
      f[row] = bad;
      CHECK_FALSE(BoundErrors(problem, FrictionLaw::kCoulomb, f.cast<long double>()).Largest() < 1e300);
    }
  }
  CHECK(GateOf(Jam(4), Eigen::Vector4d(1e18, 1, 1e18, 1)) > 1e-8);  // 1e18 cancels with an error of a tenth
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
