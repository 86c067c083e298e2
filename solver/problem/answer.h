// SPDX-License-Identifier: Apache-2.0
// Answer: what one method says of one problem, over any scalar.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/problem/counters.h"
#include "solver/problem/options.h"
#include "solver/problem/problem.h"
#include "solver/problem/solution.h"

namespace stiction {

struct Enclosure {
  double low = 0, high = 0;
};

// Rows and contacts are those of the whole problem. Vectors that a method does not have are empty.
// Answer<double> stands for all inexact numbers: those of quad are rounded before they are judged; over
// enclosures its vectors are midpoints.
template <class Scalar>
struct Answer {
  using Vector = typename ContactProblem<Scalar>::Vector;

  Outcome outcome = Outcome::kUndecided;
  std::string reason;      // which limit, or why not decided
  std::int64_t start = 0;  // of a loop, in drives
  std::int64_t period = 0;
  std::string_view method;  // that gave the answer, by its name in the table
  Arithmetic arithmetic = kArithmeticOf<Scalar>;
  FrictionLaw law = FrictionLaw::kBaraff;  // that f is meant to obey
  Vector f, a;                             // where the run ended; a = A f + b
  Vector ray;      // the direction of a step without limit; impulsive where contacts slide (6)
  Vector first_f;  // before the first step: zero but for bilateral contacts
  std::optional<Errors<double>> errors;  // of f, by the law that the answer is for; not of exact answers
  std::optional<Scalar> bound;           // exact, Coulomb's law in space: proved cosine of fF and -aF
  std::string word;                      // the cell of every contact
  Counters counters;
  std::vector<Pivot<Scalar>> pivots;              // of path methods, where asked for
  std::vector<Enclosure> f_enclosed, a_enclosed;  // over enclosures
  std::optional<Rung> rung;                       // of a filtered run
  bool moves_elsewhere = false;                   // another solution is known that accelerates more

  bool Solved() const { return outcome == Outcome::kSolved; }
  // The largest error; -1: not measured.
  double residual() const { return errors ? errors->Largest() : -1; }
};

// Of a run; what it has besides its end is for the caller to add.
template <class Scalar, class Counted>
Answer<Scalar> AnswerOf(const RunEnd<Counted>& end) {
  Answer<Scalar> answer;
  answer.outcome = end.outcome;
  answer.reason = end.reason;
  answer.start = end.start;
  answer.period = end.period;
  answer.counters = CountersOf(end.statistics);
  return answer;
}

}  // namespace stiction
