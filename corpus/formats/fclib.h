// SPDX-License-Identifier: Apache-2.0
// FCLIB: friction problems in HDF5, local and global.
//
//   local    u = W r + V l + q,  V'r + R l + s = 0                        V, R, s may be absent
//   global   M v = H r + G l + f,  u = H'v + w,  G'v + b = 0              G, b may be absent
//
// with the law of static contacts between u and r, spacedim rows each, normal row first. The equations for l
// are rows of bilateral contacts, behind the others: a = A f + b with f = (r, l),
//
//   local    A = [W V; V' R],  b = (q, s)
//   global   A = [H G]' inv(M) [H G],  b = [H G]' inv(M) f + (w, b)
//
// in factors, or condensed exactly (condense.h). So a global problem has an A that is positive semidefinite if
// its M is positive definite. Its numbers are rationals, and no doubles in general.
//
// A matrix is m, n, nz, nzmax, p, i, x: nz = -1 compressed columns (p of n + 1), -2 compressed rows (p of m +
// 1), otherwise nz triplets. fclib.h says that p lists the rows of triplets and i the columns; files hold rows
// in i, as CSparse has it. Which it is, is decided by the shape: rows in i, unless an index does not fit that
// way and all fit the other way. Entries listed more than once add up.
//
// A file has one problem: one group fclib_local or fclib_global. A group of another kind (fclib_global_rolling)
// is refused by its name. Written are local problems, numbers as doubles. `guesses` and `solution` are not
// read.

#pragma once

#include <string>

#include "corpus/record/problem_file.h"

namespace stiction {

enum class FclibStorage { kColumns, kRows, kTriplet };

// `text`: the bytes of the file. InputError names the source, the place in it, what was found and what was
// expected.
ProblemFile ParseFclib(std::string text, const std::string& source);

// The bytes of a file. Requires static contacts first and bilateral ones behind them, and numbers that are
// doubles.
std::string PrintFclib(const ExactEntries& problem, const std::string& title, FclibStorage storage);

}  // namespace stiction
