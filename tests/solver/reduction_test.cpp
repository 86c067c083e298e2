// SPDX-License-Identifier: Apache-2.0
#include "solver/problem/reduction.h"

#include <catch2/catch.hpp>

#include "solver/linear/direction.ipp"
#include "solver/problem/reduction.ipp"
#include "solver/published/published.ipp"
#include "tests/support.h"

namespace stiction::testing {
namespace {

ContactProblem<double> InDoubles(const ExactProblem& problem) {
  ContactProblem<double> rounded = As<double>(problem);
  for (std::size_t i = 0; i < problem.contacts.size(); ++i)
    rounded.contacts[i].slip[0] = ToDouble(problem.contacts[i].slip[0]);
  return rounded;
}

TEST_CASE("a problem without bilateral or sliding contacts is its own reduction") {
  const ExactProblem problem = ReferenceProblem();
  CHECK_FALSE(Reduction<Rational>::Concerns(problem));
  const Reduction<Rational> reduction(problem);
  CHECK(reduction.problem().A == problem.A);
  CHECK(reduction.problem().b == problem.b);
  CHECK(reduction.row_of() == std::vector<int>{0, 1, 2, 3});
  CHECK(reduction.Forces(Vector({1, 2, 3, 4})) == Vector({1, 2, 3, 4}));
}

TEST_CASE("4.5: a direction of the reduction is the direction with the bilateral constraint in C") {
  // Contacts: static, bilateral, frictionless; driven: the frictionless one while the first sticks.
  ExactProblem problem =
      MakeProblem({1, -1, -1}, {{9, 1, 2, 3}, {1, 8, -1, 2}, {2, -1, 7, 1}, {3, 2, 1, 6}}, {-1, 2, 3, -4});
  problem.contacts[1].kind = ContactKind::kBilateral;
  DirectionSystem<Rational, Eigen::Dynamic> full, reduced;
  full.Start(problem);
  full.Solve(problem, LayoutOf(problem),
             {IndexSet::kClamped, IndexSet::kSticking, IndexSet::kClamped, IndexSet::kNone}, 3, 1, {});
  const Reduction<Rational> reduction(problem);
  reduced.Start(reduction.problem());
  reduced.Solve(reduction.problem(), LayoutOf(reduction.problem()),
                {IndexSet::kClamped, IndexSet::kSticking, IndexSet::kNone}, 2, 1, {});
  CHECK(reduction.Direction(reduced.df()) == full.df());
  for (int row = 0; row < 3; ++row) CHECK(full.da()[reduction.row_of()[row]] == reduced.da()[row]);
}

TEST_CASE("bilateral constraints that no forces keep are inconsistent") {
  ExactProblem problem = MakeProblem({-1, -1}, {{1, 2}, {2, 4}}, {1, 3});
  for (auto& contact : problem.contacts) contact.kind = ContactKind::kBilateral;
  CHECK(Reduction<Rational>(problem).end() == ReductionEnd::kInconsistent);
  CHECK(Reduction<double>(InDoubles(problem)).end() == ReductionEnd::kInconsistent);
  problem.b = Vector({1, 2});
  const Reduction<Rational> reduction(problem);
  CHECK(reduction.end() == ReductionEnd::kReduced);
  CHECK(problem.A * reduction.Forces(ExactVector(0)) + problem.b == Vector({0, 0}));
  CHECK(Reduction<double>(InDoubles(problem)).end() == ReductionEnd::kReduced);
}

TEST_CASE("a singular bilateral block that acts on other contacts is refused") {
  ExactProblem problem = MakeProblem({-1, -1}, {{0, 1}, {1, 0}}, {0, 1});  // indefinite
  problem.contacts[0].kind = ContactKind::kBilateral;
  CHECK(Reduction<Rational>(problem).end() == ReductionEnd::kSingular);
  CHECK(Reduction<double>(InDoubles(problem)).end() == ReductionEnd::kSingular);
}

// a0 = f1 - 3, a1 = -f0 + 4 f1 - 1, a2 = f2 + f0 - 2, a0 = 0: f1 = 3, f0 = 11 - a1, f2 = a2 - 9 + a1.
TEST_CASE("where it is allowed a frictionless contact changes its force for its acceleration") {
  ExactProblem problem = MakeProblem({-1, -1, -1}, {{0, 1, 0}, {-1, 4, 0}, {1, 0, 1}}, {-3, -1, -2});
  problem.contacts[0].kind = ContactKind::kBilateral;
  CHECK(Reduction<Rational>(problem).end() == ReductionEnd::kSingular);
  const Reduction<Rational> reduction(problem, {}, /*exchanges=*/true);
  REQUIRE(reduction.end() == ReductionEnd::kReduced);
  CHECK(reduction.HasExchanges());
  CHECK(reduction.problem().A == Matrix({{0, 0}, {-1, 1}}));
  CHECK(reduction.problem().b == Vector({3, 9}));
  const ExactVector f = reduction.Forces(Vector({2, 5}));
  CHECK(f == Vector({9, 3, 5}));
  CHECK(problem.A * f + problem.b == Vector({0, 2, 12}));
  const Reduction<double> rounded(InDoubles(problem), {}, /*exchanges=*/true);
  REQUIRE(rounded.end() == ReductionEnd::kReduced);
  CHECK(rounded.Forces(Eigen::Vector2d(2, 5)) == Eigen::Vector3d(9, 3, 5));
  problem.contacts[1].kind = ContactKind::kStatic;  // with friction there is no other side to change to
  problem.contacts[1].mu = 1;
  problem.A = Matrix({{0, 1, 0, 0}, {-1, 4, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}});
  problem.b = Vector({-3, -1, 0, 0});
  CHECK(Reduction<Rational>(problem, {}, /*exchanges=*/true).end() == ReductionEnd::kSingular);
}

TEST_CASE("6: the rod that slides: none, one or two solutions") {
  // Uniform rod, m = 1, half length 1, tan of the angle 2, friction coefficient 2: aN = -4/5 fN + bN.
  ExactProblem rod =
      MakeProblem({2}, {{Rational(8, 5), Rational(6, 5)}, {Rational(6, 5), Rational(17, 5)}}, {-10, 0});
  rod.contacts[0].kind = ContactKind::kSliding;
  rod.contacts[0].slip[0] = 1;
  const Reduction<Rational> reduction(rod);
  CHECK(reduction.problem().A(0, 0) == Rational(-4, 5));
  CHECK(reduction.problem().contacts[0].kind == ContactKind::kFrictionless);
  PublishedAlgorithm<Rational> published;
  CHECK(published.Run(reduction.problem()).outcome == Outcome::kRay);
  // The impulsive direction: sliding friction opposes the velocity.
  CHECK(reduction.Direction(published.direction().df()) == Vector({1, -2}));
  CHECK(reduction.Forces(Vector({3})) == Vector({3, -6}));
}

TEST_CASE("in space the friction of a sliding contact opposes a velocity in the plane") {
  ExactProblem problem = MakeProblem({1}, {{5, 1, 2}, {1, 4, 0}, {2, 0, 3}}, {-1, 0, 0});
  problem.dimension = 3;
  problem.contacts[0].kind = ContactKind::kSliding;
  problem.contacts[0].slip = {Rational(3, 5), Rational(-4, 5)};
  const Reduction<Rational> reduction(problem);
  REQUIRE(reduction.problem().rows() == 1);
  CHECK(reduction.problem().A(0, 0) == Rational(5) - Rational(3, 5) + Rational(8, 5));
  CHECK(reduction.Forces(Vector({10})) == Vector({10, -6, 8}));
}

}  // namespace
}  // namespace stiction::testing
