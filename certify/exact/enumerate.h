// SPDX-License-Identifier: Apache-2.0
// Enumeration: every word of contact modes (modes.h), an exact linear program each. All solutions, or a proof
// of none.
//
// Words are searched depth first by their prefixes, the contacts behind a prefix relaxed (RelaxedCone). An
// infeasible prefix ends the search below it with one Farkas vector (no_solution.cpp), which refutes all its
// completions.
//
// In space a word is refuted, or it is left open (RefuteInSpace): its programs have polygons around the
// friction cones (cones.h), so that what refutes them refutes the cones, with corners added where forces leave
// the cones.
//
// Cost          in the worst case the product of the numbers of modes.
// Exactness     programs with integer data, solved by CGAL's QP_solver over Gmpz, Bland's rule. Nothing that
//               it says is believed: witnesses and Farkas vectors are verified here over rationals.
// Determinism   the result depends on the problem alone.

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "certify/exact/modes.h"
#include "solver/problem/options.h"

namespace stiction {

// A word that has solutions.
struct WordSolution {
  ModeWord word;
  ExactVector f;        // one of them, a vertex in general: rows x 1 in N
  bool unique = false;  // no other f in this word (decided exactly)
};

struct RefutedPrefix {
  ModeWord modes;
  ExactVector y;  // integers without a common factor; no_solution.cpp says what it proves
};

enum class EnumerationEnd : std::uint8_t { kComplete, kStopped, kLimit, kOpen };

struct Enumeration {
  EnumerationEnd end = EnumerationEnd::kComplete;
  double decided = 0;                   // part of all words, 0 to 1
  std::vector<WordSolution> solutions;  // in the order of the words
  std::vector<RefutedPrefix> refuted;   // if complete: words and prefixes together cover every word once
  std::int64_t distinct_witnesses = 0;  // different f among the solutions, at the end
  std::int64_t prefixes = 0;            // visited
  std::int64_t programs = 0;            // linear programs solved to decide them
  std::int64_t reused_witnesses = 0;    // prefixes decided by the witness of the prefix before
  std::int64_t reused_vectors = 0;      // prefixes refuted by an earlier Farkas vector

  bool ProvesNoSolution() const { return end == EnumerationEnd::kComplete && solutions.empty(); }
};

// Called after every prefix with what there is so far; false ends the search, as limits.stop does.
using EnumerationWatch = std::function<bool(const Enumeration&)>;
// A watch to which the first solution in the order of the words is enough.
inline bool UntilSolved(const Enumeration& so_far) { return so_far.solutions.empty(); }

// Of the request limits.programs and limits.stop are read.

// Requires: a planar problem (otherwise InputError). Throws InternalError if a witness or a Farkas vector of
// the linear programs does not stand exact verification.
Enumeration EnumerateModes(const ExactProblem& problem, const Request& request = {},
                           const EnumerationWatch& watch = {});

// Requires: a problem in space (otherwise InputError). Ends as kOpen at the first word that no Farkas vector is
// found for; of `solutions` nothing is said.
Enumeration RefuteInSpace(const ExactProblem& problem, const Request& request = {},
                          const EnumerationWatch& watch = {});

}  // namespace stiction
