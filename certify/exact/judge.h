// SPDX-License-Identifier: Apache-2.0
// A judge of forces that are called a solution, over rationals, condition by condition: accelerations of row i
// are held against s_i = abs(b_i) + min(sum_j abs(A_ij) max(abs(f_j), abs(b_j) / A_jj), sqrt(A_ii f'Af)), f'Af
// of the contacts that A couples to i, and forces against s_i / A_ii. Written apart from
// solver/problem/errors.h, of which it asks whether what the gate lets pass misses no condition by more than it
// says; the gate is stricter, since it asks for one mode of each contact.

#ifndef STICTION_CERTIFY_EXACT_JUDGE_H_
#define STICTION_CERTIFY_EXACT_JUDGE_H_

#include <optional>
#include <string>

#include "certify/exact/properties.h"
#include "solver/problem/law.h"

namespace stiction {

// The first condition of the law that f misses by more than the bound, in these units; empty if there is none.
// Shapes: f rows x 1. In the plane both laws are one.
std::optional<std::string> FindMiss(const ExactProblem& problem, const ExactVector& f, FrictionLaw law,
                                    const Rational& bound);

}  // namespace stiction

#endif  // STICTION_CERTIFY_EXACT_JUDGE_H_
