// SPDX-License-Identifier: Apache-2.0
// Scenes made simpler as scenes, minimizing further than one entry at a time, and records.

#include "search/adversary/minimize_candidate.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "corpus/json_text.h"
#include "corpus/record/problem_file.h"
#include "scene/assemble.h"
#include "search/adversary/optimizer.h"
#include "search/adversary/record.h"
#include "search/adversary/trial.h"
#include "search/campaign.h"
#include "search/units/minimize.h"
#include "tests/scratch.h"
#include "tests/support.h"

namespace stiction {
namespace {

bool Cycles(const ExactProblem& problem) {
  return RunExact(problem, {.limits = Campaign().limits}).verdict.outcome == Outcome::kCycle;
}

bool StillCycles(const Candidate& candidate) { return Cycles(ExactOf(candidate)); }

// A loop of two blocks and more, as random scenes have them.
Candidate LoopingScene() {
  Candidate like{GeneratorId::kScenes, 4, {1, 1}, false, {}};
  for (std::uint64_t seed = 0; seed < 200000; ++seed) {
    Candidate candidate = RandomCandidate(like, seed);
    InexactTrial trial(RoundedOf(candidate, nullptr), {}, Campaign().limits);
    if (trial.Loops() && Cycles(ExactOf(candidate))) return candidate;
  }
  FAIL("no scene loops");
  return like;
}

TEST_CASE("minimize candidate: a scene becomes a simpler scene with the same outcome, and then stays") {
  const Candidate found = LoopingScene();
  const MinimizedCandidate minimized = MinimizeCandidate(found, StillCycles);
  CHECK(minimized.accepted > 0);
  CHECK(minimized.accepted < minimized.tried);
  const ProblemFile file = FileOf(minimized.candidate, "simple");
  REQUIRE(Cycles(file.problem));
  REQUIRE(file.scene);
  CHECK(minimized.candidate.contacts <= found.contacts);
  CHECK(minimized.candidate.choices.size() <= found.choices.size());
  const MinimizedCandidate again = MinimizeCandidate(minimized.candidate, StillCycles);
  CHECK(again.candidate == minimized.candidate);
  CHECK(again.accepted == 0);
  const MinimizedCandidate never_again = MinimizeCandidate(found, [](const Candidate&) { return false; });
  CHECK(never_again.candidate == MinimizeCandidate(found, StillCycles, [] { return true; }).candidate);
  CHECK(never_again.accepted == 0);
  const MinimizedCandidate stopped = MinimizeCandidate(found, StillCycles, [] { return true; });
  CHECK(stopped.cancelled);
  CHECK(stopped.accepted == 0);
}

// What rounding all at once and changing one entry at a time leave with entries of two digits and more.
TEST_CASE("minimize: a loop under the whole grid comes down to single digits, mostly", "[slow]") {
  int small = 0, tried = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Choices random(seed);
    ExactProblem problem = testing::MakeProblem(
        {1, 1}, {{3, -4, 2, 0}, {-4, 7, -4, 1}, {2, -4, 7, -6}, {0, 1, -6, 7}}, {-1, 0, 0, -2});
    std::array<Rational, 2> unit;
    for (Rational& u : unit) u = Rational(random.Integer(50, 200)) / 100;
    for (int i = 0; i < 4; ++i) {  // other units, and another loop nearby
      problem.b[i] *= unit[i / 2] * (1 + Rational(random.Integer(-9, 9)) / 10000);
      for (int j = 0; j < 4; ++j) problem.A(i, j) *= unit[i / 2] * unit[j / 2];
    }
    MinimizeOptions options;
    options.policies = PlanarGrid();
    options.further = true;
    options.limits = Campaign().limits;
    if (!AllEndIn(Outcome::kCycle, problem, PlanarGrid(), options.limits)) continue;
    ++tried;
    const Minimized minimized = Minimize(problem, options);
    Rational largest = 0;
    for (int i = 0; i < 4; ++i) {
      largest = std::max<Rational>(largest, abs(minimized.problem.b[i]));
      for (int j = 0; j < 4; ++j) largest = std::max<Rational>(largest, abs(minimized.problem.A(i, j)));
    }
    CAPTURE(seed, ToString(largest));
    small += largest <= 9;
    CHECK(Minimize(minimized.problem, options).accepted == 0);
  }
  CHECK(tried == 4);
  CHECK(small >= 3);  // the fourth ends at 24: no pass is global
}

// ---- Records -----------------------------------------------------------------------------------

FrontierRecord SomeRecord(const char* objective) {
  ProblemFile file;
  file.name = "reference";
  file.problem = testing::ReferenceProblem();
  FrontierRecord record = MakeRecord(*FindObjective(objective), file, Campaign().limits);
  record.frontier = "some";
  record.what = "a record of a test";
  record.command = "none";
  record.build = "test";
  record.processor_seconds = 1;
  record.random_evaluations = 10;
  record.random_command = "none";
  return record;
}

TEST_CASE("record: what is written is read, and holds") {
  const testing::Scratch scratch;
  for (const char* objective : {"period", "friction", "condition", "pieces"}) {
    CAPTURE(objective);
    const FrontierRecord record = SomeRecord(objective);
    CHECK(FaultOf(record, Campaign().limits) == "");
    const auto file = scratch / "some.json";
    std::ofstream(file) << Print(record);
    const FrontierRecord read = ReadRecord(file);
    CHECK(Print(read) == Print(record));
    CHECK(FaultOf(read, Campaign().limits) == "");
    CHECK(ReadRecords(file.parent_path()).size() == 1);
  }
  CHECK(SomeRecord("friction").value == 1);
  const FrontierRecord condition = SomeRecord("condition");
  CHECK(condition.value > Rational(5828, 1000));
}

TEST_CASE("record: every false one is caught") {
  const Limits limits = Campaign().limits;
  FrontierRecord record = SomeRecord("period");
  record.value += 1;
  CHECK(FaultOf(record, limits).find("its value is") != std::string::npos);
  record = SomeRecord("condition");
  record.bounds->first *= 2;  // more than the least eigenvalue
  record.value = record.bounds->second / record.bounds->first;
  CHECK(FaultOf(record, limits).find("not in its bounds") != std::string::npos);
  record = SomeRecord("condition");
  record.value -= Rational(1, 1000);
  CHECK(FaultOf(record, limits).find("quotient") != std::string::npos);
  record = SomeRecord("friction");
  record.problem.problem = testing::GiveUpProblem();
  CHECK(FaultOf(record, limits).find("does not loop") != std::string::npos);
  record = SomeRecord("friction");
  ExactProblem doubled = record.problem.problem;
  doubled.b *= Rational(2);
  record.problem.problem = doubled;  // loops too, but the certificate is of another
  CHECK(FaultOf(record, limits).find("certificate is refused") != std::string::npos);
}

TEST_CASE("record: broken files are refused by their place") {
  const testing::Scratch scratch;
  const std::string text = Print(SomeRecord("friction"));
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"\"stiction-record\"", "\"stiction-problem\""},
                                                        {"\"friction\"", "\"nothing\""},
                                                        {"\"best so far\"", "\"perhaps\""},
                                                        {"\"best so far\"", "\"proved\""},
                                                        {"\"evaluations\":10", "\"evaluations\":-1"}}) {
    std::string damaged = text;
    REQUIRE(damaged.find(from) != std::string::npos);
    damaged.replace(damaged.find(from), from.size(), to);
    std::ofstream(scratch / "some.json") << damaged;
    CAPTURE(from, to);
    CHECK_THROWS_AS(ReadRecord(scratch / "some.json"), InputError);
  }
  FrontierRecord condition = SomeRecord("condition");
  for (const Rational& least : {Rational(0), Rational(-1)}) {
    condition.bounds->first = least;
    std::ofstream(scratch / "some.json") << Print(condition);
    CHECK_THROWS_WITH(ReadRecord(scratch / "some.json"),
                      Catch::Contains("bounds") && Catch::Contains("above zero"));
  }
  std::ofstream(scratch / "other.json") << text;
  std::filesystem::remove(scratch / "some.json");
  CHECK_THROWS_WITH(ReadRecords(scratch / "."), Catch::Contains("the name of the file"));
  CHECK_THROWS_AS(ReadRecords(scratch / "none"), InputError);
}

}  // namespace
}  // namespace stiction
