// SPDX-License-Identifier: Apache-2.0
// The direction system of many unknowns over floating-point scalars: updated, not solved afresh.
//
// From one step to the next a few variables change their sets. The inverse of the reduced matrix M
// (unknowns.h) follows them: a new unknown is a row and a column more, a friction that reaches its limit or
// leaves it changes the column of its normal. The unknowns are compared with those that the inverse was made
// for, so that callers say nothing. Rows and columns stand in any order, the same for both, which leaves det(M)
// as it is.
//
// Errors     of the inverse are seen in da = A df, which is needed anyway and should be zero at the unknowns: a
//            step of refinement mends them; if it does not, M is inverted anew. Where that fails too, or M is
//            close to singular on the way, the caller has to solve the system afresh.
// Source     [Baraff94], section 4.5: "the use of an incremental factorization routine".
// Shapes     df, da: rows x 1, as in direction.h.
// Cost       O(k^2) per changed set and step for k unknowns, O(rows k) for da. Allocates where M is inverted
// only.

#pragma once

#include <cstdint>
#include <vector>

#include "solver/linear/inverse.h"
#include "solver/linear/unknowns.h"

namespace stiction {

template <class Scalar>
class UpdatedSystem {
 public:
  using Problem = ContactProblem<Scalar>;
  using Vector = typename Problem::Vector;

  struct Counts {
    std::int64_t solved = 0;    // directions
    std::int64_t refined = 0;   // that took a step of refinement
    std::int64_t inverted = 0;  // times that M was inverted anew
    std::int64_t refused = 0;   // left to the caller
  };

  // `least`: unknowns below which nothing is done here.
  void Start(const Problem& problem, int least);

  // What the unknowns answer to: the driven force, or b; with b, df becomes the forces at which a = A df + b
  // rests at the unknowns, and da becomes a.
  enum class Load { kDriven, kFree };

  // The direction while the driven force grows, where the reduced matrix is regular. Returns false if it was
  // not found; df and da are then anything.
  template <class Unknowns>
  bool Solve(const Problem& problem, const Unknowns& unknowns, const Scale<Scalar>& scale, Vector& df,
             Vector& da, Load load = Load::kDriven);

  // Of the reduced matrix of the last direction found.
  int determinant_sign() const { return inverse_.determinant_sign(); }

  // The caller found that the matrix was regular, after all: it is inverted next time.
  void Forget() { valid_ = false; }

  const Counts& counts() const { return counts_; }

 private:
  // One row and column of M.
  struct Slot {
    int row;  // that names the unknown
    RowCombination<Scalar> force, rest;
  };

  template <class Unknowns>
  bool Follow(const Problem& problem, const Unknowns& unknowns, const Scale<Scalar>& scale);
  template <class Unknowns>
  int CountChanges(const Problem& problem, const Unknowns& unknowns) const;
  template <class Unknowns>
  bool InvertAnew(const Problem& problem, const Unknowns& unknowns, const Scale<Scalar>& scale);
  template <class Unknowns>
  int AppendNew(const Problem& problem, const Unknowns& unknowns);
  template <class Unknowns>
  int ReplaceColumns(const Problem& problem, const Unknowns& unknowns);
  template <class Unknowns>
  int RemoveOld(const Unknowns& unknowns);
  template <class Unknowns>
  bool FindDirection(const Problem& problem, const Unknowns& unknowns, Load load, Vector& df, Vector& da);
  template <class Unknowns>
  void Spread(const Problem& problem, const Unknowns& unknowns, Load load, Vector& df, Vector& da) const;
  void GatherColumn(const Problem& problem, const RowCombination<Scalar>& force);

  int least_ = 0;
  bool valid_ = false;
  int pause_ = 0;  // directions to come that are refused
  Scalar largest_ = Scalar(0);
  Counts counts_;
  Inverse<Scalar> inverse_;
  std::vector<Slot> slots_;
  std::vector<int> slot_of_;  // by row, -1: no unknown
  Vector row_, column_, x_, correction_;
};

}  // namespace stiction
