// SPDX-License-Identifier: Apache-2.0
// Bounds from doubles against what exact elimination decides; (H) against its witnesses.

#include "certify/exact/bounds.h"

#include <catch2/catch.hpp>

#include "certify/claims/certificate.h"
#include "certify/exact/hypothesis.h"
#include "corpus/json.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

ExactProblem Frictionless(const ExactMatrix& A, const ExactVector& b) {
  ExactProblem problem;
  problem.contacts.assign(b.size(), {ContactKind::kFrictionless, 0, {}});
  problem.A = A;
  problem.b = b;
  return problem;
}

// J J' with J of `rank` columns, and `shift` on the diagonal.
ExactProblem RandomGram(int size, int rank, const Rational& shift, Choices& choices) {
  ExactMatrix J(size, rank), A(size, size);
  ExactVector b(size);
  for (int i = 0; i < size; ++i) {
    b[i] = choices.Integer(-9, 9);
    for (int k = 0; k < rank; ++k) J(i, k) = choices.Integer(-9, 9);
  }
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) {
      A(i, j) = i == j ? shift : Rational(0);
      for (int k = 0; k < rank; ++k) A(i, j) += J(i, k) * J(j, k);
    }
  }
  return Frictionless(A, b);
}

TEST_CASE("bounds: no bound on x'Ax is above what a direction shows, and exact elimination agrees") {
  int definite = 0, negative = 0, open = 0;
  for (int index = 0; index < 300; ++index) {
    CAPTURE(index);
    Choices choices(index);
    const int size = 2 + index % 9;
    const Rational shift = index % 3 == 0 ? Rational(0) : Rational(index % 3 == 1 ? 1 : -1, 1 + index % 50);
    const ExactProblem problem = RandomGram(size, 1 + index % size, shift, choices);
    const CurvatureBounds bounds = BoundCurvature(problem);
    REQUIRE(bounds.least.has_value());
    const bool psd = IsPositiveSemidefinite(problem);
    if (*bounds.least >= 0) CHECK(psd);
    if (bounds.negative) {
      CHECK_FALSE(psd);
      CHECK(bounds.negative->value < 0);
      CHECK(*bounds.least <= bounds.most);
    }
    // The smallest eigenvalue is at least `shift`, and is `shift` if there are fewer columns than rows.
    const double smallest = ToDouble(shift);
    if (1 + index % size < size) CHECK(*bounds.least <= smallest);
    // Shifts grow by factors of four.
    CHECK(*bounds.least > 5 * std::min(smallest, 0.0) - 1e-9 * bounds.scale);
    definite += *bounds.least >= 0;
    negative += bounds.negative.has_value();
    open += *bounds.least < 0 && !bounds.negative;
  }
  CHECK(definite > 90);
  CHECK(negative > 60);
  CHECK(open > 0);
}

// J J' - d I with one column in J: its smallest eigenvalue is -d, and d is of the size of rounding errors.
TEST_CASE("bounds: what hides below rounding errors is covered by the bound") {
  for (int index = 0; index < 2000; ++index) {
    CAPTURE(index);
    Choices choices(index);
    const int size = 2;
    ExactVector J(size);
    Rational trace = 0;
    for (Rational& x : J) {
      x = choices.Integer(50000000, 100000000);
      trace += x * x;
    }
    const Rational d = trace * Rational(choices.Integer(56, 80)) / 32 / Rational(mpz_class(1) << 53);
    ExactMatrix A(size, size);
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) A(i, j) = J[i] * J[j] - (i == j ? d : Rational(0));
    }
    const CurvatureBounds bounds = BoundCurvature(Frictionless(A, J));
    REQUIRE(bounds.least.has_value());
    CHECK(Rational(*bounds.least) <= -d);
  }
}

TEST_CASE("bounds: the distance from the range is zero but for rounding exactly where b is in it") {
  int inside = 0, outside = 0;
  for (int index = 0; index < 200; ++index) {
    CAPTURE(index);
    Choices choices(index);
    const int size = 2 + index % 9;
    ExactProblem problem = RandomGram(size, 1 + index % size, 0, choices);
    if (index % 2 == 0) {
      problem.b = problem.A * ExactVector(problem.b);
    }
    const RangeDistance bound = BoundRangeDistance(problem);
    ExactVector rest = problem.A * bound.x;
    double square = 0, length = 0;
    for (int i = 0; i < size; ++i) {
      square += std::pow(ToDouble(Rational(rest[i] - problem.b[i])), 2);
      length += std::pow(ToDouble(problem.b[i]), 2);
    }
    if (length > 0) CHECK(bound.distance == Approx(std::sqrt(square / length)).margin(1e-300));
    const bool in_range = IsInRange(problem);
    in_range ? ++inside : ++outside;
    CHECK((bound.distance < 1e-9) == in_range);
    CHECK((bound.rough < 1e-6) == in_range);
  }
  CHECK(inside > 50);
  CHECK(outside > 50);
}

TEST_CASE("bounds: what is regular modulo a prime is regular") {
  int regular = 0;
  for (int index = 0; index < 200; ++index) {
    CAPTURE(index);
    Choices choices(index);
    const int size = 1 + index % 6;
    const ExactProblem problem = RandomGram(size, std::max(1, size - index % 2), 0, choices);
    const auto factors = DecideSemidefinite(problem.A);
    bool full = true;
    for (const Rational& d : std::get<LdltFactors>(factors).D) full &= d != 0;
    CHECK(IsRegularModuloPrime(problem) == full);
    regular += full;
  }
  CHECK(regular > 50);
  CHECK(regular < 150);
  CHECK(IsRegularModuloPrime(Frictionless(Matrix({{Rational(1, 3), 0}, {0, -2}}), Vector({0, 0}))));
}

TEST_CASE("(H): decided either way with a certificate, and b in range(A) implies it") {
  int holds = 0, fails = 0, outside = 0;
  for (int index = 0; index < 400; ++index) {
    CAPTURE(index);
    Choices choices(index);
    ExactProblem problem = RandomGram(4, 1 + index % 3, 0, choices);
    problem.contacts = {{ContactKind::kStatic, Rational(choices.Integer(0, 4)) / 2, {}},
                        {ContactKind::kFrictionless, 0, {}},
                        {index % 4 == 0 ? ContactKind::kBilateral : ContactKind::kFrictionless, 0, {}}};
    const Json certificate = HypothesisCertificate(problem);
    const bool holding = certificate["claim"] == "h";
    CHECK(CheckCertificate(certificate, "test").accepted);
    if (IsInRange(problem)) {
      CHECK(holding);
    } else {
      ++outside;
    }
    ++(holding ? holds : fails);
    // The claim cannot be turned round.
    Json other = certificate;
    other["claim"] = holding ? "not-h" : "h";
    CHECK_FALSE(CheckCertificate(other, "test").accepted);
  }
  CHECK(holds > 50);
  CHECK(fails > 50);
  CHECK(holds + outside > 420);  // (H) without b in range(A) occurs
}

TEST_CASE("(H) in space: decided either way with a certificate, but for the edge of a cone") {
  int holds = 0, fails = 0, beyond = 0;
  for (int index = 0; index < Few(200); ++index) {
    CAPTURE(index);
    Choices choices(index);
    ExactProblem problem = RandomGram(8, 1 + index % 5, 0, choices);
    problem.dimension = 3;
    problem.contacts = {{ContactKind::kStatic, Rational(choices.Integer(0, 4)) / 2, {}},
                        {index % 4 == 0 ? ContactKind::kBilateral : ContactKind::kFrictionless, 0, {}},
                        {ContactKind::kStatic, 1, {}},
                        {ContactKind::kFrictionless, 0, {}}};
    const Json certificate = HypothesisCertificate(problem);
    REQUIRE(certificate.is_object());
    const bool holding = certificate["claim"] == "h";
    CHECK(CheckCertificate(certificate, "test").accepted);
    if (IsInRange(problem)) CHECK(holding);
    beyond += holding && !IsInRange(problem);
    ++(holding ? holds : fails);
    Json other = certificate;
    other["claim"] = holding ? "not-h" : "h";
    CHECK_FALSE(CheckCertificate(other, "test").accepted);
  }
  CHECK(holds > Few(40));
  CHECK(fails > Few(40));
  CHECK(beyond > Few(10));
}

TEST_CASE("(H) in space: corners are added where the circle matters") {
  // A v = 0 for v = (5, 3, -4) t alone, which is at the edge of K, and in no polygon of eight sides in it.
  ExactProblem problem;
  problem.dimension = 3;
  problem.contacts = {{ContactKind::kStatic, 1, {}}};
  problem.A = Matrix({{17, -15, 10}, {-15, 25, 0}, {10, 0, Rational(25, 2)}});
  problem.b = Vector({-1, 0, 0});
  const Json fails = HypothesisCertificate(problem);
  REQUIRE(fails.is_object());
  CHECK(fails["claim"] == "not-h");
  CHECK(CheckCertificate(fails, "test").accepted);
  problem.contacts[0].mu = Rational(99, 100);  // no v but 0 is in K
  const Json holds = HypothesisCertificate(problem);
  REQUIRE(holds.is_object());
  CHECK(holds["claim"] == "h");
  CHECK(CheckCertificate(holds, "test").accepted);
  problem.A = ExactMatrix::Zero(3, 3);  // b itself in K*, within the octagon's cone or not
  for (const Rational& normal : {Rational(501, 100), Rational(499, 100)}) {
    problem.contacts[0].mu = 1;
    problem.b = Vector({normal, 3, -4});
    CHECK(HypothesisCertificate(problem)["claim"] == (normal > 5 ? "h" : "not-h"));
  }
}

TEST_CASE("(H): the examples of theory, and what it is not stated for") {
  CHECK(HypothesisCertificate(ReferenceProblem())["claim"] == "h");
  const Json fails = HypothesisCertificate(NoSolution());
  CHECK(fails["claim"] == "not-h");
  CHECK(fails["witness"]["v"][0] == fails["witness"]["v"][1]);  // the kernel of A
  ExactProblem sliding = ReferenceProblem();
  sliding.contacts[0] = {ContactKind::kSliding, 1, {1, 0}};
  CHECK_THROWS_AS(HypothesisCertificate(sliding), InputError);
  CHECK(HypothesisCertificate(NoContacts())["claim"] == "h");
}

}  // namespace
}  // namespace stiction
