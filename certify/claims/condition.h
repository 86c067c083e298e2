// SPDX-License-Identifier: Apache-2.0
// Safe by condition: an upper bound of the condition number of a symmetric definite A that forbids folds,
// whatever the number of contacts (safe.h; condition_number.md has the theorem and its proof).
//
// With D = diag(d) > 0 let all eigenvalues of DAD be in [l, u], l > 0, and m the largest mu_i d_N / d_F of the
// static contacts i with rows N, F. If
//
//   m^2 (u - l)^2 < 4 u l,     that is   m < 2 sqrt(k) / (k - 1)  with  k = u / l,
//
// every reduced determinant of A, mu is positive: the problem is safe. D changes the unit of each row; to
// stretch the friction row of a contact alone trades its mu against the condition.

#pragma once

#include <optional>

#include "certify/exact/properties.h"
#include "corpus/json_text.h"

namespace stiction {

struct ConditionBound {
  ExactVector scaling;   // d
  Rational least, most;  // l, u: least I <= DAD <= most I, proved
  // Largest over static contacts of d_N / d_F: 0 without any.
  Rational ratio;

  // For a uniform mu: safe up to it. A rational number less than 2 sqrt(ul) / (ratio (u - l)), by at most one
  // part in a thousand; empty where every mu is safe.
  std::optional<Rational> SafeFriction() const;
};

// The best D that a search over doubles finds, rounded, and bounds that are proved for it. With `weights` 1 for
// a uniform mu; otherwise mu_i stands for 1, and `ratio` is the largest mu_i d_N / d_F. Empty where A is not
// symmetric, or not so definite that doubles can tell. Requires RequireSafetyDecidable.
enum class FrictionWeights : std::uint8_t { kUniform, kOfProblem };
std::optional<ConditionBound> FindConditionBound(const ExactProblem& problem, FrictionWeights weights);

// `safe-by-condition`; empty where no bound was found that is good enough.
std::optional<Json> ConditionCertificate(const ExactProblem& problem);

// WitnessCheck (witness.h). Facts: condition, friction.
Json CheckSafeByCondition(const ExactProblem& problem, const Json& witness);

}  // namespace stiction
