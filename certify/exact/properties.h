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

#pragma once

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
// A vector that shows that something is not so, by a number that is made of it.
struct Obstacle {
  ExactVector x;
  Rational value;
};

// Or x'Ax < 0. For an asymmetric matrix the answer is that of (A + A')/2, which has the same x'Ax.
std::variant<LdltFactors, Obstacle> DecideSemidefinite(const ExactMatrix& A);

// D > 0; or x'Ax <= 0 for an x that is not 0. Of an asymmetric matrix as above.
std::variant<LdltFactors, Obstacle> DecideDefinite(const ExactMatrix& A);

// x with A x = b; or y'b /= 0, where y'A = 0. By lifting (corpus/lifting.h).
std::variant<ExactVector, Obstacle> DecideRange(const ExactMatrix& A, const ExactVector& b);

// Up to so many rows exact elimination of numbers as long as doubles takes no minutes.
inline constexpr int kQuickRows = 60;

int RankOf(const ExactMatrix& A);
bool IsSymmetric(const ExactProblem& problem);
bool IsPositiveSemidefinite(const ExactProblem& problem);
bool IsInRange(const ExactProblem& problem);
// All three.
bool MeetsAssumptions(const ExactProblem& problem);

}  // namespace stiction
