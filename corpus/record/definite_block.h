// SPDX-License-Identifier: Apache-2.0
// Symmetric, positive definite blocks of masses over exact numbers: whether one is, and inv(M) B.
//
//   definite   M scaled to a diagonal near 1 and rounded to doubles: where Cholesky's factorization of it,
//              less c I, comes to its end, M is definite, c being what rounding may have changed (S. M. Rump,
//              Verification of positive definiteness, BIT 46, 2006, cited from memory). Where an x of doubles
//              has x'Mx <= 0, it is not. What is left is decided by its pivots over rationals.
//   inv(M) B   by lifting (corpus/lifting.h); in a browser, without FLINT, by elimination over rationals.
//
// The numbers of a solution are as long as the determinant of M, which is why a whole inverse is not formed.

#pragma once

#include <optional>

#include "corpus/exact_problem.h"

namespace stiction {

// The inverse of a symmetric, positive definite matrix; empty if it is not definite.
std::optional<ExactProblem::Matrix> InverseOfDefinite(const ExactProblem::Matrix& M);

// M: symmetric, n x n.
bool IsDefinite(const ExactProblem::Matrix& M);

// X with M X = B, n x any. Requires a definite M. Stops (corpus/stop.h).
ExactProblem::Matrix SolveDefinite(const ExactProblem::Matrix& M, const ExactProblem::Matrix& B);

}  // namespace stiction
