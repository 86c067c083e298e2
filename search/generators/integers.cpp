// SPDX-License-Identifier: Apache-2.0
// integers: everything is a small integer.

#include "search/generators/generator.h"
#include "search/generators/integer_problem.h"

namespace stiction::generators {
namespace {

struct Integers {
  static constexpr GeneratorRow kRow = {
      .name = "integers",
      .distribution =
          "J of integers in [-5, 5], its number of columns uniform in 1..2n; A = J J', and b = J "
          "y or b = A x with integers in [-5, 5].",
      .exact_in_double = true,
  };

  template <class Scalar, int Rows>
  static int Fill(const Given&, Choices& choices, ContactProblem<Scalar, Rows>& problem) {
    return FillIntegers(choices, problem);
  }
};

}  // namespace

Generator MakeIntegers() { return GeneratorOf<Integers>(); }

}  // namespace stiction::generators
