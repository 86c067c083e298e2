// SPDX-License-Identifier: Apache-2.0
// Where the other readings of a policy's switches leave its path: which step is the text's, and which a choice.

#ifndef STICTION_CLI_NARRATION_PARTINGS_H_
#define STICTION_CLI_NARRATION_PARTINGS_H_

#include <vector>

#include "certify/exact/solve.h"

namespace stiction {

// The policy with another value of one switch: its run is the same up to a step, counted from 0, and then not.
struct Parting {
  std::size_t step = 0;
  const PolicySwitchRow* row = nullptr;
  int value = 0;                          // the other one
  Outcome outcome = Outcome::kUndecided;  // of the other run
};

// One switch at a time, in table order; values that leave the path nowhere are left out. Planar, over
// rationals. Runs of the other policies end in `limit` after some multiple of the steps of this one.
std::vector<Parting> PartingsOf(const ExactProblem& problem, const Policy& policy, const Limits& limits,
                                const std::vector<Pivot<Rational>>& pivots);

}  // namespace stiction

#endif  // STICTION_CLI_NARRATION_PARTINGS_H_
