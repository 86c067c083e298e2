// SPDX-License-Identifier: Apache-2.0
// Problem files at the edge of what is one: no rows, no columns, no entries, nothing that moves, jams.

#pragma once

#include <string>
#include <vector>

namespace stiction::fuzz {

// In the plane and in space; 0 to 2 contacts of every kind, mu from 0 to "inf"; A = 0, with rows of zeros, a
// jam in fractions, of low rank, ordinary, indefinite, unsymmetric; b = 0, in range, outside, huge and tiny;
// dense, in entries, and in factors, of no columns and without entries too. All are valid.
std::vector<std::string> DegenerateProblems();

// Problem files that say too little or what is no size: each is to be refused.
std::vector<std::string> FilesWithoutSizes();

}  // namespace stiction::fuzz
