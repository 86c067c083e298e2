// SPDX-License-Identifier: Apache-2.0
// Facts of a problem: what a survey says of it, and what stands beside an answer.

#include "certify/request/facts.h"

#include <catch2/catch.hpp>
#include <set>

#include "certify/exact/rest.h"
#include "corpus/json.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// Names of the assumptions that fail, by what stands beside an answer.
std::set<std::string> FailedOf(const AnyProblem& problem) {
  std::set<std::string> names;
  const Json failed = FailedAssumptions(problem);
  for (const Json& each : failed) names.insert(each["assumption"].get<std::string>());
  names.erase("h");
  return names;
}

// The same by a survey, which decides all of few rows.
std::set<std::string> SurveyedOf(const AnyProblem& problem) {
  const Json entry = Surveyed(problem, {});
  std::set<std::string> names;
  if (entry["asymmetry"]["difference"] != 0) names.insert("symmetric");
  if (entry["curvature"]["psd"] == false) names.insert("psd");
  if (entry["range"]["in-range"] == false) names.insert("in-range");
  CHECK(entry["meets assumptions"] == names.empty());
  return names;
}

TEST_CASE("facts: a survey and an answer say the same of the paper's assumptions") {
  const std::vector<std::pair<ExactProblem, std::set<std::string>>> cases = {
      {ReferenceProblem(), {}},
      {ThreeSolutions(), {}},
      {MakeProblem({1}, {{1, 2}, {0, 5}}, {1, 4}), {"symmetric"}},
      {MakeProblem({1}, {{1, 2}, {2, 1}}, {1, 4}), {"psd"}},
      {NoSolution(), {"in-range"}},
      {MakeProblem({1}, {{0, 2}, {0, -1}}, {1, 0}), {"symmetric", "psd", "in-range"}}};
  for (const auto& [problem, failing] : cases) {
    CHECK(FailedOf(problem) == failing);
    CHECK(SurveyedOf(problem) == failing);
  }
}

TEST_CASE("facts: of a problem too large for elimination what bounds leave open is undecided") {
  const int size = kQuickRows + 1;
  ExactProblem problem;
  problem.contacts.assign(size, {ContactKind::kFrictionless, 0, {}});
  problem.A = ExactMatrix::Constant(size, size, Rational(1));
  problem.b = ExactVector::Constant(size, Rational(1));
  const Json failed = FailedAssumptions(problem);
  REQUIRE(failed.size() == 2);
  for (const Json& each : failed) CHECK(each.contains("undecided"));
  problem.A = ExactMatrix::Identity(size, size);
  problem.A(0, 0) = -1;
  CHECK(FailedAssumptions(problem)[0]["witness"] == "certify --claim psd");
}

TEST_CASE("facts: what A does not couple is decided part by part, and one without a solution decides") {
  const ExactProblem whole = Decoupled(ReferenceProblem(), ThreeSolutions());
  const std::vector<UncoupledPart> parts = UncoupledParts(whole);
  REQUIRE(parts.size() > 1);
  int rows = 0;
  for (const UncoupledPart& part : parts) {
    rows += part.problem.rows();
    CHECK(part.problem.A == ExactMatrix(whole.A(part.rows, part.rows)));
  }
  CHECK(rows == whole.rows());
  CHECK(UncoupledParts(NoContacts()).size() == 1);
  const auto decided = [](const ExactProblem& problem) { return Surveyed(problem, {})["runs"].back(); };
  const Json solved = decided(whole);
  CHECK((solved["certificate"] == "solution-exists" && solved["groups"] == parts.size()));
  CHECK(decided(Decoupled(ReferenceProblem(), NoSolution()))["outcome"] == "no-solution");
}

TEST_CASE("facts: every run of a survey says how it ended, by which method, and after how many steps") {
  for (const ExactProblem& problem : {ReferenceProblem(), GiveUpProblem()}) {
    const Json entry = Surveyed(problem, {}, kDenseRows, true);
    for (const Json& run : entry["runs"]) {
      CAPTURE(run["method"].get<std::string>());
      CHECK((run.contains("outcome") && run.contains("arithmetic") && run.contains("seconds")));
      if (run["method"] == "baraff") CHECK(run["statistics"].contains("pivots"));
    }
  }
}

}  // namespace
}  // namespace stiction
