// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/linear_equations.h"

#include "solver/linear/elimination.ipp"

namespace stiction {

std::optional<ExactVector> SolveEquations(const ExactMatrix& M, const ExactVector& right,
                                          const ExactVector& guess) {
  const int size = static_cast<int>(M.rows());
  ExactMatrix augmented(size, size + 1);
  augmented << M, right;
  Elimination<Rational> elimination;
  elimination.Assign(augmented);
  elimination.Run(size, size, size + 1);
  if (!elimination.IsConsistent(size)) return std::nullopt;
  ExactVector x = guess;
  for (int i = 0; i < elimination.rank(); ++i) x[elimination.pivot_column(i)] = 0;
  if (!x.isZero(0)) {
    augmented.col(size) -= M * x;
    elimination.Assign(augmented);
    elimination.Run(size, size, size + 1);
  }
  elimination.BackSubstitute(size);
  for (int i = 0; i < elimination.rank(); ++i) {
    const int column = elimination.pivot_column(i);
    x[column] = elimination.Solution(column);
  }
  return x;
}

}  // namespace stiction
