// SPDX-License-Identifier: Apache-2.0
// What the narrations of all path methods need: numbers, names of variables, kinds of contacts.

#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "cli/narration/outcome_text.h"
#include "corpus/exact_problem.h"
#include "solver/problem/answer.h"

namespace stiction {

// "(1, -2/3)".
template <class Numbers>
std::string ListText(const Numbers& numbers, FractionText fractions = FractionText::kFull) {
  std::string text;
  for (const auto& x : numbers) text += (text.empty() ? "" : ", ") + Text(x, fractions);
  return "(" + text + ")";
}

// Names of the variables of a problem, by row.
class VariableTexts {
 public:
  explicit VariableTexts(const ExactProblem& problem) : VariableTexts(problem.contacts, problem.dimension) {}
  VariableTexts(const std::vector<Contact<Rational>>& contacts, int dimension) : dimension_(dimension) {
    layout_.Assign(contacts, dimension);
  }

  const RowLayout<Eigen::Dynamic>& layout() const { return layout_; }
  bool in_space() const { return dimension_ == 3; }
  bool IsNormal(int row) const { return layout_.IsNormal(row); }
  // Whether a row is the first, or in the plane the only, tangential row of its contact.
  bool IsTangential(int row) const { return row > 0 && IsNormal(row - 1); }
  // Whether a row stands for a variable: in space the second tangential row does not.
  bool IsVariable(int row) const { return IsNormal(row) || IsTangential(row); }
  int Normal(int row) const { return layout_.NormalRowOf(layout_.ContactOf(row)); }

  // "N1"; "F1", in space of both components of friction.
  std::string Variable(int row) const {
    return (IsNormal(row) ? "N" : "F") + std::to_string(layout_.ContactOf(row) + 1);
  }
  // In space "F1x" or "F1y", along the axes that the contact has at the time.
  std::string Component(int row) const {
    if (!in_space() || IsNormal(row)) return Variable(row);
    return Variable(row) + (IsNormal(row - 1) ? "x" : "y");
  }

 private:
  int dimension_;
  RowLayout<Eigen::Dynamic> layout_;
};

// A f + b before the first step, in the numbers of the answer.
template <class Scalar>
typename Answer<Scalar>::Vector FirstAccelerations(const ExactProblem& problem, const Answer<Scalar>& answer) {
  const ExactProblem::Vector f = answer.first_f.unaryExpr([](const Scalar& x) { return Rational(x); });
  const ExactProblem::Vector a = problem.A * f + problem.b;
  if constexpr (kIsExact<Scalar>) {
    return a;
  } else {
    return a.unaryExpr([](const Rational& x) { return ToDouble(x); });
  }
}

// What bilateral and sliding contacts do all the time, a line each.
std::string KindsText(const ExactProblem& problem, FractionText fractions);

}  // namespace stiction
