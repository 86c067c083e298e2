// SPDX-License-Identifier: Apache-2.0
// integers: everything is a small integer.

#include "search/generators/generator.h"
#include "search/generators/integer_problem.h"

namespace stiction::generators {

Generator MakeIntegers() {
  static constexpr GeneratorRow kRow = {
      .name = "integers",
      .distribution =
          "J of integers in [-5, 5], its number of columns uniform in 1..2n; A = J J', and b = J "
          "y or b = A x with integers in [-5, 5].",
      .exact_in_double = true,
  };
  return GeneratorOf<kRow>(
      [](const Given&, Choices& choices, auto& problem) { return FillIntegers(choices, problem); });
}

}  // namespace stiction::generators
