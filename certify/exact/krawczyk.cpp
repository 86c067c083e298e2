// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/krawczyk.h"

namespace stiction {
namespace {

// Numbers as integers over one denominator.
struct ScaledNumbers {
  std::vector<mpz_class> integers;
  mpz_class denominator = 1;

  explicit ScaledNumbers(const ExactVector& numbers) {
    for (const Rational& x : numbers) Fractions<Rational>::Include(denominator, x);
    for (const Rational& x : numbers) integers.push_back(Fractions<Rational>::Numerator(x, denominator));
  }
};

Rational Product(const ScaledNumbers& x, const ScaledNumbers& y) {
  mpz_class sum = 0;
  for (std::size_t k = 0; k < x.integers.size(); ++k) sum += x.integers[k] * y.integers[k];
  Rational product(sum, x.denominator * y.denominator);
  product.canonicalize();
  return product;
}

}  // namespace

// Slopes of a quadratic function change by its second derivatives times the distance.
std::optional<std::pair<int, Rational>> FindLeaving(const std::vector<Quadratic<Rational>>& equations,
                                                    const ExactMatrix& inverse, const Rational& radius) {
  const int size = static_cast<int>(equations.size());
  std::vector<ScaledNumbers> columns;
  for (int j = 0; j < size; ++j) {
    ExactVector column(size);
    for (int k = 0; k < size; ++k) column[k] = equations[k].slopes[j];
    columns.emplace_back(column);
  }
  for (int i = 0; i < size; ++i) {
    const ScaledNumbers row(inverse.row(i).transpose());
    Rational move = 0, bend = 0, defects = 0;
    for (int k = 0; k < size; ++k) {
      move += inverse(i, k) * equations[k].value;
      bend += abs(inverse(i, k)) * equations[k].bend;
    }
    for (int j = 0; j < size; ++j) defects += abs(Product(row, columns[j]) - (i == j ? 1 : 0));
    const Rational distance = abs(move) + radius * defects + 2 * radius * radius * bend;
    if (distance >= radius) return std::pair(i, distance);
  }
  return std::nullopt;
}

}  // namespace stiction
