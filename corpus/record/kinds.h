// SPDX-License-Identifier: Apache-2.0
// Kinds of findings, the gravest first. A signature begins with its kind.
//
//   safe-cycle               a cycle of a problem that is safe (certify/claims/safe.h), as found or minimized:
//   there are
//                            such, with ties (certify/where_loops_begin.md)
//   disagreement-of-methods  exact methods contradict each other or what is proved (certify/claims/agreement.h)
//   cycle, stall, ...        an exact outcome other than solved, in space one that intervals prove
//   undecided                in space: a loop over doubles that intervals neither prove nor deny
//   wrong-answer             doubles said solved, with an error above the bound of the gate
//   disagreement             doubles ended in another outcome than exact numbers, of the same problem
//
// And of a solver under test (search/under_test/):
//
//   crash, hang, leak        its process ended, its budget of time did, its memory grows
//   not-finite               it called solved what has a force that is not finite
//   silent-wrong             or misses a condition of its law by more than the accuracy that it states
//   refused-solvable         it gave up, and there is a solution

#pragma once

#include <string>
#include <string_view>

namespace stiction {

inline constexpr std::string_view kSafeCycle = "safe-cycle";
inline constexpr std::string_view kDisagreementOfMethods = "disagreement-of-methods";

// 0 for the gravest kind, then 1; the same, 2, for all that are neither of the two above.
inline constexpr int Gravity(std::string_view kind) {
  return kind == kSafeCycle ? 0 : kind == kDisagreementOfMethods ? 1 : 2;
}
inline constexpr bool IsGrave(std::string_view kind) { return Gravity(kind) < 2; }

// A failure of a solver under test.
bool IsOfSolver(std::string_view kind);

// A failure of doubles, and none of the algorithm: wrong-answer, disagreement.
bool IsOfDoubles(std::string_view kind);

// A loop of the published algorithm: cycle, stall, safe-cycle.
bool IsLoopKind(std::string_view kind);

// What a signature begins with; the whole of one that begins with no kind.
std::string KindOf(const std::string& signature);

}  // namespace stiction
