// SPDX-License-Identifier: Apache-2.0
// The condition number that forbids folds (condition_number.md), against the determinants of all words.

#include "certify/claims/condition.h"

#include <catch2/catch.hpp>

#include "certify/claims/certificate.h"
#include "certify/claims/safe.h"
#include "certify/claims/safety_threshold.h"
#include "corpus/json.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// One contact, eigenvalues 1 and root^2, turned so that the slips have the least determinant; mu = `share` of
// the bound.
ExactProblem AtTheBound(const Rational& root, const Rational& share) {
  const Rational k = root * root, sum = k + 1;
  const Rational normal = 2 * k / sum, mixed = (k - 1) * root / sum, other = (k * k + 1) / sum;
  return MakeProblem({Rational(share * 2 * root / (k - 1))}, {{normal, mixed}, {mixed, other}}, {-1, 0});
}

Json CertificateOf(const ExactProblem& problem) { return ConditionCertificate(problem).value(); }

TEST_CASE("condition: the bound is sharp for one contact") {
  for (const Rational& root : {Rational(3, 2), Rational(2), Rational(12, 5), Rational(10)}) {
    CAPTURE(root.get_d());
    const ExactProblem below = AtTheBound(root, Rational(999, 1000)),
                       above = AtTheBound(root, Rational(1001, 1000));
    CHECK_FALSE(DecideSafety(below).unsafe_word);
    CHECK(DecideSafety(above).unsafe_word);
    CHECK_FALSE(ConditionCertificate(above));
    CHECK(CheckCertificate(CertificateOf(AtTheBound(root, Rational(9, 10))), "c").accepted);
  }
}

TEST_CASE("condition: what it calls safe has positive determinants, whatever the generator", "[slow]") {
  int shown = 0, unsafe = 0;
  for (int index = 0; index < testing::Few(1000); ++index) {
    const auto generator = static_cast<GeneratorId>(index % kOrdinaryGeneratorCount);
    ExactProblem problem = Random<Rational>(generator, 1 + index % 3, index);
    for (auto& contact : problem.contacts) contact.mu /= 1 + index % 7;
    CAPTURE(index);
    const bool is_safe = !DecideSafety(problem).unsafe_word;
    unsafe += !is_safe;
    if (const auto certificate = ConditionCertificate(problem)) {
      ++shown;
      CHECK(is_safe);
      CHECK(CheckCertificate(*certificate, "c").accepted);
    }
    const auto bound = FindConditionBound(problem, FrictionWeights::kUniform);
    const auto threshold = FindSafetyThreshold(problem);
    if (bound && threshold) CHECK(bound->SafeFriction().value() < threshold->high);
  }
  CHECK(shown > testing::Few(100));
  CHECK(unsafe > testing::Few(100));
}

TEST_CASE("condition: more contacts than words can be counted") {
  const int contacts = 12;
  ExactProblem problem;
  problem.contacts.assign(contacts, {ContactKind::kStatic, Rational(1, 2), {}});
  problem.A = ExactMatrix::Identity(2 * contacts, 2 * contacts) * Rational(3);
  for (int i = 1; i < 2 * contacts; ++i) problem.A(i, i - 1) = problem.A(i - 1, i) = 1;
  problem.b = ExactVector::Constant(2 * contacts, Rational(-1));
  CHECK_FALSE(HasFewWords(problem));
  CHECK(CheckCertificate(CertificateOf(problem), "c").accepted);
}

TEST_CASE("condition: a false claim is refused, clause by clause") {
  const Json good = CertificateOf(AtTheBound(2, Rational(9, 10)));
  REQUIRE(CheckCertificate(good, "c").accepted);
  const auto refused = [&](const char* key, const Json& value, const std::string& reason) {
    Json bad = good;
    bad["witness"][key] = value;
    const CheckReport report = CheckCertificate(bad, "c");
    CHECK_FALSE(report.accepted);
    CHECK_THAT(report.reason, Catch::Contains(reason));
  };
  refused("least", "0", "a number > 0");
  refused("least", "100", "least eigenvalue");
  refused("most", "1/100", "largest eigenvalue");
  refused("most", "1000000", "m^2 (u - l)^2 < 4 u l");
  refused("scaling", Json::array({"1", "-1"}), "a number > 0");
  refused("scaling", Json::array({"1"}), "2");
  Json skew = good;
  skew["problem"]["A"][0][1] = "7";
  CHECK_FALSE(CheckCertificate(skew, "c").accepted);
}

TEST_CASE("condition: no bound for singular or asymmetric A") {
  CHECK_FALSE(FindConditionBound(MakeProblem({1}, {{1, 1}, {1, 1}}, {-1, -1}), FrictionWeights::kUniform));
  CHECK_FALSE(FindConditionBound(MakeProblem({1}, {{2, 1}, {0, 2}}, {-1, -1}), FrictionWeights::kUniform));
  const auto smooth = FindConditionBound(MakeProblem({}, {}, {}), FrictionWeights::kUniform);
  CHECK_FALSE(smooth);
}

}  // namespace
}  // namespace stiction
