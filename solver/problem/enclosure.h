// SPDX-License-Identifier: Apache-2.0
// Enclosures: number types that know a number between two ends only, as intervals do.
//
// They count as exact (scalar.h): a comparison that the ends decide is one of the numbers enclosed, and any
// other throws, so that what a run says is true of the numbers. What is zero by the sets, not by its ends, is
// set to zero or told from the sets; numbers equal by their ends alone are not taken for equal.

#ifndef STICTION_SOLVER_PROBLEM_ENCLOSURE_H_
#define STICTION_SOLVER_PROBLEM_ENCLOSURE_H_

#include "solver/problem/scalar.h"

namespace stiction {

// Specialised beside the scalar, with Approximation.
template <class Scalar>
inline constexpr bool kEncloses = false;

// A double near x; specialised beside a scalar that does not convert.
template <class Scalar>
struct Approximation {
  static double Of(const Scalar& x) { return static_cast<double>(x); }
};

// Whether a point at which something is reached must be told that it is there: not over rationals.
template <class Scalar>
inline constexpr bool kMeetsLimits = !kIsExact<Scalar> || kEncloses<Scalar>;

// The one exception from "throws": a rate whose ends have both signs. What shrinks at it reaches zero at Reach(gap, rate), from the earliest to
// never; Refuse() throws, as comparisons do. Specialised beside the scalar.
template <class Scalar>
struct UncertainRate {
  static bool Is(const Scalar&) { return false; }
  static bool IsNone(const Scalar&) { return false; }  // surely not positive
  static Scalar Reach(const Scalar& gap, const Scalar&) { return gap; }
  static bool IsReach(const Scalar&) { return false; }
  static void Refuse() {}
};

}  // namespace stiction

#endif  // STICTION_SOLVER_PROBLEM_ENCLOSURE_H_
