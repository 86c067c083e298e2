// SPDX-License-Identifier: Apache-2.0
// Force direction: how all forces change while one is driven.
//
// While f_d changes by df_d = +-1 per unit step, the maintained variables follow:
//
//   C         a stays 0:                  daN_i = 0, dfN_i unknown
//   CF        a stays 0:                  daF_i = 0, dfF_i unknown
//   NC+, NC-  stays at the limit:         dfF_i = +-mu_i dfN_i
//   all else  df = 0
//
// Source     [Baraff94], procedure fdirection, sections 4.2, 4.3; with friction 5.3 and 5.5.
// Shapes     df, da: rows x 1; da = A df. Units: df per unit of f_d, da in 1/kg.
// Singular   With mu A_.F folded into the columns the matrix is not symmetric, and can be singular even
//            for A positive definite. A consistent singular system takes zero for every unknown whose
//            column depends on the columns before it (row order); an inconsistent one has no direction.
// Oriented   Complete driving goes on where the matrix is singular, and backwards where its determinant is
//            negative: it asks for the null vector of the k x (k + 1) system, driven variable included,
//            with the orientation of Cramer's rule (complete_driving.md, 4).
// Cost       O(k^3) for k unknowns, O(rows k) for da. Allocates nothing once sized.

#ifndef STICTION_SOLVER_DIRECTION_H_
#define STICTION_SOLVER_DIRECTION_H_

#include <optional>

#include "solver/state.h"

namespace stiction {

template <class Scalar, int Rows>
class DirectionSystem {
 public:
  using Problem = ContactProblem<Scalar, Rows>;
  using Vector = typename Problem::Vector;

  enum class Status { kRegular, kSingular, kInconsistent };

  void Resize(int rows);

  // Requires: the driven variable is in neither C nor CF. `sign` is df_d, +1 or -1.
  Status Solve(const Problem& problem, const RowLayout<Rows>& layout, const IndexSets<Rows>& sets, int driven,
               int sign, const Scale<Scalar>& scale);

  // The sign d of the determinant of the reduced matrix; df and da are then the oriented null vector, with
  // df_d = d * side for the driven variable: at rest for d = 0. Empty if the null vector is not unique.
  std::optional<int> SolveOriented(const Problem& problem, const RowLayout<Rows>& layout,
                                   const IndexSets<Rows>& sets, int driven, int side,
                                   const Scale<Scalar>& scale);

  const Vector& df() const { return df_; }
  const Vector& da() const { return da_; }

 private:
  static constexpr int kColumns = Rows == Eigen::Dynamic ? Eigen::Dynamic : Rows + 1;
  using Augmented = Eigen::Matrix<Scalar, Rows, kColumns, Eigen::RowMajor>;

  void Assemble(const Problem& problem, const RowLayout<Rows>& layout, const IndexSets<Rows>& sets, int driven,
                int sign);
  Status Eliminate(const Scale<Scalar>& scale);
  void BackSubstitute(int rank);
  void SolveHomogeneous(int orientation);
  void Spread(const Problem& problem, const RowLayout<Rows>& layout, const IndexSets<Rows>& sets, int driven,
              int sign);

  int unknowns_ = 0;
  int rank_ = 0;                      // of the reduced matrix
  bool odd_swaps_ = false;            // whether the elimination swapped rows an odd number of times
  RowArray<int, Rows> unknown_;       // row of each unknown
  RowArray<int, Rows> pivot_column_;  // column of the pivot in each row of the eliminated system
  Augmented M_;                       // reduced matrix, right side in column unknowns_
  Vector x_;
  Vector df_, da_;
};

}  // namespace stiction

#endif  // STICTION_SOLVER_DIRECTION_H_
