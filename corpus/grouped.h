// SPDX-License-Identifier: Apache-2.0
// Large numbers for people.

#ifndef STICTION_CORPUS_GROUPED_H_
#define STICTION_CORPUS_GROUPED_H_

#include <cstddef>
#include <cstdint>
#include <string>

namespace stiction {

// 1234567 -> "1,234,567".
inline std::string Grouped(std::int64_t value) {
  std::string digits = std::to_string(value);
  const std::ptrdiff_t first = value < 0 ? 1 : 0;
  for (std::ptrdiff_t i = static_cast<std::ptrdiff_t>(digits.size()) - 3; i > first; i -= 3)
    digits.insert(static_cast<std::size_t>(i), ",");
  return digits;
}

}  // namespace stiction

#endif  // STICTION_CORPUS_GROUPED_H_
