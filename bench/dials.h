// SPDX-License-Identifier: Apache-2.0
// Dials: families of planar problems, each with one number that is turned until arithmetic gives way.
//
// All are drawn over rationals: A = J W J' with W > 0 diagonal, hence positive semidefinite, and b = J y in its
// range, but where the dial says otherwise. J is that of bodies with three degrees of freedom each, which touch
// in points or rest on the ground, where the dial does not say what it is. A setting is an exponent of ten
// unless `unit` says what it is.

#ifndef STICTION_BENCH_DIALS_H_
#define STICTION_BENCH_DIALS_H_

#include <string>
#include <vector>

#include "corpus/problem_file.h"
#include "search/choices.h"

namespace stiction {

struct Dial {
  std::string name, title, unit;
  std::vector<int> settings;
  bool has_solution = true;  // by what is said above
  ExactProblem (*make)(int setting, Choices& choices);
  bool is_large = false;  // takes long over rationals
};

// In the order of the tables.
const std::vector<Dial>& Dials();
// Null if none has this name.
const Dial* FindDial(const std::string& name);

// Problem `index` of a dial at a setting: a function of its arguments.
ExactProblem MakeDialProblem(const Dial& dial, int setting, std::uint64_t seed, std::int64_t index);

}  // namespace stiction

#endif  // STICTION_BENCH_DIALS_H_
