// SPDX-License-Identifier: Apache-2.0
// The cascade: what `auto` tries in turn, until one decides.
//
// Its rows (cascade.cpp) say over which numbers that are asked for, in which dimension, when, by which method
// and in which arithmetic. The first answer that is solved, or proves that nothing is, ends it; otherwise the
// answer with the least errors is told. Over floating-point and over exact numbers a row may stand for the rows
// of a table of methods (solver/solve.h) that are automatic.
//
//   doubles    in the space of bodies, where A is in factors, and the modes there, solved exactly and rounded;
//              where all of A is a burden, its entries, and nothing else. Otherwise in the plane the table,
//              proximal points where rows of bilateral contacts are singular, the fast method over quad; in
//              space the fast method without polygons, Newton's method over quad from where it ended, the
//              table. A step over quad costs about rows^3 / 3 operations, and kQuadOperations are spent at
//              most.
//   filtered   complete driving of few rows, the fast method of many, then as over rationals
//   rationals  the modes of methods in the space of bodies, where A is in factors; the table
//   others     the table
//
// Of several solutions one is preferred whose contacts rest (rest.h).

#pragma once

#include "certify/exact/solve.h"
#include "certify/request/posed.h"

namespace stiction {

inline constexpr std::int64_t kQuadOperations = 40'000'000;

// The method `auto`, in the arithmetic of the request. `suspected`: what doubles said, where quad answers.
Solution SolveInTurn(Posed& posed, const Request& request);

// A method by its name, in the arithmetic of the request (named.cpp).
Solution SolveNamed(Posed& posed, const Request& request);

}  // namespace stiction
