// SPDX-License-Identifier: Apache-2.0
// Agreement of methods: right answers agree, and every kind of wrong one is noticed.

#include "certify/claims/agreement.h"

#include <catch2/catch.hpp>

#include "corpus/json.h"
#include "tests/methods.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;
using Catch::Matchers::Contains;

const Limits kLimits = {1000, 10000, 100000};

// What the methods really say.
Answers AnswersOf(const ExactProblem& problem) {
  const ExactRun published = RunExact(problem, {.limits = kLimits});
  return {{AnswerBy("baraff", published.verdict.outcome, published.f), RunComplete(problem, kLimits),
           RunLemke(problem, kLimits)},
          EnumerateModes(problem)};
}

ExactAnswer& Of(Answers& answers, std::string_view method) {
  for (ExactAnswer& answer : answers.methods) {
    if (answer.method == method) return answer;
  }
  throw std::logic_error("no such method");
}

std::string What(const ExactProblem& problem, const Answers& answers) {
  const auto disagreement = FindDisagreement(problem, answers);
  return disagreement ? disagreement->what : "";
}

TEST_CASE("agreement: methods that are right agree") {
  for (const ExactProblem& problem : {ReferenceProblem(), GiveUpProblem(), ThreeSolutions()})
    CHECK(What(problem, AnswersOf(problem)).empty());
  for (int generator = 0; generator < kOrdinaryGeneratorCount; ++generator) {
    for (const int contacts : {1, 2, 3}) {
      for (std::uint64_t index = 0; index < 4; ++index) {
        const auto problem = Random<Rational>(static_cast<GeneratorId>(generator), contacts, index);
        CAPTURE(generator, contacts, index);
        CHECK(What(problem, AnswersOf(problem)).empty());
      }
    }
  }
}

TEST_CASE("agreement: a wrong solution is noticed, whoever returns it") {
  const ExactProblem problem = GiveUpProblem();
  for (const char* method : {"baraff", "complete", "lemke"}) {
    Answers answers = AnswersOf(problem);
    REQUIRE(Of(answers, method).outcome == Outcome::kSolved);
    Of(answers, method).f[0] += Rational(1, 1000000);
    CHECK(What(problem, answers) == std::string(method) + "-wrong");
    CHECK_THAT(FindDisagreement(problem, answers)->reason, Contains("contact 1"));
  }
  Answers answers = AnswersOf(problem);
  answers.modes->solutions[0].f[0] -= 1;
  CHECK(What(problem, answers) == "enumerate-wrong");
}

TEST_CASE("agreement: complete driving and Lemke's method must solve, the published algorithm need not") {
  const ExactProblem problem = GiveUpProblem();
  for (const char* method : {"complete", "lemke"}) {
    for (const Outcome outcome : {Outcome::kRay, Outcome::kLimit, Outcome::kUndecided}) {
      Answers answers = AnswersOf(problem);
      Of(answers, method).outcome = outcome;
      CHECK(What(problem, answers) == std::string(method) + "-" + std::string(Name(outcome)));
    }
  }
  Answers answers = AnswersOf(problem);
  Of(answers, "baraff").outcome = Outcome::kCycle;
  CHECK(What(problem, answers).empty());
}

TEST_CASE("agreement: an enumeration that misses solutions is noticed") {
  const ExactProblem problem = ThreeSolutions();
  const Answers right = AnswersOf(problem);
  REQUIRE(right.modes->solutions.size() == 3);

  Answers answers = right;
  answers.modes->solutions.clear();
  CHECK(What(problem, answers) == "enumerate-none");

  int unlisted = 0, signs = 0;
  for (int i = 0; i < 3; ++i) {
    answers = right;
    answers.modes->solutions.erase(answers.modes->solutions.begin() + i);
    --answers.modes->distinct_witnesses;
    const std::string what = What(problem, answers);
    CAPTURE(what);
    unlisted += what.ends_with("-unlisted");
    signs += what == "signs";
  }
  CHECK(unlisted >= 1);  // that of the three which complete driving finds
  CHECK(unlisted + signs == 3);
  CHECK(signs >= 1);

  // One that was stopped claims nothing about what it has not seen.
  answers.modes->solutions.clear();
  answers.modes->end = EnumerationEnd::kLimit;
  CHECK(What(problem, answers).empty());
}

TEST_CASE("agreement: a word that is said to have one solution does not list another") {
  // Two supports of one body: any share of the load is a solution, and the enumeration must say so.
  const ExactProblem table = MakeProblem({-1, -1}, {{1, 1}, {1, 1}}, {-1, -1});
  Answers answers = AnswersOf(table);
  CHECK(What(table, answers).empty());
  for (WordSolution& solution : answers.modes->solutions) {
    solution.f = Vector({Rational(1, 3), Rational(2, 3)});
    solution.unique = true;
  }
  CHECK(What(table, answers) == "baraff-unlisted");
}

TEST_CASE("agreement: the answers are written down with what they claim") {
  const Json json = AnswersToJson(AnswersOf(ThreeSolutions()));
  REQUIRE(json.size() == 4);
  CHECK(json[1]["method"] == "complete");
  CHECK(json[1]["outcome"] == "solved");
  CHECK(json[1]["f"].size() == 2);
  CHECK(json[3]["method"] == "enumerate");
  CHECK(json[3]["solutions"].size() == 3);
  CHECK_FALSE(AnswersToJson({{AnswerBy("lemke", Outcome::kRay)}, {}})->at(0).contains("f"));
}

TEST_CASE("agreement: solutions are counted with their signs") {
  const SolutionCount three = CountSolutions(ThreeSolutions(), EnumerateModes(ThreeSolutions()));
  CHECK((three.words == 3 && three.regular && !three.continuum && three.signs == 1));

  // At rest with aN = 0: f = 0 is the only solution, on the boundary of every mode.
  const ExactProblem rest = MakeProblem({1}, {{2, 0}, {0, 1}}, {0, 0});
  const SolutionCount corner = CountSolutions(rest, EnumerateModes(rest));
  CHECK((corner.words > 1 && !corner.regular && !corner.continuum));

  // Two supports of one body: the load can be shared in many ways.
  const ExactProblem table = MakeProblem({-1, -1}, {{1, 1}, {1, 1}}, {-1, -1});
  const SolutionCount many = CountSolutions(table, EnumerateModes(table));
  CHECK((many.continuum && !many.regular));

  int regular = 0;
  for (std::uint64_t index = 0; index < 60; ++index) {
    const auto problem = Random<Rational>(GeneratorId::kPsd, 2, index);
    const SolutionCount count = CountSolutions(problem, EnumerateModes(problem));
    if (!count.regular) continue;
    ++regular;
    CHECK((count.words % 2 == 1 && count.signs == 1));
  }
  CHECK(regular > 20);
}

TEST_CASE("agreement: ties are told from steps of length zero") {
  // The period of the reference problem has steps of length zero, at folds, and no tie.
  const ExactRun cycle = RunExact(ReferenceProblem(), {.limits = kLimits});
  REQUIRE(cycle.verdict.statistics.zero_steps > 0);
  CHECK_FALSE(HasTies(ReferenceProblem(), cycle));

  // Two equal contacts, driven one after the other; the second is satisfied with the first, to the bit.
  const ExactProblem twins = MakeProblem({1, 1}, {{1, 0, 1, 0}, {0, 1, 0, 1}, {1, 0, 1, 0}, {0, 1, 0, 1}},
                                         {-1, Rational(1, 2), -1, Rational(1, 2)});
  CHECK(HasTies(twins, RunExact(twins, {.limits = kLimits})));
}

}  // namespace
}  // namespace stiction
