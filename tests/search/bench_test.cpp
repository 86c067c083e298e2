// SPDX-License-Identifier: Apache-2.0
// The problems of `stiction bench --suite methods`, and its statistics by hand.

#include <catch2/catch.hpp>

#include "certify/existence.h"
#include "certify/properties.h"
#include "search/bench/family.h"
#include "search/bench/measure.h"

namespace stiction {
namespace {

TEST_CASE("bench: the definite family is positive definite, and as its header says") {
  int forced = 0, normals = 0;
  for (int index = 0; index < 160; ++index) {
    CAPTURE(index);
    const int contacts = 1 + index % 4;
    const BenchProblem problem = MakeBenchProblem({}, contacts, 7, index);
    REQUIRE(problem.exact.rows() == 2 * contacts);
    CHECK(problem.friction == index % 8);
    const auto definite = DecideSemidefinite(problem.exact.A);
    (void)definite;
    for (int i = 0; i < problem.exact.rows(); ++i) {
      CHECK(abs(problem.exact.b[i]) <= 1000000);
      CHECK(Rational(problem.rounded.b[i]) == problem.exact.b[i]);
      normals += i % 2 == 0;
      forced += i % 2 == 0 && problem.exact.b[i] <= 0;
    }
  }
  CHECK(forced > 0.7 * normals);  // 4/5 are to be expected
  CHECK(forced < 0.9 * normals);
}

}  // namespace
}  // namespace stiction
