// SPDX-License-Identifier: Apache-2.0
// What else a text file of Siconos can be than what siconos.h reads, so that a refusal can say it.
//
// Siconos writes every kind of problem as bare numbers. They are told by the sizes among them, which must fit
// each other: each kind is read as its printInFile writes it, as far as it takes to be sure. Matrices stand as
// siconos.h says, of n rows unless another size is named; nc contacts or cones of d rows.
//
//   global friction          d (2, 3), nc, M, H (d nc columns), q, b, mu
//   rolling friction         5, nc, M (5 nc), q, mu, mu_r
//   global rolling friction  5, nc, M, H (5 nc columns), q, b, mu, mu_r
//   two coefficients         3, nc, M (3 nc), q, and twice nc numbers: rolling friction in the plane (mu, mu_r)
//                            or plasticity (eta, theta), which are written alike
//   plasticity               d (3 to 6), nc, model (0, 1, 2), M (d nc), q, coefficients
//   cohesive friction        d (2, 3), nc, cohesive points k > 0, M (d (nc + k)), ...
//   relay                    n, M, q, lower bounds, upper bounds
//   SOCLCP                   n, nc, M, q, where the nc cones begin: 0, ..., n; mu
//   MLCP                     whether M is given, whether A, B, C, D are; n, m; where the blocks begin: 0, ...,
//                            n + m; their kinds; M (n + m columns), q; A, B, C, D, a, b
//   MLCP, older              n, m, rows r; A, B, C, D, a, b as numbers: r (n + m + 1) of them
//   GMP                      M in blocks, q, for each block row the number of its kind, and mu behind a 4
//
// An affine variational inequality is written as an LCP is, without its set, and cannot be told from one.
//
// Source   the functions printInFile and newFromFile of numerics/src, github.com/siconos/siconos.

#pragma once

#include <optional>
#include <string>

#include "corpus/record/problem_file.h"

namespace stiction {

// The problem of a text that is a global friction problem, whose M is taken out (condense.h), or an MLCP as
// square as ours, whose equations are bilateral contacts and whose conditions are frictionless ones. Empty of
// other kinds; InputError for what cannot be read of these.
std::optional<ProblemFile> ParseOtherSiconos(const std::string& text, const std::string& source);

// The kind that a text is of, with its article and what stands in it; empty if it is none of these. Meant for a
// text that is no LCP and no local friction problem.
std::string OtherSiconosKind(const std::string& text);

}  // namespace stiction
