// SPDX-License-Identifier: Apache-2.0
// Problems of integers, which several generators share.

#ifndef STICTION_SEARCH_GENERATORS_INTEGER_PROBLEM_H_
#define STICTION_SEARCH_GENERATORS_INTEGER_PROBLEM_H_

#include "search/generators/drawing.h"

namespace stiction::generators {

// A = J J', and b = J y or b = A x. Bound: 24 * 24 * 5^2 * 5 < 2^17.
template <class Scalar, int Rows>
void SetFromIntegers(const Jacobian<Scalar, Rows>& J, int columns, Choices& choices,
                     ContactProblem<Scalar, Rows>& problem) {
  SetGram(J, columns, problem);
  if (choices.Integer(0, 1) == 0) {
    DrawImage<Scalar, Rows, -5, 5>(J, columns, choices, problem);
  } else {
    DrawImage<Scalar, Rows, -5, 5>(problem.A, problem.rows(), choices, problem);
  }
}

template <class Scalar, int Rows>
int FillIntegers(Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  const int columns = static_cast<int>(choices.Integer(1, problem.rows()));
  const auto J = DrawIntegers<Scalar, Rows, -5, 5>(problem.rows(), columns, choices);
  SetFromIntegers(J, columns, choices, problem);
  return columns;
}

}  // namespace stiction::generators

#endif  // STICTION_SEARCH_GENERATORS_INTEGER_PROBLEM_H_
