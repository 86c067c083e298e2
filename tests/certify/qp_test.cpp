// SPDX-License-Identifier: Apache-2.0
// Frictionless contacts as a quadratic program, exactly and by Ipopt. STICTION_IPOPT: path of stiction-ipopt.

#include "certify/exact/qp.h"

#include <catch2/catch.hpp>

#include "certify/exact/feasibility_nlp.h"
#include "certify/exact/neighbour.h"
#include "certify/exact/solve.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// A = J J' of the given rank, fractions throughout; b in its range.
ExactProblem RandomSingular(int contacts, int rank, std::uint64_t seed) {
  Choices choices(seed);
  ExactMatrix J(contacts, rank);
  for (Rational& x : J.reshaped()) {
    x = Rational(choices.Integer(-4, 4), choices.Integer(1, 3));
    x.canonicalize();
  }
  ExactProblem problem;
  problem.contacts.assign(contacts, {ContactKind::kFrictionless, 0, {}});
  problem.A = J * J.transpose();
  ExactVector y(rank);
  for (Rational& x : y) x = choices.Integer(-5, 5);
  problem.b = J * y;
  return problem;
}

TEST_CASE("qp: what is no program (5) is refused by name") {
  using Catch::Contains;
  CHECK(SolveQp(NoContacts()).outcome == Outcome::kSolved);
  CHECK_THROWS_WITH(SolveQp(MakeProblem({-1, 1}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {1, 1, 1})),
                    Contains("contacts[1].kind: found static, expected frictionless"));
  ExactProblem held = MakeProblem({-1}, {{1}}, {1});
  held.contacts[0].kind = ContactKind::kBilateral;
  CHECK_THROWS_WITH(SolveQp(held), Contains("contacts[0].kind: found bilateral"));
  CHECK_THROWS_WITH(SolveQp(MakeProblem({-1, -1}, {{1, 2}, {1, 1}}, {1, 1})), Contains("A[0][1], A[1][0]"));
  CHECK_THROWS_WITH(SolveQp(MakeProblem({-1, -1, -1}, {{5, 0, 0}, {0, 1, 2}, {0, 2, 1}}, {1, 1, 1})),
                    Contains("contacts[1, 2]") && Contains("positive semidefinite"));
}

TEST_CASE("qp: by Ipopt, over doubles, near the exact solution, its failure concludes nothing") {
  IpoptProposer ipopt(STICTION_IPOPT);
  int solved = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    const bool definite = seed % 2 == 0;
    const int contacts = 1 + static_cast<int>(seed % 5);
    const ExactProblem problem =
        definite ? RandomFrictionless(contacts, seed) : RandomSingular(contacts, 1 + contacts / 2, seed);
    const Answer<double> run = ipopt.ProposePoint(problem);
    REQUIRE(run.f.size() == problem.rows());
    const ExactVector f = run.f.unaryExpr([](double x) { return Rational(x); });
    if (FindMiss(problem, f, FrictionLaw::kCoulomb, GateOf<double>(1e-6))) continue;
    ++solved;
    if (!definite) continue;
    const ExactAnswer exact = SolveQp(problem);
    double largest = 0, error = 0;
    for (int i = 0; i < problem.rows(); ++i) {
      largest = std::max(largest, std::abs(ToDouble(exact.f[i])));
      error = std::max(error, std::abs(run.f[i] - ToDouble(exact.f[i])));
    }
    CHECK(error <= 0.1 * largest);
  }
  CHECK(solved >= 18);
  const Answer<double> open = ipopt.ProposePoint(MakeProblem({-1, -1}, {{1, -1}, {-1, 1}}, {-1, 0}));
  CHECK(open.outcome == Outcome::kUndecided);
  CHECK(!open.reason.empty());
  CHECK_THROWS_WITH(ipopt.ProposePoint(ReferenceProblem()), Catch::Contains("contacts[0].kind"));
}

}  // namespace
}  // namespace stiction
