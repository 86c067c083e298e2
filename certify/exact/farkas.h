// SPDX-License-Identifier: Apache-2.0
// Farkas vectors: each refutes words of contact modes.
//
// For a vector y let g = A'y. Every solution satisfies a - A f = b, hence
//
//   y'b = y'(a - A f) = sum over contacts of  yN aN - gN fN + yF aF - gF fF,
//
// and a contact's term is >= 0 throughout its mode (modes.h) if and only if
//
//   hold    gN = 0                          stick   gN + mu abs(gF) <= 0
//   break   yN >= 0, yF = 0                 slip+   gN - mu gF <= 0, yF >= 0
//   touch   gN - mu u gF <= 0, yF = 0       slip-   gN + mu gF <= 0, yF <= 0
//
// (u: the slip of a sliding contact; gF, yF where there is a friction row; for mu = 0 the middle is gN <= 0.)
// So if y'b < 0, y refutes every word in which each contact has a mode of which this holds. By Farkas's lemma
// an infeasible word has such a vector.
//
// In space a static contact has the modes break and touch, and the term is >= 0 throughout touch if and only if
//
//   touch   -gN >= mu abs(gF), yF = 0          (lengths by their squares; a sliding contact: gN <= mu u.gF, yF
//   = 0)
//
// which is all that Coulomb's law and (21), (22) both ask of fN, fF, aN, so the claim is of either. A problem
// without a solution need not have such vectors there: which way a contact slips is not in them.

#pragma once

#include <optional>
#include <string>

#include "certify/exact/modes.h"

namespace stiction {

struct FarkasVector {
  ExactVector y;
  ExactVector g;   // A'y
  Rational value;  // y'b
};

FarkasVector MakeFarkasVector(const ExactProblem& problem, const ExactVector& y);

// Whether the contact's term is >= 0 throughout the mode. `row` is the contact's normal row.
bool TermIsNonnegative(const Contact<Rational>& contact, int row, Mode mode, const FarkasVector& farkas,
                       int dimension = 2);

// Whether the vector refutes every completion of the prefix.
bool Refutes(const ExactProblem& problem, const ModeWord& prefix, const FarkasVector& farkas);

// Why it does not; empty if it does.
std::optional<std::string> FindRefutationGap(const ExactProblem& problem, const ModeWord& prefix,
                                             const FarkasVector& farkas);

}  // namespace stiction
