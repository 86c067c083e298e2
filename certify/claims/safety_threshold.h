// SPDX-License-Identifier: Apache-2.0
// One friction coefficient for all static contacts: below which value A is safe (safe.h).
//
// A determinant det R(W) is a polynomial in mu, of a degree that is the number of slips in W. Its first
// positive root is isolated by Sturm's theorem and narrowed by halving.

#pragma once

#include <optional>
#include <vector>

#include "certify/exact/modes.h"

namespace stiction {

// mu*, the least upper bound of all m such that A is safe for 0 < mu < m, mu that of every static contact.
// It is the smallest positive root of any det R(W), a polynomial in mu, and A is not safe for mu = mu*; or it
// is zero, where some det R(W) is not positive for small mu > 0.
struct SafetyThreshold {
  ModeWord word;                     // the first whose polynomial has the root
  std::vector<Rational> polynomial;  // det R(word): coefficients of 1, mu, mu^2, ...
  // low < mu* <= high, at most 2^-20 apart and with no other root there; or low = mu* = high, as for
  // every rational mu* with a denominator <= 1000.
  Rational low, high;
};

// Empty if A is safe for all mu > 0. The problem's own mu, and b, do not matter. At most kMaxSafetyWords words.
std::optional<SafetyThreshold> FindSafetyThreshold(const ExactProblem& problem);

// The same in the limit (safe.h): for 0 < mu < mu* the matrix A + eps I is safe for all eps > 0 small enough.
// `polynomial` is the first coefficient of det(R(word) + eps I), as a polynomial in eps, that is not zero for
// all mu; mu* is the smallest positive root of any such, or zero, where one is negative for small mu > 0. At
// mu* itself the next coefficient would decide.
std::optional<SafetyThreshold> FindLimitThreshold(const ExactProblem& problem);

}  // namespace stiction
