// SPDX-License-Identifier: Apache-2.0
// Choices read from bytes: any bytes are a sequence of choices, and those that are not there are zeros.

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace stiction::fuzz {

class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : rest_(bytes) {}

  // In [low, high], at most 2^16 values. A zero byte is the value nearest zero.
  int Integer(int low, int high) {
    const int range = high - low + 1;
    unsigned word = Byte();
    if (range > 256) word = 256 * word + Byte();
    const int zero = std::clamp(0, low, high), value = zero + static_cast<int>(word % range);
    return value <= high ? value : value - range;
  }

  // The first item for a zero byte.
  template <class T, std::size_t Count>
  const T& Pick(const std::array<T, Count>& items) {
    static_assert(0 < Count && Count <= 256);
    return items[static_cast<std::size_t>(Integer(0, static_cast<int>(Count) - 1))];
  }

 private:
  unsigned Byte() {
    if (rest_.empty()) return 0;
    const auto byte = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    return byte;
  }

  std::string_view rest_;
};

}  // namespace stiction::fuzz
