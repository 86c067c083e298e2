// SPDX-License-Identifier: Apache-2.0
// What is asked for of a problem and what is answered, and solving it exactly: the table of solver/solve.h over
// rationals, whose methods need CGAL or Ipopt's process. What is called solved was verified by
// verify_solution.h. request/solve_in.h solves in any arithmetic.

#ifndef STICTION_CERTIFY_EXACT_SOLVE_H_
#define STICTION_CERTIFY_EXACT_SOLVE_H_

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "corpus/exact_problem.h"
#include "solver/problem/factored.h"
#include "solver/solve.h"

namespace stiction {

extern template Answer<Rational> Solve(const ExactProblem&, std::string_view, const SolveOptions&,
                                       Trace<Rational>*);
extern template const Method<Rational>* FindMethod(std::string_view);

// What is built over doubles alone, beside the table of the library: some in a process of its own.
std::span<const Method<double>> MethodsOverDoubles();

// Rows from which on `auto` over rationals begins with the cells that doubles find (method fast): the path
// itself costs more there, even with certified signs, than the equations of its end.
inline constexpr int kCellsFirst = 16;

enum class KeepTrace { kNo, kYes };

struct SolveRequest {
  std::string method{kAutomatic};
  Arithmetic arithmetic = Arithmetic::kExact;
  SolveOptions options = {};
  const FactoredProblem<Rational>* factors = nullptr;  // of the same problem, where it has some
  KeepTrace trace = KeepTrace::kNo;                    // of path methods
  bool confirm = true;                                 // whether suspicions are run again
};

using ExactAnswer = Answer<Rational>;
using InexactAnswer = Answer<double>;

struct Solution {
  std::variant<ExactAnswer, InexactAnswer> answer;
  std::optional<InexactAnswer> suspected = {};  // what an inexact run said that was run again

  Outcome outcome() const {
    return std::visit([](const auto& answer) { return answer.outcome; }, answer);
  }
};

// A run of a method of the table, with its path where that is asked for.
template <class Scalar>
Answer<Scalar> SolveWithPath(const ContactProblem<Scalar>& problem, const SolveRequest& request) {
  Trace<Scalar> trace;
  const bool keep = request.trace == KeepTrace::kYes;
  Answer<Scalar> answer = Solve(problem, request.method, request.options, keep ? &trace : nullptr);
  answer.pivots = std::move(trace.pivots);
  return answer;
}

// Over rationals, whatever arithmetic the request names. What is called solved was verified.
ExactAnswer SolveExactly(const ExactProblem& problem, const SolveRequest& request);

}  // namespace stiction

#endif  // STICTION_CERTIFY_EXACT_SOLVE_H_
