// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/dependent_rows.h"

#include <algorithm>

#include "certify/exact/linear_equations.h"
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
  std::vector<mp_bitcnt_t> places(rows + 1);  // of denominators that are powers of two, as most are
  for (int i = 0; i < rows; ++i) {
    const auto entry = [&](int j) -> const Rational& { return j < rows ? problem_.A(i, j) : problem_.b[i]; };
    bool is_dyadic = true;
    for (int j = 0; j <= rows; ++j) {
      places[j] = mpz_scan1(entry(j).get_den_mpz_t(), 0);
      is_dyadic = is_dyadic && mpz_sizeinbase(entry(j).get_den_mpz_t(), 2) == places[j] + 1;
    }
    const mp_bitcnt_t most = *std::max_element(places.begin(), places.end());
    mpz_class scale = 1;
    for (int j = 0; j <= rows && !is_dyadic; ++j) Fractions<Rational>::Include(scale, entry(j));
    for (int j = 0; j <= rows; ++j)
      integers_(i, j) = is_dyadic ? mpz_class(entry(j).get_num() << (most - places[j]))
                                  : Fractions<Rational>::Numerator(entry(j), scale);
  }
}

std::map<int, ExactVector> WeightsOfDependent(const ExactMatrix& M, const std::vector<int>& listed) {
  const auto [pivots, reduced] = ReducedRows(ExactMatrix(M(listed, Eigen::all).transpose()));
  std::map<int, int> kept;  // where its pivot is, by row
  for (std::size_t i = 0; i < pivots.size(); ++i) kept[listed[pivots[i]]] = static_cast<int>(i);
  std::map<int, ExactVector> weights;
  for (std::size_t k = 0; k < listed.size(); ++k) {
    if (kept.contains(listed[k])) continue;
    ExactVector& own = weights[listed[k]];
    own.resize(std::ssize(kept));
    int at = 0;
    for (const auto& [row, pivot] : kept) own[at++] = reduced(pivot, static_cast<int>(k));
  }
  return weights;
}

}  // namespace stiction
