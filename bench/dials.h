// SPDX-License-Identifier: Apache-2.0
// Sources of problems: dials, families with one number that is turned until arithmetic gives way, and the
// generators of the search.
//
// All are drawn over rationals: A = J W J' with W > 0 diagonal, hence positive semidefinite, and b = J y in its
// range, but where the dial says otherwise. J is that of bodies which touch each other or rest on the ground,
// with one to four contacts as a rule. All numbers come from integers that are drawn, so that they are the same
// on every machine.

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "corpus/exact_problem.h"

namespace stiction {

// A dial at a setting, an exponent of ten as a rule, or a generator at a number of contacts.
struct Source {
  std::string family;
  int setting = 0;
  bool has_solution = true;  // that there is one is known
  bool is_large = false;     // takes long over rationals
  std::function<ExactProblem(std::uint64_t seed, std::int64_t index)> make;
};

// kLadder: of the plane, for every arithmetic. kGate: in space too, and more where what is solved is in doubt.
enum class Dials { kLadder = 1, kGate = 2 };

// The dials that are named, all if none is, at all their settings. InputError names one that is not known.
std::vector<Source> DialSources(Dials which, const std::vector<std::string>& families);

// All generators of static contacts of the plane, at each of the sizes.
std::vector<Source> GeneratorSources(const std::vector<int>& sizes);

}  // namespace stiction
