// SPDX-License-Identifier: Apache-2.0
// Problems of integers, which several generators share.

#ifndef STICTION_SEARCH_GENERATORS_INTEGER_PROBLEM_H_
#define STICTION_SEARCH_GENERATORS_INTEGER_PROBLEM_H_

#include <cstdint>

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

// One contact at least, and each other with probability 1/2, is of another kind. Dynamic sizes.
template <class Scalar>
int WithOtherKinds(ContactKind kind, Choices& choices, ContactProblem<Scalar>& problem) {
  const auto contacts = static_cast<std::int64_t>(problem.contacts.size());
  const std::int64_t certain = choices.Integer(0, contacts - 1);
  for (std::int64_t i = 0; i < contacts; ++i) {
    if (i != certain && choices.Integer(0, 1) == 0) continue;
    Contact<Scalar>& contact = problem.contacts[static_cast<std::size_t>(i)];
    contact.kind = kind;
    if (kind == ContactKind::kBilateral) contact.mu = Scalar(0);
    if (kind == ContactKind::kSliding) contact.slip[0] = Scalar(choices.Integer(0, 1) == 0 ? 1 : -1);
  }
  const int rows = RowCount(problem.contacts, 2);
  problem.A.resize(rows, rows);
  problem.b.resize(rows);
  return FillIntegers(choices, problem);
}

}  // namespace stiction::generators

#endif  // STICTION_SEARCH_GENERATORS_INTEGER_PROBLEM_H_
