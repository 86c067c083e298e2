// SPDX-License-Identifier: Apache-2.0
// Solving a problem file's problem by any method in any arithmetic, both chosen at run time.
//
// The table of solver/solve.h is completed here: by exact arithmetic for the path methods, by methods that need
// CGAL or Ipopt's process, and by intervals. AllMethods() is what programs show and choose from.
//
//   inexact   the problem is rounded, and it is the rounded problem that is solved. Where a path method does
//             not solve it, that is a suspicion: the same rounded problem is run again, exactly, or in space,
//             where the published algorithm takes roots, over long double with finer tolerances. The answer is
//             then that of the second run, forces and all; `suspected` says what the first one said.
//   exact     what is called solved was verified by verify_solution.h.

#ifndef STICTION_CERTIFY_EXACT_SOLVE_H_
#define STICTION_CERTIFY_EXACT_SOLVE_H_

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "corpus/exact_problem.h"
#include "solver/solve.h"

namespace stiction {

extern template Answer<Rational> Solve(const ExactProblem&, std::string_view, const SolveOptions&,
                                       Trace<Rational>*);
extern template const Method<Rational>* FindMethod(std::string_view);

// A row of the table over all arithmetics.
struct MethodFacts {
  std::string_view name, title, source, ends;
  Path path = Path::kNone;
  std::string_view heading = {};
  // Whether it is built, by dimension (plane, space) and Arithmetic.
  std::array<std::array<bool, kArithmeticCount>, 2> built = {};

  bool HasPath() const { return path != Path::kNone; }
  bool IsBuilt(int dimension, Arithmetic arithmetic) const {
    return built[dimension - 2][static_cast<int>(arithmetic)];
  }
};
const std::vector<MethodFacts>& AllMethods();
// The row of that name; null if there is none.
const MethodFacts* FindMethodFacts(std::string_view name);

// What runs over doubles in a process of its own.
std::span<const Method<double>> MethodsByProcess();

// The arithmetic of that name; empty if there is none.
std::optional<Arithmetic> FindArithmetic(std::string_view name);

// Why a method is not to be had so, and what is; empty if it is.
std::string Refusal(std::string_view method, int dimension, Arithmetic arithmetic);

// Where nobody asks for an arithmetic: exact, unless the method is not built so, or problem and method are of
// the kind that doubles are for; then double or interval. And why, in words.
struct ArithmeticChoice {
  Arithmetic arithmetic = Arithmetic::kExact;
  std::string why;
};
ArithmeticChoice UsualArithmetic(std::string_view method, const ExactProblem& problem);

enum class KeepTrace { kNo, kYes };

struct SolveRequest {
  std::string method{kAutomatic};
  Arithmetic arithmetic = Arithmetic::kExact;
  SolveOptions options = {};
  KeepTrace trace = KeepTrace::kNo;  // of path methods
  bool confirm = true;               // whether suspicions are run again
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

// Requires Refusal(...).empty(). RangeError (corpus/rounded.h) for a number that the arithmetic does not hold;
// InputError where the published algorithm in space has no such reading.
Solution SolveIn(const ExactProblem& problem, const SolveRequest& request);

}  // namespace stiction

#endif  // STICTION_CERTIFY_EXACT_SOLVE_H_
