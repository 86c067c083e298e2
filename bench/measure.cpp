// SPDX-License-Identifier: Apache-2.0
#include "bench/measure.h"

#include <algorithm>

namespace stiction {

Quartiles QuartilesOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {values[n / 4], values[n / 2], values[3 * n / 4], values[9 * n / 10]};
}

Spread SpreadOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return {values.front(), values[values.size() / 2], values.back()};
}

}  // namespace stiction
