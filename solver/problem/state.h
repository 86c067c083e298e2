// SPDX-License-Identifier: Apache-2.0
// Where a run stands: forces, accelerations and the sets of all variables.

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>

#include "solver/problem/index_sets.h"
#include "solver/problem/options.h"
#include "solver/problem/problem.h"
#include "solver/problem/scalar.h"

namespace stiction {

// One entry per row.
template <int Rows>
using IndexSets = RowArray<IndexSet, Rows>;

// Shapes: rows x 1 each. Units: f in N, a in m/s^2. Always a = A f + b (to rounding).
template <class Scalar, int Rows>
struct ContactState {
  using Vector = typename ContactProblem<Scalar, Rows>::Vector;

  Vector f, a;
  IndexSets<Rows> sets;
};

// The sign of the limit at which the friction of a normal row is held, 0 if it is not.
template <int Rows>
int FrictionLimitSign(const RowLayout<Rows>& layout, const IndexSets<Rows>& sets, int row) {
  return layout.IsNormal(row) && layout.HasFriction(row) ? LimitSign(sets[row + 1]) : 0;
}

// Tolerances in the units of the problem; exact zeros for exact scalars.
template <class Scalar>
struct Scale {
  Scalar acceleration = Scalar(0);   // m/s^2
  Scalar force = Scalar(0);          // N
  Scalar pivot = Scalar(0);          // relative to a column of direction systems
  Scalar rate = Scalar(0);           // 1/kg: smallest da per unit force that is not zero
  Scalar inverse_grain = Scalar(0);  // 1/N: forces are compared after rounding to 1/inverse_grain
};

template <class Scalar, int Rows>
Scale<Scalar> MakeScale(const ContactProblem<Scalar, Rows>& problem, const Tolerances& tolerances) {
  Scale<Scalar> scale;
  if constexpr (!kIsExact<Scalar>) {
    Scalar a = 0, A = 0;
    for (int i = 0; i < problem.rows(); ++i) {
      a = std::max(a, Abs(problem.b[i]));
      A = std::max(A, Abs(problem.A(i, i)));
    }
    const Scalar f = A > 0 ? a / A : Scalar(0);
    // A tolerance below the rounding of the number type would only hide that it is too small.
    const Scalar least = 8 * std::numeric_limits<Scalar>::epsilon();
    scale.acceleration = std::max(Scalar(tolerances.acceleration), least) * a;
    scale.force = std::max(Scalar(tolerances.force), least) * f;
    scale.pivot = std::max(Scalar(tolerances.pivot), least);
    scale.rate = scale.pivot * A;
    scale.inverse_grain = f > 0 ? 1 / (std::max(Scalar(tolerances.loop_grain), least) * f) : Scalar(0);
  }
  return scale;
}

}  // namespace stiction
