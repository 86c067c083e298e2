// SPDX-License-Identifier: Apache-2.0
// Many problems of two, three or four contacts at once: one to a lane of the processor's vectors.
//
// A lane does what PublishedAlgorithm<double, Rows> does under the policy `paper`, operation by operation in
// the same order, without contractions: what it ends with is equal to the bit. It does so only on the common
// path, on which every drive puts its variable into a set, nothing is given up, and the end is a solution. A
// problem that leaves this path is *left*: the caller runs it by the algorithm itself.
//
// Shapes      static contacts of the plane, Rows = 4, 6 or 8: fN1, fF1, fN2, fF2, ...
// Exactness   lanes do not touch each other: results do not depend on the instruction set, nor on what is
// beside.

#pragma once

#include <span>
#include <vector>

#include "search/generators/generators.h"
#include "search/lanes/block.h"
#include "search/lanes/instructions.h"
#include "solver/problem/options.h"
#include "solver/problem/solution.h"

namespace stiction {

// Whether runs of this request can be batched at all.
bool IsBatched(const Request& request);
// Whether there are lanes for so many rows.
constexpr bool HasLanes(int rows) { return rows == 4 || rows == 6 || rows == 8; }
// Whether lanes can draw problems of a generator themselves.
bool IsDrawnInLanes(GeneratorId id);

template <int Rows>
class Batch {
 public:
  using Problem = ContactProblem<double, Rows>;

  // Requires one of InstructionSets() other than kNone, and IsBatched(request).
  Batch(InstructionSet set, const Request& request);

  // Makes `problem` number i of the block, and back: static contacts.
  void Put(int i, const Problem& problem, const Drawn& drawn);
  void Get(int i, Problem& problem) const;
  Drawn DrawnOf(int i) const { return {block_.friction[i], block_.columns[i]}; }
  // Draws problems first, ..., first + count - 1 of a unit: those of Generate, to the bit. Requires
  // IsDrawnInLanes(id); a palette that stays as it is.
  void Draw(GeneratorId id, std::span<const MuChoice> palette, std::uint64_t seed, std::uint64_t unit,
            std::int64_t first, int count);
  // Runs the first `count` problems.
  void Run(int count);

  // What the algorithm says of problem i. Requires !IsLeft(i).
  Verdict VerdictOf(int i) const;
  bool IsLeft(int i) const { return block_.ends[i].is_left; }
  double Force(int i, int row) const { return block_.f[row][i]; }
  // The largest of MeasureLeniently (solver/problem/lenient.h), with accelerations computed anew.
  double Error(int i) const { return block_.error[i]; }

 private:
  LaneCode<Rows> code_;
  LaneTolerances tolerances_;
  std::vector<double> mu_;
  Block<Rows> block_;
};

}  // namespace stiction
