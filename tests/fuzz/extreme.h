// SPDX-License-Identifier: Apache-2.0
// Problems with dials at their extremes, made from choices. tests/setup/extremes.py turns one dial at a time
// and judges the program from outside, a process a run; this is for millions of runs.

#pragma once

#include "corpus/exact_problem.h"
#include "tests/fuzz/bytes.h"

namespace stiction::fuzz {

// A valid problem of at most four contacts of all kinds, in the plane or in space, A = J W J', b = J c, and
// then as the bytes say: masses from 1e-300 to 1e300, contacts that repeat others or are parallel to them up to
// 1e-16, b off the range by as little, A neither symmetric nor semidefinite, rows in other units, mu from 1e-16
// to 1e16, A and b times powers of ten to 1e300, single entries that are subnormal, huge or zero. No bytes, or
// zeros: an ordinary problem.
ExactProblem ExtremeProblem(Bytes& bytes);

}  // namespace stiction::fuzz
