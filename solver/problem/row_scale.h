// SPDX-License-Identifier: Apache-2.0
// RowScale: A and b in units that suit them, by powers of two, which round nothing.
//
// Each contact has its own, so that the diagonal of A is about 1 whatever the masses are, and each group of
// contacts that A couples has b about 1. A problem in other units, D A D and D b, is the same problem then, and
// its run the same run.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "solver/problem/units.h"

namespace stiction {

// Exponents of what one unit of the scaled problem is: f_i = 2^f[i] f'_i, a_i = 2^a[i] a'_i.
struct RowScale {
  std::vector<int> f, a;
  int b = 0;  // of the group with the largest b
};

template <class Scalar>
int ExponentOf(const Scalar& x) {
  using std::ilogb;
  return x > 0 ? ilogb(x) : 0;
}

// x 2^e, rounded as ldexp does, by a product where 2^e is a normal number.
template <class Scalar>
Scalar TimesPowerOfTwo(const Scalar& x, int e) {
  if constexpr (std::is_same_v<Scalar, double>) {
    constexpr int kBias = 1023;
    if (e > -kBias && e <= kBias)
      return x * Eigen::numext::bit_cast<double>(static_cast<std::uint64_t>(e + kBias) << 52);
  }
  using std::ldexp;
  return ldexp(x, e);
}

// Half the exponent of the largest A_ii of each contact, by row; one for all if they may not differ.
template <class Problem>
std::vector<int> ExponentsOfContacts(const Problem& problem, const Groups& groups, bool uniform) {
  using Scalar = typename Problem::Vector::Scalar;
  const int rows = problem.rows();
  std::vector<Scalar> largest(problem.contacts.size(), Scalar(0));
  for (int i = 0; i < rows; ++i) {
    Scalar& most = largest[uniform ? 0 : groups.ContactOf(i)];
    most = std::max(most, Abs(Scalar(problem.A.coeff(i, i))));
  }
  std::vector<int> exponents(rows);
  for (int i = 0; i < rows; ++i)
    exponents[i] = ExponentOf(largest[uniform ? 0 : groups.ContactOf(i)]) >> 1;  // rounded down
  return exponents;
}

template <class Problem>
RowScale FindScale(const Problem& problem, bool uniform = false) {
  using Scalar = typename Problem::Vector::Scalar;
  constexpr int kNone = std::numeric_limits<int>::min();
  const int rows = problem.rows();
  Groups groups;
  groups.Find(problem);
  const std::vector<int> half = ExponentsOfContacts(problem, groups, uniform);
  std::vector<int> largest(problem.contacts.size(), kNone);  // exponents of b in these units, by group
  int most = kNone;                                          // of all groups
  const auto group = [&](int i) { return uniform ? 0 : groups.OfRow(i); };
  for (int i = 0; i < rows; ++i) {
    if (problem.b[i] == 0) continue;
    largest[group(i)] = std::max(largest[group(i)], ExponentOf(Scalar(Abs(problem.b[i]))) - half[i]);
    most = std::max(most, largest[group(i)]);
  }
  int rest = 0;  // of an A that is not semidefinite: entries beside the diagonal may be large beside it
  ForEachEntry(problem.A, [&](int i, int j, const Scalar& x) {
    if (x != 0) rest = std::max(rest, ExponentOf(Scalar(Abs(x))) - half[i] - half[j]);
  });
  RowScale scale{std::vector<int>(rows), std::vector<int>(rows), most == kNone ? 0 : most};
  for (int i = 0; i < rows; ++i) {
    const int b = largest[group(i)] == kNone ? 0 : largest[group(i)];
    scale.a[i] = b + half[i];
    scale.f[i] = b - half[i] - rest;
  }
  return scale;
}

template <class Vector>
void ScaleBy(Vector& values, const std::vector<int>& exponents, int extra = 0) {
  using std::ldexp;
  for (int i = 0; i < values.size(); ++i) values[i] = ldexp(values[i], exponents[i] + extra);
}

template <class Problem>
Problem Scaled(Problem problem, const RowScale& scale) {
  using Scalar = typename Problem::Vector::Scalar;
  ForEachEntry(problem.A, [&](int i, int j, const Scalar& x) {
    if (x != 0) problem.A.coeffRef(i, j) = TimesPowerOfTwo(x, scale.f[j] - scale.a[i]);
  });
  for (int i = 0; i < problem.rows(); ++i) problem.b[i] = TimesPowerOfTwo(problem.b[i], -scale.a[i]);
  return problem;
}

}  // namespace stiction
