// SPDX-License-Identifier: Apache-2.0
// conditioned: singular values over eight decades.

#include <array>

#include "search/generators/drawing.h"
#include "search/generators/generator.h"

namespace stiction::generators {
namespace {

// 10^(-1 / m), nearest double; [0] is for a single singular value.
constexpr std::array<double, kMaxRows> kRootsOfATenth = {
    1.0,
    0x1.999999999999ap-4,
    0x1.43d136248490fp-2,
    0x1.db4c7760bcff2p-2,
    0x1.1feb33c1c381ep-1,
    0x1.430cd74f6d478p-1,
    0x1.5cd2506741989p-1,
    0x1.707aa3f9e1202p-1,
    0x1.7ff2224115d9ap-1,
    0x1.8c6c4a1731220p-1,
    0x1.96b230bcdc434p-1,
    0x1.9f4c8a4e09bc7p-1,
    0x1.a69b609b6a52fp-1,
    0x1.ace415695e178p-1,
    0x1.b25a001781193p-1,
    0x1.b723eab4b8f23p-1,
};

// J = diag(sigma): `columns` values, geometric from 1 down to 10^-exponent.
template <int Rows>
Jacobian<double, Rows> SingularValues(int rows, int columns, int exponent) {
  double ratio = 1;
  for (int i = 0; i < exponent; ++i) ratio *= kRootsOfATenth[columns - 1];
  auto J = MakeJacobian<double, Rows>(rows, columns);
  double sigma = 1;
  for (int k = 0; k < columns; ++k) {
    for (int i = 0; i < rows; ++i) J(i, k) = 0;
    J(k, k) = sigma;
    sigma *= ratio;
  }
  return J;
}

// Applies I - 2 v v' / v'v, v = (0, ..., 0, drawn integers), to the last `size` rows. v = 0: the identity.
template <int Rows>
void DrawReflection(int rows, int columns, int size, Choices& choices, Jacobian<double, Rows>& J) {
  std::array<double, kMaxRows> v;
  choices.ForEach<-128, 127>(size, [&v](int i, int value) { v[i] = value; });
  double length2 = 0;
  for (int i = 0; i < size; ++i) length2 += v[i] * v[i];
  if (length2 == 0) return;
  const double factor = 2 / length2;
  const int first = rows - size;
  for (int k = 0; k < columns; ++k) {
    double along = 0;
    for (int i = 0; i < size; ++i) along += v[i] * J(first + i, k);
    along *= factor;
    for (int i = 0; i < size; ++i) J(first + i, k) -= along * v[i];
  }
}

// J = U diag(sigma) rounded to double, taken exactly from there on. U: reflections of 2, 3, ..., 2n rows,
// their vectors uniform in a cube.
template <class Scalar, int Rows>
int FillConditioned(Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  const int exponent = static_cast<int>(choices.Integer(0, 8));
  const bool full = choices.Integer(0, 1) == 0;
  const int columns = full ? rows : static_cast<int>(choices.Integer(1, rows - 1));
  Jacobian<double, Rows> rounded = SingularValues<Rows>(rows, columns, exponent);
  for (int size = 2; size <= rows; ++size) DrawReflection<Rows>(rows, columns, size, choices, rounded);
  auto J = MakeJacobian<Scalar, Rows>(rows, columns);
  for (int k = 0; k < columns; ++k) {
    for (int i = 0; i < rows; ++i) J(i, k) = Scalar(rounded(i, k));
  }
  SetGram(J, columns, problem);
  DrawImage<Scalar, Rows, -5, 5>(J, columns, choices, problem);
  return columns;
}

}  // namespace

Generator MakeConditioned() {
  static constexpr GeneratorRow kRow = {
      .name = "conditioned",
      .distribution =
          "J = U diag(sigma) rounded to double, U orthogonal, sigma geometric from 1 to 10^-k "
          "with k in 0..8; full rank with probability 1/2, otherwise of rank uniform in 1..2n-1; "
          "A = J J', b = J y with integers in [-5, 5].",
      .exact_in_double = false,
  };
  return GeneratorOf<kRow>(
      [](const Given&, Choices& choices, auto& problem) { return FillConditioned(choices, problem); });
}

}  // namespace stiction::generators
