// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/dependent_rows.h"

#include <algorithm>
#include <iterator>

#include "solver/linear/direction.ipp"

namespace stiction {

bool ExactDependentRows::Follows(const std::vector<bool>& zero, int row) {
  const auto [at, is_new] = known_.try_emplace({zero, row}, false);
  if (is_new) at->second = IsCombination(zero, row);
  return at->second;
}

auto ExactDependentRows::SolveDirection(const std::vector<IndexSet>& sets, int driven, int sign)
    -> System::Status {
  if (!layout_) {
    layout_.emplace().Assign(problem_.contacts);
    direction_.Start(problem_);
  }
  return direction_.Solve(problem_, *layout_, sets, driven, sign, {});
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

std::map<int, ExactProblem::Vector> WeightsOfDependent(const ExactProblem& problem,
                                                       const std::vector<int>& listed) {
  const int rows = problem.rows(), count = static_cast<int>(listed.size());
  ExactProblem::Matrix columns(rows + 1, count);
  const auto set = [&](int k, int row) { columns.col(k) << problem.A.row(row).transpose(), problem.b[row]; };
  for (int k = 0; k < count; ++k) set(k, listed[k]);
  Elimination<Rational> elimination;
  elimination.Assign(columns);
  elimination.Run(rows + 1, count, count);
  std::vector<int> kept, others;
  for (int k = 0; k < elimination.rank(); ++k) kept.push_back(listed[elimination.pivot_column(k)]);
  std::ranges::sort(kept);
  std::ranges::copy_if(listed, std::back_inserter(others),
                       [&](int row) { return !std::ranges::binary_search(kept, row); });
  const int unknowns = static_cast<int>(kept.size());
  for (int k = 0; k < count; ++k) set(k, k < unknowns ? kept[k] : others[k - unknowns]);
  elimination.Assign(columns);
  elimination.Run(rows + 1, unknowns, count);
  std::map<int, ExactProblem::Vector> weights;
  for (std::size_t k = 0; k < others.size(); ++k) {
    ExactProblem::Vector& own = weights[others[k]];
    own.resize(unknowns);
    elimination.BackSubstitute(unknowns + static_cast<int>(k));
    for (int j = 0; j < unknowns; ++j) own[j] = elimination.Solution(j);
  }
  return weights;
}

}  // namespace stiction
