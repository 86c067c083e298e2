// SPDX-License-Identifier: Apache-2.0
// Whether two problems are the same, number by number.

#pragma once

#include <algorithm>
#include <vector>

#include "corpus/exact_problem.h"
#include "corpus/rounded.h"

namespace stiction::fuzz {

inline bool IsSame(const std::vector<Contact<Rational>>& left, const std::vector<Contact<Rational>>& right) {
  return std::ranges::equal(left, right, [](const auto& x, const auto& y) {
    return x.kind == y.kind && x.mu == y.mu && x.slip == y.slip;
  });
}

inline bool IsSame(const ExactProblem& left, const ExactProblem& right) {
  const bool alike =
      left.rows() == right.rows() && left.A.rows() == right.A.rows() && left.A.cols() == right.A.cols();
  return alike && left.dimension == right.dimension && IsSame(left.contacts, right.contacts) &&
         left.A == right.A && left.b == right.b;
}

// Larger problems are read, and no more: what a target takes is to take no time.
inline constexpr int kMostRowsPrinted = 60;

// Whether all numbers are doubles, as the formats of others have them.
inline bool IsInDoubles(const AnyProblem& problem) {
  const auto is_double = [](const Rational& x) { return IsExactDouble(x); };
  bool all = std::ranges::all_of(problem.contacts(), [&](const auto& c) { return is_double(c.mu); }) &&
             std::all_of(problem.b().begin(), problem.b().end(), is_double);
  ForEachEntry(problem.entries().A, [&](int, int, const Rational& x) { all = all && is_double(x); });
  return all;
}

}  // namespace stiction::fuzz
