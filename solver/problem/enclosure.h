// SPDX-License-Identifier: Apache-2.0
// Enclosures: number types that know a number between two ends only, as intervals do.
//
// They count as exact (scalar.h): a comparison that the ends decide is one of the numbers enclosed, and any
// other throws, so that what a run says is true of the numbers. What is zero by the sets, not by its ends, is
// set to zero or told from the sets; numbers equal by their ends alone are not taken for equal.

#pragma once

#include <exception>
#include <vector>

#include "solver/problem/scalar.h"

namespace stiction {

// What comparisons of balls throw (ball.h).
class UnsureSign : public std::exception {
 public:
  const char* what() const noexcept override { return "a sign is unsure"; }
};

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

// What is asked of an enclosure before it is compared, where a comparison would throw. Specialised beside the
// scalar; the defaults are those of scalars that know their signs.
template <class Scalar>
struct Unsure {
  static bool TellsSign(const Scalar&) { return true; }
  static bool MayBePositive(const Scalar& x) { return x > 0; }
  // Of a gap that shrinks at a rate of unsure sign: not later than it could be closed.
  static Scalar Earliest(const Scalar& gap, const Scalar&) { return gap; }
  // Throws, as comparisons do.
  static void Refuse() {}
};

// Rows of (A b) that are combinations of others: there a = A f + b is zero wherever it is zero in those,
// whatever f. Where A is singular, a comparison of ends never tells such zeros.
class DependentRows {
 public:
  virtual ~DependentRows() = default;
  // Whether row `row` is a combination of the rows that are marked.
  virtual bool Follows(const std::vector<bool>& zero, int row) = 0;
};

// Which entries are known to be zero.
template <class Vector>
std::vector<bool> SureZeros(const Vector& values) {
  std::vector<bool> zero(values.size());
  for (int row = 0; row < values.size(); ++row) zero[row] = IsSurelyZero(values[row]);
  return zero;
}

// Accelerations, or their changes, that are zero by the equations between rows become zero. Null: none are
// known.
template <class Vector>
void MeetDependentZeros(DependentRows* rows, Vector& a) {
  using Scalar = typename Vector::Scalar;
  if (rows == nullptr) return;
  const std::vector<bool> zero = SureZeros(a);
  for (int row = 0; row < a.size(); ++row) {
    if (!Unsure<Scalar>::TellsSign(a[row]) && rows->Follows(zero, row)) a[row] = Scalar(0);
  }
}

}  // namespace stiction
