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
// Unknowns   may also be other forces and rests than those of the sets: unknowns.h.
// Exact      over scalars with known integers (elimination.h): A is scaled to integers once, by rows, in
//            space by contacts, the factors of forces and rests by their denominators; df and da become
//            fractions at the end.
// Cost       O(k^3) for k unknowns, O(rows k) for da. Allocates nothing once sized, integers apart. Over
//            floating-point scalars and with dynamic sizes, O(k^2) from some number of unknowns on, if few sets
//            have changed since the call before (updated_system.h).

#pragma once

#include <optional>
#include <type_traits>
#include <vector>

#include "solver/linear/elimination.h"
#include "solver/linear/unknowns.h"
#include "solver/linear/updated_system.h"
#include "solver/problem/enclosure.h"

namespace stiction {

template <class Scalar, int Rows>
class DirectionSystem {
 public:
  using Problem = ContactProblem<Scalar, Rows>;
  using Vector = typename Problem::Vector;

  enum class Status { kRegular, kSingular, kInconsistent };

  // Whether systems of many unknowns are updated; what updated() is then.
  static constexpr bool kUpdates = kIsFloatingPoint<Scalar> && Rows == Eigen::Dynamic;
  struct NotUpdated {};
  using Updated = std::conditional_t<kUpdates, UpdatedSystem<Scalar>, NotUpdated>;

  // Takes the problem that is to be solved from now on. Its A must stay as it is. `update_from`: number of
  // unknowns, at least 1, from which on the system is updated.
  void Start(const Problem& problem, int update_from = kUpdateFrom);

  template <class Unknowns>
  Status Solve(const Problem& problem, const Unknowns& unknowns, const Scale<Scalar>& scale);
  // Requires: the driven variable is in neither C nor CF. `sign` is df_d, +1 or -1.
  Status Solve(const Problem& problem, const RowLayout<Rows>& layout, const IndexSets<Rows>& sets, int driven,
               int sign, const Scale<Scalar>& scale) {
    return Solve(problem, SetUnknowns<Scalar, Rows>{problem, layout, sets, driven, sign}, scale);
  }

  // The sign d of the determinant of the reduced matrix; df and da are then the oriented null vector, in which
  // the driven force changes by d times itself: at rest for d = 0. Empty if the null vector is not unique.
  template <class Unknowns>
  std::optional<int> SolveOriented(const Problem& problem, const Unknowns& unknowns,
                                   const Scale<Scalar>& scale);

  // df() becomes the forces of the unknowns at which a = A f + b rests there, all other forces zero; da()
  // becomes a. Allocates where it does not update.
  template <class Unknowns>
  Status SolveForces(const Problem& problem, const Unknowns& unknowns, const Scale<Scalar>& scale);

  const Vector& df() const { return df_; }
  Vector& df() { return df_; }
  const Vector& da() const { return da_; }
  Vector& da() { return da_; }
  const Updated& updated() const { return updated_; }

 private:
  using Entry = typename Fractions<Scalar>::Integer;

  // A force or rest with integer factors: those of the combination times `scale`.
  struct Scaled {
    RowCombination<Entry> combination;
    Entry scale = Entry(1);
  };

  void ScaleToIntegers(const Problem& problem);
  static void Convert(const RowCombination<Scalar>& combination, Scaled& scaled);
  template <class Unknowns>
  void Assemble(const Problem& problem, const Unknowns& unknowns);
  Status Eliminate(const Scale<Scalar>& scale);
  int SolveHomogeneous();
  template <class Unknowns>
  void Spread(const Problem& problem, const Unknowns& unknowns, int held, int rate);
  template <class Unknowns>
  void SpreadIntegers(const Unknowns& unknowns, int held, int rate);

  int unknowns_ = 0;
  RowArray<int, Rows> unknown_;       // the row that names each unknown
  Elimination<Scalar, Rows> system_;  // reduced matrix, right side in column unknowns_
  Vector df_, da_;
  [[no_unique_address]] Updated updated_;

  // Of fraction-free scalars: A_ij = integer_A_(i, j) / row_scale_[i]; numerators of df; the forces of the
  // unknowns and the driven one, and the rests.
  Eigen::Matrix<Entry, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> integer_A_;
  std::vector<Entry> row_scale_, numerator_;
  std::vector<Scaled> forces_, rests_;
};

// Rows that also tell directions, where balls leave a pivot open.
template <class Scalar>
class ExactDirections : public DependentRows {
 public:
  using System = DirectionSystem<Scalar, Eigen::Dynamic>;

  // DirectionSystem::Solve on the problem that is enclosed; df and da are set unless it is inconsistent.
  virtual typename System::Status Solve(const std::vector<IndexSet>& sets, int driven, int sign,
                                        typename System::Vector& df, typename System::Vector& da) = 0;
};

}  // namespace stiction
