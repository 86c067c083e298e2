// SPDX-License-Identifier: Apache-2.0
// psd: numbers of many bits.

#include <array>

#include "search/generators/drawing.h"
#include "search/generators/generator.h"

namespace stiction::generators {
namespace {

// Entries of J are multiples of 2^-15 in [-1, 1), x multiples of 2^-11 in [-1, 1). In units of 2^-30
// abs(A) <= 16 * 2^30 = 2^34, in units of 2^-41 abs(A x) <= 16 * 2^34 * 2^11 = 2^49.
template <class Scalar, int Rows>
int FillPsd(Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  const int columns = static_cast<int>(choices.Integer(1, rows));
  auto J = MakeJacobian<Scalar, Rows>(rows, columns);
  Scalar* entries = J.data();
  choices.ForEach<-32768, 32767>(rows * columns,
                                 [entries](int i, int value) { entries[i] = Scalar(value * 0x1p-15); });
  SetGram(J, columns, problem);
  std::array<int, kMaxRows> x;
  choices.ForEach<-2048, 2047>(rows, [&x](int i, int value) { x[i] = value; });
  SetImage(
      problem.A, rows, [&x](int k) { return Scalar(x[k] * 0x1p-11); }, problem);
  return columns;
}

}  // namespace

Generator MakePsd() {
  static constexpr GeneratorRow kRow = {
      .name = "psd",
      .distribution =
          "J of multiples of 2^-15 in [-1, 1), its number of columns uniform in 1..2n; A = J J', "
          "b = A x with multiples of 2^-11 in [-1, 1).",
      .exact_in_double = true,
  };
  return GeneratorOf<kRow>(
      [](const Given&, Choices& choices, auto& problem) { return FillPsd(choices, problem); });
}

}  // namespace stiction::generators
