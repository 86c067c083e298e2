// SPDX-License-Identifier: Apache-2.0
#include "corpus/record/sparse_matrix.h"

#include <fmt/format.h>

#include <vector>

#include "corpus/exact_number.h"
#include "corpus/json_text.h"

namespace stiction {

SparseMatrix ReadEntries(const JsonPlace& place, int rows, int columns, bool strict) {
  constexpr const char* kEntry = "an entry [i, j, value]";
  const std::string row = fmt::format("a row number >= 0 and < {}", rows);
  const std::string column = fmt::format("a column number >= 0 and < {}", columns);
  const std::size_t count = place.Size("an array of entries [i, j, value]");
  SparseMatrix entries;
  for (std::size_t k = 0; k < count; ++k) {
    const JsonPlace entry = place[k];
    if (entry.Size(kEntry) != 3) entry.Refuse(kEntry);
    const int i = static_cast<int>(entry[0].Integer(0, rows - 1, row));
    const int j = static_cast<int>(entry[1].Integer(0, columns - 1, column));
    if (!entries.emplace(std::pair(i, j), ExactNumber(entry[2], strict)).second)
      entry.Refuse("each entry once");
  }
  return entries;
}

Eigen::SparseMatrix<Rational> ToEigen(const SparseMatrix& entries, Eigen::Index rows, Eigen::Index columns) {
  std::vector<Eigen::Triplet<Rational>> triplets;
  for (const auto& [at, value] : entries)
    if (value != 0) triplets.emplace_back(at.first, at.second, value);
  Eigen::SparseMatrix<Rational> matrix(rows, columns);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

SparseMatrix ByRows(const Eigen::SparseMatrix<Rational>& matrix) {
  SparseMatrix entries;
  for (int j = 0; j < matrix.outerSize(); ++j)
    for (Eigen::SparseMatrix<Rational>::InnerIterator entry(matrix, j); entry; ++entry)
      entries.emplace(std::pair(static_cast<int>(entry.row()), j), entry.value());
  return entries;
}

}  // namespace stiction
