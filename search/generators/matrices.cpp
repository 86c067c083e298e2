// SPDX-License-Identifier: Apache-2.0
// Generators of A = J J' that differ in how J is drawn.

#include <algorithm>
#include <array>

#include "search/generators/drawing.h"
#include "search/generators/generator.h"

namespace stiction::generators {
namespace {

// ---- psd: numbers of many bits ------------------------------------------------------------------

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

// ---- small: integers so small that ties are frequent --------------------------------------------

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

// ---- duplicates: contacts that repeat others ----------------------------------------------------

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

// ---- near-degenerate: rows that are nearly dependent, forces near the ends of their ranges ------

// Forces f0 at or near the boundary of every contact's conditions: open (fN = 0), at a friction limit
// (fF = +-mu fN), or inside. Integers: fN is a multiple of mu's denominator. abs(f0) <= 4 * 64.
std::array<int, kMaxRows> DrawBoundaryForces(int contacts, const std::array<MuChoice, kMaxContacts>& mu,
                                             Choices& choices) {
  std::array<int, kMaxRows> f0;
  for (int i = 0; i < contacts; ++i) {
    const int state = static_cast<int>(choices.Integer(0, 3));
    const int size = state == 0 ? 0 : static_cast<int>(choices.Integer(1, 4));
    const int limit = size * mu[i].numerator;
    f0[2 * i] = size * mu[i].denominator;
    f0[2 * i + 1] = state == 3 ? -limit : limit;
    if (state == 1) f0[2 * i + 1] = static_cast<int>(choices.Integer(-limit, limit));
  }
  return f0;
}

// J = 2^k [C 0] + N with C, N in [-3, 3], 2 <= k <= 16: nearly of the rank of C. b = J (e - J' f0) with e
// in [-1, 1] or e = 0: the acceleration at f0 is J e, small beside b, or zero.
//
// Bounds: abs(J) <= 3 * 2^k + 3 <= 2^(k + 2), abs(A) <= 2^(2k + 8) <= 2^40, abs(J' f0) <= 16 * 2^(k + 2) *
// 2^8 = 2^(k + 14), abs(b) <= 16 * 2^(k + 2) * (2^(k + 14) + 1) <= 2^52 + 2^22.
template <class Scalar, int Rows>
int FillNearDegenerate(const std::array<MuChoice, kMaxContacts>& mu, Choices& choices,
                       ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  const int columns = static_cast<int>(choices.Integer(1, rows));
  const int coarse_columns = static_cast<int>(choices.Integer(1, columns));
  const int scale = 1 << choices.Integer(2, 16);
  std::array<int, kMaxRows * kMaxRows> coarse;
  choices.ForEach<-3, 3>(rows * coarse_columns, [&coarse](int i, int value) { coarse[i] = value; });
  std::fill(coarse.begin() + rows * coarse_columns, coarse.begin() + rows * columns, 0);
  auto J = MakeJacobian<Scalar, Rows>(rows, columns);
  Scalar* entries = J.data();
  choices.ForEach<-3, 3>(rows * columns, [entries, &coarse, scale](int i, int value) {
    entries[i] = Scalar(scale * coarse[i] + value);
  });
  const std::array<int, kMaxRows> f0 = DrawBoundaryForces(rows / 2, mu, choices);
  std::array<int, kMaxRows> e{};
  if (choices.Integer(0, 3) != 0) {
    choices.ForEach<-1, 1>(columns, [&e](int i, int value) { e[i] = value; });
  }
  SetGram(J, columns, problem);
  const auto y = [&](int k) {
    Scalar sum = Scalar(e[k]);
    for (int i = 0; i < rows; ++i) sum -= J(i, k) * Scalar(f0[i]);
    return sum;
  };
  SetImage(J, columns, y, problem);
  return columns;
}

// ---- conditioned: singular values over eight decades --------------------------------------------

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
  SetGram(rounded, columns, problem);
  DrawImage<Scalar, Rows, -5, 5>(rounded, columns, choices, problem);
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

Generator MakeNearDegenerate() {
  static constexpr GeneratorRow kRow = {
      .name = "near-degenerate",
      .distribution =
          "J = 2^k [C 0] + N with integers in [-3, 3] and k in 2..16, so that its rows are "
          "nearly dependent; A = J J', b = -A f0 + J e where every contact of f0 is open, at a "
          "friction limit or inside, and e is 0 (probability 1/4) or of integers in [-1, 1].",
      .exact_in_double = true,
      .most_mu_part = 64,  // forces are multiples of it, and must stay exact
  };
  return GeneratorOf<kRow>([](const Given& given, Choices& choices, auto& problem) {
    return FillNearDegenerate(given.mu, choices, problem);
  });
}

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
