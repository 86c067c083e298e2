// SPDX-License-Identifier: Apache-2.0
// Global problems, as others publish them, made local:
//
//   M v = B r + f,  u = B'v + w     becomes     u = A r + b,  A = B' inv(M) B,  b = B' inv(M) f + w
//
// Where M is symmetric and positive definite, in blocks along its diagonal that are not large, as the masses of
// bodies are, the problem keeps its factors J = B', M, w = inv(M) f, c = w. Otherwise, as of finite elements, v
// is eliminated over rationals.

#pragma once

#include <variant>
#include <vector>

#include "corpus/record/problem_file.h"

namespace stiction {

// M velocities x velocities, B velocities x rows, f and w of them; no entry is zero.
struct GlobalEquations {
  SparseMatrix M, B;
  ExactProblem::Vector f, w;
};

// The problem of these contacts, by its factors or by the entries of A; the origin of `file` says how.
// Otherwise the row of M whose pivot is zero: then it has no inverse, or is not definite.
std::variant<AnyProblem, int> Condense(const GlobalEquations& equations, int dimension,
                                       std::vector<Contact<Rational>> contacts, ProblemFile& file);

}  // namespace stiction
