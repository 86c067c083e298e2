// SPDX-License-Identifier: Apache-2.0
// Existence: a solution with its certificate, a proof that there is none, or neither.
//
// The cheapest method first: complete driving, which ends in a solution whenever A is symmetric positive
// semidefinite and b in range(A) (solver/complete/complete_driving.md), by certified signs where they suffice
// (filtered.h: the end is solved for and verified over rationals, not the way), with many rows the cells in
// which a run over doubles ends, solved likewise; then Lemke's method, whose path is another; both after
// bilateral constraints and sliding contacts have left the problem (solver/problem/reduction.h); then all
// contact modes, which decide every planar problem that is small enough. In space complete driving and Lemke's
// method on polygons and the point of the fast method (space.h), which find solutions of Coulomb's law up to a
// bound, or of (21), (22); then words of touching and separated contacts, which may refute both laws
// (no_solution.h).

#ifndef STICTION_CERTIFY_CLAIMS_EXISTENCE_H_
#define STICTION_CERTIFY_CLAIMS_EXISTENCE_H_

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "certify/exact/enumerate.h"
#include "corpus/json.h"
#include "solver/problem/answer.h"

namespace stiction {

struct Existence {
  // `solution-exists`, of Coulomb's law in space `coulomb-solution`, or `no-solution`; null if undecided.
  Json certificate;
  std::string_view method;  // that decided: complete, fast, lemke, enumerate; or "none"
  std::string reason = {};  // of what is undecided: how each method ended that was tried
};

// Any valid problem; the law is that of static contacts in space.
Existence DecideExistence(const ExactProblem& problem, const Limits& limits,
                          const EnumerationOptions& options = {}, FrictionLaw law = FrictionLaw::kBaraff);

}  // namespace stiction

#endif  // STICTION_CERTIFY_CLAIMS_EXISTENCE_H_
