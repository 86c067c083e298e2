// SPDX-License-Identifier: Apache-2.0
// Linear equations over rationals: by elimination, or, hundreds of them, by lifting (corpus/lifting.h).

#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "certify/exact/properties.h"

namespace stiction {

// x with M x = right; unknowns that the equations leave free (columns without a pivot) are as in `guess`. Empty
// if the equations contradict each other. M: square, right and guess: as many.
std::optional<ExactVector> SolveEquations(const ExactMatrix& M, const ExactVector& right,
                                          const ExactVector& guess);

// As SolveEquations, and the same numbers. Rows and columns are chosen that are independent modulo a prime of
// 62 bits, and so are; the other rows are checked. Where that prime divides a minor there may be more: then it
// may say of equations that have a solution that they contradict each other, never the reverse.
std::optional<ExactVector> SolveByLifting(const ExactMatrix& M, const ExactVector& right,
                                          const ExactVector& guess);

// The first rows that are independent modulo a prime of 62 bits, and so are; where that prime divides a minor
// there may be more.
std::vector<int> IndependentRows(const Eigen::SparseMatrix<Rational, Eigen::RowMajor>& M);

// The reduced row echelon form of M: its columns with pivots, each the first that is independent of those
// before, and as many rows (FLINT).
std::pair<std::vector<int>, ExactMatrix> ReducedRows(const ExactMatrix& M);

}  // namespace stiction
