// SPDX-License-Identifier: Apache-2.0
// Step size: how far one variable can be driven before the sets must change.
//
// While variable d is driven, forces move along a fixed direction and accelerations answer linearly:
//
//   f(s) = f + s df,   a(s) = a + s da,   da = A df,   s >= 0
//
// StepSize returns the largest s that keeps every maintained variable legal, and the variable that
// stops it. readings.md, 3, lists the limits; they are equations (10)-(12) and, with friction, 5.2, 5.3.
//
// Source      [Baraff94], procedure maxstep, sections 4.2, 4.3, 5.5.
// Shapes      f, a, df, da: rows x 1. Units: f, s in N (df_d = +-1), a in m/s^2.
// Ensures     s >= 0. A zero step is a legal answer. No limit at all: limiting = -1, a ray.
// Ties        the driven variable first, then by Ties. Over inexact scalars steps within the force
//             tolerance tie, and rates within the pivot tolerance are zero.
// Exactness   only + - * / and sign tests. Over enclosures a friction that has left its limit for CF is at the
//             limit by what happened, not by its numbers: MeetBound tells so, until a step moves the forces. A
//             limit whose rate has an unsure sign is left out if it would surely come later than another.

#pragma once

#include <algorithm>
#include <vector>

#include "solver/problem/enclosure.h"
#include "solver/problem/solution.h"
#include "solver/problem/state.h"

namespace stiction {

template <class Scalar, int Rows>
class DirectionSystem;  // solver/linear/direction.h

template <class Scalar>
struct Step {
  Scalar s = Scalar(0);
  int limiting = -1;                 // row, -1 for a ray
  IndexSet wants = IndexSet::kNone;  // the set that the limiting variable wants into
  bool order_matters = false;        // whether the two values of Ties choose differently
};

template <class Scalar, int Rows>
class StepSize {
 public:
  using Problem = ContactProblem<Scalar, Rows>;
  using State = ContactState<Scalar, Rows>;

  void Resize(int rows);

  // Over enclosures: the friction in `row` is exactly at its limit of this sign; and, no friction is any more.
  void MeetBound(int row, int sign) { met_bound_[row] = sign; }
  void LeaveBounds() { std::fill(met_bound_.begin(), met_bound_.end(), 0); }

  void KnowDependentRows(DependentRows* rows) { dependent_rows_ = rows; }

  // Requires: the maintained variables are legal at f, a; aN_d < 0 for a driven normal; for a friction
  // variable to establish aF_d /= 0 and abs(fF_d) <= mu fN_d; to zero fF_d /= 0.
  Step<Scalar> Find(const Problem& problem, const RowLayout<Rows>& layout, const State& state,
                    const DirectionSystem<Scalar, Rows>& direction, int driven, DriveGoal goal, Ties ties,
                    const Scale<Scalar>& scale);

 private:
  struct Limit {
    Scalar s = Scalar(0);
    IndexSet wants = IndexSet::kNone;
    bool exists = false;
    bool may_exist = false;  // over enclosures: another, not before `earliest`
    Scalar earliest = Scalar(0);

    void MayExistFrom(const Scalar& s) {
      if (!may_exist || s < earliest) earliest = s;
      may_exist = true;
    }
  };

  // The driver's gap shrinks at `rate`; a limit exists if rate > 0.
  static void Offer(Limit& limit, const Scalar& gap, const Scalar& rate, IndexSet wants,
                    const Scalar& tolerance);
  void LimitDriven(const Problem& problem, const RowLayout<Rows>& layout, const State& state,
                   const DirectionSystem<Scalar, Rows>& direction, int driven, DriveGoal goal,
                   const Scale<Scalar>& scale);
  void LimitMaintained(const Problem& problem, const RowLayout<Rows>& layout, const State& state,
                       const DirectionSystem<Scalar, Rows>& direction, int row, const Scale<Scalar>& scale);
  int Order(int row, int other) const;
  bool IsSurelyBefore(int row, int other) const;
  void RequireBeyond(int nearest) const;
  Scalar GapToBound(const Scalar& bound, const Scalar& f, int row, int sign) const;
  int FirstOf(const State& state, int driven, Ties ties, int nearest, const Scalar& reach) const;

  RowArray<Limit, Rows> limits_;
  DependentRows* dependent_rows_ = nullptr;
  std::vector<bool> resting_;      // accelerations that are zero and stay so, where rows are dependent
  RowArray<int, Rows> met_bound_;  // sign of the limit, or 0; over enclosures
};

}  // namespace stiction
