// SPDX-License-Identifier: Apache-2.0
// The methods of a page: of certify/methods.cpp those that have a path, in the plane.

#include <array>

#include "certify/solve.h"
#include "solver/solve.ipp"

namespace stiction {

template <>
std::span<const Method<Rational>> Methods<Rational>() {
  static const std::array rows = {CompleteRow<Rational>({}), LemkeRow<Rational>({}), BaraffRow<Rational>({})};
  return rows;
}

template Answer<Rational> Solve(const ExactProblem&, std::string_view, const SolveOptions&, Trace<Rational>*);

}  // namespace stiction
