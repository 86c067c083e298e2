// SPDX-License-Identifier: Apache-2.0
// Contact modes: in a mode the law of a contact is a closed convex cone of (fN, fF, aN, aF):
//
//   kind                     mode          conditions
//   bilateral                hold          aN = 0                                     (fN free)
//   frictionless,            break         fN = 0,               aN >= 0
//     static with mu = 0     touch         fN >= 0,              aN = 0               (fF = 0, aF free)
//   sliding, velocity u      break         fN = fF = 0,          aN >= 0              (aF free)
//                            touch         fN >= 0,              aN = 0, fF = -mu u fN (aF free)
//   static with mu > 0       break         fN = fF = 0,          aN >= 0              (aF free)
//                            stick         abs(fF) <= mu fN,     aN = aF = 0
//                            slip+         fN >= 0, fF = -mu fN, aN = 0, aF >= 0
//                            slip-         fN >= 0, fF = +mu fN, aN = 0, aF <= 0
//
// The union of the modes of a contact is its law: (15), (16), (24) of [Baraff94]. A word names a mode for
// every contact. In the plane its conditions with a = A f + b are linear, so the solutions of a problem are a
// finite union of polyhedra, one per word; a degenerate solution lies in several.
//
// In space a static contact has break and touch whatever its mu; touch is fN >= 0, aN = 0, fF.fF <= mu^2 fN^2,
// aF free, which is no more than what its law implies. So words there can refute (no_solution.cpp), and not
// solve.

#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "certify/exact/linear_system.h"
#include "certify/exact/properties.h"
#include "corpus/json_text.h"

namespace stiction {

enum class Mode : std::uint8_t { kHold, kBreak, kTouch, kStick, kSlipPlus, kSlipMinus };

// "hold", "break", "touch", "stick", "slip+", "slip-".
std::string_view Name(Mode mode);

using ModeWord = std::vector<Mode>;  // one mode per contact, or for the first contacts: a prefix

// The modes of a contact, in the order of the search.
std::span<const Mode> ModesOf(const Contact<Rational>& contact, int dimension = 2);

// The number of words that begin with a prefix of this length; with length 0, of all words.
mpz_class Completions(const ExactProblem& problem, std::size_t length);

// All words: the last contact's mode changes fastest, each in the order of ModesOf.
std::vector<ModeWord> AllWords(const ExactProblem& problem);

// The law of one contact in one mode: forces are combinations of `edges` with coefficients >= 0 (or free),
// accelerations have the signs of the relations.
struct Cone {
  struct Edge {
    Rational f_t;  // of the force (1, f_t)
    bool free = false;
  };
  std::vector<Edge> edges;
  Relation a_n = Relation::kZero, a_t = Relation::kFree;
};
Cone ConeOf(const Contact<Rational>& contact, Mode mode);

// What all modes of the contact imply:
//
//   bilateral   aN = 0          frictionless, sliding, static   fN >= 0, aN >= 0, and fF = 0 (mu = 0),
//                                                               fF = -mu u fN (sliding), abs(fF) <= mu fN
//
// No convex relaxation of one contact is tighter: this is the sum of its modes, hence the convex hull of their
// union.
Cone RelaxedCone(const Contact<Rational>& contact);

// Whether f meets the conditions of the modes, and the relaxed ones of the contacts behind the prefix.
bool MeetsModes(const ExactProblem& problem, const ModeWord& prefix, const ExactVector& f,
                const ExactVector& a);

}  // namespace stiction
