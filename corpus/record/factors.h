// SPDX-License-Identifier: Apache-2.0
// Problems in factors, over exact numbers: A = J inv(M) J' and b = J w + c (solver/problem/forms.h), the key
// `factors` of a problem file:
//
//   J   {"size": [rows, velocities], "entries": [[row, velocity, number], ...]}, or rows of numbers
//   M   its blocks along the diagonal, each a number or rows of numbers, symmetric and positive definite
//   w   a number for each velocity
//   c   a number for each row; without it zeros
//
// Written as they are read, M in blocks as small as it falls into. Of a block of more than kMostWholeInverse
// velocities inv(M) is not formed over exact numbers (definite_block.h): J inv(M) is.

#pragma once

#include <optional>
#include <vector>

#include "corpus/exact_problem.h"
#include "corpus/record/sparse_matrix.h"

namespace stiction {

inline constexpr int kMostWholeInverse = 12;

// The diagonal blocks of a square matrix, as small as it falls into.
std::vector<ExactProblem::Matrix> BlocksOf(const Eigen::SparseMatrix<Rational>& M);

// What a text says of J, M, w and c. Shapes fit and blocks are symmetric; whether they are definite is open.
struct FactorParts {
  SparseMatrix J;  // by (row, velocity); no entry is zero
  std::vector<ExactProblem::Matrix> M;
  ExactProblem::Vector w, c;
};
// What is wrong goes to `faults`; the result holds only where there is nothing. `rows`: those of the contacts.
// Strict: numbers are strings only, and J is in entries.
FactorParts ReadFactorParts(const JsonPlace& place, int rows, bool strict, Faults& faults);

// The problem of these contacts; empty if a block of M is not definite.
std::optional<ExactFactors> MakeFactors(int dimension, std::vector<Contact<Rational>> contacts,
                                        FactorParts parts);
// The same of a text.
std::optional<ExactFactors> ReadFactors(const JsonPlace& place, int dimension,
                                        const std::vector<Contact<Rational>>& contacts, int rows,
                                        Faults& faults);
// The rows that J says it has; -1 where it does not tell.
int RowsOfFactors(const JsonPlace& place);
Json ToJson(const ExactFactors& factors);

// Whether c = 0, so that b = J w is in range(A) = range(J), M being definite. Otherwise it may be, too.
bool IsInRangeByFactors(const ExactFactors& factors);

// Each number the nearest double, those of inv(M) and b too.
FactoredProblem<double> InDoubles(const ExactFactors& factors);

// For ErrorMeter (solver/problem/errors.h): sums of abs(A_ij f_j) over doubles, rounded down, so that errors
// are told the larger for it; exact where doubles do not hold them.
void AddSizes(const ExactFactors& factors, const ExactProblem::Vector& f, std::vector<Rational>& size);

}  // namespace stiction
