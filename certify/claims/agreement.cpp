// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/agreement.h"

#include <fmt/format.h>

#include <algorithm>

#include "certify/claims/certificate.h"
#include "certify/claims/safe.h"
#include "certify/claims/witness.h"
#include "certify/exact/hypothesis.h"
#include "certify/exact/verify_solution.h"
#include "corpus/json.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

using Found = std::optional<Disagreement>;

Found FindWrongSolution(const ExactProblem& problem, std::string_view method, const ExactVector& f) {
  const auto violation = FindViolation(problem, f);
  if (!violation) return std::nullopt;
  return Disagreement{fmt::format("{}-wrong", method), fmt::format("{}: {}", method, *violation)};
}

bool MustSolve(const Answer<Rational>& answer) {
  return answer.method == "complete" || answer.method == "lemke";
}

// With sliding contacts there may be none.
bool HasSolution(const ExactProblem& problem) { return !HasSlidingContact(problem); }

// Whether f is a solution of one of the words, and the only one of a word that has only one.
bool IsListed(const ExactProblem& problem, const Enumeration& modes, const ExactVector& f) {
  const ExactVector a = Accelerations(problem, f);
  return std::any_of(modes.solutions.begin(), modes.solutions.end(), [&](const WordSolution& solution) {
    return MeetsModes(problem, solution.word, f, a) && (!solution.unique || solution.f == f);
  });
}

Found CompareWithModes(const ExactProblem& problem, const Answers& answers) {
  const Enumeration& modes = *answers.modes;
  if (modes.solutions.empty() && HasSolution(problem))
    return Disagreement{"enumerate-none", fmt::format("all {} refuted prefixes say that no mode has a solution",
                                                      modes.refuted.size())};
  for (const Answer<Rational>& answer : answers.methods) {
    if (answer.outcome != Outcome::kSolved || IsListed(problem, modes, answer.f)) continue;
    return Disagreement{fmt::format("{}-unlisted", answer.method),
                        fmt::format("the solution of {} stands in none of the {} words that have solutions",
                                    answer.method, modes.solutions.size())};
  }
  return std::nullopt;
}

Found CheckSigns(const ExactProblem& problem, const Enumeration& modes) {
  if (!HasSolution(problem)) return std::nullopt;
  const SolutionCount count = CountSolutions(problem, modes);
  if (!count.regular || count.signs == 1) return std::nullopt;
  ModeWord all_clamped;  // its reduced matrix is A
  for (const auto& contact : problem.contacts)
    all_clamped.push_back(contact.HasFrictionRows() ? Mode::kStick : Mode::kTouch);
  if (ReducedDeterminant(problem, all_clamped) == 0) return std::nullopt;
  return Disagreement{"signs", fmt::format("the signs of {} regular solutions sum to {}, expected 1",
                                           count.words, count.signs)};
}

// Whether the variable stands at a limit of its set.
bool StandsAtLimit(IndexSet set, bool normal, const Rational& f, const Rational& a, const Rational& bound) {
  switch (set) {
    case IndexSet::kClamped:
      return f == 0;
    case IndexSet::kSticking:
      return abs(f) == bound;
    case IndexSet::kSeparating:
    case IndexSet::kAtLower:
    case IndexSet::kAtUpper:
    case IndexSet::kSuspended:
      return a == 0;
    case IndexSet::kNone:
      return normal ? f == 0 && a == 0 : a == 0 || (f != 0 && abs(f) == bound);
  }
  return true;
}

}  // namespace

std::optional<Disagreement> FindDisagreement(const ExactProblem& problem, const Answers& answers) {
  for (const Answer<Rational>& answer : answers.methods) {
    if (answer.outcome != Outcome::kSolved) continue;
    if (auto wrong = FindWrongSolution(problem, answer.method, answer.f)) return wrong;
  }
  if (answers.modes) {
    for (const WordSolution& solution : answers.modes->solutions) {
      if (auto wrong = FindWrongSolution(problem, "enumerate", solution.f)) return wrong;
    }
  }
  for (const Answer<Rational>& answer : answers.methods) {
    if (!MustSolve(answer) || answer.outcome == Outcome::kSolved || !HasSolution(problem)) continue;
    return Disagreement{fmt::format("{}-{}", answer.method, Name(answer.outcome)),
                        fmt::format("{} ended in {}, expected solved", answer.method, Name(answer.outcome))};
  }
  if (!answers.modes || answers.modes->end != EnumerationEnd::kComplete) return std::nullopt;
  if (auto found = CompareWithModes(problem, answers)) return found;
  return CheckSigns(problem, *answers.modes);
}

Answer<Rational> AnswerBy(std::string_view method, Outcome outcome, ExactVector f) {
  Answer<Rational> answer;
  answer.method = method;
  answer.outcome = outcome;
  answer.f = std::move(f);
  return answer;
}

SharedJson AnswersToJson(const Answers& answers) {
  Json json = Json::array();
  for (const Answer<Rational>& answer : answers.methods) {
    Json entry = {{"method", answer.method}, {"outcome", Name(answer.outcome)}};
    if (answer.outcome == Outcome::kSolved) entry["f"] = ListJson(answer.f);
    json.push_back(std::move(entry));
  }
  if (!answers.modes) return json;
  Json solutions = Json::array();
  for (const WordSolution& solution : answers.modes->solutions) {
    const Json word = WordToJson(solution.word);
    solutions.push_back({{"modes", word}, {"f", ListJson(solution.f)}, {"unique", solution.unique}});
  }
  json.push_back({{"method", "enumerate"},
                  {"complete", answers.modes->end == EnumerationEnd::kComplete},
                  {"solutions", std::move(solutions)}});
  return json;
}

SolutionCount CountSolutions(const ExactProblem& problem, const Enumeration& modes) {
  STICTION_CHECK(modes.end == EnumerationEnd::kComplete, "solutions are counted after all words");
  SolutionCount count;
  count.words = static_cast<int>(modes.solutions.size());
  count.continuum = std::any_of(modes.solutions.begin(), modes.solutions.end(),
                                [](const WordSolution& solution) { return !solution.unique; });
  // A solution on the boundary of its mode is listed in the next mode too.
  count.regular = !count.continuum && modes.distinct_witnesses == count.words;
  if (!count.regular) return count;
  for (const WordSolution& solution : modes.solutions) {
    const int sign = sgn(ReducedDeterminant(problem, solution.word));
    count.regular = count.regular && sign != 0;
    count.signs += sign;
  }
  return count;
}

bool HasTies(const ExactProblem& problem, const ExactRun& run) {
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(problem.contacts);
  for (const Pivot<Rational>& pivot : run.trace.pivots) {
    for (int row = 0; row < problem.rows(); ++row) {
      if (row == pivot.limiting) continue;
      const bool normal = layout.IsNormal(row);
      const Rational bound =
          normal ? Rational(0) : Rational(problem.contacts[layout.ContactOf(row)].mu * pivot.f[row - 1]);
      if (StandsAtLimit(pivot.sets[row], normal, pivot.f[row], pivot.a[row], bound)) return true;
    }
  }
  return false;
}

}  // namespace stiction
