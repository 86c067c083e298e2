// SPDX-License-Identifier: Apache-2.0
// What the code for one instruction set is given, and gives back: plain numbers. This header has no functions,
// since a function that is compiled for several instruction sets under one name may end up in the wrong
// program.

#pragma once

#include <cstdint>

namespace stiction {

inline constexpr int kBlockProblems = 256;
inline constexpr int kMostLanes = 8;
inline constexpr int kBlockRoom = kBlockProblems + kMostLanes;  // whole vectors are read

// Counters of a run, as in Statistics. Nothing is given up, and every step is a pivot.
struct LaneEnd {
  bool is_left;  // nothing else is meant then
  std::uint8_t drives, steps, zero_steps, longest_zero_run, singular_directions;
};

// Problems of Rows / 2 contacts, one to a column, and how they end.
template <int Rows>
struct Block {
  alignas(64) double A[Rows][Rows][kBlockRoom];
  alignas(64) double b[Rows][kBlockRoom];
  alignas(64) double mu[Rows / 2][kBlockRoom];
  // Of problems that were drawn in lanes: the number in the palette of the friction that all contacts have, or
  // -1, and the columns of J.
  std::int32_t friction[kBlockRoom];
  std::int32_t columns[kBlockRoom];
  LaneEnd ends[kBlockProblems];
  double f[Rows][kBlockRoom];
  double error[kBlockRoom];  // the largest, with accelerations computed anew
};

// Of Scale, before they are multiplied by the numbers of a problem.
struct LaneTolerances {
  double acceleration, force, pivot;
};

// Generators whose problems lanes can draw.
enum class LaneFamily : std::uint8_t { kIntegers, kPsd, kSmall };

struct LaneDraw {
  LaneFamily family;
  std::uint64_t unit_seed;  // of the unit: ProblemSeed is Mix(unit_seed + odd (index + 1))
  std::uint64_t odd;
  std::int64_t first;
  int count;
  const double* mu;  // the palette
  std::uint64_t palette;
};

// Functions of one instruction set for so many rows.
template <int Rows>
struct LaneCode {
  void (*run)(Block<Rows>& block, int count, const LaneTolerances& tolerances);
  void (*draw)(Block<Rows>& block, const LaneDraw& draw);
};
struct LaneCodes {
  LaneCode<4> two_contacts;
  LaneCode<6> three_contacts;
  LaneCode<8> four_contacts;
};

extern const LaneCodes kAvx2Lanes, kAvx512Lanes;

}  // namespace stiction
