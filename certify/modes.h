// SPDX-License-Identifier: Apache-2.0
// Enumeration: every contact mode, an exact linear program each. All solutions, or a proof of none.
//
// In a mode the law of a contact is a closed convex cone of (fN, fF, aN, aF):
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
// every contact. Its conditions with a = A f + b are linear, so the solutions of a problem are a finite union
// of polyhedra, one per word; a degenerate solution lies in several.
//
// Words are searched depth first by their prefixes. The contacts behind a prefix are relaxed to
//
//   bilateral   aN = 0          frictionless, sliding, static   fN >= 0, aN >= 0, and fF = 0 (mu = 0),
//                                                               fF = -mu u fN (sliding), abs(fF) <= mu fN
//
// which all their modes imply. No convex relaxation of one contact is tighter: this is the sum of its modes,
// hence the convex hull of their union. An infeasible prefix ends the search below it with one Farkas vector
// (no_solution.h), which refutes all its completions.
//
// Cost          in the worst case the product of the numbers of modes.
// Exactness     programs with integer data, solved by CGAL's QP_solver over Gmpz, Bland's rule. Nothing that
//               it says is believed: witnesses and Farkas vectors are verified here over rationals.
// Determinism   the result depends on the problem alone.

#ifndef STICTION_CERTIFY_MODES_H_
#define STICTION_CERTIFY_MODES_H_

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "certify/properties.h"

namespace stiction {

enum class Mode : std::uint8_t { kHold, kBreak, kTouch, kStick, kSlipPlus, kSlipMinus };

// "hold", "break", "touch", "stick", "slip+", "slip-".
std::string_view Name(Mode mode);

using ModeWord = std::vector<Mode>;  // one mode per contact, or for the first contacts: a prefix

// The modes of a planar contact, in the order of the search.
std::span<const Mode> ModesOf(const Contact<Rational>& contact);

// The first condition that f breaks, with its numbers; empty if f is a solution. Planar problems of all four
// kinds: (15); (16) for static, (24) for sliding contacts; aN = 0 for bilateral ones.
std::optional<std::string> FindLawViolation(const ExactProblem& problem, const ExactVector& f);

// Whether f meets the conditions of the modes, and the relaxed ones of the contacts behind the prefix.
bool MeetsModes(const ExactProblem& problem, const ModeWord& prefix, const ExactVector& f,
                const ExactVector& a);

struct EnumerationProgress {
  double decided = 0;  // part of all words, 0 to 1
  std::int64_t prefixes = 0;
  std::int64_t programs = 0;
  std::int64_t solutions = 0;
};

struct EnumerationOptions {
  bool first_solution_only = false;
  std::int64_t programs = 1000000;  // budget of linear programs
  // Called after every prefix; false cancels the search.
  std::function<bool(const EnumerationProgress&)> progress;
};

// A word that has solutions.
struct WordSolution {
  ModeWord word;
  ExactVector f;        // one of them, a vertex in general: rows x 1 in N
  bool unique = false;  // no other f in this word (decided exactly)
};

struct RefutedPrefix {
  ModeWord modes;
  ExactVector y;  // integers without a common factor; no_solution.h says what it proves
};

enum class EnumerationEnd : std::uint8_t { kComplete, kFirstSolution, kCancelled, kLimit };

struct Enumeration {
  EnumerationEnd end = EnumerationEnd::kComplete;
  std::vector<WordSolution> solutions;  // in the order of the words
  std::vector<RefutedPrefix> refuted;   // if complete: words and prefixes together cover every word once
  std::int64_t distinct_witnesses = 0;  // different f among the solutions
  std::int64_t prefixes = 0;            // visited
  std::int64_t programs = 0;            // linear programs solved to decide them
  std::int64_t reused_witnesses = 0;    // prefixes decided by the witness of the prefix before
  std::int64_t reused_vectors = 0;      // prefixes refuted by an earlier Farkas vector

  bool ProvesNoSolution() const { return end == EnumerationEnd::kComplete && solutions.empty(); }
};

// Requires: a planar problem (otherwise InputError). Throws InternalError if a witness or a Farkas vector of
// the linear programs does not stand exact verification.
Enumeration EnumerateModes(const ExactProblem& problem, const EnumerationOptions& options = {});

}  // namespace stiction

#endif  // STICTION_CERTIFY_MODES_H_
