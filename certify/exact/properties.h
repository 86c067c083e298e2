// SPDX-License-Identifier: Apache-2.0
// The paper's assumptions on A and b, decided exactly, each answer with a witness.
//
//   symmetric                A = A'
//   positive semidefinite    A = L diag(D) L', D >= 0        or x with x'Ax < 0
//   positive definite        A = L diag(D) L', D > 0         or x /= 0 with x'Ax <= 0
//   in range                 x with A x = b                  or y with y'A = 0, y'b /= 0
//
// Assumed in section 3 of [Baraff94] ("A is symmetric and positive semidefinite, and b is a vector in the
// column space of A"); properties of a problem, never conditions of its validity.

#ifndef STICTION_CERTIFY_EXACT_PROPERTIES_H_
#define STICTION_CERTIFY_EXACT_PROPERTIES_H_

#include <optional>
#include <utility>
#include <variant>

#include "corpus/exact_problem.h"

namespace stiction {

using ExactMatrix = ExactProblem::Matrix;
using ExactVector = ExactProblem::Vector;

// The first (i, j), i < j, with A_ij /= A_ji; empty for a symmetric matrix.
std::optional<std::pair<int, int>> FindAsymmetry(const ExactMatrix& A);

struct LdltFactors {
  ExactMatrix L;  // lower triangular, unit diagonal
  ExactVector D;  // >= 0
};
struct NegativeCurvature {
  ExactVector x;
  Rational value;  // x'Ax < 0
};
// For an asymmetric matrix the answer is that of (A + A')/2, which has the same x'Ax.
std::variant<LdltFactors, NegativeCurvature> DecideSemidefinite(const ExactMatrix& A);

struct NoCurvature {
  ExactVector x;   // not 0
  Rational value;  // x'Ax <= 0
};
// As above; D > 0.
std::variant<LdltFactors, NoCurvature> DecideDefinite(const ExactMatrix& A);

struct RangePoint {
  ExactVector x;  // A x = b
};
struct RangeObstacle {
  ExactVector y;   // y'A = 0
  Rational value;  // y'b /= 0
};
std::variant<RangePoint, RangeObstacle> DecideRange(const ExactMatrix& A, const ExactVector& b);

bool IsSymmetric(const ExactProblem& problem);
bool IsPositiveSemidefinite(const ExactProblem& problem);
bool IsInRange(const ExactProblem& problem);
// All three.
bool MeetsAssumptions(const ExactProblem& problem);

}  // namespace stiction

#endif  // STICTION_CERTIFY_EXACT_PROPERTIES_H_
