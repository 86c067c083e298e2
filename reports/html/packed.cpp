// SPDX-License-Identifier: Apache-2.0
#include "reports/html/packed.h"

#include <zlib.h>

#include <cstdint>
#include <string_view>
#include <vector>

#include "solver/problem/check.h"

namespace stiction {

namespace {

std::string Base64(const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? bytes[i + k] : 0);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kDigits[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace

std::string Packed(const std::string& plain) {
  uLongf size = compressBound(plain.size());
  std::vector<std::uint8_t> bytes(size);
  const int code = compress2(bytes.data(), &size, reinterpret_cast<const Bytef*>(plain.data()), plain.size(),
                             Z_DEFAULT_COMPRESSION);
  STICTION_CHECK(code == Z_OK, "zlib: found an error, expected room for what it deflates");
  bytes.resize(size);
  return Base64(bytes);
}

}  // namespace stiction
