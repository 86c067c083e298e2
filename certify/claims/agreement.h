// SPDX-License-Identifier: Apache-2.0
// Agreement: what several exact methods answer about one problem, held against each other and against what is
// proved of them.
//
// For A symmetric positive semidefinite and b in range(A), which all problems here must have:
//
//   - every solution that a method returns meets (15) and (16), by verify_solution.h;
//   - complete driving and Lemke's method end in a solution (solver/complete/complete_driving.md,
//   solver/lemke/lemke.h);
//   - some mode has a solution, and those of the other methods stand among the words that have any;
//   - if A is definite and all solutions are *regular*, the signs of their reduced determinants sum to 1
//     (complete_driving.md, 3), so their number is odd;
//   - under `apex=suspended` the published algorithm gives nothing up in a safe problem (safe.h), as long as no
//     step has a tie.
//
// Where contacts slide, only the first holds, and that a solution which was found stands among the words that
// have any.
//
// Anything else refutes a program or a proof here.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "certify/exact/enumerate.h"
#include "certify/exact/exact.h"
#include "corpus/json_text.h"
#include "solver/problem/answer.h"

namespace stiction {

struct Answers {
  std::vector<Answer<Rational>> methods;  // that follow one path; of each: method, outcome, f
  std::optional<Enumeration> modes;       // where they were tried
};

struct Disagreement {
  std::string
      what;  // for a signature: "lemke-ray", "complete-wrong", "enumerate-none", "baraff-unlisted", "signs"
  std::string reason;  // in words, with numbers
};

// The first, in the order above; empty if all agree. A method that did not end in `solved` says nothing, unless
// it is `complete` or `lemke`; an enumeration that is not complete says nothing but its solutions.
std::optional<Disagreement> FindDisagreement(const ExactProblem& problem, const Answers& answers);

SharedJson AnswersToJson(const Answers& answers);

// What is compared of a method, f if it solved.
Answer<Rational> AnswerBy(std::string_view method, Outcome outcome, ExactVector f = {});

// Solutions of a complete enumeration.
struct SolutionCount {
  int words = 0;           // that have solutions
  bool continuum = false;  // some word has more than one
  // Every solution stands in one word only, hence inside it, and its reduced determinant is not zero.
  bool regular = false;
  int signs = 0;  // sum of the signs of the reduced determinants, of regular solutions
};
SolutionCount CountSolutions(const ExactProblem& problem, const Enumeration& modes);

// Whether, after some step, a variable other than the one that limited it stands at a limit of its set, or one
// in no set where its conditions change. Never, for b in general position.
bool HasTies(const ExactProblem& problem, const ExactRun& run);

}  // namespace stiction
