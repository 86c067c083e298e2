// SPDX-License-Identifier: Apache-2.0
// The signature of a loop: unchanged where the loop is the same, different where it is not.

#include "search/units/signature.h"

#include <catch2/catch.hpp>
#include <set>

#include "solver/problem/check.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;
using Catch::Contains;

std::string SignatureUnder(const ExactProblem& problem, const std::string& policy) {
  return Signature(problem, RunExact(problem, {.policy = ParsePolicy(policy)}));
}

std::string WordUnder(const ExactProblem& problem, const std::string& policy) {
  return LoopWord(problem, RunExact(problem, {.policy = ParsePolicy(policy)}));
}

// visit(problem) for the reference problem and random ones, all of which cycle.
template <class Visit>
void ForEachLoop(Visit visit) {
  visit(ReferenceProblem());
  for (const CyclingSeed& seed : CyclingSeeds()) {
    CAPTURE(seed.index);
    visit(Cycling(seed));
  }
}

TEST_CASE("signature: of the reference problem it has its outcome, contacts, drives and steps, and a word") {
  const ExactProblem problem = ReferenceProblem();
  CHECK_THAT(SignatureUnder(problem, "paper"), Catch::StartsWith("cycle-2c-4d-10s-"));
  const std::string word = WordUnder(problem, "paper");
  CHECK(std::count(word.begin(), word.end(), ' ') == 10);  // one item per step
  CHECK(std::count(word.begin(), word.end(), '=') == 2);   // of length zero
}

TEST_CASE("signature: reversing tangents does not change it") {
  ForEachLoop([](const ExactProblem& problem) {
    const std::string signature = SignatureUnder(problem, "ties=contacts");
    const std::string word = WordUnder(problem, "ties=contacts");
    for (int turned = 1; turned < 1 << problem.contacts.size(); ++turned) {
      std::vector<Rational> unit;
      for (int row = 0; row < problem.rows(); ++row) {
        unit.push_back(row % 2 == 1 && (turned >> (row / 2) & 1) != 0 ? -1 : 1);
      }
      CHECK(SignatureUnder(InUnits(problem, unit), "ties=contacts") == signature);
      CHECK(WordUnder(InUnits(problem, unit), "ties=contacts") == word);
    }
  });
}

TEST_CASE("signature: other units of A, b and mu do not change it") {
  ForEachLoop([](const ExactProblem& problem) {
    ExactProblem scaled = problem;
    std::vector<Rational> unit;
    for (int row = 0; row < problem.rows(); ++row) {
      unit.push_back(Rational(1 + row) / 3);
      scaled.b[row] *= Rational(2, 7);
      for (int j = 0; j < problem.rows(); ++j) scaled.A(row, j) *= 5;
    }
    CHECK(SignatureUnder(scaled, "paper") == SignatureUnder(problem, "paper"));
    CHECK(SignatureUnder(InUnits(problem, unit), "paper") == SignatureUnder(problem, "paper"));
    CHECK(WordUnder(InUnits(problem, unit), "paper") == WordUnder(problem, "paper"));
  });
}

TEST_CASE("signature: contacts in the opposite order, scanned in the opposite order, do not change it") {
  ForEachLoop([](const ExactProblem& problem) {
    CHECK(SignatureUnder(Reversed(problem), "scan=highest") == SignatureUnder(problem, "paper"));
    CHECK(WordUnder(Reversed(problem), "scan=highest") == WordUnder(problem, "paper"));
  });
}

TEST_CASE("signature: any order of contacts does not change it where the scan does not look at the order") {
  int loops = 0;
  ForEachLoop([&loops](const ExactProblem& problem) {
    const std::string policy = "scan=most-violated";
    if (RunExact(problem, {.policy = ParsePolicy(policy)}).verdict.outcome != Outcome::kCycle) return;
    ++loops;
    CHECK(WordUnder(Reversed(problem), policy) == WordUnder(problem, policy));
    CHECK(SignatureUnder(Reversed(problem), policy) == SignatureUnder(problem, policy));
  });
  CHECK(loops > 0);
}

TEST_CASE("signature: a word is that of one period, wherever the run entered it") {
  const ExactRun run = RunExact(ReferenceProblem(), {});
  const std::string word = LoopWord(ReferenceProblem(), run);
  ExactRun shifted = run;
  auto& pivots = shifted.trace.pivots;
  const auto is_first = [&run](const auto& pivot) { return pivot.drive == run.verdict.start + 1; };
  const auto first = std::find_if(pivots.begin(), pivots.end(), is_first);
  const auto last = std::find_if_not(first, pivots.end(), is_first);
  // The first drive of the period comes again after its last.
  std::vector<Pivot<Rational>> again(first, last);
  for (auto& pivot : again) pivot.drive = static_cast<int>(run.verdict.start + run.verdict.period) + 1;
  pivots.insert(pivots.end(), again.begin(), again.end());
  shifted.verdict.start += 1;
  CHECK(LoopWord(ReferenceProblem(), shifted) == word);
  CHECK(Signature(ReferenceProblem(), shifted) == Signature(ReferenceProblem(), run));
}

TEST_CASE("signature: different loops have different signatures") {
  std::set<std::string> signatures;
  std::set<std::string> words;
  ForEachLoop([&](const ExactProblem& problem) {
    const ExactRun run = RunExact(problem, {});
    signatures.insert(Signature(problem, run));
    words.insert(LoopWord(problem, run));
  });
  CHECK(signatures.size() >= 4);
  CHECK(words.size() >= signatures.size());
  CHECK(WordUnder(ReferenceProblem(), "paper") != WordUnder(ReferenceProblem(), "file=yes"));
}

TEST_CASE("signature: of another outcome only its name and the contacts remain, and it has no word") {
  const ExactRun run = RunExact(GiveUpProblem(), {});
  CHECK(Signature(GiveUpProblem(), run) == "solved-2c");
  CHECK_THROWS_AS(LoopWord(GiveUpProblem(), run), InternalError);
}

}  // namespace
}  // namespace stiction
