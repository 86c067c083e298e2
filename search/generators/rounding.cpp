// SPDX-License-Identifier: Apache-2.0
#include "search/generators/rounding.h"

#include <algorithm>
#include <cmath>

#include "certify/exact/properties.h"

namespace stiction {
namespace {

// The same problem in other units: f_i = s_i f'_i, so A' = S A S, b' = S b and mu' = mu s_N / s_F.
ExactProblem Rescaled(const ExactProblem& problem, const std::vector<Rational>& s) {
  ExactProblem rescaled = problem;
  for (int i = 0; i < problem.rows(); ++i) {
    rescaled.b[i] *= s[i];
    for (int j = 0; j < problem.rows(); ++j) rescaled.A(i, j) *= s[i] * s[j];
  }
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(problem.contacts, problem.dimension);
  for (int contact = 0; contact < layout.ContactCount(); ++contact) {
    const int row = layout.NormalRowOf(contact);
    if (layout.HasFriction(row)) rescaled.contacts[contact].mu *= s[row] / s[row + 1];
  }
  return rescaled;
}

// The power of two nearest to 1 / sqrt(x) from above, within a factor of two; 1 for x <= 0.
Rational InverseRoot(const Rational& x) {
  if (x <= 0) return 1;
  const mpz_class &above = x.get_num(), &below = x.get_den();
  long exponent = static_cast<long>(mpz_sizeinbase(above.get_mpz_t(), 2)) -
                  static_cast<long>(mpz_sizeinbase(below.get_mpz_t(), 2));
  const mpz_class longer = (exponent > 0 ? below : above) << std::abs(exponent);
  if (exponent > 0 ? above < longer : longer < below) --exponent;  // of 2^exponent <= x: x may be no double
  const long half = -exponent / 2;
  const Rational power(mpz_class(1) << std::abs(half));
  return half < 0 ? Rational(1 / power) : power;
}

Rational Rounded(const Rational& x) {  // to the nearest integer, halves upward
  const Rational shifted = x + Rational(1, 2);
  mpz_class floor;
  mpz_fdiv_q(floor.get_mpz_t(), shifted.get_num_mpz_t(), shifted.get_den_mpz_t());
  return Rational(floor);
}

template <class Numbers>
Rational LargestEntry(const Numbers& numbers) {
  Rational largest = 0;
  for (const Rational& x : numbers.reshaped()) largest = std::max<Rational>(largest, abs(x));
  return largest;
}

// The largest rational g such that all numbers are integer multiples of it: gcd of numerators over lcm of
// denominators; 1 if all are zero.
template <class Matrix>
Rational CommonFactor(const Matrix& numbers) {
  mpz_class numerator = 0, denominator = 1;
  for (const Rational& x : numbers.reshaped()) {
    if (x == 0) continue;
    numerator = gcd(numerator, x.get_num());
    denominator = lcm(denominator, x.get_den());
  }
  return numerator == 0 ? Rational(1) : Rational(Rational(numerator) / Rational(denominator));
}

// x to so many significant bits.
Rational Significant(const Rational& x, int bits) {
  if (x == 0) return 0;
  const auto size = static_cast<long>(mpz_sizeinbase(x.get_num_mpz_t(), 2)) -
                    static_cast<long>(mpz_sizeinbase(x.get_den_mpz_t(), 2));
  const long shift = bits - size;
  const Rational power(mpz_class(1) << std::abs(shift));
  const Rational scale = shift < 0 ? Rational(1 / power) : power;
  return Rounded(Rational(x * scale)) / scale;
}

}  // namespace

ExactProblem Stretched(const ExactProblem& problem, int only_contact) {
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(problem.contacts, problem.dimension);
  std::vector<Rational> s(problem.rows(), Rational(1));
  for (int contact = 0; contact < layout.ContactCount(); ++contact) {
    const int row = layout.NormalRowOf(contact);
    const Rational& mu = problem.contacts[contact].mu;
    if (!layout.HasFriction(row) || mu <= 0 || (only_contact >= 0 && only_contact != contact)) continue;
    for (int t = 1; t < problem.dimension; ++t) s[row + t] = mu;
  }
  return Rescaled(problem, s);
}

ExactProblem Equilibrated(const ExactProblem& problem) {
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(problem.contacts, problem.dimension);
  std::vector<Rational> s(problem.rows());
  for (int row = 0; row < problem.rows(); ++row) {
    s[row] = layout.IsNormal(row) ? InverseRoot(problem.A(row, row)) : s[row - 1];
  }
  return Stretched(Rescaled(problem, s), -1);
}

ExactProblem RoundedTo(const ExactProblem& problem, std::int64_t size_A, std::int64_t size_b,
                       const Ridge& ridge) {
  ExactProblem rounded = problem;
  const Rational largest_A = LargestEntry(problem.A), largest_b = LargestEntry(problem.b);
  const Rational scale_A = largest_A == 0 ? Rational(0) : Rational(Rational(size_A) / largest_A);
  const Rational scale_b = largest_b == 0 ? Rational(0) : Rational(Rational(size_b) / largest_b);
  for (int i = 0; i < problem.rows(); ++i) {
    rounded.b[i] = Rounded(Rational(problem.b[i] * scale_b));
    for (int j = 0; j < problem.rows(); ++j) {
      rounded.A(i, j) = Rounded(Rational(problem.A(i, j) * scale_A * (i == j ? 1 + ridge.share : Rational(1))));
      if (i == j) rounded.A(i, j) += ridge.number;
    }
  }
  return rounded;
}

ExactProblem RoundedByLot(const ExactProblem& problem, int size, Choices& lots) {
  ExactProblem rounded = problem;
  const Rational largest_A = LargestEntry(problem.A), largest_b = LargestEntry(problem.b);
  const Rational scale_A = largest_A == 0 ? Rational(0) : Rational(Rational(size) / largest_A);
  const Rational size_b(lots.Integer((size + 1) / 2, size));
  const Rational scale_b = largest_b == 0 ? Rational(0) : Rational(size_b / largest_b);
  const auto round = [&lots](const Rational& x) {
    return Rounded(Rational(x + Rational(lots.Integer(-12, 12)) / 16));
  };
  for (int i = 0; i < problem.rows(); ++i) {
    rounded.b[i] = round(Rational(problem.b[i] * scale_b));
    for (int j = i; j < problem.rows(); ++j)
      rounded.A(i, j) = rounded.A(j, i) = round(Rational(problem.A(i, j) * scale_A));
  }
  return rounded;
}

std::pair<ExactProblem, ExactProblem> WithoutCommonFactors(const ExactProblem& problem) {
  const Rational in_A = CommonFactor(problem.A), in_b = CommonFactor(problem.b);
  ExactProblem divided_A = problem, divided_b = problem;
  for (Rational& x : divided_A.A.reshaped()) x /= in_A;
  for (Rational& x : divided_b.b) x /= in_b;
  return {std::move(divided_A), std::move(divided_b)};
}

std::optional<ExactProblem> WithRoundedFactors(const ExactProblem& problem, int bits) {
  auto decision = DecideSemidefinite(problem.A);
  if (!std::holds_alternative<LdltFactors>(decision)) return std::nullopt;
  auto& factors = std::get<LdltFactors>(decision);
  ExactProblem rounded = problem;
  const int size = problem.rows();
  ExactVector c = problem.b;
  for (int i = 0; i < size; ++i) {
    for (int k = 0; k < i; ++k) c[i] -= factors.L(i, k) * c[k];
  }
  for (int i = 0; i < size; ++i) {
    factors.D[i] = Significant(factors.D[i], bits);
    // b stays in range(A): its part along a zero pivot is zero, as that of an exact b is.
    c[i] = Significant(c[i], bits);
    for (int k = 0; k < i; ++k) factors.L(i, k) = Significant(factors.L(i, k), bits);
  }
  for (int i = 0; i < size; ++i) {
    rounded.b[i] = 0;
    for (int k = 0; k <= i; ++k) rounded.b[i] += factors.L(i, k) * c[k];
    for (int j = 0; j < size; ++j) {
      rounded.A(i, j) = 0;
      for (int k = 0; k <= std::min(i, j); ++k) {
        rounded.A(i, j) += factors.L(i, k) * factors.D[k] * factors.L(j, k);
      }
    }
  }
  return WithoutCommonFactors(WithoutCommonFactors(rounded).first).second;
}

// Above kSmall only numbers with fewer bits stand here: counting large numbers down by ones would take for ever
// and make nothing easier to read.
std::vector<Rational> SimplerNumbers(const Rational& x, bool positive) {
  constexpr int kSmall = 16;
  const int sign = x < 0 ? -1 : 1;
  const mpz_class whole = abs(x.get_num()) / x.get_den();
  std::vector<Rational> numbers = {0, sign, 2 * sign, sign * Rational(mpz_class(whole / 2))};
  if (whole > kSmall) {
    const mpz_class one_bit_less = (mpz_class(1) << (mpz_sizeinbase(whole.get_mpz_t(), 2) - 1)) - 1;
    numbers.push_back(sign * Rational(one_bit_less));
    numbers.push_back(Rounded(x));
  } else {
    for (const mpz_class& near : {mpz_class(whole - 1), whole, mpz_class(whole + 1)})
      numbers.push_back(sign * Rational(near));
    numbers.push_back(-sign);
    for (int denominator = 2; denominator <= 4; ++denominator) {
      numbers.push_back(Rounded(Rational(x * denominator)) / denominator);
    }
  }
  std::vector<Rational> distinct;
  for (const Rational& number : numbers) {
    const bool known = std::find(distinct.begin(), distinct.end(), number) != distinct.end();
    if (!known && number != x && !(positive && number < 0)) distinct.push_back(number);
  }
  return distinct;
}

}  // namespace stiction
