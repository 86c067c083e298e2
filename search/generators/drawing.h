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

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "search/generators/choices.h"
#include "search/generators/generators.h"
#include "solver/problem/check.h"
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

// Numbers entry(0), ..., entry(count - 1) as integers, and what they are over. They may be doubles.
template <class Scalar, class Entry>
auto OverOneDenominator(int count, Entry entry) {
  using Parts = Fractions<Scalar>;
  using Integer = typename Parts::Integer;
  std::pair<std::vector<Integer>, Integer> over = {{}, 1};
  over.first.reserve(count);
  if constexpr (std::is_same_v<std::decay_t<decltype(entry(0))>, double>) {
    int places = 0;
    for (int k = 0; k < count; ++k) {
      if (entry(k) != 0) places = std::max(places, 52 - std::ilogb(entry(k)));
    }
    STICTION_CHECK(places < 900, "doubles that are integers over a power of two");
    over.second = Integer(std::ldexp(1.0, places));
    for (int k = 0; k < count; ++k) over.first.emplace_back(std::ldexp(entry(k), places));
  } else {
    for (int k = 0; k < count; ++k) Parts::Include(over.second, entry(k));
    for (int k = 0; k < count; ++k) over.first.push_back(Parts::Numerator(entry(k), over.second));
  }
  return over;
}

// The sum of products of such numbers: one common divisor is sought, not one for each.
template <class Scalar, class Over>
Scalar DotOf(const Over& x, const Over& y) {
  typename Over::second_type sum = 0, under = x.second * y.second;
  for (std::size_t k = 0; k < x.first.size(); ++k) Fractions<Scalar>::AddProduct(sum, x.first[k], y.first[k]);
  return Fractions<Scalar>::Quotient(sum, under);
}

// Its rows, each over one denominator.
template <class Scalar, class Factor>
auto RowsOverOneDenominator(const Factor& M, int rows, int columns) {
  std::vector<decltype(OverOneDenominator<Scalar>(0, [](int) { return Scalar(0); }))> over;
  for (int i = 0; i < rows; ++i)
    over.push_back(OverOneDenominator<Scalar>(
        columns, [&](int k) -> const auto& { return M(i, k); }));
  return over;
}

// A = L R', which is symmetric: L = J W, R = J.
template <class Scalar, int Rows, class Factor>
void SetProduct(const Factor& L, const Factor& R, int columns, ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  if constexpr (kIsExact<Scalar>) {
    const auto left = RowsOverOneDenominator<Scalar>(L, rows, columns);
    const auto other = RowsOverOneDenominator<Scalar>(R, &L == &R ? 0 : rows, columns);
    const auto& right = other.empty() ? left : other;
    for (int j = 0; j < rows; ++j) {
      for (int i = j; i < rows; ++i) problem.A(i, j) = DotOf<Scalar>(left[i], right[j]);
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
template <class Scalar, int Rows, class Factor>
void SetGram(const Factor& J, int columns, ContactProblem<Scalar, Rows>& problem) {
  SetProduct(J, J, columns, problem);
  if constexpr (kIsExact<Scalar>) MirrorLowerTriangle(problem);
}

// b = M times y(0), ..., y(columns - 1).
template <class Scalar, int Rows, class Factor, class Coefficient>
void SetImage(const Factor& M, int columns, Coefficient y, ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  if constexpr (kIsExact<Scalar>) {
    std::vector<Scalar> coefficients;
    for (int k = 0; k < columns; ++k) coefficients.push_back(y(k));
    const auto over =
        OverOneDenominator<Scalar>(columns, [&](int k) -> const Scalar& { return coefficients[k]; });
    const auto rows_of_M = RowsOverOneDenominator<Scalar>(M, rows, columns);
    for (int i = 0; i < rows; ++i) problem.b[i] = DotOf<Scalar>(rows_of_M[i], over);
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
