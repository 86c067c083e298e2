// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/dependent_rows.h"

#include "solver/linear/elimination.ipp"

namespace stiction {

bool ExactDependentRows::Follows(const std::vector<bool>& zero, int row) {
  const auto [at, is_new] = known_.try_emplace({zero, row}, false);
  if (is_new) at->second = IsCombination(zero, row);
  return at->second;
}

// The equations of the combination: a column for every row that is zero, the row itself on the right.
bool ExactDependentRows::IsCombination(const std::vector<bool>& zero, int row) {
  const int rows = problem_.rows();
  if (integers_.rows() != rows) ScaleToIntegers();
  std::vector<int> columns;
  for (int i = 0; i < rows; ++i) {
    if (zero[i]) columns.push_back(i);
  }
  const int unknowns = static_cast<int>(columns.size());
  columns.push_back(row);
  system_.Resize(rows + 1, unknowns + 1);
  for (int j = 0; j <= unknowns; ++j) {
    for (int i = 0; i <= rows; ++i) system_(i, j) = integers_(columns[j], i);
  }
  system_.Run(rows + 1, unknowns, unknowns + 1);
  return system_.IsConsistent(unknowns);
}

// Combinations of rows do not care for their scales.
void ExactDependentRows::ScaleToIntegers() {
  const int rows = problem_.rows();
  integers_.resize(rows, rows + 1);
  Eigen::Matrix<Rational, 1, Eigen::Dynamic> row(rows + 1);
  for (int i = 0; i < rows; ++i) {
    row << problem_.A.row(i), problem_.b[i];
    const auto scale = CommonDenominator<Rational>(row);
    for (int j = 0; j <= rows; ++j) integers_(i, j) = Fractions<Rational>::Numerator(row[j], scale);
  }
}

}  // namespace stiction
