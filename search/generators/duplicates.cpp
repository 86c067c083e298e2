// SPDX-License-Identifier: Apache-2.0
// duplicates: contacts that repeat others.

#include <algorithm>

#include "search/generators/generator.h"
#include "search/generators/integer_problem.h"

namespace stiction::generators {
namespace {

// Contact `to` becomes contact `from`, its tangent reversed if sign = -1.
template <class Scalar, int Rows>
void CopyContact(int from, int to, int sign, int columns, Jacobian<Scalar, Rows>& J) {
  for (int k = 0; k < columns; ++k) {
    J(2 * to, k) = J(2 * from, k);
    J(2 * to + 1, k) = Scalar(sign) * J(2 * from + 1, k);
  }
}

template <class Scalar, int Rows>
int FillDuplicates(Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  const int contacts = problem.rows() / 2;
  const int columns = static_cast<int>(choices.Integer(1, problem.rows()));
  auto J = DrawIntegers<Scalar, Rows, -5, 5>(problem.rows(), columns, choices);
  const int certain = contacts > 1 ? static_cast<int>(choices.Integer(1, contacts - 1)) : 0;
  int copies = 0;
  for (int to = 1; to < contacts; ++to) {
    if (to != certain && choices.Integer(0, 3) != 3) continue;
    ++copies;
    const int from = static_cast<int>(choices.Integer(0, to - 1));
    const int sign = choices.Integer(0, 1) == 0 ? 1 : -1;
    CopyContact<Scalar, Rows>(from, to, sign, columns, J);
  }
  SetFromIntegers(J, columns, choices, problem);
  return std::min(columns, 2 * (contacts - copies));
}

}  // namespace

Generator MakeDuplicates() {
  static constexpr GeneratorRow kRow = {
      .name = "duplicates",
      .distribution =
          "As integers, but one contact for certain, and each other with probability 1/4, is a "
          "copy of an earlier one, its tangent reversed with probability 1/2; a single contact "
          "has no copy.",
      .exact_in_double = true,
  };
  return GeneratorOf<kRow>(
      [](const Given&, Choices& choices, auto& problem) { return FillDuplicates(choices, problem); });
}

}  // namespace stiction::generators
