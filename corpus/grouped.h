// SPDX-License-Identifier: Apache-2.0
// Large numbers, and how many of what, for people.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace stiction {

// 1234567 -> "1,234,567".
inline std::string Grouped(std::int64_t value) {
  std::string digits = std::to_string(value);
  const std::ptrdiff_t first = value < 0 ? 1 : 0;
  for (std::ptrdiff_t i = static_cast<std::ptrdiff_t>(digits.size()) - 3; i > first; i -= 3)
    digits.insert(static_cast<std::size_t>(i), ",");
  return digits;
}

// "contacts", "prefixes", "bodies"; of several words the last one is counted.
inline std::string Plural(std::string_view noun) {
  const std::string word(noun);
  const auto ends = [&noun](std::string_view tail) { return noun.ends_with(tail); };
  if (ends("x") || ends("s") || ends("ch") || ends("sh")) return word + "es";
  const bool behind_vowel =
      noun.size() > 1 && std::string_view("aeiou").find(noun[noun.size() - 2]) != noun.npos;
  if (ends("y") && !behind_vowel) return word.substr(0, word.size() - 1) + "ies";
  return word + "s";
}

// "1 problem", "2,345 problems".
inline std::string Counted(std::int64_t count, std::string_view noun) {
  return Grouped(count) + " " + (count == 1 ? std::string(noun) : Plural(noun));
}

}  // namespace stiction
