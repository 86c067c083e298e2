// SPDX-License-Identifier: Apache-2.0
// What pages pack (reports/html/packed.h), as it was before.

#pragma once

#include <zlib.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace stiction {

inline std::vector<std::uint8_t> FromBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  int many = 0;
  for (const char c : text.substr(0, text.find('='))) {
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    many += 6;
    if (many >= 8) bytes.push_back(static_cast<std::uint8_t>(bits >> (many -= 8)));
  }
  return bytes;
}

// Of at most a megabyte.
inline std::string Unpacked(const std::string& packed) {
  const std::vector<std::uint8_t> bytes = FromBase64(packed);
  std::string text(1 << 20, '\0');
  uLongf size = text.size();
  if (uncompress(reinterpret_cast<Bytef*>(text.data()), &size, bytes.data(), bytes.size()) != Z_OK)
    throw std::runtime_error("found no deflated text");
  text.resize(size);
  return text;
}

}  // namespace stiction
