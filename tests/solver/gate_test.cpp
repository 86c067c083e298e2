// SPDX-License-Identifier: Apache-2.0
// The gate: what it says of forces is never less than their residual over rationals, and not much more.

#include "solver/problem/gate.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "certify/space.h"
#include "certify/verify_solution.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// A long double has eleven bits more than a double.
Rational ExactlyOf(long double x) {
  const auto high = static_cast<double>(x);
  return Rational(high) + Rational(static_cast<double>(x - high));
}

TEST_CASE("gate: the bound is not below the residual over rationals, and above it by rounding only") {
  int above = 0;
  for (std::uint64_t index = 0; index < 400; ++index) {
    CAPTURE(index);
    const auto problem = Random<double>(GeneratorId::kPsd, 1 + static_cast<int>(index % 6), index);
    ExactProblem exact;
    exact.contacts.resize(problem.contacts.size());
    for (std::size_t i = 0; i < problem.contacts.size(); ++i)
      exact.contacts[i] = {problem.contacts[i].kind, Rational(problem.contacts[i].mu), {}};
    exact.A = problem.A.unaryExpr([](double x) { return Rational(x); });
    exact.b = problem.b.unaryExpr([](double x) { return Rational(x); });
    PublishedAlgorithm<double> algorithm;
    if (algorithm.Run(problem).outcome != Outcome::kSolved) continue;
    const LongVector f = algorithm.state().f.cast<long double>();
    const ExactVector f_exact = algorithm.state().f.unaryExpr([](double x) { return Rational(x); });
    const Rational residual = NaturalResidual(exact, f_exact, Accelerations(exact, f_exact));
    const Rational bound = ExactlyOf(ResidualBound(problem, FrictionLaw::kBaraff, f));
    CHECK(bound >= residual);
    CHECK(bound - residual < Rational(1, 1000000000000));
    above += bound > residual;
  }
  CHECK(above > 200);
}

// A static contact in space whose force is at the limit of friction, up to rounding, and b so small beside it
// that the rounding of the force itself is a violation.
TEST_CASE("gate: in space, beside forces that are huge, the bound is not below the residual over rationals") {
  int violated = 0;
  for (std::uint64_t index = 0; index < 400; ++index) {
    CAPTURE(index);
    Choices choices(index);
    const double size = std::ldexp(1.0, static_cast<int>(choices.Integer(0, 300)));
    const double mu = static_cast<double>(choices.Integer(1, 40)) / 8;
    ContactProblem<double> problem;
    problem.dimension = 3;
    problem.contacts = {{ContactKind::kStatic, mu, {}}};
    problem.A = Eigen::Matrix3d::Identity() / size;
    problem.A(1, 1) = 1 / static_cast<double>(choices.Integer(1, 9));
    const double normal = static_cast<double>(choices.Integer(1, 9)) * size / 3;
    problem.b = Eigen::Vector3d(-normal / size, 0, static_cast<double>(choices.Integer(1, 99)));
    const LongVector f = Eigen::Vector3d(normal, 0, -mu * normal).cast<long double>();
    ExactProblem exact;
    exact.dimension = 3;
    exact.contacts = {{ContactKind::kStatic, Rational(mu), {}}};
    exact.A = problem.A.unaryExpr([](double x) { return Rational(x); });
    exact.b = problem.b.unaryExpr([](double x) { return Rational(x); });
    const ExactVector f_exact = f.unaryExpr([](long double x) { return ExactlyOf(x); });
    const Rational residual = CoulombResidualBound(exact, f_exact);
    const long double bound = ResidualBound(problem, FrictionLaw::kCoulomb, f);
    CHECK(bound >= ToDouble(residual) * (1 - 1e-9));
    violated += residual > Rational(1, 1000000000);
    if (size < 8) CHECK(bound < ToDouble(residual) + 1e-15);
  }
  CHECK(violated > 100);
}

}  // namespace
}  // namespace stiction
