// SPDX-License-Identifier: Apache-2.0
// Problems of the suite `gate`: dials of the plane (dials.h), more of them, and dials in space.
//
// What is added is drawn over rationals, too: A = J W J' with W > 0 diagonal, hence positive semidefinite, and
// b = J y in its range, but where the dial says otherwise. J is that of bodies which touch each other or rest
// on the ground, with one to four contacts as a rule; names of dials in space begin with "space-". All numbers
// come from integers that are drawn, so that they are the same on every machine.

#ifndef STICTION_BENCH_GATE_DIALS_H_
#define STICTION_BENCH_GATE_DIALS_H_

#include <string>
#include <vector>

#include "bench/sources.h"

namespace stiction {

// Of the dials that are named, all if none is, at all their settings. InputError names one that is not known.
std::vector<Source> GateSources(const std::vector<std::string>& families);

}  // namespace stiction

#endif  // STICTION_BENCH_GATE_DIALS_H_
