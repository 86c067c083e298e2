// SPDX-License-Identifier: Apache-2.0
// Proofs that a run of the published algorithm in space never ends, or ends in a step that nothing limits.
//
// States   The sets of a state that remembers nothing else recur (solver/published/readings.md, 8).
// Boxes    What a state remembers beyond its sets are resting forces and recorded directions, a few coordinates
// x:
//          a force, or the tangent of half the angle of a direction. From all of a box around c the run takes
//          the same steps, every sign strict, to the same sets; so the period is a smooth map F of the
//          coordinates, and
//
//            abs(F(c) - c)_i + sum_j sup abs(dF_i / dx_j) r_j <= r_i
//
//          keeps it in the box for ever. A coordinate that the period leaves untouched is a parameter.
// Punctured boxes  A contact turns away with an aF that is zero at the fixed point of F, and nowhere else in
// the
//          box. The run comes into the box, and never to the fixed point (Endless).
// Endless  No state recurs, if besides F contracts, sum_j sup abs(dF_i / dx_j) r_j < r_i, takes different
// points
//          of the box to different ones, and moves the first.
// Rays     After the last step something is driven, and no limit is met, however far.
//
// certify/certificates.md, Loops in space, says what stands in a certificate, and has the proof.
//
// Numbers  FineInterval: as many bits as it takes, with derivatives.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "certify/exact/properties.h"
#include "certify/exact/rejected.h"
#include "corpus/exact_problem.h"
#include "solver/problem/options.h"

namespace stiction {

// What is stated of a run: bits and word, and where it loops the rest.
struct RunInSpace {
  int bits = 0;
  std::int64_t start = 0, period = 0;  // in drives; the first state of the main loop after so many
  // Every step from f = 0 to the end of one period, or to the one that nothing limits.
  std::vector<std::string> word = {};
  // Of a box, a number for each coordinate; empty for states.
  std::vector<int> charts =
      {};  // 0: a force; 1, -1: a direction, or its opposite, by the tangent of half its angle
  ExactVector centre = {}, radii = {};
  bool punctured = false;  // a box without the fixed point
  bool endless = false;    // whether it says that no state recurs

  bool IsBox() const { return radii.size() > 0; }
};

// What all require: dimension 3, frictionless and static contacts, PublishedReadsInSpace(policy).

// Empty if the run ends, or if no proof was found. What is returned has no fault.
std::optional<RunInSpace> ProveLoopInSpace(const ExactProblem& problem, const Policy& policy,
                                           const Limits& limits);
// The same, of a box in which no state recurs.
std::optional<RunInSpace> ProveEndlessInSpace(const ExactProblem& problem, const Policy& policy,
                                              const Limits& limits);
std::optional<Rejected> FindLoopFault(const ExactProblem& problem, const Policy& policy,
                                      const RunInSpace& loop);

std::optional<RunInSpace> ProveRayInSpace(const ExactProblem& problem, const Policy& policy,
                                          const Limits& limits);
std::optional<Rejected> FindRayFault(const ExactProblem& problem, const Policy& policy, const RunInSpace& ray);

}  // namespace stiction
