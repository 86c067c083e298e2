// SPDX-License-Identifier: Apache-2.0
// Judges forces that a solver under test calls a solution, by the conditions of its law over rationals: doubles
// are exact numbers.
//
// The laws `frictionless` and `coulomb`, and `pyramid` in the plane, which is the same: wrong is what has a
// lenient error (solver/problem/lenient.h) above its accuracy, solved what has a strict one within it, and
// neither what lies between. All others row by row, each between its bounds:
//
//   f = low, a >= 0        f = high, a <= 0        low <= f <= high, a = 0
//
// what the nearest of the three misses, forces and accelerations in lenient units (solver/problem/units.h). A
// miss is named after the condition that is missed by most.
//
// Idle groups: contacts that A couples, with b = 0 at all of them. They have no unit of their own, and what
// rounds elsewhere leaves forces there in a method that sees the whole matrix. With W the work of all forces of
// the problem, min(abs(f'Af), abs(b'f)), their unit of force is sqrt(W / A_ii), the force that alone gives A_ii
// f^2 = W, and of acceleration sqrt(A_ii W): both change as forces and accelerations do under A -> D A D.
// Forces of idle groups that are all within the accuracy are taken for none. abs(A_ij) <= sqrt(A_ii A_jj), so
// the accelerations that they make are within as many times the accuracy as there are rows. Where W = 0 any
// force is an error.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/exact_problem.h"
#include "search/under_test/solver.h"

namespace stiction {

// What became of a problem that a solver under test was given.
struct Examined {
  std::string_view kind;  // of a failure (corpus/record/kinds.h); "passed"; "refused", "unjudged": none that is
                          // shown; "stopped": the search is
  // In which way; may be empty: signal; what is missed by more than the accuracy: "pulls", "moves-inward",
  // "presses-and-separates", "moves" (bilateral), "friction-beyond-limit", "friction-drives-slip",
  // "slips-below-limit", "friction-askew".
  std::string what;
  double error = 0;             // of what is called solved, relative; infinite where a force is not finite
  bool misses_coulomb = false;  // passes, and misses Coulomb's law by more than the accuracy
  bool is_neither = false;  // by Coulomb's law: passes, and has a strict error (errors.h) above the accuracy
  bool says_solved = false;

  // "silent-wrong-pulls-2c": what findings are grouped by. Requires a failure.
  std::string Signature(std::size_t contacts) const;
  bool Fails() const;
};

// The problem as posed (solver_process.h); "unjudged" under `findex` where the problem of the normals has more
// than one solution.
Examined JudgeForces(const ContactProblem<double>& posed, SolverLaw law, const Rational& accuracy,
                     const Eigen::VectorXd& f);

// Limits of the friction of each row, 0 of normals, under the laws that are judged row by row: of `box` and
// `findex` whatever the forces are. Empty under `findex` where the problem of the normals has more than one
// solution.
std::optional<std::vector<Rational>> LimitsOf(const ContactProblem<double>& posed, SolverLaw law,
                                              const ExactProblem::Vector& f);

// Forces that satisfy the law exactly, verified; empty if none are known. Of `frictionless`; in the plane of
// `coulomb` and `pyramid`, by complete driving; of `box`, and of `findex` where its bounds are known, by
// Lemke's method.
std::optional<ExactProblem::Vector> SolutionUnder(SolverLaw law, const ContactProblem<double>& posed);

// Forces of Coulomb's law as `auto` finds them over doubles, with errors below 1e-8 (gate.h), in space too;
// empty if it finds none. That a solution exists is known of every problem of rest (certify/existence.md).
std::optional<ExactProblem::Vector> NearSolution(const ContactProblem<double>& posed);

}  // namespace stiction
