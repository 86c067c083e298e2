// SPDX-License-Identifier: Apache-2.0
// Problems and pivots in other numbers.

#pragma once

#include <string>
#include <string_view>

#include "corpus/exact_problem.h"
#include "corpus/input_error.h"
#include "solver/problem/solution.h"

namespace stiction {

// convert(x) of every number x.
template <class To, class From, class Convert>
Pivot<To> Converted(const Pivot<From>& pivot, Convert convert) {
  Pivot<To> result;
  result.drive = pivot.drive;
  result.driven = pivot.driven;
  result.goal = pivot.goal;
  result.df = pivot.df.unaryExpr(convert);
  result.da = pivot.da.unaryExpr(convert);
  result.s = convert(pivot.s);
  result.limiting = pivot.limiting;
  result.from = pivot.from;
  result.to = pivot.to;
  result.wanted = pivot.wanted;
  result.gave_up = pivot.gave_up;
  result.f = pivot.f.unaryExpr(convert);
  result.a = pivot.a.unaryExpr(convert);
  result.sets = pivot.sets;
  result.turned_away = pivot.turned_away;
  for (const auto& d : pivot.recorded) result.recorded.push_back({convert(d[0]), convert(d[1])});
  result.word = pivot.word;
  result.determinant = pivot.determinant;
  result.turn = pivot.turn;
  result.entering = pivot.entering;
  result.leaving = pivot.leaving;
  result.cover = convert(pivot.cover);
  return result;
}

// A number of a problem that a scalar does not hold: too large, or so small that it would lose its digits.
class RangeError : public InputError {
 public:
  RangeError(const std::string& path, const Rational& found, std::string_view arithmetic);
};

// Every number at its nearest double, and that at its nearest Scalar. RangeError, which names the first of
// them, where one becomes infinite, or underflows: its rounding is not relative to it.
template <class Scalar>
ContactProblem<Scalar> Rounded(const ExactProblem& problem);

extern template ContactProblem<float> Rounded(const ExactProblem&);
extern template ContactProblem<double> Rounded(const ExactProblem&);

// The rational problem that a rounded one is. Doubles and narrower.
template <class Scalar>
ExactProblem Unrounded(const ContactProblem<Scalar>& problem) {
  return Converted<Rational>(problem, [](Scalar x) { return Rational(static_cast<double>(x)); });
}

}  // namespace stiction
