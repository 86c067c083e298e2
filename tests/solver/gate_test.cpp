// SPDX-License-Identifier: Apache-2.0
// The gate: what it says of forces is never less than their residual over rationals, and not much more.

#include "solver/problem/gate.h"

#include <catch2/catch.hpp>

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

}  // namespace
}  // namespace stiction
