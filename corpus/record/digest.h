// SPDX-License-Identifier: Apache-2.0
// Digests: SHA-256 of bytes, and that of a problem, the same for every file that states the same numbers,
// however it spells them.

#pragma once

#include <string>
#include <string_view>

#include "corpus/exact_problem.h"

namespace stiction {

// 64 hexadecimal digits.
std::string Sha256(std::string_view bytes);

// "sha256:" and 64 hexadecimal digits: SHA-256 of the lines
//
//   stiction-problem 1
//   dimension 2
//   static 3/4            each contact: its kind, mu, the components of slip; what it does not have falls away
//   A 3 -4 2 0            each row
//   b -1 0 0 -2
//
// in ASCII, each ended by a line feed, numbers in lowest terms (p or p/q). Names, scenes and origins are no
// part of it; the order of contacts and the directions of tangents are.
std::string ProblemDigest(const ExactProblem& problem);

}  // namespace stiction
