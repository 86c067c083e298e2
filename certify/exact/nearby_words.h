// SPDX-License-Identifier: Apache-2.0
// Words of contact modes near a point of doubles, and their equations solved exactly (feasibility_nlp.h).

#pragma once

#include <functional>
#include <optional>
#include <queue>
#include <set>
#include <utility>
#include <vector>

#include "certify/exact/modes.h"
#include "certify/exact/wide_ball.h"
#include "solver/problem/answer.h"

namespace stiction {

// f = force f', where f' solves the problem with A / max abs(A_ij), b / max abs(b_i).
struct ScaledProblem {
  ContactProblem<double> numbers;
  Rational force;
};

// InputError for a friction coefficient beyond the doubles.
ScaledProblem MakeScaled(const ExactProblem& problem);
// Made of what the numbers were rounded to, in the same units.
ScaledProblem MakeScaled(const ExactProblem& problem, const ContactProblem<double>& rounded);

// By how much a point breaks the conditions of a mode.
using RankedMode = std::pair<double, Mode>;

// The words made of ranked modes, in the order of the sum of what is broken.
class WordsByRank {
 public:
  // Of the point f of the scaled problem.
  WordsByRank(const ExactProblem& problem, const ScaledProblem& scaled, const std::vector<double>& f);

  // Empty after the last.
  std::optional<ModeWord> Next();

 private:
  using Entry = std::pair<double, std::vector<int>>;

  void Push(std::vector<int> ranks);

  std::vector<std::vector<RankedMode>> modes_;  // by contact
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waiting_;
};

// A solution of the problem in the word, exactly verified, f and a = A f + b; or undecided. `near`: forces
// close to the point, of few bits. Where the equations leave forces free they are taken as zero, then as in
// `near`: inside its word Ipopt's point has room for the others to follow.
Answer<Rational> SolveWord(const ExactProblem& problem, const ModeWord& word,
                           const std::vector<Rational>& near);

// The same between ends, zero where the word says so: the one solution of the word's equations, if it solves
// the problem, whose numbers are those of `rounded` at their nearest doubles (Rounded, corpus/rounded.h).
// Undecided where balls do not tell every sign that the law asks for.
Answer<NarrowBall> EncloseWord(const ContactProblem<double>& rounded, const ModeWord& word);

// A solution, as by SolveWord, in one of the first `words` words near the point f of the scaled problem; or
// undecided, as near a point that is not finite. Counter: words, whose equations were solved. Those in `tried`
// are passed over, and the others put there.
Answer<Rational> SolveNear(const ExactProblem& problem, const ScaledProblem& scaled,
                           const std::vector<double>& f, int words, std::set<ModeWord>& tried);

}  // namespace stiction
