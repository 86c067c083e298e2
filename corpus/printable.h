// SPDX-License-Identifier: Apache-2.0
// What a foreign file holds, as messages and JSON can have it.

#pragma once

#include <string>
#include <string_view>

namespace stiction {

// Every byte that is no printable character of ASCII becomes '?'.
inline std::string Printable(std::string_view text) {
  std::string printable(text);
  for (char& c : printable) {
    if (c < ' ' || c > '~') c = '?';
  }
  return printable;
}

}  // namespace stiction
