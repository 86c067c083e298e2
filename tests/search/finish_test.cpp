// SPDX-License-Identifier: Apache-2.0
// Finishing: what a finding has in the end, and the alarms that ring only then.

#include "search/units/finish.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "certify/claims/certificate.h"
#include "certify/exact/enumerate.h"
#include "certify/exact/exact.h"
#include "corpus/json.h"
#include "corpus/record/kinds.h"
#include "corpus/record/problem_file.h"
#include "search/units/signature.h"
#include "tests/methods.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

const Limits kBudget = {1000, 10000, 100000};

bool Never() { return false; }

// As a unit leaves it.
Finding FoundAs(const ExactProblem& problem, const std::string& kind, const std::string& policy = "paper") {
  const ExactRun run = RunExact(problem, {.policy = ParsePolicy(policy), .limits = kBudget});
  ProblemFile file;
  file.name = "found";
  file.problem = problem;
  Finding finding;
  finding.kind = kind;
  finding.signature = Signature(problem, run);
  finding.unit = 3;
  finding.index = 5;
  finding.generator = "integers";
  finding.contacts = static_cast<int>(problem.contacts.size());
  finding.policy = policy;
  finding.inexact_outcome = "cycle";
  finding.exact_outcome = Name(run.verdict.outcome);
  finding.problem = ToJson(file)->dump();
  return finding;
}

Finding FinishedFrom(const Finding& finding, const ExactMethods& methods = {}) {
  const auto finished = FinishFinding(finding, kBudget, Never, methods);
  REQUIRE(finished.has_value());
  return *finished;
}

// Of a certificate that stands.
std::string ClaimIn(const std::string& text) {
  const CheckReport report = CheckCertificate(Json::parse(text), "certificate");
  CHECK(report.accepted);
  return report.claim;
}

TEST_CASE("finish: a cycle is certified, minimized with its signature, and certified again") {
  const Finding found = FoundAs(ReferenceProblem(), "cycle");
  const Finding finished = FinishedFrom(found);
  CHECK(finished.done);
  CHECK(finished.kind == "cycle");
  CHECK(finished.signature == found.signature);
  CHECK(finished.problem == found.problem);
  CHECK(ClaimIn(finished.certificate) == "cycle");
  CHECK(ClaimIn(finished.minimized_certificate) == "cycle");
  CHECK(ClaimIn(finished.existence) == "solution-exists");
  CHECK(ClaimIn(finished.minimized_existence) == "solution-exists");
  const ProblemFile small = ParseProblem(finished.minimized, "minimized");
  CHECK(Signature(small.problem, RunExact(small.problem, {})) == found.signature);
  CHECK(small.expect == std::map<std::string, std::string>{{"paper", "cycle"}});
  CHECK(small.origin->at("parent") == "integers-3-5");
  const Json facts = Json::parse(finished.facts);
  CHECK(facts.at("found").at("grid") == Json{{"solved", 216}, {"cycle", 1320}});
  CHECK(facts.at("found").at("safe") == false);
  CHECK(facts.at("found").at("start") == 3);
  CHECK(facts.at("found").at("period") == 4);
  CHECK(facts.at("found").at("steps") == 13);
  CHECK(facts.at("found").at("existence").at("method") == "complete");
  CHECK(facts.at("minimized").at("outcome") == "cycle");
  CHECK_FALSE(facts.contains("disagreement"));
  CHECK(facts.at("ipopt").at("outcome") == "solved");
  CHECK(facts.at("ipopt").at("starts") >= 1);
}

TEST_CASE("finish: what Ipopt says is written down, and decides nothing") {
  const Finding found = FoundAs(ReferenceProblem(), "cycle");
  ExactMethods methods;
  methods.ipopt = [](const ExactProblem& problem) {
    CHECK(problem.b == ReferenceProblem().b);
    return Feasibility{"undecided", 20, 0};
  };
  const auto finished = FinishFinding(
      found, {}, [] { return false; }, methods);
  REQUIRE(finished);
  CHECK(Json::parse(finished->facts).at("ipopt") == Json{{"outcome", "undecided"}, {"starts", 20}});
  CHECK(finished->kind == "cycle");
  CHECK(ClaimIn(finished->existence) == "solution-exists");
}

TEST_CASE("finish: what the whole grid shows is minimized for the whole grid, and certified under all of it",
          "[slow]") {
  const auto seed =
      std::find_if(CyclingSeeds().begin(), CyclingSeeds().end(), [](const CyclingSeed& candidate) {
        return AllEndIn(Outcome::kCycle, Cycling(candidate), PlanarGrid(), kBudget);
      });
  REQUIRE(seed != CyclingSeeds().end());
  const Finding finished = FinishedFrom(FoundAs(Cycling(*seed), "cycle"));
  const ProblemFile small = ParseProblem(finished.minimized, "minimized");
  CHECK(AllEndIn(Outcome::kCycle, small.problem, PlanarGrid(), kBudget));
  CHECK(small.expect == std::map<std::string, std::string>{{"*", "cycle"}});
  CHECK(CertifiedPolicies(Json::parse(finished.certificate)).size() == 1);
  CHECK(CertifiedPolicies(Json::parse(finished.minimized_certificate)).size() == PlanarGrid().size());
}

TEST_CASE("finish: what the whole grid shows stays so, where one policy alone would allow a simpler problem") {
  const Limits few = {1000, 5, 100000};  // no policy ends within five steps
  Finding found = FoundAs(ReferenceProblem(), "limit");
  found.signature = "limit-2c";
  found.exact_outcome = "limit";
  ExactMethods methods;  // those that end do
  methods.complete = [](const ExactProblem& problem, const Limits&) { return RunComplete(problem, kBudget); };
  methods.lemke = [](const ExactProblem& problem, const Limits&) { return RunLemke(problem, kBudget); };
  const auto finished = FinishFinding(found, few, Never, methods);
  REQUIRE(finished.has_value());
  CHECK(finished->kind == "limit");
  const ExactProblem small = ParseProblem(finished->minimized, "minimized").problem;
  CHECK(AllEndIn(Outcome::kLimit, small, PlanarGrid(), few));
  CHECK(Json::parse(finished->facts).at("minimized").at("grid") == Json{{"limit", 1536}});
}

TEST_CASE("finish: what exact numbers solve has the certificate of its solution, and no minimized form") {
  const Finding finished = FinishedFrom(FoundAs(GiveUpProblem(), "disagreement"));
  CHECK(finished.done);
  CHECK(finished.kind == "disagreement");
  CHECK(ClaimIn(finished.certificate) == "solution-exists");
  CHECK(ClaimIn(finished.existence) == "solution-exists");
  CHECK(finished.minimized.empty());
  CHECK(finished.minimized_certificate.empty());
  CHECK(finished.minimized_existence.empty());
}

TEST_CASE("finish: of a problem without a solution that is certified") {
  const Finding finished = FinishedFrom(FoundAs(NoSolution(), "ray"));
  CHECK(ClaimIn(finished.existence) == "no-solution");
  CHECK(finished.kind == kDisagreementOfMethods);  // complete driving did not solve it
}

TEST_CASE("finish: methods that contradict each other make it a grave finding, kept as it was found") {
  ExactMethods complete, lemke, modes;
  complete.complete = [](const ExactProblem& problem, const Limits& limits) {
    ExactAnswer run = RunComplete(problem, limits);
    run.outcome = Outcome::kRay;
    return run;
  };
  lemke.lemke = [](const ExactProblem& problem, const Limits& limits) {
    ExactAnswer run = RunLemke(problem, limits);
    run.f[0] += 1;
    return run;
  };
  modes.modes = [](const ExactProblem& problem) {
    Enumeration none = EnumerateModes(problem);
    none.solutions.clear();
    return none;
  };
  const Finding found = FoundAs(ReferenceProblem(), "cycle");
  for (const ExactMethods* wrong : {&complete, &lemke, &modes}) {
    const Finding finished = FinishedFrom(found, *wrong);
    CHECK(finished.kind == kDisagreementOfMethods);
    CHECK(finished.signature == found.signature);
    CHECK(finished.minimized.empty());
    const Json facts = Json::parse(finished.facts);
    CHECK(facts.at("answers").size() == 4);
    CHECK_FALSE(facts.at("disagreement").get<std::string>().empty());
  }
}

TEST_CASE("finish: a cycle that is safe once minimized is a grave finding") {
  const Finding found = FoundAs(ReferenceProblem(), "cycle");
  ExactMethods safe, undecided;
  safe.is_safe = [](const ExactProblem&) { return true; };
  undecided.is_safe = [](const ExactProblem&) { return std::nullopt; };
  const Finding finished = FinishedFrom(found, safe);
  CHECK(finished.kind == kSafeCycle);
  CHECK(finished.signature == found.signature);
  const Finding unknown = FinishedFrom(found, undecided);
  CHECK(unknown.kind == "cycle");
  CHECK(Json::parse(unknown.facts).at("minimized").at("safe").is_null());
}

TEST_CASE("finish: cancelled at any moment, nothing is returned") {
  const Finding found = FoundAs(ReferenceProblem(), "cycle");
  int asked = 0;
  for (int least = 0; least < 2000; least = 3 * least + 1) {
    asked = 0;
    CHECK_FALSE(FinishFinding(found, kBudget, [&] { return ++asked > least; }).has_value());
  }
}

}  // namespace
}  // namespace stiction
