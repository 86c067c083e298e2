// SPDX-License-Identifier: Apache-2.0
// SparseMatrix: exact numbers by row and column, and how files list them.

#pragma once

#include <Eigen/SparseCore>
#include <map>
#include <utility>

#include "corpus/json_text.h"
#include "corpus/rational.h"

namespace stiction {

// By (row, column), zero-based; what is not there is zero.
using SparseMatrix = std::map<std::pair<int, int>, Rational>;

// The same as a matrix, without the zeros that are listed; and back.
Eigen::SparseMatrix<Rational> ToEigen(const SparseMatrix& entries, Eigen::Index rows, Eigen::Index columns);
SparseMatrix ByRows(const Eigen::SparseMatrix<Rational>& matrix);

// Dense matrices of rationals are not made beyond this number of rows (about 1 GB).
inline constexpr int kMostDenseRows = 4000;

// A list of entries [row, column, number], each once; zeros that are listed stay. Strict as in ExactNumber.
SparseMatrix ReadEntries(const JsonPlace& place, int rows, int columns, bool strict = false);

}  // namespace stiction
