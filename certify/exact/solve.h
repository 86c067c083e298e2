// SPDX-License-Identifier: Apache-2.0
// What is asked for of a problem and what is answered, and solving it exactly: the table of solver/solve.h over
// rationals, whose methods need CGAL or Ipopt's process. What is called solved was verified by
// verify_solution.h. request/solve_in.h solves in any arithmetic.

#pragma once

#include <optional>
#include <string_view>
#include <variant>

#include "corpus/exact_problem.h"
#include "solver/problem/forms.h"
#include "solver/solve.h"

namespace stiction {

extern template Answer<Rational> Solve(const ExactProblem&, const Request&);
extern template const Method<Rational>* FindMethod(std::string_view);

// What is built over doubles alone, beside the table of the library: some in a process of its own.
std::span<const Method<double>> MethodsOverDoubles();

// Rows from which on `auto` over rationals begins with the cells that doubles find (method fast): the path
// itself costs more there, even with certified signs, than the equations of its end.
inline constexpr int kCellsFirst = 16;

// Rows up to which `auto` computes over rationals; above, where A is in factors, certificates are made in
// these.
inline constexpr int MostExactRows(int dimension) { return dimension == 2 ? 60 : 24; }

using ExactAnswer = Answer<Rational>;
using InexactAnswer = Answer<double>;

struct Solution {
  std::variant<ExactAnswer, InexactAnswer> answer;
  std::optional<InexactAnswer> suspected = {};  // what an inexact run said that was run again

  Outcome outcome() const {
    return std::visit([](const auto& answer) { return answer.outcome; }, answer);
  }
};

// Over rationals, whatever arithmetic the request names. What is called solved was verified.
ExactAnswer SolveExactly(const ExactProblem& problem, const Request& request);

}  // namespace stiction
