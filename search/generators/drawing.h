// SPDX-License-Identifier: Apache-2.0
// What generators share: a matrix J of drawn numbers, and A = J W J', b = J y or b = A x from it.
//
// Arithmetic on small integers stays in int; everything else is done over Scalar, so that rationals redo
// exactly what doubles do. For the exact generators a bound on every integer that can arise is stated: all
// partial sums are integers (times one power of two) of at most 53 bits, hence exact in any order.
//
//   r <= 24 rows, c <= 24 columns (the plane: 16); abs(J) <= p, abs(x) <= q, abs(y) <= q:
//   abs(A) <= c p^2,  abs(J y) <= c p q,  abs(A x) <= r c p^2 q

#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "search/generators/choices.h"
#include "search/generators/generators.h"
#include "solver/problem/scalar.h"

namespace stiction::generators {

inline constexpr int kMaxRows = 2 * kMaxContacts;  // of the plane

// On the stack for fixed Rows. Only the leading columns in use are ever set or read.
template <class Scalar, int Rows>
using Jacobian = Eigen::Matrix<Scalar, Rows, Rows>;

template <class Scalar, int Rows>
Jacobian<Scalar, Rows> MakeJacobian(int rows, int columns) {
  Jacobian<Scalar, Rows> J;
  if constexpr (Rows == Eigen::Dynamic) J.resize(rows, columns);
  return J;
}

template <class Scalar, int Rows>
void Resize(int contacts, int dimension, ContactProblem<Scalar, Rows>& problem) {
  problem.dimension = dimension;
  if constexpr (Rows == Eigen::Dynamic) {
    problem.contacts.resize(contacts);
    problem.A.resize(dimension * contacts, dimension * contacts);
    problem.b.resize(dimension * contacts);
  }
}

// Makes all contacts static and returns their friction coefficients.
template <class Scalar, int Rows>
std::array<MuChoice, kMaxContacts> DrawFriction(std::span<const MuChoice> palette, Choices& choices,
                                                ContactProblem<Scalar, Rows>& problem) {
  std::array<MuChoice, kMaxContacts> chosen;
  const int last = static_cast<int>(palette.size()) - 1;
  const bool single = choices.Integer(0, 1) == 0;
  std::size_t pick = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    if (i == 0 || !single) pick = choices.Integer(0, last);
    chosen[i] = palette[pick];
    Contact<Scalar>& contact = problem.contacts[i];
    contact.kind = ContactKind::kStatic;
    contact.mu = Scalar(chosen[i].numerator);
    if (chosen[i].denominator != 1) contact.mu /= Scalar(chosen[i].denominator);
    contact.slip = {Scalar(0), Scalar(0)};
  }
  return chosen;
}

// `columns` columns of uniform integers, column by column.
template <class Scalar, int Rows, int kLow, int kHigh>
Jacobian<Scalar, Rows> DrawIntegers(int rows, int columns, Choices& choices) {
  auto J = MakeJacobian<Scalar, Rows>(rows, columns);
  Scalar* entries = J.data();
  choices.ForEach<kLow, kHigh>(rows * columns, [entries](int i, int value) { entries[i] = Scalar(value); });
  return J;
}

// Numbers entry(0), ..., entry(count - 1) as integers, and what they are over.
template <class Scalar, class Entry>
auto OverOneDenominator(int count, Entry entry) {
  using Parts = Fractions<Scalar>;
  std::pair<std::vector<typename Parts::Integer>, typename Parts::Integer> over = {{}, 1};
  for (int k = 0; k < count; ++k) Parts::Include(over.second, entry(k));
  for (int k = 0; k < count; ++k) over.first.push_back(Parts::Numerator(entry(k), over.second));
  return over;
}

// The sum of products of such numbers: one common divisor is sought, not one for each.
template <class Scalar, class Over>
Scalar DotOf(const Over& x, const Over& y) {
  typename Over::second_type sum = 0, under = x.second * y.second;
  for (std::size_t k = 0; k < x.first.size(); ++k) Fractions<Scalar>::AddProduct(sum, x.first[k], y.first[k]);
  return Fractions<Scalar>::Quotient(sum, under);
}

// A = L R', which is symmetric: L = J W, R = J.
template <class Scalar, int Rows, class Factor>
void SetProduct(const Factor& L, const Factor& R, int columns, ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  if constexpr (kIsExact<Scalar>) {
    std::vector<decltype(OverOneDenominator<Scalar>(0, [](int) { return Scalar(0); }))> left;
    for (int i = 0; i < rows; ++i)
      left.push_back(OverOneDenominator<Scalar>(columns, [&](int k) -> Scalar { return L(i, k); }));
    for (int j = 0; j < rows; ++j) {
      const auto right = OverOneDenominator<Scalar>(columns, [&](int k) -> Scalar { return R(j, k); });
      for (int i = j; i < rows; ++i) problem.A(i, j) = DotOf<Scalar>(left[i], right);
    }
    return;
  }
  typename ContactProblem<Scalar, Rows>::Vector column(rows);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < rows; ++i) column[i] = L(i, 0) * R(j, 0);
    for (int k = 1; k < columns; ++k) {
      for (int i = 0; i < rows; ++i) column[i] += L(i, k) * R(j, k);
    }
    for (int i = 0; i < rows; ++i) problem.A(i, j) = column[i];
  }
}

template <class Scalar, int Rows>
void MirrorLowerTriangle(ContactProblem<Scalar, Rows>& problem) {
  for (int j = 1; j < problem.rows(); ++j) {
    for (int i = 0; i < j; ++i) problem.A(i, j) = problem.A(j, i);
  }
}

// A = J J'.
template <class Scalar, int Rows>
void SetGram(const Jacobian<Scalar, Rows>& J, int columns, ContactProblem<Scalar, Rows>& problem) {
  SetProduct(J, J, columns, problem);
  if constexpr (kIsExact<Scalar>) MirrorLowerTriangle(problem);
}

// b = M times y(0), ..., y(columns - 1).
template <class Scalar, int Rows, class Factor, class Coefficient>
void SetImage(const Factor& M, int columns, Coefficient y, ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  if constexpr (kIsExact<Scalar>) {
    const auto over = OverOneDenominator<Scalar>(columns, [&](int k) -> Scalar { return y(k); });
    for (int i = 0; i < rows; ++i) {
      const auto row = OverOneDenominator<Scalar>(columns, [&](int k) -> Scalar { return M(i, k); });
      problem.b[i] = DotOf<Scalar>(row, over);
    }
    return;
  }
  for (int i = 0; i < rows; ++i) problem.b[i] = Scalar(0);
  for (int k = 0; k < columns; ++k) {
    const Scalar coefficient = y(k);
    for (int i = 0; i < rows; ++i) problem.b[i] += M(i, k) * coefficient;
  }
}

// b = M x with uniform integers x.
template <class Scalar, int Rows, int kLow, int kHigh, class Factor>
void DrawImage(const Factor& M, int columns, Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  std::array<int, 3 * kMaxContacts> x;
  choices.ForEach<kLow, kHigh>(columns, [&x](int i, int value) { x[i] = value; });
  SetImage(
      M, columns, [&x](int k) { return Scalar(x[k]); }, problem);
}

// ---- Of integers, which several generators share -----------------------------------------------

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
