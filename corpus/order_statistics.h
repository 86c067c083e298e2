// SPDX-License-Identifier: Apache-2.0
// Order statistics without interpolation.

#pragma once

#include <algorithm>
#include <vector>

namespace stiction {

struct Quartiles {
  double least = 0, low = 0, median = 0, high = 0, ninety = 0, most = 0;
};

// The values of rank 0, n/4, n/2, 3n/4 and 9n/10, rounded down, and n - 1. Zeros if there are none.
inline Quartiles QuartilesOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {values[0], values[n / 4], values[n / 2], values[3 * n / 4], values[9 * n / 10], values[n - 1]};
}

}  // namespace stiction
