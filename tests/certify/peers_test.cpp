// SPDX-License-Identifier: Apache-2.0
// Answers of other packages in corpus/peers: called a success, and wrong over rationals.

#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

#include "certify/exact/exact.h"
#include "certify/exact/neighbour.h"
#include "certify/exact/verify_solution.h"
#include "corpus/formats/read_problem.h"
#include "corpus/json.h"
#include "corpus/rational.h"
#include "corpus/record/problem_file.h"
#include "tests/methods.h"

namespace stiction {
namespace {

TEST_CASE("peers: answers that a package calls a success violate the law, and the problems have solutions") {
  std::set<std::string> packages;
  for (const auto& entry : std::filesystem::directory_iterator(STICTION_SOURCES "/corpus/peers")) {
    if (entry.path().extension() != ".json") continue;
    INFO(entry.path());
    const ProblemFile file = ReadProblem(entry.path());
    const Json origin = file.origin;
    REQUIRE(origin.at("called") == "success");
    packages.insert(origin.at("package"));
    ExactProblem::Vector f(file.problem.rows());
    REQUIRE(origin.at("forces").size() == static_cast<std::size_t>(f.size()));
    bool are_numbers = true;
    for (int i = 0; i < f.size(); ++i) {
      const auto force = ParseRational(origin.at("forces")[i].get<std::string>());
      are_numbers = are_numbers && force;
      if (force) f[i] = *force;
    }
    if (are_numbers) {
      CHECK(FindViolation(file.problem, f));
      CHECK(ExactResidual(file.problem, f) > 1e-6);
    }
    const ExactAnswer complete = RunComplete(file.problem, Limits());
    REQUIRE(complete.outcome == Outcome::kSolved);
    CHECK_FALSE(FindViolation(file.problem, complete.f));
  }
  CHECK(packages.size() == 4);
}

}  // namespace
}  // namespace stiction
