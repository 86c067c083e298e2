// SPDX-License-Identifier: Apache-2.0
// A neighbour of a problem: what `solved` says of forces that are not exact, made and held against rationals.
//
// Forces are called solved if they satisfy every condition exactly for some b, mu and A that differ by at most
// eps and tau (solver/problem/errors.h). FindNeighbour makes such b, mu and A; CheckNeighbour, which shares
// nothing with the gate, holds them against the problem and the forces against them:
//
//   abs(dA_ij) <= tau abs(A_ij)      abs(db_N) <= eps abs(b_N)      abs(db_T) <= eps abs(b_T)      abs(dmu) <=
//   eps mu
//
// (db_T of each tangent, b_T of the tangents of a contact together; of sliding contacts in space abs(dslip) <=
// eps). The forces are the same but for those of contacts that part, which are zero and whose sum changes no
// row by more than eps abs(b_i) + tau S_i; and in space, for friction at its limit, but for 2^-80 of it, so
// that its length is rational.
//
// Shapes: f rows x 1. Problems of rationals; of doubles and floats their own numbers.

#pragma once

#include <optional>
#include <string>

#include "certify/exact/properties.h"
#include "solver/problem/errors.h"
#include "solver/problem/options.h"

namespace stiction {

struct Neighbour {
  ExactProblem problem;
  ExactVector f;
};

// The problem that the modes of the contacts ask for; whether it is near, CheckNeighbour says.
Neighbour MakeNeighbour(const ExactProblem& problem, const ExactVector& f, FrictionLaw law, const Gate& gate);

// Why the neighbour is none, or its forces are no solution of it; empty if neither.
std::optional<std::string> CheckNeighbour(const ExactProblem& problem, const ExactVector& f, FrictionLaw law,
                                          const Gate& gate, const Neighbour& neighbour);

// Both: why no neighbour was found of which f is an exact solution; empty if one was. With eps = 0 the problem
// itself.
std::optional<std::string> FindMiss(const ExactProblem& problem, const ExactVector& f, FrictionLaw law,
                                    const Gate& gate);

// How far the nearest neighbour is: the largest error by the theta of a gate, over rationals, rounded.
double ExactResidual(const ExactProblem& problem, const ExactVector& f, const Gate& gate = GateOf<double>());

}  // namespace stiction
