// SPDX-License-Identifier: Apache-2.0
// Simpler numbers for a problem: what Minimize (minimize.h) tries. None of these promises that the problem
// keeps its outcome, or its properties, unless it says so.

#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "corpus/exact_problem.h"
#include "search/generators/choices.h"

namespace stiction {

// ---- Units -------------------------------------------------------------------------------------
// The same problem in other units: f_i = s_i f'_i, so A' = S A S, b' = S b and mu' = mu s_N / s_F.

// Tangents in units that make mu = 1, of one contact or (contact < 0) of all.
ExactProblem Stretched(const ExactProblem& problem, int only_contact);
// Each contact in units in which its normal's diagonal entry is near one, tangents stretched.
ExactProblem Equilibrated(const ExactProblem& problem);
// A divided by the largest number of which all its entries are multiples; the same of b.
std::pair<ExactProblem, ExactProblem> WithoutCommonFactors(const ExactProblem& problem);

// ---- Rounding ----------------------------------------------------------------------------------

// What is added to the diagonal of A: a number, and a share of the entry itself.
struct Ridge {
  int number;
  Rational share;
};

// A and b scaled to largest entries size_A and size_b, with a ridge, rounded.
ExactProblem RoundedTo(const ExactProblem& problem, std::int64_t size_A, std::int64_t size_b,
                       const Ridge& ridge);
// A and b scaled to largest entries of `size` and of half of it to all of it, each number rounded after up to
// 3/4 is added or taken away.
ExactProblem RoundedByLot(const ExactProblem& problem, int size, Choices& lots);
// A = L D L' and b = L c with L, D and c to so many significant bits, common factors taken out: semidefinite
// whatever the rounding, which matters where A is nearly singular. Empty where A is not positive semidefinite,
// as one that was rounded to doubles may be.
std::optional<ExactProblem> WithRoundedFactors(const ExactProblem& problem, int bits);
// Numbers to try in the place of x, simplest first; `positive`: none below zero.
std::vector<Rational> SimplerNumbers(const Rational& x, bool positive);

}  // namespace stiction
