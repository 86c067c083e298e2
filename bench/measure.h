// SPDX-License-Identifier: Apache-2.0
// What one method made of one problem, and what can be said of several of them.

#ifndef STICTION_BENCH_MEASURE_H_
#define STICTION_BENCH_MEASURE_H_

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/problem/solution.h"

namespace stiction {

struct Measure {
  Outcome outcome = Outcome::kUndecided;
  bool wrong = false;          // solved, it says, and verification refuses the answer
  bool refutes = false;        // exact, and says that there is no solution, or meets a ray
  double seconds = 0;          // without the verification of the answer
  double library_seconds = 0;  // part of it: in Ipopt's process

  bool Solved() const { return outcome == Outcome::kSolved && !wrong; }
};

// Order statistics without interpolation: the values of rank n/4, n/2, 3n/4 and 9n/10, rounded down, from zero.
// Requires a value.
struct Quartiles {
  double low = 0, median = 0, high = 0, ninety = 0;
};
Quartiles QuartilesOf(std::vector<double> values);

struct Spread {
  double least = 0, median = 0, most = 0;
};
// Zeros if there are none.
Spread SpreadOf(std::vector<double> values);

// What cannot be true of the measures of one problem: an exact answer that is wrong, or one method that refutes
// what another has solved. Empty if there is nothing.
struct NamedMeasure {
  std::string name;
  bool exact = false;
  Measure measure;
};
std::optional<std::string> FindMismatch(std::span<const NamedMeasure> measures);

}  // namespace stiction

#endif  // STICTION_BENCH_MEASURE_H_
