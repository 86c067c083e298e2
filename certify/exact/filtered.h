// SPDX-License-Identifier: Apache-2.0
// The path methods of the plane with certified signs: every sign that a step depends on is proved, and every
// step is that of the run over rationals.
//
//   rung            numbers                                    zeros that it knows
//   double          balls around doubles                       by the sets (solver/problem/enclosure.h)
//   double-double   balls around double-doubles, 100 bits      besides, accelerations that follow from others
//                                                              (dependent_rows.h), and open pivots of
//                                                              directions
//   exact           balls around floats of 254 bits             as many
//                   rationals, where these leave a sign open   all
//
// Where nobody asks for the path, only for a solution, none is followed with certified signs: CertifyDoubles
// runs the method over doubles and certifies the end, at the price of a check. What follows is of paths.
//
// A run that meets a sign which its rung does not tell is left, and begun anew on the next. Nothing is carried
// from one rung to another, so that each run is a run of the one program that all scalars share. Nondegenerate
// problems end on the first rung, at one to two times the time of doubles.
//
// Statements: `solved`, `cycle`, `ray`, `singular` and `stall` are true of the method in exact arithmetic, on
// the problem as it is; the forces lie within their ends. A repeated state is a proof where its sets decide its
// forces, and those that were given up were left alike. Kinds: bilateral and sliding contacts leave the problem
// exactly, before it is enclosed (reduction.h); a run is told in the terms of the whole problem, as those of
// exact.h.

#pragma once

#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "certify/exact/solve.h"
#include "corpus/exact_problem.h"
#include "solver/problem/ball.h"
#include "solver/problem/options.h"
#include "solver/problem/solution.h"

namespace stiction {

// The methods over balls, which are those of every rung but the last.
template <>
std::span<const Method<Ball<double>>> Methods<Ball<double>>();

// A method of the table over balls: forces and accelerations with their ends, in the
// middle of them otherwise, as pivots; undecided where a sign was unsure. Its forces are not judged. Lemke's
// method takes a covering vector of ones. Requires dimension 2. On the rung exact no rationals are run. The
// answer keeps METHOD, which has to outlive it.
InexactAnswer RunEnclosed(std::string_view method, const ExactProblem& problem, const Request& request,
                          Rung rung);

// The rungs that a run is tried on. A suspicion of doubles is better begun on the second: the first seldom
// tells what rounding did not. A run that begins on the rung exact is one over rationals.
struct Rungs {
  Rung first = Rung::kDouble, last = Rung::kExact;
  bool with_rationals = true;  // of the rung exact; otherwise only its balls are tried
};

// A verdict of the run over rationals, and the rung that gave it; `undecided` for kUnsureSign where none did.
struct OnRung {
  Verdict verdict;
  Rung rung = Rung::kExact;
  bool by_balls = false;  // not by rationals
  // Of a run beyond doubles that is not solved, on a problem without other kinds; otherwise empty.
  std::vector<Pivot<double>> pivots = {};
};

// The published algorithm. Requires dimension 2. A thread keeps the memory of its runs.
OnRung RunPublishedFiltered(const ExactProblem& problem, const Request& request, const Rungs& rungs = {});

// Complete driving: the counters of the run over rationals, but the end is not believed. The equations of the
// last word are solved over rationals, and the solution is verified; what that does not give, the run over
// rationals does. Without a path or a ray. Requires dimension 2.
ExactAnswer RunCompleteFiltered(const ExactProblem& problem, const Limits& limits);

// What a method ends in over doubles, certified: the equations of its cells, or of those near its forces, over
// balls; where these leave a sign open, over rationals, with forces and accelerations exact. Counters and
// word are of the run over doubles. Empty where it solved nothing, or doubles do not hold the problem, or no
// cells near have a solution. Requires dimension 2, and a method that is built over doubles.
using CertifiedAnswer = std::variant<std::monostate, ExactAnswer, InexactAnswer>;
CertifiedAnswer CertifyDoubles(std::string_view method, const ExactProblem& problem, const Request& request);

}  // namespace stiction
