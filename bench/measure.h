// SPDX-License-Identifier: Apache-2.0
// Order statistics without interpolation.

#ifndef STICTION_BENCH_MEASURE_H_
#define STICTION_BENCH_MEASURE_H_

#include <vector>

namespace stiction {

// The values of rank n/4, n/2, 3n/4 and 9n/10, rounded down, from zero. Requires a value.
struct Quartiles {
  double low = 0, median = 0, high = 0, ninety = 0;
};
Quartiles QuartilesOf(std::vector<double> values);

struct Spread {
  double least = 0, median = 0, most = 0;
};
// Zeros if there are none.
Spread SpreadOf(std::vector<double> values);

}  // namespace stiction

#endif  // STICTION_BENCH_MEASURE_H_
