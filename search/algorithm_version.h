// SPDX-License-Identifier: Apache-2.0
// The version of what searches compute.
//
// The same problem (seed, unit, index) under the same version takes the same steps and ends the same way, by
// the published algorithm, complete driving and Lemke's method alike. tests/search/algorithm_version_test.cpp
// holds traces that were recorded under it. Whoever changes them on purpose raises it, so that no
// store mixes what was computed under both.

#pragma once

namespace stiction {

inline constexpr int kAlgorithmVersion = 1;

// Of what is counted of runs besides their steps and ends: which answers of doubles are wrong, which loops in
// space are proved, which problems are audited. A store is gone on with, and merged, under one such version; it
// is raised with the other, too.
inline constexpr int kCountsVersion = 6;

// Of a search that tests a solver: raised with these, and with what its answers, hangs and leaks are judged by.
inline constexpr int kJudgeVersion = kCountsVersion + 4;

}  // namespace stiction
