// SPDX-License-Identifier: Apache-2.0
// Safe problems: where every reduced determinant is positive, the path of forces never turns back.
//
// For a word of modes W (modes.h) let R(W) be the reduced matrix of [Baraff94], 5.3:
//
//   mode of a contact    rows    columns             complete_driving.md
//   break                none    none                B
//   touch                N       A_N                 0
//   stick                N, F    A_N, A_F            S
//   slip+, slip-         N       A_N - mu A_F, A_N + mu A_F     -, +
//
// *Safe*: det R(W) > 0 for all words of all contacts. This is a property of A and mu alone. Contacts that are
// absent, or whose variables are not established yet, ask for no more:
//
//   - a contact that is not there is one in `break`: same rows, same columns;
//   - a static contact with mu > 0 that is clamped but has no friction yet has the column A_N, the mean of
//     those of slip- and slip+, and the same row.
//     A determinant is linear in each column; so with any number of such contacts it is the mean of the
//     determinants of words, and positive in a safe problem.
//
// What follows (proved; complete_driving.md, 4, and here), whatever else A is, symmetric or not:
//
//   - in a stage with driven variable v, side df_v = 1 and side da_v = det R(W with v) / det R(W) > 0 on every
//     piece: no fold, no descent, and no ray, since a_v reaches zero. So for every b there is a solution;
//   - for nondegenerate b it is the only one: another would be the end of a path that joins two solutions of
//     opposite sign;
//   - under `apex=suspended` (readings.md) the published algorithm gives nothing up, in whatever order it takes
//     the variables (b nondegenerate for that order too): the pieces before and behind a facet have df_v of one
//     sign, so no step of length zero leads back through the facet just crossed.
//
// Not so under `apex=kept`, hence `paper`: there a friction variable can be in CF while fN = 0, with row F and
// column A_F. That is a fifth mode, of which safety says nothing; safe_test.cpp has a safe problem of two
// contacts in which `paper` gives up. If the determinants with this mode are positive too, nothing is given up
// for b in general position, but under give-up=previous (proved; where_loops_begin.md, which also has loops of
// safe problems with ties).
//
// A body with two sticking contacts has a singular word, so A of most scenes is not safe. *Weakly safe*: no
// determinant is negative. Then (proved; condition_number.md) complete driving has no fold and no descent, at
// most pieces with df_v = 0, whatever b; if A is symmetric semidefinite and b in range(A) + K*, b(eps) of
// complete_driving.md, 5, has one solution. The published algorithm gives nothing up under `apex=suspended`,
// for b nondegenerate in its order, as long as the matrices that it meets are regular; what it does at singular
// ones is open. *Safe in the limit*: A + eps I is safe for all small eps > 0, as a solver makes it that softens
// its constraints. The determinants of A + eps I are det(R(W) + eps I), whose coefficients are those of the
// characteristic polynomial of -R(W); the last of them is 1, so that the sign for small eps > 0, that of the
// first which is not zero, is always known. Safe in the limit implies weakly safe (eps = 0), not conversely.
// (Units matter here: A + eps D, D diagonal and positive, may differ where A is weakly safe and no more.)
//
// A positive definite is safe for all mu small enough: for mu = 0 the determinants are principal minors.
//
// Decided by elimination down the tree of words: det R(W) is the product of the pivot blocks of its contacts in
// the successive Schur complements. They are positive as long as all determinants are, so no zero is divided
// by. Checked without it: every matrix is written down and its determinant found by Gaussian elimination.

#pragma once

#include <optional>
#include <vector>

#include "certify/exact/modes.h"

namespace stiction {

// More words than these, the first so many of them positive, are not decided: InputError.
inline constexpr int kMaxSafetyWords = 1 << 16;

// R(W), and its determinant. Requires: one mode for every contact, of its kind; slip+-, stick for mu = 0 too.
ExactMatrix ReducedMatrix(const ExactProblem& problem, const ModeWord& word);
Rational ReducedDeterminant(const ExactProblem& problem, const ModeWord& word);

struct Safety {
  // In the order of words: the last contact's mode changes fastest, each in the order of ModesOf.
  std::vector<Rational>
      determinants;  // of all words; of an unsafe problem up to the first that is not positive
  std::optional<ModeWord> unsafe_word;  // that one
};

// What safety is about: a planar problem of frictionless and static contacts; otherwise InputError. The
// functions below, and FindSafetyThreshold, require it.
void RequireSafetyDecidable(const ExactProblem& problem);

// The same, by its place in `source`.
void RequireSafetyIsSaid(const ExactProblem& problem, const std::string& source);
// The same, of a certificate: otherwise Rejected.
void RequireClaimableSafety(const ExactProblem& problem);

// Whether there are at most so many words, whatever mu.
bool HasFewWords(const ExactProblem& problem, int most = kMaxSafetyWords);

Safety DecideSafety(const ExactProblem& problem);

// As above. Every word is looked at, and singular ones more than once: seconds for so many.
inline constexpr int kMaxWeakSafetyWords = 1 << 12;
struct WeakSafety {
  int vanishing = 0;                      // words whose determinant is zero
  std::optional<ModeWord> negative_word;  // the first whose determinant is negative: not weakly safe
  std::optional<ModeWord>
      limit_word;  // the first whose determinant is negative for A + eps I: not safe in the limit
};
WeakSafety DecideWeakSafety(const ExactProblem& problem);

// det(R + eps I): coefficients of 1, eps, ..., eps^n = 1.
std::vector<Rational> ShiftedDeterminant(const ExactMatrix& R);

// Whether it is safe; empty for more than kMostContactsOfSafety contacts, 4^n determinants.
inline constexpr int kMostContactsOfSafety = 5;
std::optional<bool> IsSafeIfSmall(const ExactProblem& problem);

// `safe` or `unsafe`.
Json SafetyCertificate(const ExactProblem& problem);
// The same; null where there are too many words, the first of them all positive.
Json SafetyCertificateIfDecided(const ExactProblem& problem);

// WitnessChecks (witness.h). Facts: words, smallest; word, determinant.
Json CheckSafe(const ExactProblem& problem, const Json& witness);
Json CheckUnsafe(const ExactProblem& problem, const Json& witness);

}  // namespace stiction
