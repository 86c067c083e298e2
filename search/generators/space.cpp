// SPDX-License-Identifier: Apache-2.0
// space: as integers, with two rows of friction.

#include "search/generators/generator.h"
#include "search/generators/integer_problem.h"

namespace stiction::generators {

Generator MakeSpace() {
  static constexpr GeneratorRow kRow = {
      .name = "space",
      .distribution =
          "Contacts of space, with two rows of friction: J of integers in [-5, 5], its number of "
          "columns uniform in 1..3n; A = J J', and b = J y or b = A x with integers in [-5, 5]. "
          "Run over doubles, what they suspect over intervals, and existence by complete driving "
          "on polygons, over rationals. Not part of a campaign that names no generators.",
      .exact_in_double = true,
      .dimension = 3,
  };
  return GeneratorOf<kRow>(
      [](const Given&, Choices& choices, auto& problem) { return FillIntegers(choices, problem); });
}

}  // namespace stiction::generators
