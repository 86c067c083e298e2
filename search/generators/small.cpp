// SPDX-License-Identifier: Apache-2.0
// small: integers so small that ties are frequent.

#include <algorithm>

#include "search/generators/drawing.h"
#include "search/generators/generator.h"

namespace stiction::generators {
namespace {

// Values are -2 ... 2 with weights 1 1 5 1 1. Bound: abs(A) <= 16 * 2^2, abs(J y) <= 16 * 2 * 2.
template <class Scalar, int Rows>
int FillSmall(Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  const int columns = static_cast<int>(choices.Integer(1, problem.rows()));
  auto J = MakeJacobian<Scalar, Rows>(problem.rows(), columns);
  Scalar* entries = J.data();
  choices.ForEach<-4, 4>(problem.rows() * columns, [entries](int i, int value) {
    entries[i] = Scalar(value - std::clamp(value, -2, 2));
  });
  SetGram(J, columns, problem);
  DrawImage<Scalar, Rows, -2, 2>(J, columns, choices, problem);
  return columns;
}

}  // namespace

Generator MakeSmall() {
  static constexpr GeneratorRow kRow = {
      .name = "small",
      .distribution =
          "J of integers in [-2, 2], zero with probability 5/9, its number of columns uniform in "
          "1..2n; A = J J', b = J y with integers in [-2, 2].",
      .exact_in_double = true,
  };
  return GeneratorOf<kRow>(
      [](const Given&, Choices& choices, auto& problem) { return FillSmall(choices, problem); });
}

}  // namespace stiction::generators
