// SPDX-License-Identifier: Apache-2.0
// Lifting: equations with integer coefficients, solved exactly by Dixon's p-adic expansions.
//
// A x = b modulo a prime p gives the last digits of x in base p, and what they leave of b the next ones. With
// as many as Hadamard's bounds of numerators and denominator ask for, one fraction alone fits.
//
// Source  J. D. Dixon, Exact solution of linear equations using p-adic expansions, Numerische Mathematik 40,
//         1982.
// Cost    size^3 operations on machine words once, and size^2 for each digit of a solution. The numbers of a
//         solution are as long as the determinant of A.

#pragma once

#include <optional>
#include <vector>

#include "corpus/rational.h"

namespace stiction {

using IntegerVector = std::vector<mpz_class>;
using IntegerRows = std::vector<IntegerVector>;

// A matrix whose rows are each times its denominator: scale[i].
template <class Matrix>
IntegerRows InIntegers(const Matrix& M, IntegerVector& scale) {
  IntegerRows rows(M.rows());
  scale.assign(M.rows(), 1);
  for (int i = 0; i < M.rows(); ++i) {
    for (int j = 0; j < M.cols(); ++j) scale[i] = lcm(scale[i], M(i, j).get_den());
    for (int j = 0; j < M.cols(); ++j) rows[i].emplace_back(M(i, j).get_num() * (scale[i] / M(i, j).get_den()));
  }
  return rows;
}

// The prime below 2^62 of this number, from 0 on.
std::uint64_t LiftingPrime(int number);

// Columns, the first that are independent modulo the prime. Rows of equal length.
std::vector<int> IndependentColumns(const IntegerRows& A, std::uint64_t prime);

// x = numerators / denominator.
struct CommonFractions {
  IntegerVector numerators;
  mpz_class denominator = 1;
};

// Of each b the x with A x = b; empty where A, which is square, is singular modulo the prime. Stops between
// digits (corpus/stop.h).
std::optional<std::vector<CommonFractions>> SolveLifted(const IntegerRows& A,
                                                        const std::vector<std::vector<Rational>>& right,
                                                        std::uint64_t prime);

}  // namespace stiction
