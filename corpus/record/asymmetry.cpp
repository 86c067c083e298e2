// SPDX-License-Identifier: Apache-2.0
#include "corpus/record/asymmetry.h"

#include <algorithm>

namespace stiction {

Asymmetry LargestAsymmetry(const AnyProblem& problem) {
  Asymmetry largest;
  if (problem.factors() != nullptr) return largest;
  const auto& A = problem.entries().A;
  for (const auto& [at, value] : ByRows(A)) {
    const auto [i, j] = at;
    const Rational difference = abs(Rational(value - A.coeff(j, i)));
    if (difference > largest.difference) largest = {difference, std::min(i, j), std::max(i, j)};
  }
  return largest;
}

AnyProblem Symmetrized(const AnyProblem& problem) {
  if (LargestAsymmetry(problem).difference == 0) return problem;
  if (problem.IsDense()) {
    ExactProblem symmetric = problem;
    symmetric.A = (symmetric.A + problem.dense().A.transpose()) * Rational(1, 2);
    return symmetric;
  }
  ExactEntries symmetric = problem.entries();
  const Eigen::SparseMatrix<Rational> transposed = symmetric.A.transpose();
  symmetric.A = (symmetric.A + transposed) * Rational(1, 2);
  symmetric.A.prune([](Eigen::Index, Eigen::Index, const Rational& x) { return x != 0; });
  return symmetric;
}

void Symmetrize(ProblemFile& file) {
  const Asymmetry largest = LargestAsymmetry(file.problem);
  if (largest.difference == 0) return;
  file.problem = Symmetrized(file.problem);
  const SharedJson symmetrized = {
      {"largest difference", ToString(largest.difference)}, {"i", largest.i}, {"j", largest.j}};
  file.origin.Add({{"symmetrized", symmetrized}});
}

}  // namespace stiction
