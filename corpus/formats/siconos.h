// SPDX-License-Identifier: Apache-2.0
// The text files of Siconos' numerics component (`.dat`): LCP and friction problems.
//
//   LCP        n, matrix, q                      w = M z + q         n frictionless contacts
//   friction   dimension, contacts, matrix, q, mu  u = W r + q       static contacts, normal row first
//
// Both are a = A f + b with the law of stiction's contacts; at rest a velocity plays the part of an
// acceleration. Behind the last number may stand one flag, 0 or 1, as Siconos' own files have it, and below
// an empty line a remark, which `origin` keeps; anything else there is an error, and mostly the sign of another
// kind of problem (siconos_kinds.h). A matrix is its storage type, its rows and columns, and then
//
//   0   dense     rows and columns again, values column by column
//   1   blocks    number of blocks, of block rows, of block columns; last row + 1 of every block row, last
//                 column + 1 of every block column; numbers of row pointers and of block columns listed, the
//                 pointers, the block columns; every block: its number, its values column by column
//   2   csparse   1 triplet or 2 compressed columns, then what CSparse's cs_print wrote:
//                   CSparse Version ...                             CSparse Version ...
//                   triplet: R-by-C, nzmax: N nnz: N                R-by-C, nzmax: N nnz: N, 1-norm: X
//                       i j : value                                     col j : locations FIRST to LAST
//                                                                         i : value
//                 (Siconos writes six digits here; we write all that a double has.)
//
// A number is the IEEE double nearest to its text, which is what Siconos reads.

#pragma once

#include <optional>
#include <string>

#include "corpus/record/problem_file.h"

namespace stiction {

enum class SiconosKind { kLcp, kFriction };
enum class SiconosStorage { kDense, kBlocks, kTriplet, kColumns };

// What the text must be; nothing: its first words decide. `source` names it in errors, which give the line,
// what was found and what was expected there, and the kind of problem that the text is instead, where it is
// known.
ProblemFile ParseSiconos(const std::string& text, std::optional<SiconosKind> kind, const std::string& source);

// Requires frictionless contacts only (LCP), or static ones only (friction); numbers that are doubles.
std::string PrintSiconos(const ExactEntries& problem, SiconosKind kind, SiconosStorage storage);

}  // namespace stiction
