// SPDX-License-Identifier: Apache-2.0
// Solving a problem file's problem by any method in any arithmetic, both chosen at run time. AllMethods() is
// what programs show and choose from.
//
//   inexact   the problem is rounded, and it is the rounded problem that is solved. Where a path method does
//             not solve it, that is a suspicion: the same rounded problem is run again, exactly, or in space,
//             where the published algorithm takes roots, over quad with finer tolerances. The answer is
//             then that of the second run, forces and all; `suspected` says what the first one said.
//   exact     exact/solve.h.

#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "certify/exact/solve.h"
#include "corpus/stopwatch.h"

namespace stiction {

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

// Requires Refusal(...).empty() (request.h), and TakesEntries(...) of a problem that stays sparse. RangeError
// (corpus/rounded.h) for a number that the arithmetic does not hold; InputError where the published algorithm
// in space has no such reading. `watch` starts anew once the problem is in the numbers of a floating
// arithmetic.
Solution SolveIn(const AnyProblem& problem, const Request& request, Stopwatch* watch = nullptr);

// The same of doubles over doubles, with no rationals but where it takes them: the answer of SolveIn,
// arithmetic kDouble, of the rationals that they are. Requires finite numbers.
Solution SolveDoubles(const ContactProblem<double>& problem, const Request& request);

}  // namespace stiction
